// Opens the built page in Chromium and Firefox and checks it, two groups of tests at a time.
import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';
import { brotliCompress, constants } from 'node:zlib';
import { NAMES, launch } from './browsers.mjs';
import { explorer } from './explorer.mjs';
import { frames } from './frames.mjs';
import { ladder } from './ladder.mjs';
import { losses } from './losses.mjs';
import { odds } from './odds.mjs';
import { offline } from './offline.mjs';
import { readers } from './readers.mjs';
import { sea } from './sea.mjs';
import { serve } from './server.mjs';

const USAGE = `usage: node run.mjs [--browser NAME] [--group NAME] [--only 'TEXT|TEXT'] [--dist DIR]
  --browser NAME  only chromium or firefox
  --group NAME    only one group of tests: sea, explorer, frames, readers, losses, odds, offline or ladder
  --only TEXTS    only tests with one of these texts in their name
  --dist DIR      folder of the built page (default: dist)
The native program must be built, too: target/debug/seastate, or the path in SEASTATE_BIN.`;

const GROUPS = { sea, explorer, frames, readers, losses, odds, offline, ladder };
const top = fileURLToPath(new URL('../..', import.meta.url));
const out = fileURLToPath(new URL('out', import.meta.url));

function stop(message) {
  console.error(`run.mjs: ${message}`);
  process.exit(2);
}

/** The command line's options, checked. */
function readOptions() {
  const options = {
    browser: { type: 'string' },
    group: { type: 'string' },
    only: { type: 'string', default: '' },
    dist: { type: 'string', default: join(top, 'dist') },
  };
  let values;
  try {
    ({ values } = parseArgs({ options }));
  } catch (error) {
    stop(`${error.message}\n${USAGE}`);
  }
  const { browser, group } = values;
  if (browser && !NAMES.includes(browser)) stop(`there is no browser ${browser}\n${USAGE}`);
  if (group && !(group in GROUPS)) stop(`there is no group ${group}\n${USAGE}`);
  return { ...values, dist: resolve(values.dist) };
}

const { dist, ...options } = readOptions();
if (!existsSync(join(dist, 'index.html'))) stop(`${dist} has no index.html: run \`trunk build --release\` first`);
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });

let passed = 0;
const failed = [];
const isWanted = (name) => options.only.split('|').some((part) => name.includes(part));

/** Runs one test and prints its result; `takeStrays` returns what has left the page's origin meanwhile. */
async function run(name, body, takeStrays = () => []) {
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

/** Heights and displacements of a state, computed by the native program. */
async function compute(state) {
  const target = process.env.CARGO_TARGET_DIR ?? join(top, 'target');
  const program = process.env.SEASTATE_BIN ?? join(target, 'debug', 'seastate');
  const folder = join(out, 'native');
  await promisify(execFile)(program, ['export', state, '-o', folder, '--raw']);
  const bytes = (name) => {
    const file = readFileSync(join(folder, name));
    return file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
  };
  return {
    heights: new Float32Array(bytes('heights.f32')),
    displacement: new Uint16Array(bytes('displacement.f16')),
  };
}

const computed = new Map();

/** `compute(state)`, run once for both browsers. */
function native(state) {
  if (!computed.has(state)) computed.set(state, compute(state));
  return computed.get(state);
}

/** Size of a file as a host sends it, bytes: compressed by brotli, except for pictures. */
async function sentBytes(file) {
  const raw = readFileSync(join(dist, file));
  if (/\.(jpg|png)$/.test(file)) return raw.length;
  const params = {
    [constants.BROTLI_PARAM_QUALITY]: 11,
    [constants.BROTLI_PARAM_LGWIN]: 24,
    [constants.BROTLI_PARAM_SIZE_HINT]: raw.length,
  };
  return (await promisify(brotliCompress)(raw, { params })).length;
}

/** Names of the files of a first visit: those in folders are fetched only when they are wanted. */
function firstFiles() {
  return readdirSync(dist, { withFileTypes: true }).filter((entry) => entry.isFile()).map((entry) => entry.name);
}

async function isSmallEnough() {
  const budget = JSON.parse(readFileSync(join(top, 'web', 'budget.json'), 'utf8'));
  const files = await Promise.all(firstFiles().map(async (file) => [file, await sentBytes(file)]));
  const sum = (list) => list.reduce((total, [, bytes]) => total + bytes, 0);
  const found = { all: sum(files), wasm: sum(files.filter(([file]) => file.endsWith('.wasm'))) };
  const note = `${found.all} bytes with brotli, ${found.wasm} of them wasm`;
  for (const part of ['all', 'wasm']) {
    if (!(found[part] > 0 && found[part] <= budget[part])) {
      throw new Error(`${note}; the budget for ${part} is ${budget[part]}`);
    }
  }
  return note;
}

/** Runs one group in a browser of its own, so that a crash in it leaves the other groups alone. */
async function runGroup(name, group, context) {
  let browser;
  await run(`${name}: starts for ${group}`, async () => {
    browser = await launch(name);
    return browser.version;
  });
  if (!browser) return;
  const test = async (title, body) => isWanted(title) && run(title, body, browser.takeStrays);
  await GROUPS[group]({ ...context, browser, test });
  await browser.close().catch(() => {});
}

const server = await serve(dist);
const context = { out, top, dist, origin: server.origin, port: server.port, native };
const names = NAMES.filter((name) => !options.browser || options.browser === name);
const groups = Object.keys(GROUPS).filter((group) => !options.group || options.group === group);
const jobs = groups.flatMap((group) => names.map((name) => [name, group]));
const work = async () => {
  while (jobs.length > 0) await runGroup(...jobs.shift(), context);
};
const size = 'the page: small enough';
const sized = !options.group && isWanted(size) && run(size, isSmallEnough);
// Two groups at a time: many tests wait for clocks, and two cores can draw for two browsers.
await Promise.all([sized, work(), work()]);
await server.close();

const list = failed.length > 0 ? `: ${failed.join('; ')}` : '';
console.log(`browser tests: ${passed} passed, ${failed.length} failed${list}`);
process.exit(failed.length > 0 || passed === 0 ? 1 : 0);
