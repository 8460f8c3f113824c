// The studio in a browser, against the real server.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ROOT, folder, launch, open, scene, until } from './browser.mjs';

const SMASH = process.env.SMASH ?? join(ROOT, 'target', 'debug', 'smash');
/** What the browser itself says of a refusal, of an address that is no more, or of a server that is gone: the page
 *  tells all three. */
const KNOWN = /status of 40[49]|ERR_CONNECTION/;
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
async function tried(act, name = 'thrown_ball_drag', change = () => {}) {
  const file = scene(name, change);
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
    // In the same plots, with its dash.
    await page.locator('.plots-legend', { hasText: 'Lines: 0: base model' }).waitFor();
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

/** The first residual plot: where a time and a residual in mm are on the screen, and its poses. */
async function firstPlot(page) {
  const plot = page.getByTestId('residual-plot').first();
  const over = plot.locator('.u-over');
  await over.evaluate((one) => one.scrollIntoView({ block: 'center' }));
  const box = await over.boundingBox();
  const { report } = await page.evaluate(async () => (await fetch('api/state')).json());
  const key = await plot.getAttribute('data-key');
  const series = report.models[0].series.find((one) => `${one.body}/${one.axis}` === key);
  const poses = series.points.map(({ time, value }) => ({ time, value: 1000 * value }));
  const sigma = 1000 * series.sigma;
  // As the plot is scaled: all times with 3 % around them, and zero in the middle.
  const times = report.scene.bodies.flatMap((body) => body.observations.map((pose) => pose.time));
  const [start, span] = [Math.min(...times), Math.max(...times) - Math.min(...times)];
  const half = 1.25 * Math.max(...poses.map((pose) => Math.abs(pose.value)), 2.6 * sigma);
  return {
    poses,
    sigma,
    // A mouse is where a pixel is.
    pixel: { s: (1.06 * span) / box.width, mm: (2 * half) / box.height },
    at: (time, value) => [
      box.x + (box.width * ((time - start) / span + 0.03)) / 1.06,
      box.y + (box.height * (1 - value / half)) / 2,
    ],
  };
}

/** What the list of the ball's poses says is changed. */
const changes = (page, pattern) =>
  until(
    () => page.getByTestId('poses-ball').locator('summary').textContent(),
    (text) => pattern.test(text),
    'the poses',
  );

test('a click in a plot marks a pose, another one takes it back', () =>
  tried(async (page) => {
    await page.getByTestId('mode-mark').check();
    const click = async () => {
      const { poses, at } = await firstPlot(page);
      await page.mouse.click(...at(poses[3].time, poses[3].value));
    };
    await click();
    await changes(page, /poses, 1 marked wrong$/);
    await page.getByTestId('poses-ball').locator('summary').click();
    assert.equal(await page.getByTestId('wrong-ball-3').isChecked(), true);
    await click();
    await changes(page, /poses$/);
  }));

test('a pose is dragged to another time, unless Esc leaves it', () =>
  tried(async (page) => {
    await page.getByTestId('mode-time').check();
    const { poses, at, pixel } = await firstPlot(page);
    const [own, next] = [poses[3], poses[4]];
    const aim = (own.time + next.time) / 2;
    const drag = async () => {
      await page.mouse.move(...at(own.time, own.value));
      await page.mouse.down();
      await page.mouse.move(...at(aim, own.value));
    };
    await drag();
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await drag();
    await page.getByText(/pose 3 from .* Esc leaves it/).waitFor();
    await page.mouse.up();
    await changes(page, /poses, 1 at another time$/);
    await page.getByTestId('poses-ball').locator('summary').click();
    const moved = parseFloat(await page.getByTestId('time-ball-3').inputValue());
    assert.ok(Math.abs(moved - aim) <= pixel.s, `${moved} s, not ${aim} s`);
    assert.equal(await page.getByTestId('variant-2').count(), 0, 'Esc made no variant');
  }));

test('the band of a plot is dragged to another noise', () =>
  tried(async (page) => {
    await page.getByTestId('mode-noise').check();
    const { poses, sigma, at, pixel } = await firstPlot(page);
    const middle = (poses[0].time + poses[1].time) / 2;
    await page.mouse.move(...at(middle, 2 * sigma));
    await page.mouse.down();
    await page.mouse.move(...at(middle, 8 * sigma));
    await page.mouse.up();
    await page.getByTestId('noise-reset').waitFor();
    const stated = parseFloat(await page.getByTestId('noise-position').inputValue());
    // The band is two σ wide.
    assert.ok(Math.abs(stated - 4 * sigma) <= pixel.mm / 2, `${stated} mm, not ${4 * sigma} mm`);
  }));

test('a pose is dragged to a noise of its own, unless Esc leaves it, and typed back', () =>
  tried(async (page) => {
    await page.getByTestId('mode-noise').check();
    const { poses, sigma, at, pixel } = await firstPlot(page);
    const [{ time, value }] = poses.slice(3);
    const drag = async () => {
      await page.mouse.move(...at(time, value));
      await page.mouse.down();
      await page.mouse.move(...at(time, value + 6 * sigma));
    };
    await drag();
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await drag();
    await page.getByText(/noise of pose 3 × .*; Esc leaves it/).waitFor();
    await page.mouse.up();
    await changes(page, /poses, 1 of another noise$/);
    await page.getByTestId('poses-ball').locator('summary').click();
    const scale = page.getByTestId('scale-ball-3');
    const dragged = parseFloat(await scale.inputValue());
    // The bar is two σ long, to two digits.
    assert.ok(Math.abs(dragged - 3) <= pixel.mm / (2 * sigma) + 0.05, `${dragged}, not 3`);
    assert.equal(await page.getByTestId('variant-2').count(), 0, 'Esc made no variant');
    await scale.fill('1');
    await scale.press('Tab');
    await changes(page, /poses$/);
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
    await page.getByTestId('explanation').waitFor({ timeout: 60_000 });
    const stage = await page.getByTestId('stage').boundingBox();
    assert.ok(stage.y + 150 < 900, `the stage starts at ${stage.y}`);
    const effects = await page.getByTestId('catalogue').locator('li').allTextContents();
    assert.ok(
      effects.some((one) => one.startsWith('Magnus') && one.endsWith('this scene has no orientations')),
      effects.join('\n'),
    );
  }));

test('of a long film, poses are listed page by page', () =>
  tried(
    async (page) => {
      await page.getByTestId('poses-ball').locator('summary').click();
      await page.getByText('Poses 0 to 199 of 321.').waitFor();
      assert.equal(await page.getByTestId('wrong-ball-250').count(), 0);
      await page.getByTestId('later-ball').click();
      await page.getByTestId('wrong-ball-250').check();
      await changes(page, /1 marked wrong$/);
      assert.equal(await page.getByTestId('wrong-ball-250').isChecked(), true);
      assert.equal(await page.getByTestId('later-ball').isDisabled(), true);
    },
    'thrown_ball_drag',
    (data) => {
      const { observations } = data.bodies[0];
      const between = (one, next, share) => ({
        time: one.frame / data.fps + ((next.frame - one.frame) / data.fps) * share,
        position: one.position.map((x, axis) => x + (next.position[axis] - x) * share),
      });
      data.bodies[0].observations = observations.flatMap((one, index) => {
        const next = observations[index + 1] ?? one;
        const steps = next === one ? [0] : [...Array(10).keys()].map((step) => step / 10);
        return steps.map((share) => between(one, next, share));
      });
    },
  ));

test('a law that is typed while the studio is away is there when it is back', async () => {
  const file = scene('thrown_ball_drag');
  const studio = await served(file);
  const { page, close } = await opened(studio.address);
  await studio.kill();
  await page.getByTestId('law-text').fill('name = "half');
  await page.getByTestId('banner').waitFor({ state: 'visible' });
  const again = await served(file);
  // Another address, at the same port, in the same browser.
  await page.goto(again.address);
  await until(
    () => page.evaluate(async () => (await (await fetch('api/state')).json()).draft),
    (draft) => draft === 'name = "half',
    'the draft at the server',
  );
  assert.equal(await page.getByTestId('law-text').inputValue(), 'name = "half');
  await close();
  await again.kill();
});

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

/** A law that another browser types. */
const typedElsewhere = (page) =>
  page.evaluate(() =>
    fetch('api/law', {
      method: 'POST',
      body: JSON.stringify({ draft: 'name = "theirs' }),
      headers: { 'Content-Type': 'application/json', 'X-Smash': '1' },
    }).then((answer) => answer.json()),
  );

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
