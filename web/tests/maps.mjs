// Differences between the maps of the native program and of the page.
import assert from 'node:assert/strict';

/** The number that the 16 bits of a half float stand for. */
export function half(bits) {
  const [sign, exponent, fraction] = [bits >> 15 ? -1 : 1, (bits >> 10) & 31, bits & 1023];
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** RMS difference of the heights of all cascades together, divided by the reference's significant wave height. */
export function compareHeights(reference, found, { n, cascades }) {
  const size = n * n;
  assert.equal(reference.length, cascades * size, 'native heights: length');
  assert.equal(found.length, cascades * size, 'heights: length');
  // Each cascade repeats on its own patch: variances and errors add.
  let [variance, error] = [0, 0];
  for (let c = 0; c < cascades; c += 1) {
    for (let i = c * size; i < (c + 1) * size; i += 1) {
      variance += reference[i] ** 2 / size;
      error += (reference[i] - found[i]) ** 2 / size;
    }
  }
  const hs = 4 * Math.sqrt(variance);
  assert.ok(hs > 0.5, `Hs of the native sea is ${hs} m`);
  return Math.sqrt(error) / hs;
}

/** RMS difference divided by the reference's RMS, in the layer and channel where it is largest. */
export function compareHalves(reference, found, { n, cascades }) {
  const size = n * n;
  assert.equal(reference.length, cascades * size * 4, 'native displacement: length');
  assert.equal(found.length, cascades * size * 4, 'displacement: length');
  let worst = 0;
  for (let layer = 0; layer < cascades; layer += 1) {
    for (let channel = 0; channel < 4; channel += 1) {
      let [square, error] = [0, 0];
      for (let i = 0; i < size; i += 1) {
        const at = (layer * size + i) * 4 + channel;
        const value = half(reference[at]);
        square += value ** 2;
        error += (value - half(found[at])) ** 2;
      }
      if (square > 0 || error > 0) worst = Math.max(worst, Math.sqrt(error / square));
    }
  }
  assert.ok(Number.isFinite(worst), 'the maps hold numbers');
  return worst;
}
