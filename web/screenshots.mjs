// SMASH=../target/release/smash node screenshots.mjs
//
// Takes the pictures of docs/: the report of scenes/thrown_ball_drag.json, light and dark, as it
// opens; the difference drawn five times as large.

import { join } from 'node:path';
import { folder, launch, open, ROOT, scene, smash } from './tests/browser.mjs';

const report = join(folder, 'report.html');
smash('report', scene('thrown_ball_drag'), '-o', report);

const browser = await launch();
for (const [name, colorScheme] of [
  ['report', 'light'],
  ['report-dark', 'dark'],
]) {
  const { page, close } = await open(browser, report, {
    colorScheme,
    viewport: { width: 1280, height: 1060 },
  });
  // The base model, which misses: what one wants to see first.
  await page.getByLabel('base model').check();
  await page.getByTestId('exaggeration').selectOption('5');
  await page.waitForTimeout(500);
  await page.screenshot({ path: join(ROOT, 'docs', `${name}.png`) });
  await close();
}
await browser.close();
