// The studio in a browser, against the real server.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { folder, open, scene, until } from './browser.mjs';
import { BASE, WITH_DRAG, browser, opened, rmse, served, shows, tried, typedElsewhere } from './studio.mjs';

test('an effect is added, the error falls, and undo and redo go back and forth', () =>
  tried(async (page) => {
    await shows(page, BASE);
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    assert.match(await page.getByTestId('fit-error').textContent(), /7\.1\d mm → 0\.98\d* mm/);
    await page.getByTestId('undo').click();
    await shows(page, BASE);
    await page.getByTestId('redo').click();
    await shows(page, WITH_DRAG);
    await page.getByTestId('remove-quadratic_drag@ball').click();
    await shows(page, BASE);
    // Three variants, and none is lost.
    await page.getByTestId('variant-1').click();
    await shows(page, WITH_DRAG);
    assert.equal(await page.getByTestId('variant-2').count(), 1);
  }));

test('variants stand side by side', () =>
  tried(async (page) => {
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    await page.getByTestId('compare-0').check();
    await until(
      () => page.content(),
      (html) => html.includes('0: base model'),
      'the base model',
    );
    // In the same plots, with its dash.
    await page.locator('.plots-legend', { hasText: 'Lines: 0: base model' }).waitFor();
    await page.getByTestId('compare-0').uncheck();
    await until(
      () => page.getByTestId('compare-0').isChecked(),
      (isChecked) => !isChecked,
      'the box',
    );
  }));

test('keys undo and redo, but where one types they are the text’s', () =>
  tried(async (page) => {
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    await page.keyboard.press('Control+z');
    await shows(page, BASE);
    await page.keyboard.press('Control+Shift+Z');
    await shows(page, WITH_DRAG);
    const text = page.getByTestId('law-text');
    await text.click();
    await page.keyboard.type('a');
    await page.keyboard.press('Control+z');
    await until(
      () => text.inputValue(),
      (typed) => typed === '',
      'the law',
    );
    assert.match(await rmse(page), WITH_DRAG);
    await page.getByTestId('show-keys').click();
    assert.match(await page.getByTestId('keys').textContent(), /Ctrl Zundo/);
  }));

test('the first window shows the collision, and why an effect can’t be added', () =>
  tried(async (page) => {
    await page.getByTestId('explanation').waitFor();
    const stage = await page.getByTestId('stage').boundingBox();
    assert.ok(stage.y + 150 < 900, `the stage starts at ${stage.y}`);
    const effects = await page.getByTestId('catalogue').locator('li').allTextContents();
    assert.ok(
      effects.some((one) => one.startsWith('Magnus') && one.endsWith('this scene has no orientations')),
      effects.join('\n'),
    );
  }));

test('a saved session opens in another studio, and the report needs none', () =>
  tried(async (page, studio, file) => {
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    const saved = async (what) => {
      const [download] = await Promise.all([
        page.waitForEvent('download'),
        page.getByTestId(`save-${what}`).click(),
      ]);
      const path = join(folder, `saved-${what}.${what === 'report' ? 'html' : 'json'}`);
      await download.saveAs(path);
      return path;
    };
    const [session, report] = [await saved('session'), await saved('report')];
    assert.equal(JSON.parse(readFileSync(session, 'utf8')).schema, 'smash.session/1');
    const offline = await open(browser, report);
    assert.match(await offline.page.getByTestId('verdict').textContent(), /0\.98/);
    assert.deepEqual(offline.errors, []);
    await offline.close();

    await studio.kill();
    const again = await served(file);
    const other = await opened(again.address);
    // Going on where it was.
    await shows(other.page, WITH_DRAG);
    await other.page.getByTestId('undo').click();
    await shows(other.page, BASE);
    await other.page.getByTestId('open-session').setInputFiles(session);
    await shows(other.page, WITH_DRAG);
    assert.equal(await other.page.getByTestId('variant-2').count(), 0, 'nothing is doubled');
    await other.close();
    await again.kill();
    // The first page has lost its server, and says so.
    await page.getByTestId('banner').waitFor({ state: 'visible' });
  }));

test('two browsers see the same', () =>
  tried(async (page, studio) => {
    const other = await opened(studio.address);
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    // It asks every few seconds.
    await shows(other.page, WITH_DRAG).catch(() => shows(other.page, WITH_DRAG));
    await other.page.getByTestId('undo').click();
    await shows(other.page, BASE);
    await shows(page, BASE).catch(() => shows(page, BASE));
    assert.deepEqual(other.errors, []);
    await other.close();
  }));

test('an answer that an act has overtaken shows nothing old', () =>
  tried(async (page) => {
    const answers = [];
    await page.route('**/api/state', async (route) => {
      const response = await route.fetch();
      answers.push(() => route.fulfill({ response }));
    });
    const asked = page.waitForRequest('**/api/state');
    await typedElsewhere(page);
    await asked;
    // It reads the state before the act, and answers after it.
    const answer = await until(() => answers.shift(), Boolean, 'the state');
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    // The page asks again once it has taken that answer in.
    const again = page.waitForResponse('**/api/revision');
    await answer();
    await again;
    assert.match(await rmse(page), WITH_DRAG);
  }));

test('a diagnosis that an act has overtaken is asked for again', () =>
  tried(async (page) => {
    let asked = 0;
    await page.route('**/api/diagnosis', async (route) => {
      asked += 1;
      // As the server answers where another variant is seen by now.
      if (asked === 1) await route.fulfill({ json: null });
      else await route.continue();
    });
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    await until(
      () => page.getByTestId('diagnosing').count(),
      (count) => asked > 1 && count === 0,
      'the diagnosis',
    );
    assert.deepEqual((await page.getByTestId('error').allTextContents()).filter(Boolean), []);
  }));

test('the state is fetched only when there is a newer one', () =>
  tried(async (page) => {
    const asked = [];
    page.on('request', (request) => asked.push(request.url().split('/api/')[1]));
    for (let polls = 0; polls < 2; polls += 1) await page.waitForResponse('**/api/revision');
    assert.ok(!asked.includes('state'), `${asked}`);
    const fetched = page.waitForResponse('**/api/state');
    await typedElsewhere(page);
    await fetched;
    await until(
      () => page.getByTestId('law-text').inputValue(),
      (law) => law === 'name = "theirs',
      'the law',
    );
  }));

test('a killed studio is announced, and started again has all', async () => {
  const file = scene('thrown_ball_drag');
  const studio = await served(file);
  const { page, close } = await opened(studio.address);
  await page.getByTestId('add-quadratic_drag@ball').click();
  await shows(page, WITH_DRAG);
  await page.getByTestId('law-text').fill('name = "half');
  await until(
    () => page.getByTestId('mistake').count(),
    (count) => count > 0,
    'the mistake',
  );
  await studio.kill();
  await page.getByTestId('undo').click();
  await page.getByTestId('banner').waitFor({ state: 'visible' });
  await close();
  const again = await served(file);
  const { page: next, errors, close: closeNext } = await opened(again.address);
  await shows(next, WITH_DRAG);
  assert.equal(await next.getByTestId('law-text').inputValue(), 'name = "half');
  assert.deepEqual(errors, []);
  await closeNext();
  await again.kill();
});
