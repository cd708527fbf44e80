// Brings the program into the page, and says in plain words what stands in the way.
//
// Every way in which this can fail is a rung of the ladder in index.html. Nothing here knows anything about the sea: the state
// is the address, and the program reads it there.

const STALL_SECONDS = 20; // without a byte
const ADAPTER_SECONDS = 30; // without an answer
const SLOW_SECONDS = 20; // until the first picture, before the page asks for patience
const WATCH_MS = 250; // between two looks at the program
const START_MS = 50; // the same until its first picture
const START_TRIES = 3; // of a device that is refused
const COVER_SECONDS = 10; // that the last picture waits for the foam of the next
const FRAME_SECONDS = 10; // without a frame of the browser's, after a loss
const LOSS_WINDOW_SECONDS = 60; // in which lost devices are counted
const LOSS_REVIVALS = 8; // in place, the same program with another device; after that
const LOSS_RELOADS = 2; // by loading the page again; after that the page gives up
const LOSS_KEY = 'seastate-device-lost';

// Where pages are written, and none is kept.
const LOCAL = new Set(['localhost', '127.0.0.1', '[::1]']);

// What the program asks of a device beyond a few buffers: WebGPU's own base limits.
const LIMITS = {
  maxTextureDimension2D: 8192,
  maxComputeInvocationsPerWorkgroup: 256,
  maxComputeWorkgroupStorageSize: 16384,
  maxStorageTexturesPerShaderStage: 4,
  maxStorageBuffersPerShaderStage: 8,
  maxStorageBufferBindingSize: 128 * 1024 * 1024,
};

const element = (id) => document.getElementById(id);

/** A reason to show the ladder instead of the sea. */
class Rung extends Error {
  constructor(rung, reason) {
    super(reason ?? rung);
    this.rung = rung;
    this.reason = reason;
  }
}

function say(text) {
  element('status').textContent = text;
}

/** Shows one rung; `reason` is the technical text under it. */
function show(rung, reason) {
  for (const section of document.querySelectorAll('[data-rung]')) {
    section.hidden = section.dataset.rung !== rung;
  }
  element('reason').textContent = reason ?? '';
  element('reason').hidden = !reason;
  element('state').textContent = `seastate "${location.search.slice(1)}"`;
  element('loading').hidden = true;
  element('ladder').hidden = false;
  document.body.dataset.rung = rung;
}

/** Takes a passing rung back. */
function hide(rung) {
  if (document.body.dataset.rung !== rung) return;
  delete document.body.dataset.rung;
  element('ladder').hidden = true;
  element('loading').hidden = document.body.classList.contains('running');
}

function after(seconds, make) {
  return new Promise((_, reject) => setTimeout(() => reject(make()), seconds * 1000));
}

function checkBrowser() {
  if (location.protocol === 'file:') throw new Rung('file');
  if (typeof WebAssembly !== 'object' || typeof WebAssembly.compileStreaming !== 'function') throw new Rung('no-wasm');
  if (!isSecureContext) throw new Rung('insecure', location.origin);
  if (!navigator.gpu) throw new Rung('no-webgpu', navigator.userAgent);
}

let density; // of the screen's pixels, when the canvas was last fitted

/**
 * Keeps the canvas, which has all pixels of the screen, within what the device can draw on. eframe looks at its size alone,
 * which another density (another screen) leaves as it is: that moves it a hair.
 */
function fit() {
  if (density === devicePixelRatio) return;
  const { style } = document.documentElement;
  style.setProperty('--most', `${Math.floor(LIMITS.maxTextureDimension2D / devicePixelRatio)}px`);
  if (density) style.setProperty('--nudge', style.getPropertyValue('--nudge') === '0.02px' ? '0px' : '0.02px');
  density = devicePixelRatio;
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
    throw new Rung('limits', low.map(([name, need]) => `${name}: ${need} needed, this one has ${adapter.limits[name]}`).join('\n'));
  }
}

const megabytes = (bytes) => (bytes / 1e6).toFixed(1);

/** Whether bytes are those of a sum, as in an `integrity` attribute. */
async function isWhole(bytes, sum) {
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-384', bytes));
  return sum === `sha384-${btoa(String.fromCharCode(...digest))}`;
}

