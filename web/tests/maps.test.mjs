import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compareHalves, compareHeights, half } from './maps.mjs';

test('halves are read right', () => {
  const large = [[0x3c00, 1], [0xc000, -2], [0x7bff, 65504]];
  const small = [[0x0001, 2 ** -24], [0x3555, 0.333251953125], [0x8000, -0]];
  for (const [bits, value] of [...large, ...small]) {
    assert.equal(half(bits), value);
  }
  assert.ok(Number.isNaN(half(0x7e00)));
});

const shape = { n: 8, cascades: 2 };
const heights = Float32Array.from({ length: 128 }, (_, i) => 2 * Math.sin(i));

test('equal maps agree, a fault of 1 % is found', () => {
  assert.equal(compareHeights(heights, heights, shape), 0);
  assert.ok(compareHeights(heights, heights.map((v) => v * 1.01), shape) > 1e-4);
  const halves = Uint16Array.from({ length: 512 }, (_, i) => 0x3c00 + i);
  assert.equal(compareHalves(halves, halves, shape), 0);
  assert.ok(compareHalves(halves, halves.map((v) => v + 10), shape) > 2 ** -10);
  const lastBits = halves.map((v, i) => v + (i % 3 === 0));
  assert.ok(compareHalves(halves, lastBits, shape) < 2 ** -10, 'the last bit may differ');
});

test('a fault in one small cascade is found', () => {
  const small = Uint16Array.from({ length: 512 }, (_, i) => (i < 256 ? 0x5000 : 0x1000) + (i % 16));
  const wrong = small.map((v, i) => (i < 256 ? v : v + 32));
  assert.ok(compareHalves(small, wrong, shape) > 2 ** -10);
});

test('a flat sea and a wrong length are no reference', () => {
  assert.throws(() => compareHeights(new Float32Array(128), new Float32Array(128), shape), /Hs/);
  assert.throws(() => compareHeights(heights, heights.slice(1), shape), /length/);
});

test('numbers that are none are found', () => {
  const halves = new Uint16Array(512).fill(0x3c00);
  const wrong = halves.slice();
  wrong[5] = 0x7e00;
  assert.throws(() => compareHalves(halves, wrong, shape), /numbers/);
});
