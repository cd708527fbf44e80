// Loads and starts the program, and shows a message in plain words when something fails.
//
// Each kind of failure has a message, a "rung" of the "ladder", in index.html. This file knows nothing about the sea:
// the program reads its state from the page's address.

const STALL_SECONDS = 20; // without a byte, before a download counts as stalled
const ADAPTER_SECONDS = 30; // limit for a graphics adapter or device to answer
const SLOW_SECONDS = 20; // without a first picture, before the page asks for patience
const WATCH_MS = 250; // interval of watch()
const START_MS = 50; // interval of watch() until the first picture
const START_TRIES = 3; // attempts to start, if the browser refuses a device
const COVER_SECONDS = 10; // longest time that the old canvas covers the new one while foam builds up on a new device
const FRAME_SECONDS = 10; // without an animation frame after a device loss, before the tab counts as dead
const LOSS_WINDOW_SECONDS = 60; // period over which device losses are counted
const LOSS_REVIVALS = 8; // device losses answered with a new device
const LOSS_RELOADS = 2; // further device losses answered by reloading the page; after these the page gives up
const LOSS_KEY = 'seastate-device-lost'; // sessionStorage key of the recent loss times
const BOX_TOLERANCE_PX = 2; // browsers round the canvas's edges to whole device pixels

// Hosts used for development: no offline copy is kept there.
const LOCAL = new Set(['localhost', '127.0.0.1', '[::1]']);

// Limits that the program needs from the device. Each is WebGPU's default limit.
const LIMITS = {
  maxTextureDimension2D: 8192,
  maxComputeInvocationsPerWorkgroup: 256,
  maxComputeWorkgroupStorageSize: 16384,
  maxStorageTexturesPerShaderStage: 4,
  maxStorageBuffersPerShaderStage: 8,
  maxStorageBufferBindingSize: 128 * 1024 * 1024,
};

const element = (id) => document.getElementById(id);

/** An error with the name of the message in index.html (the "rung") that explains it, and a technical reason. */
class Rung extends Error {
  constructor(rung, reason) {
    super(reason ?? rung);
    this.rung = rung;
    this.reason = reason;
  }
}

let said = ['Loading…']; // the English text of the status, and the values in its places

/** Shows what the page is doing, in the visitor's language (words.js). */
function say(...text) {
  said = text;
  element('status').textContent = window.seastateWords(...text);
}

addEventListener('seastate-words', () => say(...said));

/** Shows one failure message of index.html (a "rung"), with the technical text `reason` below it. */
function show(rung, reason) {
  for (const section of document.querySelectorAll('[data-rung]')) {
    section.hidden = section.dataset.rung !== rung;
  }
  element('reason').textContent = reason ?? '';
  element('details').hidden = !reason;
  // The browser's name helps whoever gets a report, and only hides the message from everybody else.
  element('details').open = reason !== navigator.userAgent;
  element('state').textContent = `seastate "${location.search.slice(1)}"`;
  element('loading').hidden = true;
  element('ladder').hidden = false;
  document.body.dataset.rung = rung;
}

/** Hides a failure message (a "rung") whose cause has gone. */
function hide(rung) {
  if (document.body.dataset.rung !== rung) return;
  delete document.body.dataset.rung;
  element('ladder').hidden = true;
  element('loading').hidden = document.body.classList.contains('running');
}

/** Returns a promise that rejects after some seconds with the error that `make` returns. */
function after(seconds, make) {
  return new Promise((_, reject) => setTimeout(() => reject(make()), seconds * 1000));
}

function checkBrowser() {
  if (location.protocol === 'file:') throw new Rung('file');
  if (typeof WebAssembly !== 'object' || typeof WebAssembly.compileStreaming !== 'function') throw new Rung('no-wasm');
  if (!isSecureContext) throw new Rung('insecure', location.origin);
  if (!navigator.gpu) throw new Rung('no-webgpu', navigator.userAgent);
}

let density; // devicePixelRatio at the last fit()

/**
 * Limits the canvas to the largest texture of the device. eframe only watches the canvas's size in CSS pixels, which
 * stays the same when the device pixel ratio changes: a nudge of 0.02 px makes it measure the canvas again.
 */
function fit() {
  if (density === devicePixelRatio) return;
  const { style } = document.documentElement;
  style.setProperty('--most', `${Math.floor(LIMITS.maxTextureDimension2D / devicePixelRatio)}px`);
  if (density) style.setProperty('--nudge', style.getPropertyValue('--nudge') === '0.02px' ? '0px' : '0.02px');
  density = devicePixelRatio;
}

