// The page for screen readers, by axe-core's rules: the mirrored controls of each tab, and the page without a GPU.
import assert from 'node:assert/strict';
import axe from 'axe-core';
import { openSea } from './sea.mjs';

const STATE = 'n=64&pause=1&mesh=0.1&renderscale=0.25&adaptive=0';
const TABS = ['Seas', 'Weather', 'View', 'Study', 'Share'];

/** Violations that keep people from using the page, a line each. */
async function seriousViolations(tab) {
  await tab.evaluate(axe.source);
  return tab.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ['violations'] });
    const serious = violations.filter(({ impact }) => ['serious', 'critical'].includes(impact));
    return serious.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html}`));
  });
}

export async function readers(context) {
  const { test, browser, origin } = context;

  await test(`${browser.name}: axe-core finds nothing serious in the controls for screen readers`, async () => {
    const tab = await openSea(context, STATE, { size: [760, 520] });
    try {
      await tab.evaluate(() => document.getElementById('readers-ask').click());
      const list = () =>
        [...document.querySelectorAll('#controls button')].map((element) => element.ariaLabel ?? element.textContent);
      let count = 0;
      for (const name of TABS) {
        await tab.until(`the tab ${name}`, `(${list})().includes(${JSON.stringify(name)})`);
        const open = (label) => {
          const found = [...document.querySelectorAll('#controls button')].find((e) => e.textContent === label);
          found.click();
        };
        // The weather is open at first; a second click would close it.
        if (name !== 'Weather') await tab.evaluate(open, name);
        await new Promise((resolve) => setTimeout(resolve, 1500));
        assert.deepEqual(await seriousViolations(tab), [], name);
        count += await tab.evaluate(() => document.getElementById('controls').childElementCount);
        const handles = (await tab.evaluate(`(${list})()`)).filter((label) => /resize/i.test(label));
        assert.deepEqual(handles, [], 'handles of windows are no buttons');
        if (name === 'Seas') await tab.evaluate(open, 'Weather');
      }
      // A button for the fault that the rules must find.
      await tab.evaluate(() => document.getElementById('controls').append(document.createElement('button')));
      assert.match((await seriousViolations(tab)).join(), /button-name/, 'the planted fault is found');
      return `${count} elements in ${TABS.length} tabs`;
    } finally {
      await tab.close();
    }
  });

  await test(`${browser.name}: axe-core finds nothing serious in the page without a GPU`, async () => {
    const before = () => {
      GPU.prototype.requestAdapter = async () => null;
    };
    const tab = await browser.open(`${origin}/`, { before, size: [760, 520] });
    try {
      await tab.until('the rung', () => document.body.dataset.rung);
      assert.deepEqual(await seriousViolations(tab), []);
    } finally {
      await tab.close();
    }
  });
}
