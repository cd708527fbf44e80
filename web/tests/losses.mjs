// Device losses at any moment: the same sea comes back, at the same time, without loading the page again.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { frames, openSea } from './sea.mjs';
import { apart, fromPng, random } from './stats.mjs';

// With a version: the state is both a link and a bare string, which have different ones without it.
const STATE = 'v=2&wind=15&fetch=300&t=20&pause=1&n=64&ui=0&adaptive=0&mesh=0.1&renderscale=0.5&afloat=buoy*4*-30';
const SIZE = [320, 200];
const LOSSES = 12;
const SEED = 2026;
const ALIKE = 0.01; // largest mean difference of two pictures of the same sea, as a share of the range

// The next two functions run in the page ahead of its own scripts, so they cannot use names of this file.

// Collects all devices in `devices`. `strikes` are the ages (ms) at which the next devices are destroyed. `lostAt` is
// the time of the last destruction.
const keepDevices = () => {
  window.devices = [];
  window.strikes = [];
  const real = GPUAdapter.prototype.requestDevice;
  GPUAdapter.prototype.requestDevice = async function requestDevice(...rest) {
    const device = await real.apply(this, rest);
    window.devices.push(device);
    const age = window.strikes.shift();
    const strike = () => {
      window.lostAt = Date.now();
      device.destroy();
    };
    if (age === 0) strike();
    else if (age > 0) setTimeout(strike, age);
    return device;
  };
};