/**
 * Corrects the canvas's size in device pixels. eframe takes it from `devicePixelContentBoxSize`, but scales its
 * interface by `devicePixelRatio`. Where the two disagree (a ratio emulated by developer tools, some embedded views),
 * words overlap and taps miss. In that case the size becomes the size in CSS pixels times the ratio.
 */
function mendPixelSize() {
  const { prototype } = ResizeObserverEntry;
  const original = Object.getOwnPropertyDescriptor(prototype, 'devicePixelContentBoxSize');
  if (!original) return; // without it, eframe multiplies the size in CSS pixels by the ratio
  Object.defineProperty(prototype, 'devicePixelContentBoxSize', {
    ...original,
    get() {
      const reported = original.get.call(this);
      const { inlineSize, blockSize } = reported[0];
      const width = Math.round(this.contentRect.width * devicePixelRatio);
      const height = Math.round(this.contentRect.height * devicePixelRatio);
      const error = Math.max(Math.abs(inlineSize - width), Math.abs(blockSize - height));
      if (error <= BOX_TOLERANCE_PX) return reported;
      const corrected = { inlineSize: { value: width }, blockSize: { value: height } };
      return [Object.create(ResizeObserverSize.prototype, corrected)];
    },
  });
}

async function checkAdapter() {
  let adapter;
  try {
    const late = after(ADAPTER_SECONDS, () => new Rung('no-adapter', `no answer in ${ADAPTER_SECONDS} s`));
    adapter = await Promise.race([navigator.gpu.requestAdapter(), late]);
  } catch (error) {
    throw error instanceof Rung ? error : new Rung('no-adapter', String(error));
  }
  if (!adapter) throw new Rung('no-adapter', navigator.userAgent);
  const low = Object.entries(LIMITS).filter(([name, need]) => !(adapter.limits[name] >= need));
  if (low.length > 0) {
    throw new Rung(
      'limits',
      low.map(([name, need]) => `${name}: ${need} needed, this one has ${adapter.limits[name]}`).join('\n'),
    );
  }
}

const megabytes = (bytes) => (bytes / 1e6).toFixed(1);

/** Whether bytes have the checksum `sum`, which has the form of an HTML `integrity` attribute. */
async function isWhole(bytes, sum) {
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-384', bytes));
  return sum === `sha384-${btoa(String.fromCharCode(...digest))}`;
}

/** Returns a response with the same bytes that shows their progress and keeps them in `parts` while they are read. */
function counted(response, parts) {
  // With a Content-Encoding, Content-Length counts compressed bytes, but the stream decompressed ones: no total.
  const packed = response.headers.has('content-encoding');
  const total = packed ? 0 : Number(response.headers.get('content-length') ?? 0);
  const bar = element('bar');
  bar.hidden = false;
  let received = 0;
  let stall;
  const wait = () => {
    stall = setTimeout(() => show('stalled', `${megabytes(received)} MB have come`), STALL_SECONDS * 1000);
  };
  const arrived = () => {
    clearTimeout(stall);
    hide('stalled');
  };
  const reader = response.body.getReader();
  const stream = new ReadableStream({
    start: wait,
    async pull(controller) {
      let chunk;
      try {
        chunk = await reader.read();
      } catch (error) {
        arrived();
        throw error;
      }
      arrived();
      if (chunk.done) {
        bar.hidden = true;
        say('Compiling…');
        controller.close();
        return;
      }
      received += chunk.value.byteLength;
      parts.push(chunk.value);
      if (total > 0 && received <= total) {
        bar.max = total;
        bar.value = received;
        say('Loading: {done} of {total} MB', { done: megabytes(received), total: megabytes(total) });
      } else {
        bar.removeAttribute('value');
        say('Loading: {done} MB', { done: megabytes(received) });
      }
      wait();
      controller.enqueue(chunk.value);
    },
    cancel(reason) {
      arrived();
      return reader.cancel(reason);
    },
  });
  return new Response(stream, { headers: { 'content-type': 'application/wasm' } });
}

/** Imports a module with a given checksum: the browser checks the link's file, and import() reuses that file. */
function importWhole(address, sum) {
  const link = document.createElement('link');
  link.rel = 'modulepreload';
  link.href = address;
  link.integrity = sum;
  document.head.append(link);
  return import(address);
}