/** The response again, with its bytes counted, and kept in `parts`, while the compiler takes them. */
function counted(response, parts) {
  // With a Content-Encoding the length is that of the packed bytes, but the packed bytes cannot be counted: no total then.
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
        say(`Loading: ${megabytes(received)} of ${megabytes(total)} MB`);
      } else {
        bar.removeAttribute('value');
        say(`Loading: ${megabytes(received)} MB`);
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

/** Imports a module, if it is what its sum says: import() takes it from the link that has asked for it. */
function importWhole(address, sum) {
  const link = document.createElement('link');
  link.rel = 'modulepreload';
  link.href = address;
  link.integrity = sum;
  document.head.append(link);
  return import(address);
}

/** Fetches both halves of the program; compiles the large one while it arrives. */
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
    // fetch() would check the sum, too, but hand out nothing before all has come.
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

/** Notes a loss, and says how many there were lately; loading the page again does not forget them. */
function countLoss() {
  const now = Date.now();
  try {
    const losses = JSON.parse(sessionStorage.getItem(LOSS_KEY) ?? '[]').filter((at) => now - at < LOSS_WINDOW_SECONDS * 1000);
    losses.push(now);
    sessionStorage.setItem(LOSS_KEY, JSON.stringify(losses));
    return losses.length;
  } catch {
    return Infinity; // without a memory it could go on for ever
  }
}

function forgetLosses() {
  try {
    sessionStorage.removeItem(LOSS_KEY);
  } catch {
    // Nothing was noted, then.
  }
}

/** Starts on a canvas; an answer that never comes counts as a refusal. */
function start(handle, canvas) {
  return Promise.race([handle.start(canvas), after(ADAPTER_SECONDS, () => new Error(`no device in ${ADAPTER_SECONDS} s`))]);
}

/**
 * Brings a lost device back: the same program goes on with another one, on another canvas, under the last picture of the
 * old. Where that does not help, the page is loaded again, since the address holds the state; but not for ever. Gives the
 * old canvas, or nothing if there is nothing more to watch.
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

/** What the program said when it panicked; nothing if it has not. */
function panicText(handle) {
  if (!handle?.has_panicked()) return undefined;
  return handle.panic_message() ?? 'no message';
}

/**
 * Keeps a copy of the page for times without a network. Not where pages are written: another one may be at this address
 * tomorrow, and must not meet a worker of this one.
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
    // The page works without.
    console.info(`seastate: no copy for times without a network: ${error}`);
  }
}

/**
 * Firefox (153) draws nothing in a tab any more, whatever is loaded there, once a lost device has presented a frame. Its
 * title can still be changed.
 */
function watchFrames() {
  const { title } = document;
  const late = setTimeout(() => {
    if (document.hidden) return;
    show('tab');
    document.title = 'Please open the sea in a new tab';
  }, FRAME_SECONDS * 1000);
  requestAnimationFrame(() => {
    clearTimeout(late);
    hide('tab');
    document.title = title;
  });
}

/** Panicked, lost, or drawing? */
function watch(handle) {
  let begun = performance.now();
  let shown = false; // a picture of this device
  let cover; // the canvas that still shows one of the last device
  let panicked = false;
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
      // The loss that made it panic may be told a little later.
      if (panicked) {
        show('panic', panic);
        return;
      }
      panicked = true;
    } else if (!shown && handle.seen() && (!cover || handle.settled() || seconds > COVER_SECONDS)) {
      shown = true;
      cover?.remove();
      cover = undefined;
      if (!document.body.classList.contains('running')) keepOffline();
      document.body.classList.add('running');
      element('loading').hidden = true;
    } else if (!shown && seconds > SLOW_SECONDS) {
      say('Preparing the graphics: the first time this can take a minute…');
    }
    setTimeout(look, shown || panicked ? WATCH_MS : START_MS);
  };
  look();
}

/** A trap that no panic announced (memory exhausted, stack overflow), and no loss either. */
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

/** Instead of the sea, with `bench=1` (or the number of repetitions) in the address: what it costs on this GPU. */
async function bench(handle) {
  const query = new URLSearchParams(location.search);
  const repeat = Math.max(5, Number(query.get('bench')) || 0);
  query.delete('bench');
  const tell = (what) => say(`Measuring: ${what}…`);
  // Once more if the device was lost on the way; each run has one of its own.
  const measured = await handle.bench(query.toString(), repeat, tell).catch(() => handle.bench(query.toString(), repeat, tell));
  const table = element('bench');
  table.textContent = measured.text;
  table.hidden = false;
  element('loading').hidden = true;
  window.measured = measured;
}

/** Starts on the page's canvas; a browser that has just lost its graphics process may refuse at first. */
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
    fit();
    addEventListener('resize', fit);
    const program = download(abort.signal);
    program.catch(() => {}); // awaited below
    await checkAdapter();
    const { glue, module } = await program;
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
