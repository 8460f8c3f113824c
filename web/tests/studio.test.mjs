// The studio in a browser, against the real server.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ROOT, folder, launch, open, scene, until } from './browser.mjs';

const SMASH = process.env.SMASH ?? join(ROOT, 'target', 'debug', 'smash');
/** What the browser itself says of a refusal, or of a server that is gone: the page tells both. */
const KNOWN = /status of 409|ERR_CONNECTION/;
const BASE = /7\.1\d mm/;
const WITH_DRAG = /0\.98\d* mm/;

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** A studio of a scene's file, at its address. */
async function served(file) {
  const child = spawn(SMASH, ['studio', file, '--json', '--no-open'], {
    cwd: folder,
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const told = await new Promise((resolve, reject) => {
    let text = '';
    child.stdout.on('data', (data) => {
      text += data;
      if (text.includes('\n')) resolve(JSON.parse(text));
    });
    child.on('exit', () => reject(new Error('the studio ended')));
  });
  const ended = new Promise((resolve) => {
    child.on('exit', resolve);
  });
  return {
    ...told,
    kill: () => {
      child.kill('SIGKILL');
      return ended;
    },
  };
}

/** Opens a studio's page; a console error fails the test. */
async function opened(address) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true });
  const page = await context.newPage();
  const errors = [];
  page.on('console', (message) => {
    const isBad = ['error', 'warning'].includes(message.type()) && !KNOWN.test(message.text());
    if (isBad) errors.push(message.text());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  await page.goto(address);
  await page.getByTestId('position-rmse').waitFor();
  return { page, errors, close: () => context.close() };
}

/** A studio of its own for one test, which does something and wants no console error. */
async function tried(act, name = 'thrown_ball_drag') {
  const file = scene(name);
  const studio = await served(file);
  const { page, errors, close } = await opened(studio.address);
  try {
    await act(page, studio, file);
    assert.deepEqual(errors, []);
  } finally {
    await close();
    await studio.kill();
  }
}

const rmse = (page) => page.getByTestId('position-rmse').textContent();
const shows = (page, pattern) =>
  until(
    () => rmse(page),
    (text) => pattern.test(text),
    'the error',
  );

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
    await page.getByTestId('compare-0').uncheck();
    await until(
      () => page.getByTestId('compare-0').isChecked(),
      (isChecked) => !isChecked,
      'the box',
    );
  }));

test('a law shows its mistake, and is put in when it is good', () =>
  tried(async (page) => {
    await page.getByTestId('law-example').click();
    const text = page.getByTestId('law-text');
    const good = await text.inputValue();
    await text.fill(good.replace('norm(v)', 'nrom(v)'));
    const mistake = await until(
      () => page.getByTestId('mistake').allTextContents(),
      (all) => all.length > 0,
      'the mistake',
    );
    assert.match(mistake[0], /\^{4}/);
    assert.match(mistake[0], /did you mean `norm`\?/);
    assert.equal(await page.getByTestId('law-put-in').isDisabled(), true);
    await text.fill(good);
    await until(() => page.getByTestId('law-put-in').isEnabled(), Boolean, 'the button');
    await page.getByTestId('law-put-in').click();
    await shows(page, WITH_DRAG);
    await page.getByTestId('remove-my_drag@ball').waitFor();
  }));

test('a pose is marked and taken back, moved in time and put back, and noise is stated', () =>
  tried(async (page) => {
    const first = await rmse(page);
    await page.getByTestId('poses-ball').locator('summary').click();
    await page.getByTestId('wrong-ball-0').check();
    const marked = await until(
      () => rmse(page),
      (text) => text !== first,
      'the error',
    );
    await page.getByTestId('wrong-ball-0').uncheck();
    await until(
      () => rmse(page),
      (text) => text === first,
      'the error',
    );
    assert.notEqual(marked, first);

    const time = page.getByTestId('time-ball-3');
    const own = await time.inputValue();
    const next = parseFloat(await page.getByTestId('time-ball-4').inputValue());
    await time.fill(String((parseFloat(own) + next) / 2));
    await time.press('Tab');
    await until(
      () => rmse(page),
      (text) => text !== first,
      'the error',
    );
    // Beyond its neighbour: refused, with the mend.
    await page.getByTestId('time-ball-3').fill(String(next + 1));
    await page.getByTestId('time-ball-3').press('Tab');
    const told = await until(
      () => page.getByTestId('error').allTextContents(),
      (all) => all.some(Boolean),
      'the refusal',
    );
    assert.match(told.join(' '), /isn't between the poses before and after/);
    const moved = (parseFloat(own) + next) / 2;
    await until(
      () => page.getByTestId('time-ball-3').inputValue(),
      (value) => Math.abs(parseFloat(value) - moved) < 1e-6,
      'the time',
    );

    await page.getByTestId('noise-position').fill('2');
    await page.getByTestId('noise-state').click();
    await page.getByTestId('noise-reset').click();
    await until(
      () => page.getByTestId('noise-reset').count(),
      (count) => count === 0,
      'the noise',
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
    let letGo;
    const isDone = new Promise((resolve) => {
      letGo = resolve;
    });
    // The poll reads the state before the act, and answers after it.
    const isRead = new Promise((resolve) => {
      void page.route(
        '**/api/state',
        async (route) => {
          const response = await route.fetch();
          resolve();
          await isDone;
          await route.fulfill({ response });
        },
        { times: 1 },
      );
    });
    await isRead;
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    const late = page.waitForResponse('**/api/state');
    letGo();
    await (await late).finished();
    // Two frames later it would be seen.
    await page.evaluate(
      () => new Promise((seen) => requestAnimationFrame(() => requestAnimationFrame(seen))),
    );
    await shows(page, WITH_DRAG);
    assert.match(await rmse(page), WITH_DRAG);
  }));

test('a window that is behind leaves the law that another one types', () =>
  tried(async (page, studio) => {
    const text = page.getByTestId('law-text');
    const sent = async (law) => {
      const answer = page.waitForResponse(
        (response) => response.url().endsWith('api/law') && response.request().postDataJSON().draft === law,
      );
      await text.fill(law);
      await answer;
    };
    await sent('name = "older');
    const other = await opened(studio.address);
    const posts = [];
    other.page.on('request', (request) => {
      if (request.url().endsWith('api/law')) posts.push(request.postDataJSON().draft);
    });
    const theirs = other.page.getByTestId('law-text');
    assert.equal(await theirs.inputValue(), 'name = "older');
    await other.page.route('**/api/**', (route) => route.abort('connectionrefused'));
    await other.page.getByTestId('banner').waitFor({ state: 'visible' });
    await sent('name = "newer');
    await other.page.unroute('**/api/**');
    await other.page.getByTestId('banner').waitFor({ state: 'hidden' });
    await until(
      () => theirs.inputValue(),
      (law) => law === 'name = "newer',
      'the law',
    );
    assert.deepEqual(posts, []);
    // Who takes it up is told what is wrong.
    await theirs.focus();
    await other.page.getByTestId('mistake').waitFor();
    assert.deepEqual(posts, ['name = "newer']);
    await other.close();
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
