// What the studio's tests share: studios of their own, and pages on them.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { PATIENCE_MS, ROOT, folder, launch, scene, until } from './browser.mjs';

const SMASH = process.env.SMASH ?? join(ROOT, 'target', 'debug', 'smash');
/** What the browser itself says of a refusal, of an address that is no more, or of a server that is gone: the page
 *  tells all three. */
const KNOWN = /status of 40[49]|ERR_CONNECTION/;
export const BASE = /7\.1\d mm/;
export const WITH_DRAG = /0\.98\d* mm/;

export let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

/** A studio of a scene's file, at its address. */
export async function served(file) {
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
export async function opened(address) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
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
export async function tried(act, name = 'thrown_ball_drag', change = () => {}) {
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

export const rmse = (page) => page.getByTestId('position-rmse').textContent();
export const shows = (page, pattern) =>
  until(
    () => rmse(page),
    (text) => pattern.test(text),
    'the error',
  );

/** The first residual plot: where a time and a residual in mm are on the screen, and its poses. */
export async function firstPlot(page) {
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
export const changes = (page, pattern) =>
  until(
    () => page.getByTestId('poses-ball').locator('summary').textContent(),
    (text) => pattern.test(text),
    'the poses',
  );

/** A law that another browser types. */
export const typedElsewhere = (page) =>
  page.evaluate(() =>
    fetch('api/law', {
      method: 'POST',
      body: JSON.stringify({ draft: 'name = "theirs' }),
      headers: { 'Content-Type': 'application/json', 'X-Smash': '1' },
    }).then((answer) => answer.json()),
  );
