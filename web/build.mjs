// node build.mjs --out FILE
//
// Bundles src/ and page.html into one file: script and style inlined, nothing loaded from
// elsewhere. Types are stripped, not checked; `npm run check` checks them.

import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));

/** Of the one argument `--out FILE`; dist/page.html without it. */
function outFile(args) {
  if (args.length === 0) return join(here, 'dist', 'page.html');
  if (args.length === 2 && args[0] === '--out') return args[1];
  console.error('usage: node build.mjs [--out FILE]');
  process.exit(2);
}

async function bundled(entry) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    charset: 'utf8',
    legalComments: 'inline',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

const hash = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;

/** Puts `text` in place of the one comment `<!--NAME-->` of the skeleton. */
function filled(skeleton, name, text) {
  const parts = skeleton.split(`<!--${name}-->`);
  if (parts.length !== 2) throw new Error(`page.html must hold <!--${name}--> once`);
  return parts.join(text);
}

const out = outFile(process.argv.slice(2));
const [script, style] = [await bundled('src/main.ts'), await bundled('src/style.css')];
if (/<\/script|<!--/i.test(script)) throw new Error('the script would end its own element');
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  'img-src data: blob:',
  "connect-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

let page = readFileSync(join(here, 'page.html'), 'utf8');
page = filled(page, 'POLICY', `<meta http-equiv="Content-Security-Policy" content="${policy}">`);
page = filled(page, 'STYLE', `<style>${style}</style>`);
page = filled(page, 'SCRIPT', `<script>${script}</script>`);
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
