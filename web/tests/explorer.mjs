// The page in a visitor's hands: the panel, mouse and touch, links, saved pictures, screen readers.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { frames, openSea, stateOf } from './sea.mjs';
import { SEA, change, crop, fromPng, spread } from './stats.mjs';

// Few pixels of sea below a panel of the usual size.
const STATE = 'n=64&pause=1&t=20&mesh=0.1&renderscale=0.25&adaptive=0';
const SIZE = [760, 520];

export async function explorer(context) {
  const { test, out, browser } = context;
  const shot = (tab, name) => tab.screenshot(join(out, `${browser.name}-${name}.png`)).then(fromPng);
  const place = async (tab, label) => {
    const [x, y, width, height] = await tab.until(
      `"${label}" on the panel`,
      (name) => window.seastate.widget_bounds(name) && [...window.seastate.widget_bounds(name)],
      label,
    );
    return { x, y, width, height, middle: [x + width / 2, y + height / 2] };
  };
  /** Waits for `count` more frames, whether or not their foam is complete. */
  const turns = async (tab, count) => {
    const have = await tab.evaluate(() => window.seastate.frames());
    await tab.until(
      `${count} more frames`,
      (enough) => {
        window.seastate.is_picture_complete();
        return window.seastate.frames() >= enough;
      },
      have + count,
    );
  };
  const click = async (tab, label) => {
    await tab.page.mouse.move(...(await place(tab, label)).middle);
    await turns(tab, 2);
    // Without a frame in between: frames are slow here, and a long press is no click.
    await tab.page.mouse.down();
    await tab.page.mouse.up();
    await turns(tab, 2);
  };
  // Touch events of one finger. Firefox's driver needs a touch screen for them, so there the page creates the events.
  const fingerOf = (tab) => async (kind, x, y) => {
    const touch = tab.page.touchscreen;
    if (browser.name === 'chromium') {
      await {
        touchstart: () => touch.touchStart(x, y),
        touchmove: () => touch.touchMove(x, y),
        touchend: () => touch.touchEnd(),
      }[kind]();
      return;
    }
    await tab.evaluate(
      (type, at) => {
        const canvas = document.querySelector('canvas');
        const point = new Touch({
          identifier: 1,
          target: canvas,
          clientX: at[0],
          clientY: at[1],
          pageX: at[0],
          pageY: at[1],
        });
        const down = type === 'touchend' ? [] : [point];
        canvas.dispatchEvent(
          new TouchEvent(type, {
            touches: down,
            targetTouches: down,
            changedTouches: [point],
            bubbles: true,
            cancelable: true,
          }),
        );
      },
      kind,
      [x, y],
    );
  };
  const drag = async (tab, from, to) => {
    const { mouse } = tab.page;
    await mouse.move(...from);
    await turns(tab, 2);
    await mouse.down();
    await turns(tab, 1);
    for (let i = 1; i <= 5; i += 1) {
      await mouse.move(from[0] + ((to[0] - from[0]) * i) / 5, from[1] + ((to[1] - from[1]) * i) / 5);
      await turns(tab, 1);
    }
    await mouse.up();
    await turns(tab, 2);
  };

  await test(`${browser.name}: Beaufort 8 by the slider, a typed value, undo`, async () => {
    const tab = await openSea(context, STATE, { size: SIZE });
    try {
      const slider = await place(tab, 'Beaufort');
      // The handle's centre stays 8 points away from the ends of the rail.
      const at = (n) => [slider.x + 8 + ((slider.width - 16) * n) / 12, slider.y + slider.height / 2];
      await drag(tab, at(6), at(8));
      const gale = await stateOf(tab);
      assert.ok(Number(gale.wind) > 17.2 && Number(gale.wind) < 20.7, `wind ${gale.wind}`);
      await click(tab, 'Undo');
      assert.equal((await stateOf(tab)).wind, undefined, 'undone');
      // A typed time.
      await click(tab, 'View');
      await click(tab, 'Time in seconds');
      await tab.page.keyboard.type('33');
      await tab.page.keyboard.press('Enter');
      await turns(tab, 3);
      assert.equal((await stateOf(tab)).t, '33', 'typed');
      assert.deepEqual(tab.errors, [], 'console errors');
      await shot(tab, 'panel');
      return `wind ${gale.wind} m/s`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: play, pause, scrub`, async () => {
    const tab = await openSea(context, STATE, { size: SIZE });
    try {
      await click(tab, 'Play');
      await tab.until('time to run', () => Number(new URLSearchParams(window.seastate.state()).get('t')) > 20.5);
      await click(tab, 'Pause');
      const stopped = await stateOf(tab);
      assert.equal(stopped.pause, '1');
      await click(tab, 'View');
      const slider = await place(tab, 'Time');
      const y = slider.y + slider.height / 2;
      await drag(tab, [slider.x + 0.3 * slider.width, y], [slider.x + 0.75 * slider.width, y]);
      const scrubbed = Number((await stateOf(tab)).t);
      assert.ok(scrubbed > 80 && scrubbed < 100, `t ${scrubbed}`);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: orbit by mouse and by touch`, async () => {
    const tab = await openSea(context, `${STATE}&camera=orbit&pitch=-20&y=20&ui=0`, { size: SIZE });
    try {
      const before = await stateOf(tab);
      await drag(tab, [300, 300], [400, 300]);
      const turned = await stateOf(tab);
      assert.ok(turned.heading !== before.heading && turned.x !== undefined, JSON.stringify(turned));
      const finger = fingerOf(tab);
      await finger('touchstart', 300, 300);
      await turns(tab, 2);
      for (const x of [330, 360, 390]) {
        await finger('touchmove', x, 300);
        await turns(tab, 1);
      }
      await finger('touchend', 390, 300);
      await turns(tab, 2);
      const touched = await stateOf(tab);
      assert.notEqual(touched.heading, turned.heading, 'one finger turns');
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: the address opens the same picture in a second tab`, async () => {
    const tab = await openSea(context, `${STATE}&wind=17&fetch=200&sun=15&sunaz=50&ui=0`, { size: SIZE });
    try {
      await drag(tab, [300, 300], [340, 280]);
      // The address follows the moving pointer with a delay: it must be the address of the picture.
      const heading = (text) => new URLSearchParams(text).get('heading');
      await frames(tab, 3);
      const shown = heading(await tab.evaluate(() => window.seastate.state()));
      await tab.until('the address', (at) => new URLSearchParams(location.search).get('heading') === at, shown);
      const first = await shot(tab, 'first-tab');
      const link = await tab.evaluate(() => location.search.slice(1));
      const other = await openSea(context, link, { size: SIZE });
      const second = await shot(other, 'second-tab');
      await other.close();
      const apart = change(first, second);
      assert.ok(apart < 0.01, `the pictures differ by ${apart.toFixed(4)}`);
      return `difference ${apart.toFixed(4)}`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: copies the link, and a saved picture brings its sea back`, async () => {
    // Catches texts for the clipboard and downloads, whatever the browser allows.
    const before = () => {
      window.copied = [];
      const clipboard = {
        writeText: (text) => {
          window.copied.push(text);
          return Promise.resolve();
        },
        write: () => Promise.resolve(),
      };
      Object.defineProperty(navigator, 'clipboard', { value: clipboard, configurable: true });
      window.saved = [];
      // The page's security policy forbids fetching a blob by its address: the blob is kept when it gets the address.
      const address = URL.createObjectURL.bind(URL);
      let last;
      URL.createObjectURL = (blob) => {
        last = blob;
        return address(blob);
      };
      HTMLAnchorElement.prototype.click = function caught() {
        window.saved.push({ name: this.download, blob: last });
      };
    };
    const tab = await openSea(context, `${STATE}&wind=18`, { size: SIZE, before });
    try {
      await click(tab, 'Share');
      await click(tab, 'Copy link');
      const link = await tab.until('the link', () => window.copied[0]);
      assert.ok(new URL(link).searchParams.get('wind') === '18', link);
      await click(tab, 'Picture');
      await tab.until('the picture', () => window.saved.length > 0);
      await tab.evaluate(() => window.seastate.set_state('n=64&pause=1&mesh=0.1&renderscale=0.25'));
      await turns(tab, 2);
      await tab.evaluate(async () => {
        const { name, blob } = window.saved[0];
        const data = new DataTransfer();
        data.items.add(new File([blob], name, { type: 'image/png' }));
        document
          .querySelector('canvas')
          .dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
      });
      await tab.until(
        'the sea of the picture',
        () => new URLSearchParams(window.seastate.state()).get('wind') === '18',
      );
      assert.deepEqual(tab.errors, [], 'console errors');
      return await tab.evaluate(() => window.saved[0].name);
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: H hides the panel, a phone has a sheet`, async () => {
    const tab = await openSea(context, STATE, { size: SIZE });
    try {
      const full = crop(await shot(tab, 'with-panel'), [0.58, 0.05, 0.98, 0.5]);
      await tab.page.mouse.click(200, 400);
      await tab.page.keyboard.press('h');
      await tab.until('the panel to go', () => new URLSearchParams(window.seastate.state()).get('ui') === '0');
      await frames(tab, 2);
      const bare = crop(await shot(tab, 'without-panel'), [0.58, 0.05, 0.98, 0.5]);
      assert.ok(change(full, bare) > SEA.change, 'the panel is gone');
      await tab.page.keyboard.press('h');
      await tab.page.setViewport({ width: 390, height: 844, deviceScaleFactor: 1 });
      await tab.until('the narrow window', () => document.querySelector('canvas').clientWidth === 390);
      await frames(tab, 4);
      const phone = await shot(tab, 'phone');
      assert.ok(spread(crop(phone, [0.02, 0.5, 0.98, 0.9])) > 0, 'a sea above the sheet');
      await click(tab, 'Weather');
      const button = await place(tab, 'Undo');
      assert.ok(
        button.height >= 44 && button.y > 844 * 0.5 && button.y < 844,
        `a finger hits what is in the sheet: ${JSON.stringify(button)}`,
      );
      await shot(tab, 'phone-sheet');
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: a screen reader lists the panel and uses it`, async () => {
    const tab = await openSea(context, STATE, { size: SIZE });
    try {
      assert.equal(
        await tab.evaluate(() => document.getElementById('controls').childElementCount),
        0,
        'nothing is mirrored unasked',
      );
      await tab.evaluate(() => document.getElementById('readers-ask').focus());
      await tab.page.keyboard.press('Enter');
      const find = (what) =>
        tab.until(
          `an element for ${what}`,
          (name) =>
            [...document.getElementById('controls').children].some((e) => (e.ariaLabel ?? e.textContent) === name),
          what,
        );
      const wind = () => tab.evaluate(() => Number(new URLSearchParams(window.seastate.state()).get('wind') ?? 12));
      await find('Undo');
      await find('Beaufort');
      const before = await wind();
      await tab.evaluate(() => {
        const slider = [...document.querySelectorAll('#controls input[type=range]')].find(
          (e) => e.ariaLabel === 'Beaufort',
        );
        slider.value = 8;
        slider.dispatchEvent(new Event('input'));
      });
      await tab.until('Beaufort 8 to be told', () =>
        document.getElementById('told').textContent.includes('Beaufort 8'),
      );
      assert.ok((await wind()) > before + 3, 'the wind follows');
      // Arrow keys work, too.
      const eight = await wind();
      await tab.evaluate(() =>
        [...document.querySelectorAll('#controls input[type=range]')].find((e) => e.ariaLabel === 'Beaufort').focus(),
      );
      await tab.page.keyboard.press('ArrowRight');
      await tab.until('Beaufort 9 to be told', () =>
        document.getElementById('told').textContent.includes('Beaufort 9'),
      );
      assert.ok((await wind()) > eight, 'an arrow moves it');
      assert.equal(await tab.evaluate(() => document.activeElement.ariaLabel), 'Beaufort', 'and it keeps the keyboard');
      // Buttons work; elements come and go with their widgets.
      const press = (name) =>
        tab.evaluate(
          (label) => [...document.querySelectorAll('#controls button')].find((e) => e.textContent === label).click(),
          name,
        );
      await press('Study');
      await find('Search');
      // A typed text appears, and can be removed.
      const search = (words) =>
        tab.evaluate((text) => {
          const field = [...document.querySelectorAll('#controls input[type=text]')].find(
            (e) => e.ariaLabel === 'Search',
          );
          field.value = text;
          field.dispatchEvent(new Event('change'));
        }, words);
      await search('caustics');
      await find('Caustics');
      await search('');
      await tab.until(
        'the search to end',
        () =>
          ![...document.getElementById('controls').children].some((e) => (e.ariaLabel ?? e.textContent) === 'Caustics'),
      );
      assert.equal(
        await tab.evaluate(() =>
          [...document.querySelectorAll('#controls button')].some((e) => e.textContent === 'Hurricane'),
        ),
        false,
      );
      await press('Seas');
      await find('Hurricane');
      await press('Play');
      await tab.until('the sea to run', () => new URLSearchParams(window.seastate.state()).get('pause') === null);
      assert.deepEqual(tab.errors, [], 'console errors');
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: who wants less motion starts with a still sea`, async () => {
    const tab = await openSea(context, 'n=64&t=20&ui=0&mesh=0.1', {
      before: () => {
        const ask = window.matchMedia.bind(window);
        window.matchMedia = (query) =>
          query.includes('prefers-reduced-motion')
            ? Object.create(MediaQueryList.prototype, { matches: { value: true } })
            : ask(query);
      },
    });
    try {
      assert.equal((await stateOf(tab)).pause, '1');
    } finally {
      await tab.close();
    }
  });
}
