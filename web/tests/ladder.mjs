// Each rung of the ladder in index.html, provoked by removing what the page needs. A page that cannot run must show
// why, and must never be blank.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { fromPng, spread } from './stats.mjs';

const QUERY = '?wind=15&fetch=300&t=20&n=64';

// Runs in the page ahead of its own scripts, so it cannot use names of this file. Lowers one limit of the adapter.
const lowLimits = () => {
  const real = GPU.prototype.requestAdapter;
  GPU.prototype.requestAdapter = async function (...rest) {
    const adapter = await real.apply(this, rest);
    const limits = new Proxy(adapter.limits, {
      get: (target, name) => (name === 'maxComputeWorkgroupStorageSize' ? 8192 : Reflect.get(target, name, target)),
    });
    const get = (target, name) => (name === 'limits' ? limits : Reflect.get(target, name, target));
    return new Proxy(adapter, { get });
  };
};

// Runs in the page, too.
const refuse = () => {
  GPU.prototype.requestAdapter = async () => {
    throw new Error('refused by the test');
  };
};

const RUNGS = [
  { rung: 'old', before: () => { delete HTMLScriptElement.prototype.noModule; } },
  { rung: 'no-wasm', before: () => { delete globalThis.WebAssembly; } },
  { rung: 'insecure', before: () => { Object.defineProperty(globalThis, 'isSecureContext', { value: false }); } },
  { rung: 'no-webgpu', before: () => { delete Navigator.prototype.gpu; } },
  { rung: 'no-adapter', before: () => { GPU.prototype.requestAdapter = async () => null; } },
  { rung: 'no-adapter', name: 'request refused', before: refuse, reason: /refused by the test/ },
  { rung: 'limits', before: lowLimits, reason: /maxComputeWorkgroupStorageSize: 16384 needed, this one has 8192/ },
  { rung: 'download', name: 'program missing', folder: 'fault/wasm-404', reason: /404/ },
  { rung: 'download', name: 'another file in its place', folder: 'fault/wasm-html' },
  { rung: 'download', name: 'cut off', folder: 'fault/wasm-cut' },
  { rung: 'download', name: 'loader missing', folder: 'fault/glue-404' },
  { rung: 'download', name: 'another program', folder: 'fault/wasm-other', reason: /not what the page was built/ },
  { rung: 'download', name: 'another loader', folder: 'fault/glue-other' },
  { rung: 'stalled', folder: 'fault/wasm-stall', reason: /MB have come/ },
  { rung: 'start', folder: 'fault/stub', play: 'reject', reason: /no device: the stub refuses/ },
  { rung: 'panic', folder: 'fault/stub', play: 'panic', reason: /the stub panicked at src\/stub.rs:1/ },
  { rung: 'panic', name: 'a trap without words', folder: 'fault/stub', play: 'trap', reason: /unreachable executed/ },
  { rung: 'panic', name: 'while answering', folder: 'fault/stub', play: 'throw', reason: /unreachable in an answer/ },
  { rung: 'lost', folder: 'fault/stub', play: 'lost', reason: /the stub was unplugged/ },
  { rung: 'tab', folder: 'fault/stub', play: 'halt', before: () => { window.requestAnimationFrame = () => 0; } },
];

