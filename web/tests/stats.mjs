// Statistics that tell a picture of open water from a flat plane, a gradient, a frozen frame and noise; stats.test.mjs
// checks that they do.
import { PNG } from 'pngjs';

/** Decodes a PNG into luma from 0 to 255. */
export function fromPng(buffer) {
  const { width, height, data } = PNG.sync.read(Buffer.from(buffer));
  const luma = new Float64Array(width * height);
  for (let i = 0; i < luma.length; i += 1) {
    luma[i] = 0.2126 * data[4 * i] + 0.7152 * data[4 * i + 1] + 0.0722 * data[4 * i + 2];
  }
  return { width, height, luma };
}

/** Part of a picture; the edges are fractions of its size. */
export function crop({ width, height, luma }, [left, top, right, bottom]) {
  const [x0, x1] = [Math.round(left * width), Math.round(right * width)];
  const [y0, y1] = [Math.round(top * height), Math.round(bottom * height)];
  const out = new Float64Array((x1 - x0) * (y1 - y0));
  for (let y = y0; y < y1; y += 1) out.set(luma.subarray(y * width + x0, y * width + x1), (y - y0) * (x1 - x0));
  return { width: x1 - x0, height: y1 - y0, luma: out };
}

/** Halves the resolution by means of 2 x 2 pixels, which halves dither and grain and keeps waves. */
function half({ width, height, luma }) {
  const [w, h] = [width >> 1, height >> 1];
  const out = new Float64Array(w * h);
  for (let y = 0; y < h; y += 1) {
    for (let x = 0; x < w; x += 1) {
      const i = 2 * y * width + 2 * x;
      out[y * w + x] = (luma[i] + luma[i + 1] + luma[i + width] + luma[i + width + 1]) / 4;
    }
  }
  return { width: w, height: h, luma: out };
}

const rms = (values) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / Math.max(values.length, 1));
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Second differences along the rows ("detail"): zero for a plane and for a gradient in any direction. */
function rowDetail({ width, height, luma }, lag = 2) {
  const w = width - 2 * lag;
  const out = new Float64Array(w * height);
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < w; x += 1) {
      const i = y * width + x;
      out[y * w + x] = luma[i] - 2 * luma[i + lag] + luma[i + 2 * lag];
    }
  }
  return { width: w, height, luma: out };
}

/** RMS of the detail in each tile of `size` x `size` pixels. */
function tiles({ width, height, luma }, size = 12) {
  const out = [];
  for (let y = 0; y + size <= height; y += size) {
    for (let x = 0; x + size <= width; x += size) {
      const tile = [];
      for (let j = 0; j < size; j += 1) tile.push(...luma.subarray((y + j) * width + x, (y + j) * width + x + size));
      out.push(rms(tile));
    }
  }
  return out;
}

/** Correlation of the detail between neighbours in a row: about 0 for noise, because the detail's lag is two pixels. */
function coherence({ width, height, luma }) {
  let [cross, square] = [0, 0];
  for (let y = 0; y < height; y += 1) {
    for (let i = y * width; i < y * width + width - 1; i += 1) {
      cross += luma[i] * luma[i + 1];
      square += (luma[i] ** 2 + luma[i + 1] ** 2) / 2;
    }
  }
  return square > 0 ? cross / square : 0;
}

/** Least values for a sea: of `measure`, and of `change` for a moving one. */
export const SEA = { detail: 1.2, tiles: 0.7, coherence: 0.1, change: 0.8, spread: 4 };

/** Detail in the median tile, share of tiles with detail, coherence of the detail, spread of the luma. */
export function measure(picture) {
  const detail = rowDetail(half(picture));
  const each = tiles(detail);
  return {
    detail: median(each),
    tiles: each.filter((value) => value >= SEA.detail / 2).length / Math.max(each.length, 1),
    coherence: coherence(detail),
    spread: spread(picture),
  };
}

/** The values below those of SEA, as texts; empty for a sea. */
export function notASea(picture) {
  const found = measure(picture);
  return ['detail', 'tiles', 'coherence', 'spread']
    .filter((name) => !(found[name] >= SEA[name]))
    .map((name) => `${name} ${found[name].toFixed(3)} < ${SEA[name]}`);
}

/** RMS change of the detail between two pictures, in units of its RMS: 0 if frozen, 1.4 if unrelated. */
export function change(a, b) {
  const [p, q] = [rowDetail(half(a)).luma, rowDetail(half(b)).luma];
  const scale = Math.hypot(rms(p), rms(q)) / Math.SQRT2;
  return scale > 0 ? rms(p.map((value, i) => value - q[i])) / scale : 0;
}

/** Mean difference of two pictures of the same size, as a share of the range. */
export function apart(a, b) {
  if (a.width !== b.width || a.height !== b.height) {
    throw new Error(`sizes differ: ${a.width} x ${a.height}, ${b.width} x ${b.height}`);
  }
  return a.luma.reduce((sum, v, i) => sum + Math.abs(v - b.luma[i]), 0) / a.luma.length / 255;
}

/** Standard deviation of the luma: 0 for a blank page. */
export function spread({ luma }) {
  const mean = luma.reduce((sum, v) => sum + v, 0) / luma.length;
  return rms(luma.map((v) => v - mean));
}

/** Generator of random numbers from 0 to 1, the same for the same seed (mulberry32). */
export function random(seed) {
  let a = seed;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
