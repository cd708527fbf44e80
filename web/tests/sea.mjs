// The sea itself: visible, moving, the same as the native program's, and in step with the address.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { compareHalves, compareHeights } from './maps.mjs';
import { SEA, change, crop, fromPng, measure, notASea, spread } from './stats.mjs';

// Without the panel, which would cover a window this small, and with all pixels, however slow the processor is.
const STATE = 'wind=15&fetch=300&t=20&n=64&ui=0&adaptive=0';
// With few pixels and a coarse mesh, for tests that do not look closely at the picture.
const LEAN = `${STATE}&mesh=0.1&renderscale=0.5`;
// A part of the picture below the horizon, in fractions of the window: left, top, right, bottom.
const WATER = [0.02, 0.62, 0.5, 0.98];

/** Opens a state and waits for its picture. */
export async function openSea({ browser, origin }, state, { folder = '', ...settings } = {}) {
  const tab = await browser.open(`${origin}/${folder}?${state}`, settings);
  await tab.until('the first picture', () => document.body.classList.contains('running') || document.body.dataset.rung);
  assert.equal(
    await tab.evaluate(() => document.body.dataset.rung),
    undefined,
    await tab.evaluate(() => document.body.innerText),
  );
  await frames(tab, 3);
  return tab;
}

/** Waits for `count` more frames and a complete picture. Requests the frames: a paused sea draws none by itself. */
export async function frames(tab, count) {
  const have = await tab.evaluate(() => window.seastate.frames());
  await tab.until(
    `${count} more frames`,
    (enough) => window.seastate.is_picture_complete() && window.seastate.frames() >= enough,
    have + count,
  );
}

const values = (query) => Object.fromEntries(new URLSearchParams(query));
export const stateOf = async (tab) => values(await tab.evaluate(() => window.seastate.state()));
export const addressOf = async (tab) => values(await tab.evaluate(() => location.search));

/** Asserts that `found` has the numbers of `expected`; it may have more. */
export function agree(found, expected, what) {
  for (const [name, value] of Object.entries(expected)) {
    assert.equal(Number(found[name]), value, `${what}: ${name} in ${JSON.stringify(found)}`);
  }
}