export async function ladder({ test, out, dist, origin, browser }) {
  for (const { rung, name, before, folder, play, reason } of RUNGS) {
    await test(`${browser.name}: ladder: ${rung}${name ? `, ${name}` : ''}`, async () => {
      const url = `${origin}/${folder ? `${folder}/` : ''}${QUERY}${play ? `&play=${play}` : ''}`;
      const tab = await browser.open(url, { before });
      try {
        const shown = await tab.until('a rung', () => document.body.dataset.rung);
        assert.equal(shown, rung);
        const text = await tab.evaluate(() => document.getElementById('ladder').innerText);
        const visible = await tab.evaluate(() => [...document.querySelectorAll('section[data-rung]')]
          .filter((each) => each.checkVisibility())
          .map((each) => each.dataset.rung));
        assert.deepEqual(visible, [rung], 'exactly one rung is to be seen');
        assert.match(text, /wind=15&fetch=300&t=20&n=64/, 'the state is kept');
        if (reason) assert.match(text, reason);
        assert.equal(await tab.evaluate(() => location.search.startsWith('?wind=15&fetch=300&t=20&n=64')), true);
        await tab.until('the picture', () => {
          const still = document.querySelector('#ladder img');
          return still.complete && still.naturalWidth > 0;
        });
        const picture = fromPng(await tab.screenshot(join(out, `${browser.name}-ladder-${rung}.png`)));
        assert.ok(spread(picture) > 4, 'the page is blank');
      } finally {
        await tab.close();
      }
    });
  }

  await test(`${browser.name}: ladder: a device that is lost at once is given up after some tries`, async () => {
    const tab = await browser.open(`${origin}/fault/stub/${QUERY}&play=lost`);
    try {
      await tab.until('the last rung', () => document.body.dataset.rung === 'lost');
      const said = (what) => tab.log.filter((line) => line.includes(what)).length;
      assert.deepEqual([said('opening another'), said('loading the page again')], [8, 2]);
      const canvases = await tab.evaluate(() => document.querySelectorAll('canvas').length);
      assert.equal(canvases, 1, 'canvases are not heaped up');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: ladder: file`, async () => {
    const tab = await browser.open(pathToFileURL(join(dist, 'index.html')).href);
    try {
      const shown = await tab.until('a rung', () => document.body.dataset.rung);
      assert.equal(shown, 'file');
      assert.match(await tab.evaluate(() => document.getElementById('ladder').innerText), /web server/);
      const picture = fromPng(await tab.screenshot(join(out, `${browser.name}-ladder-file.png`)));
      assert.ok(spread(picture) > 4, 'the page is blank');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: every rung says what to do, and names another way`, async () => {
    const tab = await browser.open(`${origin}/fault/stub/${QUERY}&play=reject`);
    try {
      await tab.until('a rung', () => document.body.dataset.rung);
      const rungs = await tab.evaluate(() => [...document.querySelectorAll('section[data-rung]')].map((each) => [
        each.dataset.rung,
        each.querySelector('p').textContent,
        each.querySelector('h2').textContent,
      ]));
      const tested = new Set([...RUNGS.map((each) => each.rung), 'file']);
      assert.deepEqual(new Set(rungs.map(([rung]) => rung)), tested, 'every rung is tested');
      for (const [rung, text, title] of rungs) {
        assert.match(text, /: (open|update|allow|switch|check|close|load)|again/, rung);
        assert.ok(title.length > 10, rung);
      }
      assert.match(await tab.evaluate(() => document.getElementById('kept').innerText), /Windows, macOS and Linux/);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: loading is no blank page`, async () => {
    const tab = await browser.open(`${origin}/fault/stub/${QUERY}&play=sleep`);
    try {
      await tab.until('the start', () => document.getElementById('status').textContent.startsWith('Preparing'));
      const picture = fromPng(await tab.screenshot(join(out, `${browser.name}-loading.png`)));
      assert.ok(spread(picture) > 4, 'the page is blank');
      assert.deepEqual(tab.errors, []);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: progress counts bytes`, async () => {
    const tab = await browser.open(`${origin}/fault/wasm-stall/${QUERY}`);
    try {
      const text = await tab.until('half a program', () => {
        const status = document.getElementById('status').textContent;
        const bar = document.getElementById('bar');
        return bar.value > 0 && Math.abs(bar.value / bar.max - 0.5) < 0.01 && status;
      });
      assert.match(text, /^Loading: \d+\.\d of \d+\.\d MB$/);
      return text;
    } finally {
      await tab.close();
    }
  });
}
