// Opens the built page in Chromium and Firefox and says what holds: `node run.mjs [--browser NAME] [--only 'TEXT|TEXT']`.
//
// `dist/` must be built, and the native program too: it gives the reference for "one state, one sea on every stack".
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';
import { parseArgs } from 'node:util';
import { NAMES, launch, takeStrays } from './browsers.mjs';
import { ladder } from './ladder.mjs';
import { explorer } from './explorer.mjs';
import { losses } from './losses.mjs';
import { odds } from './odds.mjs';
import { offline } from './offline.mjs';
import { sea } from './sea.mjs';
import { serve } from './server.mjs';

const { values: options } = parseArgs({ options: { browser: { type: 'string' }, only: { type: 'string', default: '' }, explorer: { type: 'boolean' } } });
const top = fileURLToPath(new URL('../..', import.meta.url));
const dist = join(top, 'dist');
const out = fileURLToPath(new URL('out', import.meta.url));
const budget = JSON.parse(readFileSync(join(top, 'web', 'budget.json'), 'utf8'));

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
if (!existsSync(join(dist, 'index.html'))) {
  console.error('browser tests: there is no dist/index.html: run `trunk build --release` first');
  process.exit(2);
}

let passed = 0;
const failed = [];

async function test(name, body, isNeeded = false) {
  if (!isNeeded && !options.only.split('|').some((part) => name.includes(part))) return;
  const begun = Date.now();
  const seconds = () => `${((Date.now() - begun) / 1000).toFixed(1)} s`;
  try {
    const note = await body();
    const strays = takeStrays();
    if (strays.length > 0) throw new Error(`something left the page: ${strays.join(', ')}`);
    passed += 1;
    console.log(`ok    ${name}${note ? `: ${note}` : ''} (${seconds()})`);
  } catch (error) {
    failed.push(name);
    console.log(`FAIL  ${name} (${seconds()})\n      ${String(error?.message ?? error).replaceAll('\n', '\n      ')}`);
  }
}

/** The native program's heights and displacements for a state. */
function native(state) {
  const target = process.env.CARGO_TARGET_DIR ?? join(top, 'target');
  const program = process.env.SEASTATE_BIN ?? join(target, 'debug', 'seastate');
  const folder = join(out, 'native');
  execFileSync(program, ['export', state, '-o', folder, '--raw'], { stdio: ['ignore', 'ignore', 'inherit'] });
  const bytes = (name) => {
    const file = readFileSync(join(folder, name));
    return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
  };
  return { heights: new Float32Array(bytes('heights.f32')), displacement: new Uint16Array(bytes('displacement.f16')) };
}

const server = await serve(dist);
const context = { test, out, top, dist, origin: server.origin, port: server.port, native };

/** Bytes of a file as a host sends it: pictures are packed already. */
function sent(file) {
  const raw = readFileSync(join(dist, file));
  if (/\.(jpg|png)$/.test(file)) return raw.length;
  const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: raw.length };
  return brotliCompressSync(raw, { params }).length;
}

await test('the page: small enough', () => {
  const files = readdirSync(dist).map((file) => [file, sent(file)]);
  const sum = (list) => list.reduce((total, [, bytes]) => total + bytes, 0);
  const found = { all: sum(files), wasm: sum(files.filter(([file]) => file.endsWith('.wasm'))) };
  const note = `${found.all} bytes with brotli, ${found.wasm} of them wasm`;
  for (const part of ['all', 'wasm']) {
    if (!(found[part] > 0 && found[part] <= budget[part])) throw new Error(`${note}; the budget for ${part} is ${budget[part]}`);
  }
  return note;
});

const groups = options.explorer ? { explorer } : { sea, explorer, losses, odds, offline, ladder };
for (const name of NAMES.filter((each) => !options.browser || each === options.browser)) {
  for (const [group, body] of Object.entries(groups)) {
    // A browser for each group: one that a test has broken breaks no other group.
    let browser;
    await test(`${name}: starts for ${group}`, async () => {
      browser = await launch(name);
      return browser.version;
    }, true);
    if (!browser) continue;
    await body({ ...context, browser });
    await browser.close().catch(() => {});
  }
}

await server.close();
console.log(`browser tests: ${passed} passed, ${failed.length} failed${failed.length ? `: ${failed.join('; ')}` : ''}`);
process.exit(failed.length || passed === 0 ? 1 : 0);
