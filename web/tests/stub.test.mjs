// The stub of the program has every function that the page asks for. If one were missing, a test would see a failure of
// the page that the real program cannot cause.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

const web = new URL('../', import.meta.url);
const scripts = readdirSync(web).filter((name) => name.endsWith('.js') && name !== 'sea-state.js');

/** Names of the program's functions that a script calls. */
const CALL = /\b(?:seastate\??|sea|handle|program\(\)\??)\.([a-z_]+)\(/g;
const called = (text) => [...text.matchAll(CALL)].map((found) => found[1]);

test('the stub can all that the page asks for', async () => {
  globalThis.location = new URL('http://localhost/');
  const { WebHandle } = await import('./stub.js');
  const asked = new Set(scripts.flatMap((name) => called(readFileSync(new URL(name, web), 'utf8'))));
  for (const name of ['start', 'has_first_picture', 'set_safe_area', 'tilt_button', 'accessible_items', 'link_state']) {
    assert.ok(asked.has(name), `the page calls ${name}, which this test does not see`);
  }
  const missing = [...asked].filter((name) => typeof WebHandle.prototype[name] !== 'function');
  assert.deepEqual(missing, []);
});
