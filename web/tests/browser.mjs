// What all tests in the browser share: Chromium, pages whose errors count, reports made by smash.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

export const ROOT = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const SMASH = process.env.SMASH ?? join(ROOT, 'target', 'debug', 'smash');
const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** A temporary folder, gone when the process ends. */
export const folder = mkdtempSync(join(tmpdir(), 'smash-page-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

export function smash(...args) {
  return execFileSync(SMASH, args, {
    cwd: folder,
    encoding: 'utf8',
    maxBuffer: 1e8,
    stdio: ['ignore', 'pipe', 'pipe'],
  });
}

/** 3D is drawn by the processor: test machines have no graphics. */
export function launch({ has3d = true } = {}) {
  const graphics = has3d
    ? ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
    : ['--disable-gpu', '--disable-3d-apis'];
  return chromium.launch({
    executablePath: CHROMIUM,
    args: [
      '--no-sandbox',
      '--no-first-run',
      '--disable-quic',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      ...graphics,
    ],
  });
}

/** A page without network, in a window of its own; what it logs as an error is in `errors`. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({
    offline: true,
    viewport: { width: 1280, height: 900 },
    acceptDownloads: true,
    ...options,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  const errors = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) errors.push(message.text());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  await page.goto(pathToFileURL(file).href);
  await page.locator('h1').waitFor();
  return { page, errors, close: () => context.close() };
}

const DATA = /(<script type="application\/json" id="smash-data">)([\s\S]*?)(<\/script>)/;

/** The data in a page that smash wrote. */
export function dataOf(file) {
  return JSON.parse(readFileSync(file, 'utf8').match(DATA)[2]);
}

/** A copy of a page with its data changed. */
export function changed(file, name, change) {
  const data = dataOf(file);
  change(data);
  const json = JSON.stringify(data).replaceAll('<', '\\u003c');
  const copy = join(folder, name);
  writeFileSync(
    copy,
    readFileSync(file, 'utf8').replace(DATA, (_, head, __, tail) => head + json + tail),
  );
  return copy;
}

/** A scene of the repository, changed, as a file. */
export function scene(name, change = () => {}) {
  const data = JSON.parse(readFileSync(join(ROOT, 'scenes', `${name}.json`), 'utf8'));
  change(data);
  const file = join(folder, `${name}-${Math.random().toString(36).slice(2)}.json`);
  writeFileSync(file, JSON.stringify(data));
  return file;
}

/** How long a page may take for what it does at once where nothing else runs, ms: other tests do. */
export const PATIENCE_MS = 120_000;

/** Waits until `read` gives what `isRight` likes, and gives it back. */
export async function until(read, isRight, what) {
  let last;
  for (const end = Date.now() + PATIENCE_MS; Date.now() < end;) {
    last = await read();
    if (isRight(last)) return last;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`${what}: it stays ${JSON.stringify(last)}`);
}
