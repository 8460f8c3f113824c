// SMASH=../target/release/smash node screenshots.mjs
//
// Takes the pictures of docs/, all of scenes/thrown_ball_drag.json: the report, light and dark, with
// the difference drawn five times as large; the studio after one effect was added.

import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import { folder, launch, open, ROOT, scene, SMASH, smash } from './tests/browser.mjs';

const browser = await launch();
const picture = (name) => ({ path: join(ROOT, 'docs', `${name}.png`) });

async function ofReport() {
  const report = join(folder, 'report.html');
  smash('report', scene('thrown_ball_drag'), '-o', report);
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
    await page.screenshot(picture(name));
    await close();
  }
}

async function ofStudio() {
  const name = 'thrown_ball_drag.json';
  copyFileSync(join(ROOT, 'scenes', name), join(folder, name));
  const args = ['studio', name, '--json', '--no-open'];
  const studio = spawn(SMASH, args, { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
  const [line] = await once(studio.stdout, 'data');
  const page = await browser.newPage({ viewport: { width: 1280, height: 1060 } });
  await page.goto(JSON.parse(line).address);
  await page.getByTestId('add-quadratic_drag@ball').click();
  await page.locator('.fell').waitFor();
  await page.getByTestId('diagnosing').waitFor();
  await page.getByTestId('explanation').waitFor({ timeout: 120_000 });
  await page.screenshot(picture('studio'));
  await page.close();
  studio.kill();
}

await ofReport();
await ofStudio();
await browser.close();
