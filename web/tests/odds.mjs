// Rare events: refused memory, canvases of odd sizes, other device pixel ratios, clocks that jump, slow displays.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { frames, openSea, stateOf } from './sea.mjs';
import { SEA, fromPng, spread } from './stats.mjs';

const STATE = 'wind=15&fetch=300&t=20&pause=1&n=64&mesh=0.1&adaptive=0&ui=0';

// The next functions run in the page ahead of its own scripts, so they cannot use names of this file.

// Refuses textures with the picture's shape that are wider than 200 pixels.
const shortOfMemory = () => {
  window.widths = [];
  window.heard = new Set();
  setInterval(() => window.heard.add(window.seastate?.announcement()), 50);
  const real = GPUDevice.prototype.createTexture;
  GPUDevice.prototype.createTexture = function createTexture(descriptor) {
    const { width, height } = descriptor.size;
    if (width > 100 && Math.abs(width / height - 1.6) < 0.03) {
      window.widths.push(width);
      const error = new GPUOutOfMemoryError('refused by the test');
      if (width > 200) setTimeout(() => this.dispatchEvent(new GPUUncapturedErrorEvent('uncapturederror', { error })));
    }
    return real.call(this, descriptor);
  };
};

// Shows at most 30 frames a second, and tells that the GPU finishes each in 4 ms. Without that, a software adapter would
// take as long as a GPU that is too slow. Notes the widths of the textures with the picture's shape.
const idleAtThirtyHertz = () => {
  window.widths = [];
  const create = GPUDevice.prototype.createTexture;
  GPUDevice.prototype.createTexture = function createTexture(descriptor) {
    const { width, height } = descriptor.size;
    if (width <= 160 && Math.abs(width / height - 1.6) < 0.06) window.widths.push(width);
    return create.call(this, descriptor);
  };
  const has = GPUSupportedFeatures.prototype.has;
  GPUSupportedFeatures.prototype.has = function hasFeature(name) {
    return name !== 'timestamp-query' && has.call(this, name);
  };
  // The page's clock stands between frames, so that the test does not depend on the speed of this machine.
  let now = performance.now();
  performance.now = () => now;
  GPUQueue.prototype.onSubmittedWorkDone = async () => {
    const done = now + 4;
    await null;
    now = Math.max(now, done);
  };
  const request = window.requestAnimationFrame.bind(window);
  let frame = now;
  window.frames30 = 0;
  window.requestAnimationFrame = (callback) =>
    request(() => {
      frame += 1000 / 30;
      now = frame;
      window.frames30 += 1;
      callback(now);
    });
};

// Tells scripts a device pixel ratio of 1.5, while elements are measured with a ratio of 1.
const emulatedRatio = () => {
  Object.defineProperty(window, 'devicePixelRatio', { value: 1.5 });
};

const skewedClock = () => {
  window.skew = 0;
  const real = performance.now.bind(performance);
  performance.now = () => real() + window.skew;
};

