// The page without a network, its service worker and copies, and the page in a frame.
import assert from 'node:assert/strict';
import { setTimeout as sleep } from 'node:timers/promises';
import { poll } from './browsers.mjs';
import { openSea } from './sea.mjs';
import { serve } from './server.mjs';

const STATE = 'wind=15&fetch=300&t=20&pause=1&n=64&ui=0&mesh=0.1';

/**
 * Waits until the page in the frame runs or shows a rung; returns which of the two, the rung with its text.
 *
 * The frame is looked up and asked anew each time, because an answer can be lost while Chromium moves the frame into a
 * process of its own; a single long wait would then never end.
 */
async function frameState(tab) {
  const answer = async () => {
    const frame = tab.page.frames().find((each) => each.url().startsWith('http://127.0.0.1'));
    return frame?.evaluate(() => {
      const { classList, dataset, innerText } = document.body;
      return classList.contains('running') ? 'running' : dataset.rung && `${dataset.rung}: ${innerText}`;
    });
  };
  const found = await poll(() => Promise.race([answer(), sleep(2000)]));
  return found || `nothing; frames: ${tab.page.frames().map((each) => each.url())}; log: ${tab.log.join(' | ')}`;
}

export async function offline(context) {
  const { test, browser, dist } = context;

  await test(`${browser.name}: a visited page opens without a network, and a new version is used at once`, async () => {
    let server = await serve(dist);
    const { port } = server;
    // A host name that the page does not count as a development host, and a folder, as on a real host.
    const at = { browser, origin: `http://sea.localhost:${port}` };
    const folder = 'fault/none/';
    const open = () => openSea(at, STATE, { folder });
    try {
      let tab = await open();
      const [first] = await tab.until(
        'a copy',
        async () =>
          (await navigator.serviceWorker.ready).active?.state === 'activated' &&
          (await caches.keys()).length > 0 &&
          caches.keys(),
      );
      await tab.close();
      await server.close();
      tab = await open();
      assert.deepEqual(tab.errors, [], 'console errors');
      assert.equal(new URLSearchParams(await tab.evaluate(() => window.seastate.state())).get('wind'), '15');
      await tab.close();

      // Another version of the page: another heading, so another checksum.
      const edit = (path, body) => {
        if (path === 'index.html') return body.toString().replace(/<h1>[^<]*/, '<h1>Later');
        return path === 'sw.js' ? body.toString().replace(/`\$\{OURS\}[^`]*`/, '`${OURS}later`') : body;
      };
      server = await serve(dist, { port, edit });
      tab = await open();
      assert.equal(await tab.evaluate(() => document.querySelector('h1').textContent), 'Later', "a page from the network is the network's");
      await tab.until(
        'the copy of the new version alone',
        async (old) => {
          const names = await caches.keys();
          return names.length === 1 && names[0] !== old;
        },
        first,
      );
      await tab.close();
      await server.close();
      tab = await open();
      assert.equal(await tab.evaluate(() => document.querySelector('h1').textContent), 'Later', 'without a network, too');
      await tab.close();
    } finally {
      await server.close().catch(() => {});
    }
  });

  await test(`${browser.name}: no copy at a local address, and one that is there goes`, async () => {
    let tab = await openSea(context, STATE);
    await tab.evaluate(() => navigator.serviceWorker.register('sw.js'));
    await tab.until('a worker', async () => Boolean((await navigator.serviceWorker.getRegistration())?.active));
    await tab.close();
    tab = await openSea(context, STATE);
    try {
      await tab.until('the worker to go', async () => (await navigator.serviceWorker.getRegistration()) === undefined);
      await tab.until('its copy, too', async () => (await caches.keys()).length === 0);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: shows in a frame of another page`, async () => {
    const tab = await browser.open(`http://localhost:${context.port}/frame/?${STATE}`);
    try {
      assert.equal(await frameState(tab), 'running');
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });
}
