// The page in frames of other pages: the element <sea-state>, its messages, and scrolling.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { openSea } from './sea.mjs';
import { SEA, fromPng, spread } from './stats.mjs';

const STATE = 'n=64&mesh=0.1&adaptive=0&renderscale=0.5&t=20&pause=1';

/** Opens the page of examples with its first sea ready. */
async function openExamples(context, state = STATE) {
  const tab = await context.browser.open(`http://localhost:${context.port}/examples.html?${state}`, {
    size: [640, 480],
  });
  await tab.until('the words of the sea', () => document.getElementById('words').textContent.startsWith('Force'));
  return tab;
}

export async function frames(context) {
  const { test, browser, out } = context;

  await test(`${browser.name}: the element <sea-state> is set, asked, and tells of changes`, async () => {
    const tab = await openExamples(context);
    try {
      const found = await tab.evaluate(async () => {
        const sea = document.querySelector('sea-state');
        const before = await sea.getState();
        const change = new Promise((resolve) => sea.addEventListener('change', resolve, { once: true }));
        const after = await sea.setState('wind=25&fetch=500&n=64&mesh=0.1&pause=1');
        const { detail } = await change;
        const points = [[0, 0], [50, 0], [0, 0]];
        const heights = await sea.heights(points, 20);
        const later = await sea.heights(points, 24);
        return { before, after, detail, heights, later, words: sea.words };
      });
      const { before, after, detail, heights, later, words } = found;
      assert.match(before, /^v=2&wind=9&fetch=200&mesh=0.1&t=20&pause=1&n=64&ui=mini/);
      assert.match(after, /^v=2&wind=25&fetch=500.*ui=mini/, 'what is shown over the sea stays as it is');
      assert.equal(detail.state, after);
      const height_m = Number(/^Force 10 sea, waves (\d+\.\d) m high$/.exec(words)?.[1]);
      assert.ok(height_m > 5, `the new sea, not the old one: ${words}`);
      assert.equal(heights.length, 3);
      assert.equal(heights[0], heights[2]);
      assert.ok(heights.every(Number.isFinite) && heights[0] !== heights[1] && heights[0] !== later[0], `${heights}`);
      assert.deepEqual(tab.errors, [], 'console errors');
      return `${words}; heights ${heights.map((height) => height.toFixed(2)).join(', ')} m`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: buttons of the examples work, and a frame adds no steps to "back"`, async () => {
    const tab = await openExamples(context);
    try {
      const steps = await tab.evaluate(() => history.length);
      await tab.page.click('#storm');
      await tab.until('a storm', () => document.getElementById('words').textContent.startsWith('Force 10'));
      await tab.page.click('#ask');
      await tab.until('heights', () => /m, .* m/.test(document.getElementById('heights').textContent));
      await new Promise((resolve) => setTimeout(resolve, 1500));
      assert.equal(await tab.evaluate(() => history.length), steps);
      assert.ok(spread(fromPng(await tab.screenshot(join(out, `${browser.name}-examples.png`)))) > SEA.spread);
      return await tab.evaluate(() => document.getElementById('words').textContent);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: messages that are wrong change nothing`, async () => {
    const tab = await openExamples(context);
    try {
      const found = await tab.evaluate(async () => {
        const sea = document.querySelector('sea-state');
        const { contentWindow } = sea.shadowRoot.querySelector('iframe');
        const before = await sea.getState();
        const refusal = (promise) => promise.then(() => 'taken', (error) => error.message);
        const answers = [
          await refusal(sea.heights([[0]])),
          await refusal(sea.heights([[0, Infinity]])),
          await refusal(sea.heights(new Array(1001).fill([0, 0]))),
          await refusal(sea.heights([[0, 0]], 'now')),
          await refusal(sea.setState('x'.repeat(70_000))),
        ];
        const heard = [];
        addEventListener('message', ({ data }) => heard.push(data));
        const wrong = [null, 'wind=3', 7, {}, { seastate: 2, id: 1, call: 'setState', state: 'wind=3' }];
        wrong.push({ seastate: 1, id: 'a', call: 'setState', state: 'wind=3' });
        wrong.push({ seastate: 1, id: 1, call: 'constructor' });
        for (const message of wrong) contentWindow.postMessage(message, '*');
        // A message that does not come from the frame is not taken for its answer.
        postMessage({ seastate: 1, event: 'change', state: 'wind=3', words: 'false' }, '*');
        const after = await sea.getState();
        return { answers, before, after, words: sea.words, refused: heard.filter((data) => data?.error) };
      });
      for (const answer of found.answers) assert.match(answer, /needed/);
      assert.equal(found.after, found.before);
      assert.notEqual(found.words, 'false');
      assert.equal(found.refused.length, 1);
      assert.match(found.refused[0].error, /there is no call constructor/);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: the wheel scrolls the other page until the frame is clicked`, async () => {
    const tab = await openExamples(context);
    try {
      await tab.evaluate(() => document.querySelector('sea-state').scrollIntoView({ block: 'center' }));
      const box = await (await tab.page.$('sea-state')).boundingBox();
      const { mouse } = tab.page;
      const stateNow = () => tab.evaluate(() => document.querySelector('sea-state').getState());
      const place = () => tab.evaluate(() => scrollY);
      const [start, before] = [await place(), await stateNow()];
      await mouse.move(box.x + box.width / 2, box.y + 30);
      await mouse.wheel({ deltaY: 40 });
      await tab.until('the page to scroll', (old) => scrollY > old, start);
      await new Promise((resolve) => setTimeout(resolve, 500));
      assert.equal(await stateNow(), before, 'the camera stays');
      await tab.evaluate(() => document.querySelector('sea-state').scrollIntoView({ block: 'center' }));
      const again = await (await tab.page.$('sea-state')).boundingBox();
      // The pointer rests before the click: a frame that saw both at once would take the way for a drag.
      const middle = [again.x + again.width / 2, again.y + again.height / 3];
      await mouse.move(...middle);
      await new Promise((resolve) => setTimeout(resolve, 500));
      await mouse.click(...middle);
      const clicked = await place();
      await mouse.wheel({ deltaY: 100 });
      const zoomed = await tab.until(
        'a zoom',
        () =>
          document
            .querySelector('sea-state')
            .getState()
            .then((state) => /fov=/.test(state) && state),
      );
      assert.notEqual(zoomed, before);
      assert.equal(await place(), clicked, 'the page stays');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: the title tells the sea, and a chosen file is opened`, async () => {
    const tab = await openSea(context, `wind=10&fetch=100&${STATE}&ui=0`);
    try {
      await tab.until('the title', () => document.title === 'Force 5, 2.1 m: Seastate');
      const input = await tab.page.$('#open-files');
      await input.uploadFile(join(context.top, 'assets', 'spectra', 'two-systems.txt'));
      await tab.until(
        'the buoy in the address',
        () => new URLSearchParams(location.search).get('spectrum') === 'measured',
      );
      assert.deepEqual(tab.errors, [], 'console errors');
      return await tab.evaluate(() => document.title);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a film is recorded`, async () => {
    const tab = await openSea(context, 'wind=10&n=64&mesh=0.1&adaptive=0&renderscale=0.25&t=20&ui=0');
    try {
      const bytes = await tab.evaluate(async () => {
        HTMLAnchorElement.prototype.click = () => {};
        const saved = new Promise((resolve) => {
          URL.createObjectURL = (blob) => {
            resolve(blob.arrayBuffer());
            return 'blob:';
          };
        });
        dispatchEvent(new Event('seastate-film-start'));
        await new Promise((resolve) => setTimeout(resolve, 3000));
        dispatchEvent(new Event('seastate-film-stop'));
        return new Uint8Array(await saved).slice(0, 4).join(' ');
      });
      // The signature of Matroska, which WebM is.
      assert.equal(bytes, '26 69 223 163');
    } finally {
      await tab.close();
    }
  });
}