/** Fetches the program's WebAssembly and its JavaScript loader; compiles the WebAssembly while it arrives. */
async function download(signal) {
  const names = document.querySelector('meta[name="seastate-program"]').dataset;
  const here = (name) => new URL(name, document.baseURI);
  try {
    const connecting = setTimeout(() => show('stalled', 'no answer yet'), STALL_SECONDS * 1000);
    const answer = fetch(here(names.wasm), { signal }).finally(() => {
      clearTimeout(connecting);
      hide('stalled');
    });
    const glue = importWhole(here(names.glue), names.glueIntegrity);
    glue.catch(() => {}); // awaited below
    const response = await answer;
    if (!response.ok) throw new Rung('download', `${names.wasm}: ${response.status} ${response.statusText}`);
    // fetch() can check the checksum itself, but then releases no byte before the last has come.
    const parts = [];
    const module = await WebAssembly.compileStreaming(counted(response, parts));
    if (!(await isWhole(await new Blob(parts).arrayBuffer(), names.wasmIntegrity))) {
      throw new Rung('download', `${names.wasm} is not what the page was built with`);
    }
    return { glue: await glue, module };
  } catch (error) {
    throw error instanceof Rung ? error : new Rung('download', String(error));
  }
}

const pause = (seconds) => new Promise((resolve) => setTimeout(resolve, seconds * 1000));

/** Records a device loss and returns the number of recent losses. The record survives a reload of the page. */
function countLoss() {
  const now = Date.now();
  try {
    const losses = JSON.parse(sessionStorage.getItem(LOSS_KEY) ?? '[]').filter(
      (at) => now - at < LOSS_WINDOW_SECONDS * 1000,
    );
    losses.push(now);
    sessionStorage.setItem(LOSS_KEY, JSON.stringify(losses));
    return losses.length;
  } catch {
    return Infinity; // without sessionStorage the page could reload for ever
  }
}

function forgetLosses() {
  try {
    sessionStorage.removeItem(LOSS_KEY);
  } catch {
    // Without sessionStorage no loss was recorded.
  }
}

/** Starts the program on a canvas. No answer within ADAPTER_SECONDS counts as a failure. */
async function start(handle, canvas) {
  await Promise.race([
    handle.start(canvas),
    after(ADAPTER_SECONDS, () => new Error(`no device in ${ADAPTER_SECONDS} s`)),
  ]);
  // The invisible fields that eframe adds to receive typed text need a name for screen readers.
  for (const field of document.querySelectorAll('body > input')) field.setAttribute('aria-label', 'Typed text');
}

/**
 * Recovers from a device loss: the running program gets a new device and a new canvas, which the old canvas covers with
 * the last picture. After too many losses the page is reloaded (the address holds the state); after further losses it
 * gives up. Returns the old canvas, or undefined if the page reloads or has given up.
 */
async function recover(handle, reason) {
  for (;;) {
    const losses = countLoss();
    if (losses > LOSS_REVIVALS + LOSS_RELOADS) {
      forgetLosses();
      show('lost', reason);
      return undefined;
    }
    if (losses > LOSS_REVIVALS || handle.has_panicked()) {
      console.warn(`seastate: the graphics device was lost (${reason}), loading the page again`);
      location.reload();
      return undefined;
    }
    console.warn(`seastate: the graphics device was lost (${reason}), opening another`);
    const old = element('sea');
    const fresh = old.cloneNode();
    const hasKeyboard = document.activeElement === old;
    old.removeAttribute('id');
    old.inert = true;
    old.before(fresh);
    try {
      await start(handle, fresh);
      if (hasKeyboard) fresh.focus();
      watchFrames();
      return old;
    } catch (error) {
      reason = String(error?.message ?? error);
      fresh.remove();
      old.id = 'sea';
      old.inert = false;
      await pause(1);
    }
  }
}

/** The message of the program's panic; undefined if it has not panicked. */
function panicText(handle) {
  if (!handle?.has_panicked()) return undefined;
  return handle.panic_message() ?? 'no message';
}

/**
 * Registers the service worker, which keeps an offline copy of the page. On development hosts it removes worker and
 * copies instead: a later page on the same host and port must not be served from them.
 */
async function keepOffline() {
  const workers = navigator.serviceWorker;
  if (!workers) return;
  try {
    if (!LOCAL.has(location.hostname)) {
      await workers.register('sw.js', { updateViaCache: 'none' });
      return;
    }
    const worker = await workers.getRegistration();
    if (!worker) return;
    await worker.unregister();
    const copies = (await caches.keys()).filter((name) => name.startsWith(`seastate ${worker.scope} `));
    await Promise.all(copies.map((name) => caches.delete(name)));
  } catch (error) {
    // The page works without an offline copy.
    console.info(`seastate: no offline copy: ${error}`);
  }
}

/**
 * Asks the visitor to open a new tab if the browser stops drawing in this one. In Firefox 153 a tab stays blank,
 * whatever is loaded in it, once a lost device has presented a frame. The tab's title can still be changed.
 */
function watchFrames() {
  const { title } = document;
  const late = setTimeout(() => {
    if (document.hidden) return;
    show('tab');
    document.title = window.seastateWords('Please open this sea in a new tab');
  }, FRAME_SECONDS * 1000);
  requestAnimationFrame(() => {
    clearTimeout(late);
    hide('tab');
    document.title = title;
  });
}