// Delays the destruction of a device in Firefox until no frame is on its way to the screen: otherwise Firefox 153 draws
// nothing more in the tab, not even another page.
const betweenFrames = () => {
  if (!navigator.userAgent.includes('Firefox')) return;
  const frame = window.requestAnimationFrame.bind(window);
  const destroy = GPUDevice.prototype.destroy;
  let told = Promise.resolve();
  GPUDevice.prototype.destroy = function destroyed() {
    told = Promise.all([told, this.lost]);
    const idle = this.queue
      .onSubmittedWorkDone()
      .catch(() => {})
      .then(() => new Promise((resolve) => setTimeout(resolve, 500)));
    idle.then(() => destroy.call(this));
  };
  const gone = new Set();
  const cancel = window.cancelAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) => {
    const id = frame((now) => told.then(() => gone.has(id) || callback(now)));
    return id;
  };
  window.cancelAnimationFrame = (id) => {
    gone.add(id);
    cancel(id);
  };
};
const KEPT = `(${keepDevices})(); (${betweenFrames})();`;

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export async function losses(context) {
  const { test, out, browser } = context;
  const shot = (tab, name) => tab.screenshot(join(out, `${browser.name}-${name}.png`)).then(fromPng);
  const turn = (tab, state) => tab.evaluate((text) => window.seastate.set_state(text), state);
  const stateIn = (tab) => tab.evaluate(() => window.seastate.state());
  const count = (tab) => tab.evaluate(() => window.devices.length);
  const destroy = (tab) =>
    tab.evaluate(() => {
      window.lostAt = Date.now();
      window.devices.at(-1).destroy();
    });
  // The page removes the old canvas when the next picture is complete.
  const isBack = (tab, since) =>
    tab.until(
      'the sea to come back',
      (had) =>
        document.body.dataset.rung ||
        ((window.devices.length > had || !window.stayed) &&
          window.seastate.device_lost() === undefined &&
          document.body.classList.contains('running') &&
          document.querySelectorAll('canvas').length === 1),
      since,
    );

  // Ways to lose a device. Each leaves the state as in STATE; `running` changes only the time.
  const moments = {
    still: async (tab) => {
      await destroy(tab);
    },
    running: async (tab, dice) => {
      await turn(tab, STATE.replace('&pause=1', ''));
      await sleep(1500 * dice());
      await destroy(tab);
    },
    slider: async (tab, dice) => {
      for (let i = 0; i < 8; i += 1) {
        await turn(tab, STATE.replace('wind=15', `wind=${8 + i}`));
        if (i === 5) await destroy(tab);
        await sleep(60 * dice());
      }
    },
    resize: async (tab, dice) => {
      await tab.page.setViewport({ width: 300 + Math.round(100 * dice()), height: 240, deviceScaleFactor: 1 });
      await sleep(200 * dice());
      await destroy(tab);
    },
    start: async (tab, dice) => {
      await tab.evaluate(
        (age) => {
          window.strikes = [age];
        },
        dice() < 0.3 ? 0 : Math.ceil(1000 * dice()),
      );
      await destroy(tab);
    },
  };

  await test(`${browser.name}: a device lost ${LOSSES} times, and always the same sea`, async () => {
    const whole = await openSea(context, STATE, { size: SIZE });
    const reference = await shot(whole, 'lost-nothing');
    // The measure can tell a later sea from this one.
    await turn(whole, STATE.replace('t=20', 't=21'));
    await frames(whole, 3);
    const later = apart(reference, await shot(whole, 'lost-later'));
    assert.ok(later > 2 * ALIKE, `a second later differs by ${later.toFixed(4)}`);
    await whole.close();

    const tab = await openSea(context, STATE, { size: SIZE, before: KEPT });
    const dice = random(SEED);
    // Without `start` in Firefox: the first frame is painted from a ResizeObserver, so betweenFrames cannot delay it.
    const names = Object.keys(moments).filter((name) => browser.name !== 'firefox' || name !== 'start');
    const found = { apart: [], seconds: [], slowest: {}, reloads: 0 };
    try {
      // A reload of the page removes `stayed`.
      await tab.evaluate(() => {
        window.stayed = true;
      });
      for (let i = 0; i < LOSSES; i += 1) {
        const name = names[Math.floor(names.length * dice())];
        // After eight losses within a minute the page reloads (ladder.mjs). Here it forgets them in time.
        await tab.evaluate(() => {
          const recorded = JSON.parse(sessionStorage.getItem('seastate-device-lost') ?? '[]');
          if (recorded.length >= 7) sessionStorage.removeItem('seastate-device-lost');
        });
        const had = await count(tab);
        const begun = Date.now();
        await moments[name](tab, dice);
        // `start` loses two devices.
        assert.equal(await isBack(tab, had + (name === 'start' ? 1 : 0)), true, `loss ${i}, ${name}`);
        // Since the last loss; a reloaded page does not know its time.
        const seconds = (Date.now() - ((await tab.evaluate(() => window.lostAt)) ?? begun)) / 1000;
        found.seconds.push(seconds);
        found.slowest[name] = Math.max(found.slowest[name] ?? 0, seconds);
        if (!(await tab.evaluate(() => window.stayed))) {
          found.reloads += 1;
          await tab.evaluate(() => {
            window.stayed = true;
          });
        }
        const state = new URLSearchParams(await stateIn(tab));
        assert.equal(state.get('wind'), '15', `loss ${i}, ${name}: the sea of before`);
        assert.equal(state.get('afloat'), 'buoy*4*-30', `loss ${i}, ${name}: the buoy`);
        if (name === 'running') {
          assert.ok(
            state.get('pause') === null && Number(state.get('t')) >= 20 && Number(state.get('t')) < 30,
            `loss ${i}: it runs on, ${state}`,
          );
          await turn(tab, STATE);
        } else {
          assert.equal(state.get('t'), '20', `loss ${i}, ${name}: the time of before`);
        }
        if (name === 'resize') await tab.page.setViewport({ width: SIZE[0], height: SIZE[1], deviceScaleFactor: 1 });
        await frames(tab, 3);
        const picture = await shot(tab, `lost-${i}`);
        found.apart.push(apart(reference, picture));
        assert.ok(found.apart[i] < ALIKE, `loss ${i}, ${name}: differs by ${found.apart[i].toFixed(4)}`);
      }
      assert.ok(found.reloads <= LOSSES / 4, `${found.reloads} reloads`);
      const median = [...found.seconds].sort((a, b) => a - b)[LOSSES >> 1];
      const slowest = Object.entries(found.slowest).map(([name, s]) => `${name} ${s.toFixed(1)}`);
      const worst = Math.max(...found.apart).toFixed(5);
      return [
        `${found.reloads} reloads, pictures differ by ${worst} at most (a second later: ${later.toFixed(3)})`,
        `back after ${median.toFixed(1)} s, at most ${slowest.join(', ')} s`,
      ].join('; ');
    } finally {
      await tab.close();
    }
  });

  // In the other tests no page may be reloaded.
  const staying = `${KEPT} window.stayed = true;`;

  await test(`${browser.name}: foam with a past comes back, and so does what was undone`, async () => {
    const tab = await openSea(context, STATE.replace('&pause=1', '').replace('wind=15', 'wind=20'), {
      size: SIZE,
      before: staying,
    });
    try {
      const t = () => tab.evaluate(() => Number(new URLSearchParams(window.seastate.state()).get('t')));
      await tab.until('three seconds of sea', () => Number(new URLSearchParams(window.seastate.state()).get('t')) > 23);
      await tab.evaluate(() => document.querySelector('canvas').focus());
      await tab.page.keyboard.press(' ');
      await tab.until('the stop', () => new URLSearchParams(window.seastate.state()).get('pause') === '1');
      await frames(tab, 3);
      const [at, before] = [await t(), await shot(tab, 'foam-before')];
      const had = await count(tab);
      await destroy(tab);
      assert.equal(await isBack(tab, had), true);
      assert.equal(await t(), at, 'the time');
      await frames(tab, 3);
      const difference = apart(before, await shot(tab, 'foam-after'));
      assert.ok(difference < ALIKE, `differs by ${difference.toFixed(4)}`);
      // The keyboard is still the sea's.
      await tab.page.keyboard.press(' ');
      await tab.until('the sea to go on', () => new URLSearchParams(window.seastate.state()).get('pause') === null);
      return `differs by ${difference.toFixed(5)}`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a device lost in the first start, and in a measurement`, async () => {
    // In Firefox before the first frame, which betweenFrames cannot delay.
    const first = browser.name === 'firefox' ? 0 : 30;
    const before = `(${keepDevices})(); window.stayed = true; window.strikes = [${first}];`;
    const tab = await browser.open(`${context.origin}/?${STATE}`, { size: SIZE, before });
    try {
      assert.equal(await isBack(tab, 1), true);
      assert.equal(new URLSearchParams(await stateIn(tab)).get('t'), '20');
    } finally {
      await tab.close();
    }
    const bench = await browser.open(`${context.origin}/?n=64&bench=1`, {
      size: SIZE,
      before: `(${keepDevices})(); window.strikes = [300];`,
    });
    try {
      await bench.until(
        'the measurement to begin again',
        () => document.body.dataset.rung || window.devices.length > 1,
      );
      assert.equal(await bench.evaluate(() => document.body.dataset.rung), undefined);
    } finally {
      await bench.close();
    }
  });

  if (browser.name !== 'chromium') return;
  await test(`${browser.name}: the browser's graphics process is killed`, async () => {
    const tab = await openSea(context, STATE, { size: SIZE, before: staying });
    try {
      const reference = await shot(tab, 'gpu-before');
      const had = await count(tab);
      await browser.crashGpu();
      assert.equal(await isBack(tab, had), true, await tab.evaluate(() => document.body.innerText));
      await frames(tab, 3);
      const difference = apart(reference, await shot(tab, 'gpu-after'));
      assert.ok(difference < ALIKE, `differs by ${difference.toFixed(4)}`);
      return `differs by ${difference.toFixed(5)}`;
    } finally {
      await tab.close();
    }
  });
}
