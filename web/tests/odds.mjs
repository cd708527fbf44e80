// What seldom happens: memory that is refused, canvases of no size and of any, other pixels, clocks that jump.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { frames, openSea, stateOf } from './sea.mjs';
import { SEA, fromPng, spread } from './stats.mjs';

const STATE = 'wind=15&fetch=300&t=20&pause=1&n=64&mesh=0.1&adaptive=0&ui=0';

// Run in the page ahead of its own scripts. What has the shape of the picture is refused where it is larger than 200 pixels.
const shortOfMemory = () => {
  window.widths = [];
  window.heard = new Set();
  setInterval(() => window.heard.add(window.seastate?.told()), 50);
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

const skewedClock = () => {
  window.skew = 0;
  const real = performance.now.bind(performance);
  performance.now = () => real() + window.skew;
};

export async function odds(context) {
  const { test, out, browser } = context;
  const picture = async (tab, name) => fromPng(await tab.screenshot(join(out, `${browser.name}-${name}.png`)));
  // Errors of devices that were given up are logged, and rightly.
  const isSea = async (tab, name) => assert.ok(spread(await picture(tab, name)) > SEA.spread, 'the page is blank');

  await test(`${browser.name}: memory that is refused costs pixels, and the page says so`, async () => {
    const tab = await browser.open(`${context.origin}/?${STATE}`, { size: [320, 200], before: shortOfMemory });
    try {
      await tab.until('a picture that fits', () => document.body.dataset.rung || (window.widths.at(-1) < 200 && window.seastate.device_lost() === undefined && [...window.heard].some((said) => said?.includes('short of memory'))));
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
      await tab.evaluate(() => { document.querySelector('canvas').style.height = '0'; });
      await become('without height', 0, () => document.querySelector('canvas').height <= 1);
      await new Promise((resolve) => setTimeout(resolve, 500));
      await tab.evaluate(() => { document.querySelector('canvas').style.height = ''; });
      await become('of before', 200, (height) => document.querySelector('canvas').height === height);
      await frames(tab, 2);
      await isSea(tab, 'unfolded');
      await tab.page.setViewport({ width: 320, height: 200, deviceScaleFactor: 2 });
      // Emulation says 2 to scripts and 1 to what measures elements: all that can be seen is that the page measures anew.
      await become('that is measured anew', 0, () => document.documentElement.style.getPropertyValue('--nudge') === '0.02px');
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

  await test(`${browser.name}: after an hour's sleep the sea goes on where it was`, async () => {
    const tab = await openSea(context, STATE.replace('&pause=1', ''), { before: skewedClock });
    try {
      const now = () => tab.evaluate(() => [Number(new URLSearchParams(window.seastate.state()).get('t')), window.seastate.frames()]);
      const [t, frame] = await now();
      await tab.evaluate(() => { window.skew = 3600e3; });
      await frames(tab, 5);
      const [later, last] = await now();
      assert.ok(later > t && later - t <= 0.1 * (last - frame) + 0.11, `${later - t} s in ${last - frame} frames`);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  if (browser.name !== 'chromium') return; // whose driver alone can switch scripts off
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
