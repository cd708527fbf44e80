// Moves sliders at random for a while and watches the memory. Run by hand: `node soak.mjs [--minutes 30] [--seed 1]`.
//
// Reads Chromium's processes in /proc: Linux only. `dist/` must be built.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { launch } from './browsers.mjs';
import { frames, openSea } from './sea.mjs';
import { serve } from './server.mjs';
import { random } from './stats.mjs';

const { values: options } = parseArgs({
  options: { minutes: { type: 'string', default: '30' }, seed: { type: 'string', default: '1' } },
});
const MINUTES = Number(options.minutes);
const WARM_UP = 0.2; // share of the time before memory counts
const MOST_GROWTH = 0.05; // share of the memory
// Few pixels, so that a software adapter makes many moves.
const BASE = { wind: 14, fetch: 300, n: 64, mesh: 0.2, renderscale: 0.5, adaptive: 0 };
const SIZES = [[640, 420], [500, 360], [360, 560]];
const MOVES = {
  wind: [3, 28], fetch: [5, 800], dir: [0, 360], seed: [1, 1e6], swell: [0, 1], depth: [3, 4000], chop: [0, 1.5],
  sun: [-10, 60], haze: [0, 1], overcast: [0, 1], heading: [0, 359], pitch: [-30, 10], y: [2, 40], scale2: [0, 1],
  scale3: [0, 1], foamdecay: [1, 10],
};
const CHOICES = {
  n: [64, 128], cascades: [1, 2, 3, 4], spectrum: ['jonswap', 'pm', 'elfouhaily', 'donelan', 'tma'],
  whitecaps: ['monahan', 'fixed'], view: ['picture', 'height', 'wireframe'], camera: ['fly', 'orbit', 'buoy'],
  afloat: ['buoy*10*-30', 'buoy*10*-30_boat*0*-40'], ui: [0, 1], bloom: [0, 0.3],
};

const dice = random(Number(options.seed));
const one = (list) => list[Math.floor(list.length * dice())];
const between = ([low, high]) => Number((low + (high - low) * dice()).toFixed(2));
const text = (state) => Object.entries(state).map(([key, value]) => `${key}=${value}`).join('&');
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

// Runs in the page ahead of its own scripts. Keeps the program's memory in `wasmMemory`.
const keepMemory = () => {
  const real = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...rest) => {
    const made = await real.apply(WebAssembly, rest);
    const instance = made.instance ?? made;
    window.wasmMemory ??= instance.exports.memory;
    return made;
  };
};

/** Resident memory of a process in bytes. */
const resident = (id) => 1024 * Number(/^VmRSS:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]);

const server = await serve(join(fileURLToPath(new URL('../..', import.meta.url)), 'dist'));
const browser = await launch('chromium');
const tab = await openSea({ browser, origin: server.origin }, text(BASE), { size: SIZES[0], before: keepMemory });
const session = await tab.page.createCDPSession();
await session.send('Performance.enable');

async function measure() {
  await tab.page.setViewport({ width: SIZES[0][0], height: SIZES[0][1], deviceScaleFactor: 1 });
  await tab.evaluate((state) => window.seastate.set_state(state), `${text(BASE)}&pause=1`);
  await frames(tab, 5);
  for (let i = 0; i < 3; i += 1) await session.send('HeapProfiler.collectGarbage');
  const { metrics } = await session.send('Performance.getMetrics');
  const processes = await browser.processes();
  const of = (type) => processes.filter((each) => each.type === type).map((each) => resident(each.id));
  return {
    heap: metrics.find((each) => each.name === 'JSHeapUsedSize').value,
    wasm: await tab.evaluate(() => window.wasmMemory.buffer.byteLength),
    // The largest renderer process is the page's.
    renderer: Math.max(...of('renderer')),
    gpu: Math.max(...of('GPU')),
  };
}

async function move() {
  const state = { ...BASE };
  for (let i = 0; i < 5; i += 1) {
    const key = one([...Object.keys(MOVES), ...Object.keys(CHOICES)]);
    state[key] = key in MOVES ? between(MOVES[key]) : one(CHOICES[key]);
  }
  if (dice() < 0.1) {
    const [width, height] = one(SIZES);
    await tab.page.setViewport({ width, height, deviceScaleFactor: 1 });
  }
  // A dragged slider, or one new value.
  const steps = dice() < 0.5 ? 10 : 1;
  const [from, to] = [between(MOVES.wind), between(MOVES.wind)];
  for (let i = 1; i <= steps; i += 1) {
    state.wind = (from + ((to - from) * i) / steps).toFixed(2);
    await tab.evaluate((now) => window.seastate.set_state(now), text(state));
    await sleep(60);
  }
  await sleep(500 * dice());
}

const begun = Date.now();
const share = () => (Date.now() - begun) / (60e3 * MINUTES);
const samples = [];
let moves = 0;
while (share() < 1) {
  const until = Date.now() + Math.min(60e3, (60e3 * MINUTES) / 20);
  while (Date.now() < until) {
    await move();
    moves += 1;
  }
  samples.push({ at: share(), ...(await measure()) });
  const { at, ...bytes } = samples.at(-1);
  const sizes = Object.entries(bytes).map(([name, n]) => `${name} ${(n / 1e6).toFixed(1)} MB`);
  console.log(`${(at * MINUTES).toFixed(1)} min, ${moves} moves: ${sizes.join(', ')}`);
}

const warm = samples.filter((sample) => sample.at > WARM_UP);
const some = Math.max(1, Math.floor(warm.length / 5));
const growth = (of) => median(warm.slice(-some).map(of)) / median(warm.slice(0, some).map(of)) - 1;
const faults = [...tab.errors];
const total = growth(({ heap, wasm, renderer }) => heap + wasm + renderer);
if (!(total < MOST_GROWTH)) faults.push(`memory grew by ${(100 * total).toFixed(1)} %`);
const rung = await tab.evaluate(() => document.body.dataset.rung);
if (rung) faults.push(`the page ended on the rung ${rung}`);
const percent = (share) => `${(100 * share).toFixed(1)} %`;
const each = ['heap', 'wasm', 'renderer', 'gpu'].map((name) => `${name} ${percent(growth((sample) => sample[name]))}`);
const verdict = faults.length > 0 ? `FAULTS: ${faults.join('; ')}` : 'no error';
console.log(`soak: ${MINUTES} min, ${moves} moves, growth ${percent(total)} (${each.join(', ')}); ${verdict}`);
await browser.close();
await server.close();
process.exit(faults.length ? 1 : 0);