/** Gives the keyboard to the sea, so that its keys work at once. In a frame of another page, that page keeps it. */
function takeKeyboard() {
  const isFree = document.activeElement === null || document.activeElement === document.body;
  if (isFree && window.parent === window) element('sea').focus({ preventScroll: true });
}

/** Polls the program for a device loss, a panic and its first picture, and reacts to each. */
function watch(handle) {
  let begun = performance.now();
  let shown = false; // whether the current device has drawn a picture
  let cover; // old canvas with the last picture of the lost device
  let panicked = false; // whether the previous poll found a panic
  const look = () => next().catch((error) => show('panic', panicText(handle) ?? String(error)));
  const next = async () => {
    fit();
    const seconds = (performance.now() - begun) / 1000;
    const lost = handle.device_lost();
    const panic = panicText(handle);
    if (lost !== undefined) {
      const old = await recover(handle, lost);
      if (!old) return;
      if (shown) cover = old;
      else old.remove();
      [begun, shown] = [performance.now(), false];
    } else if (panic !== undefined) {
      // A device loss that caused the panic may be reported a little later, so the program is polled once more.
      if (panicked) {
        show('panic', panic);
        return;
      }
      panicked = true;
    } else if (
      !shown &&
      handle.has_first_picture() &&
      (!cover || handle.is_picture_complete() || seconds > COVER_SECONDS)
    ) {
      shown = true;
      cover?.remove();
      cover = undefined;
      if (!document.body.classList.contains('running')) keepOffline();
      document.body.classList.add('running');
      element('loading').hidden = true;
      takeKeyboard();
    } else if (!shown && seconds > SLOW_SECONDS) {
      say('Preparing the graphics: the first time this can take a minute…');
    }
    setTimeout(look, shown || panicked ? WATCH_MS : START_MS);
  };
  look();
}

/** Shows WebAssembly traps that come without a panic or a device loss (memory exhausted, stack overflow). */
function watchTraps() {
  const trapped = (error) => {
    if (!(error instanceof WebAssembly.RuntimeError)) return;
    setTimeout(() => {
      if (!document.body.dataset.rung && window.seastate?.device_lost() === undefined) show('panic', String(error));
    }, 2 * WATCH_MS);
  };
  addEventListener('error', (event) => trapped(event.error));
  addEventListener('unhandledrejection', (event) => trapped(event.reason));
}

/** Measures the GPU passes here instead of showing the sea; `bench=` in the address is the number of repetitions. */
async function bench(handle) {
  const query = new URLSearchParams(location.search);
  const repeat = Math.max(5, Number(query.get('bench')) || 0);
  query.delete('bench');
  const tell = (what) => say('Measuring: {what}…', { what });
  // A second attempt, if the device was lost during the first. Each attempt has a device of its own.
  const measured = await handle
    .bench(query.toString(), repeat, tell)
    .catch(() => handle.bench(query.toString(), repeat, tell));
  const table = element('bench');
  table.textContent = measured.text;
  table.hidden = false;
  element('loading').hidden = true;
  window.measured = measured;
}

/** Starts the program on the page's canvas. A browser whose GPU process has just crashed may refuse at first. */
async function begin(handle) {
  for (let left = START_TRIES - 1; ; left -= 1) {
    try {
      return await start(handle, element('sea'));
    } catch (error) {
      if (left <= 0 || handle.has_panicked()) throw error;
      await pause(0.5);
    }
  }
}

async function boot() {
  document.documentElement.classList.add('booted');
  const abort = new AbortController();
  try {
    checkBrowser();
    watchTraps();
    mendPixelSize();
    fit();
    addEventListener('resize', fit);
    const program = download(abort.signal);
    program.catch(() => {}); // awaited below
    await checkAdapter();
    const { glue, module } = await program;
    // early.js has already said why this browser cannot show the page.
    if (document.body.dataset.rung) return;
    say('Starting…');
    let handle;
    try {
      await glue.default({ module_or_path: module });
      handle = new glue.WebHandle();
      window.seastate = handle;
      if (new URLSearchParams(location.search).has('bench')) return await bench(handle);
      await begin(handle);
    } catch (error) {
      const panic = panicText(handle) ?? (error instanceof WebAssembly.RuntimeError ? String(error) : undefined);
      throw panic === undefined ? new Rung('start', String(error?.message ?? error)) : new Rung('panic', panic);
    }
    say('Preparing the shaders…');
    watch(handle);
  } catch (error) {
    abort.abort();
    show(error.rung ?? 'start', error.rung ? error.reason : String(error));
  }
}

boot();