export async function odds(context) {
  const { test, out, browser } = context;
  const picture = async (tab, name) => fromPng(await tab.screenshot(join(out, `${browser.name}-${name}.png`)));
  // Does not look at the console's errors: those of an abandoned device are right.
  const isSea = async (tab, name) => assert.ok(spread(await picture(tab, name)) > SEA.spread, 'the page is blank');

  await test(`${browser.name}: memory that is refused costs pixels, and the page says so`, async () => {
    const tab = await browser.open(`${context.origin}/?${STATE}`, { size: [320, 200], before: shortOfMemory });
    try {
      await tab.until(
        'a picture that fits',
        () =>
          document.body.dataset.rung ||
          (window.widths.at(-1) < 200 &&
            window.seastate.device_lost() === undefined &&
            [...window.heard].some((said) => said?.includes('short of memory'))),
      );
      assert.equal(await tab.evaluate(() => document.body.dataset.rung), undefined);
      await frames(tab, 2);
      await isSea(tab, 'refused');
      const { n, wind } = await stateOf(tab);
      assert.deepEqual([n, wind], ['64', '15'], 'the state is as it was');
      return `widths ${(await tab.evaluate(() => [...new Set(window.widths)])).join(', ')}`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: canvases of no size, of any size, and other pixels`, async () => {
    const tab = await openSea(context, `${STATE}&renderscale=0.25`);
    const canvas = () => tab.evaluate(() => ['width', 'height'].map((side) => document.querySelector('canvas')[side]));
    const become = (what, size, test) => tab.until(`a canvas ${what}`, test, size);
    try {
      await tab.evaluate(() => {
        document.querySelector('canvas').style.height = '0';
      });
      await become('without height', 0, () => document.querySelector('canvas').height <= 1);
      await new Promise((resolve) => setTimeout(resolve, 500));
      await tab.evaluate(() => {
        document.querySelector('canvas').style.height = '';
      });
      await become('of before', 200, (height) => document.querySelector('canvas').height === height);
      await frames(tab, 2);
      await isSea(tab, 'unfolded');
      await tab.page.setViewport({ width: 320, height: 200, deviceScaleFactor: 2 });
      // The emulation tells scripts a ratio of 2, while elements may still be measured with a ratio of 1.
      await become('of twice the pixels', 400, (height) => document.querySelector('canvas').height === height);
      await frames(tab, 2);
      await tab.page.setViewport({ width: 9000, height: 40, deviceScaleFactor: 1 });
      await become('of the widest kind', 8192, (width) => document.querySelector('canvas').width === width);
      await frames(tab, 2);
      const widest = await canvas();
      await tab.page.setViewport({ width: 320, height: 200, deviceScaleFactor: 1 });
      await become('of before', 320, (width) => document.querySelector('canvas').width === width);
      await frames(tab, 2);
      await isSea(tab, 'resized');
      assert.deepEqual(tab.errors, [], 'console errors');
      return `${widest.join(' x ')} of 9000 x 40`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a display of 30 Hz costs no pixels`, async () => {
    const state = 'n=64&mesh=0.1&foam=0&ui=0';
    const tab = await browser.open(`${context.origin}/?${state}`, { size: [160, 100], before: idleAtThirtyHertz });
    try {
      // The page begins with a quarter of the width, because it knows that the adapter is a software adapter.
      await tab.until('a first picture', () => window.seastate?.has_first_picture());
      await tab.until('all pixels', () => window.widths.at(-1) === 160);
      const seen = await tab.evaluate(() => [window.frames30, window.widths.length]);
      await tab.until('150 frames more', (frames) => window.frames30 >= frames + 150, seen[0]);
      const later = await tab.evaluate((count) => window.widths.slice(count), seen[1]);
      assert.ok(
        later.every((width) => width === 160),
        `the picture stays as wide as its canvas: ${later}`,
      );
      assert.deepEqual(tab.errors, [], 'console errors');
      return `widths ${(await tab.evaluate(() => [...new Set(window.widths)])).join(', ')}`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a canvas measured with another pixel ratio than scripts see`, async () => {
    const state = 'n=64&pause=1&t=20&mesh=0.1&renderscale=0.25&adaptive=0';
    const tab = await openSea(context, state, { size: [760, 520], before: emulatedRatio });
    try {
      const canvas = await tab.evaluate(() => {
        const { width, height, clientWidth, clientHeight } = document.querySelector('canvas');
        return { width, height, clientWidth, clientHeight };
      });
      assert.deepEqual(canvas, { width: 1140, height: 780, clientWidth: 760, clientHeight: 520 });
      const bounds = (label) =>
        tab.until(
          label,
          (name) => {
            const place = window.seastate.widget_bounds(name);
            return place && [...place];
          },
          label,
        );
      // The last tab is at the right end of the panel.
      const last = await bounds('Share');
      assert.ok(
        last[0] > 640 && last[0] + last[2] < 760 && last[1] + last[3] < 520,
        `the panel is at the right edge: ${last}`,
      );
      const [x, y, width, height] = await bounds('Play');
      await tab.page.mouse.click(x + width / 2, y + height / 2);
      await tab.until('the sea to run', () => new URLSearchParams(window.seastate.state()).get('pause') === null);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: after an hour's sleep the sea goes on where it was`, async () => {
    const tab = await openSea(context, STATE.replace('&pause=1', ''), { before: skewedClock });
    try {
      const now = () =>
        tab.evaluate(() => [Number(new URLSearchParams(window.seastate.state()).get('t')), window.seastate.frames()]);
      const [t, frame] = await now();
      await tab.evaluate(() => {
        window.skew = 3600e3;
      });
      await frames(tab, 5);
      const [later, last] = await now();
      assert.ok(later > t && later - t <= 0.1 * (last - frame) + 0.11, `${later - t} s in ${last - frame} frames`);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  if (browser.name !== 'chromium') return; // Firefox's driver cannot switch scripts off
  await test(`${browser.name}: without scripts the page says so`, async () => {
    const tab = await browser.open('about:blank');
    try {
      await tab.page.setJavaScriptEnabled(false);
      await tab.page.goto(`${context.origin}/`);
      const said = await tab.evaluate(() => document.querySelector('noscript').innerText);
      assert.match(said, /Allow scripts/);
      await isSea(tab, 'noscript');
    } finally {
      await tab.close();
    }
  });
}