export async function sea(context) {
  const { test, out, browser } = context;
  const shot = (tab, name) => tab.screenshot(join(out, `${browser.name}-${name}.png`)).then(fromPng);

  await test(`${browser.name}: a sea is seen`, async () => {
    const tab = await openSea(context, STATE);
    try {
      const picture = await shot(tab, 'sea');
      const water = crop(picture, WATER);
      assert.deepEqual(notASea(water), [], JSON.stringify(measure(water)));
      assert.deepEqual(tab.errors, [], 'console errors');
      const { detail, tiles, coherence } = measure(water);
      const share = (100 * tiles).toFixed(0);
      return `detail ${detail.toFixed(2)}, in ${share} % of the water, coherence ${coherence.toFixed(2)}`;
    } finally {
      await tab.close();
    }
  });

  // Each is a variant of the light that the default sea does not compile.
  for (const [name, look] of [
    ['clouds', 'clouds=cumulus&cloudcover=0.4&glints=1&gusts=1&bloom=0.04&sun=40&sunaz=60'],
    ['lagoon', 'depth=4&water=ia&caustics=1&clouds=stratocumulus'],
  ]) {
    await test(`${browser.name}: a sea with ${name} is seen`, async () => {
      const tab = await openSea(context, `v=2&${STATE}&pause=1&mesh=0.1&${look}`);
      try {
        const picture = await shot(tab, name);
        assert.deepEqual(notASea(crop(picture, WATER)), [], JSON.stringify(measure(crop(picture, WATER))));
        // Invalid light at the horizon would be a white line, and with bloom a white picture.
        const { width, height, luma } = picture;
        for (let y = 0; y < height; y += 1) {
          const row = luma.subarray(y * width, (y + 1) * width);
          const mean = row.reduce((sum, value) => sum + value, 0) / width;
          assert.ok(mean < 245, `row ${y} is white: ${mean}`);
        }
        if (name === 'clouds') {
          // A clear sky is even.
          const sky = measure(crop(picture, [0.02, 0.02, 0.98, 0.3]));
          assert.ok(sky.detail > 0.3, `detail ${sky.detail} in the sky`);
        }
        assert.deepEqual(tab.errors, [], 'console errors');
      } finally {
        await tab.close();
      }
    });
  }

  await test(`${browser.name}: the sea moves by itself`, async () => {
    const tab = await openSea(context, STATE);
    try {
      const before = await stateOf(tab);
      const first = crop(await shot(tab, 'moves-a'), WATER);
      await tab.until(
        'two seconds of sea',
        (start) => Number(new URLSearchParams(window.seastate.state()).get('t')) > start + 2,
        Number(before.t),
      );
      await frames(tab, 2);
      const second = crop(await shot(tab, 'moves-b'), WATER);
      const moved = change(first, second);
      assert.ok(moved > SEA.change, `change ${moved.toFixed(3)}`);
      return `change ${moved.toFixed(2)}`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a paused sea stands still, another time is another picture`, async () => {
    const pictures = [];
    for (const [name, time] of Object.entries({ t20: 20, 't20-again': 20, t26: 26 })) {
      const tab = await openSea(context, `wind=15&fetch=300&t=${time}&n=64&pause=1&ui=0&mesh=0.1&renderscale=0.5`);
      pictures.push(crop(await shot(tab, name), WATER));
      agree(await stateOf(tab), { t: time }, 'paused');
      await tab.close();
    }
    const [same, other] = [change(pictures[0], pictures[1]), change(pictures[0], pictures[2])];
    assert.ok(same < 0.02, `the same state twice differs by ${same.toFixed(4)}`);
    assert.ok(other > SEA.change, `change ${other.toFixed(3)}`);
    return `same time ${same.toFixed(4)}, other time ${other.toFixed(2)}`;
  });

  await test(`${browser.name}: the settings are those of the address`, async () => {
    const tab = await openSea(context, 'wind=12.5&fetch=80&seed=7&n=64&t=3&pause=1&swell=0.4');
    try {
      agree(await stateOf(tab), { wind: 12.5, fetch: 80, seed: 7, n: 64, t: 3, swell: 0.4 }, 'state');
      agree(await addressOf(tab), { wind: 12.5, fetch: 80, seed: 7, n: 64, t: 3, swell: 0.4 }, 'address');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a changed value changes the address, back restores it`, async () => {
    const tab = await openSea(context, `${LEAN}&pause=1`);
    try {
      const first = crop(await shot(tab, 'back-a'), WATER);
      await tab.evaluate((state) => window.seastate.set_state(state), `${LEAN}&pause=1`.replace('wind=15', 'wind=22'));
      await tab.until('the new wind in the address', () => new URLSearchParams(location.search).get('wind') === '22');
      agree(await stateOf(tab), { wind: 22, fetch: 300 }, 'after the change');
      await frames(tab, 3);
      const changed = crop(await shot(tab, 'back-b'), WATER);
      assert.ok(change(first, changed) > 0.3, 'the picture has changed');
      await tab.evaluate(() => history.back());
      await tab.until(
        'the old wind in the program',
        () => new URLSearchParams(window.seastate.state()).get('wind') === '15',
      );
      agree(await addressOf(tab), { wind: 15, fetch: 300 }, 'after going back');
      await frames(tab, 3);
      const restored = crop(await shot(tab, 'back-c'), WATER);
      assert.ok(change(first, restored) < 0.02, `the picture is back: ${change(first, restored).toFixed(4)}`);
      await tab.evaluate(() => history.forward());
      await tab.until('the new wind again', () => new URLSearchParams(window.seastate.state()).get('wind') === '22');
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a dropped buoy becomes the sea, a bad file changes nothing`, async () => {
    const tab = await openSea(context, 'n=64&pause=1&t=20&ui=0');
    const drop = (files) =>
      tab.evaluate((list) => {
        const data = new DataTransfer();
        for (const [name, text] of list) data.items.add(new File([text], name));
        document
          .querySelector('canvas')
          .dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
      }, files);
    try {
      const text = readFileSync(join(context.top, 'assets', 'spectra', 'two-systems.txt'), 'utf8');
      await drop([['two-systems.txt', text]]);
      await tab.until(
        'the buoy in the address',
        () => new URLSearchParams(location.search).get('spectrum') === 'measured',
      );
      const state = await stateOf(tab);
      assert.ok(state.measured.split('_').length > 30, state.measured);
      await frames(tab, 3);
      assert.deepEqual(notASea(crop(await shot(tab, 'buoy'), WATER)), []);
      await drop([['bad.csv', '0.1,2\n0.2,1\n0.15,1\n']]);
      await frames(tab, 3);
      assert.deepEqual(await stateOf(tab), state);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: the mouse moves the camera, and the address follows`, async () => {
    const tab = await openSea(context, `${LEAN}&pause=1`);
    try {
      const before = await tab.evaluate(() => location.search);
      const { mouse } = tab.page;
      await mouse.move(75, 150);
      await mouse.down();
      for (let x = 80; x <= 120; x += 10) {
        await mouse.move(x, 150);
        await frames(tab, 1);
      }
      await mouse.up();
      await tab.until('a new address', (old) => location.search !== old, before);
      agree(await addressOf(tab), { wind: 15, fetch: 300, n: 64 }, 'address');
      return await tab.evaluate(() => location.search);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: nonsense in the address still opens a sea`, async () => {
    const tab = await openSea(context, 'wind=gale&fetch=-5&seed=%F0%9F%8C%8A&n=63&colour=blue&t=NaN&=&&%zz');
    try {
      assert.ok(spread(await shot(tab, 'nonsense')) > SEA.spread);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: opens from a subfolder, packed`, async () => {
    const tab = await openSea(context, LEAN, { folder: 'fault/wasm-gzip/' });
    try {
      assert.ok(spread(await shot(tab, 'subfolder')) > SEA.spread);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: the same sea as the native program`, async () => {
    const reference = await context.native(STATE);
    const tab = await openSea(context, `${LEAN}&pause=1`);
    try {
      const found = await tab.evaluate(async (state) => {
        const maps = await window.seastate.read_back(state);
        const text = (array) => {
          const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
          let out = '';
          for (let i = 0; i < bytes.length; i += 0x8000) out += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
          return btoa(out);
        };
        return {
          n: maps.n,
          cascades: maps.cascades,
          heights: text(maps.heights),
          displacement: text(maps.displacement),
        };
      }, STATE);
      const bytes = (text) => new Uint8Array(Buffer.from(text, 'base64')).buffer;
      const heights = compareHeights(reference.heights, new Float32Array(bytes(found.heights)), found);
      const halves = compareHalves(reference.displacement, new Uint16Array(bytes(found.displacement)), found);
      const note = `heights ${heights.toExponential(1)} of Hs, halves ${halves.toExponential(1)} of their rms`;
      assert.ok(heights <= 1e-4 && halves <= 2 ** -10, note);
      return note;
    } finally {
      await tab.close();
    }
  });
}
