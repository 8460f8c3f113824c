// Poses and noise in a browser: marked, moved and stated, with the mouse and by the keyboard.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { until } from './browser.mjs';
import { WITH_DRAG, changes, firstPlot, rmse, shows, tried } from './studio.mjs';

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

/** What is told beside the poses. */
const told = (page, pattern) =>
  until(
    () => page.getByTestId('error').allTextContents(),
    (all) => all.some((text) => pattern.test(text)),
    'the message',
  );

test('keys undo and redo from a field of a number, but for what is being typed there', () =>
  tried(async (page) => {
    await page.getByTestId('poses-ball').locator('summary').click();
    const scale = page.getByTestId('scale-ball-3');
    await scale.fill('');
    await scale.pressSequentially('3');
    // Not stated yet: it is the text's own.
    await page.keyboard.press('Control+z');
    await until(
      () => scale.inputValue(),
      (value) => value !== '3',
      'the field',
    );
    await scale.fill('3');
    await scale.press('Enter');
    await changes(page, /1 of another noise$/);
    await until(() => scale.evaluate((field) => field === document.activeElement), Boolean, 'the focus');
    await page.keyboard.press('Control+z');
    await changes(page, /poses$/);
    await page.keyboard.press('Control+y');
    await changes(page, /1 of another noise$/);
    await page.keyboard.press('Control+z');
    await changes(page, /poses$/);
    await page.keyboard.press('Control+Shift+Z');
    await changes(page, /1 of another noise$/);
  }));

test('a pose’s emptied noise is that of the others, and what is no number is told', () =>
  tried(async (page) => {
    await page.getByTestId('poses-ball').locator('summary').click();
    const scale = page.getByTestId('scale-ball-3');
    const type = async (text) => {
      await scale.fill(text);
      await scale.press('Enter');
    };
    await type('3');
    await changes(page, /1 of another noise$/);
    await type('');
    await changes(page, /poses$/);
    await until(
      () => scale.inputValue(),
      (value) => value === '1',
      'the field',
    );
    // As small as a scene's may be, and no smaller.
    await type('0.001');
    await changes(page, /1 of another noise$/);
    await type('0');
    await told(
      page,
      /^Noise of pose 3 of ball: 0 times that of the others is not within 0\.001 to 1000 times/,
    );
    assert.equal(await scale.inputValue(), '0.001');
    const time = page.getByTestId('time-ball-3');
    await time.fill('');
    await time.press('Enter');
    await told(page, /^Time of pose 3 of ball: no number is typed/);
    assert.notEqual(await time.inputValue(), '');
  }));

test('noise is stated in the page’s units, of what is measured, and emptied it is the scene’s', () =>
  tried(async (page) => {
    const position = page.getByTestId('noise-position');
    assert.equal(await page.getByTestId('noise-orientation').count(), 0, 'a ball without orientations');
    const state = async (text) => {
      await position.fill(text);
      await page.getByTestId('noise-state').click();
    };
    for (const wrong of ['-2', '0']) {
      await state(wrong);
      await told(page, /^Noise of positions: \S+ mm is not within .* mm\. Type one σ in mm, above 0/);
    }
    await state('2');
    await page.getByTestId('noise-reset').waitFor();
    assert.equal(await page.getByTestId('variant-1').textContent(), 'noise 2 mm');
    await state('');
    await until(
      () => page.getByTestId('noise-reset').count(),
      (count) => count === 0,
      'the noise',
    );
  }));

test('of two kinds of noise both are stated', () =>
  tried(async (page) => {
    const turn = page.getByTestId('noise-orientation');
    await turn.fill('');
    await page.getByTestId('noise-state').click();
    await told(page, /^Noise of orientations: no number is typed\. Type one σ in degrees/);
    await turn.fill('1');
    await page.getByTestId('noise-state').click();
    await page.getByTestId('noise-reset').waitFor();
    assert.match(await page.getByTestId('variant-1').textContent(), /^noise 2 mm, 1°$/);
  }, 'boxes'));

test('a click that slips drags nothing', () =>
  tried(async (page) => {
    for (const [mode, isOnBand] of [
      ['noise', false],
      ['noise', true],
      ['time', false],
    ]) {
      await page.getByTestId(`mode-${mode}`).check();
      const { poses, sigma, at } = await firstPlot(page);
      const middle = (poses[0].time + poses[1].time) / 2;
      const [x, y] = isOnBand ? at(middle, 2 * sigma) : at(poses[3].time, poses[3].value);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 1, y - 2);
      await page.mouse.up();
    }
    // An act after it is the first.
    await page.getByTestId('add-quadratic_drag@ball').click();
    await shows(page, WITH_DRAG);
    assert.match(await page.getByTestId('variant-1').textContent(), /quadratic_drag/);
  }));
