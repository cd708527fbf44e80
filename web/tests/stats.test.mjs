import assert from 'node:assert/strict';
import { test } from 'node:test';
import { SEA, apart, change, measure, notASea, random, spread } from './stats.mjs';

const [width, height] = [400, 160];

function picture(at) {
  const luma = new Float64Array(width * height);
  for (let y = 0; y < height; y += 1) for (let x = 0; x < width; x += 1) luma[y * width + x] = Math.round(at(x, y));
  return { width, height, luma };
}

/** Sine waves in perspective, as a stand-in for a sea. */
function waves(time, amplitude = 1) {
  const next = random(7);
  const parts = Array.from({ length: 60 }, () => {
    const k = 0.1 * 60 ** next();
    const angle = (next() - 0.5) * 2;
    return { kx: k * Math.sin(angle), kz: k * Math.cos(angle), w: Math.sqrt(9.81 * k), phase: 6.28 * next(), a: 0.5 };
  });
  return picture((x, y) => {
    const distance = 3000 / (y + 30);
    const side = ((x - width / 2) * distance) / 300;
    const slope = parts.reduce(
      (sum, p) => sum + p.a * Math.cos(p.kx * side + p.kz * distance - p.w * time + p.phase),
      0,
    );
    return 70 + 0.2 * y + amplitude * 4 * slope;
  });
}

const dither = random(3);
const notSeas = {
  'a flat plane': picture(() => 90),
  'a flat plane with dither': picture(() => 90 + dither() - 0.5),
  'a gradient downwards': picture((x, y) => 40 + y),
  'a gradient across': picture((x) => 40 + x / 2 + dither() - 0.5),
  'a curved sky': picture((x, y) => 60 + 80 * Math.exp(-((x - 200) ** 2 + (y - 20) ** 2) / 9000) + dither() - 0.5),
  'a plane with one edge': picture((x) => (x < 180 ? 60 : 160)),
  'a plane with a horizon': picture((x, y) => (y < 60 ? 60 : 160)),
  'a glitter spot on a plane': picture((x, y) => 60 + (Math.abs(x - 200) < 25 ? 60 * Math.sin(x * 1.3 + y) : 0)),
  noise: picture(() => 90 + 60 * (dither() - 0.5)),
};

test('waves are a sea', () => {
  assert.deepEqual(notASea(waves(20)), [], JSON.stringify(measure(waves(20))));
});

for (const [name, image] of Object.entries(notSeas)) {
  test(`${name} is no sea`, () => {
    assert.notDeepEqual(notASea(image), [], JSON.stringify(measure(image)));
  });
}

test('faint waves are no sea', () => {
  assert.notDeepEqual(notASea(waves(20, 0.03)), []);
});

test('a frozen frame does not change, a moving sea does', () => {
  assert.equal(change(waves(20), waves(20)), 0);
  assert.ok(change(waves(20), waves(26)) > SEA.change);
  assert.equal(change(notSeas['a flat plane'], notSeas['a flat plane']), 0);
});

test('a change of brightness alone is no motion', () => {
  const image = waves(20);
  const brighter = { ...image, luma: image.luma.map((v) => v + 20) };
  assert.ok(change(image, brighter) < 0.01);
});

test('a blank page has no spread', () => {
  assert.equal(spread(notSeas['a flat plane']), 0);
  assert.ok(spread(waves(20)) > SEA.spread);
});

test('pictures are as far apart as their mean difference', () => {
  const [a, b] = [picture(() => 100), picture((x) => (x < width / 4 ? 151 : 100))];
  assert.equal(apart(a, a), 0);
  assert.ok(Math.abs(apart(a, b) - 0.05) < 1e-9);
  assert.throws(() => apart(a, { ...b, width: 2 * b.width }));
});
