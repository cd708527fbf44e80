// Brings the program into the page, and says in plain words what stands in the way.
//
// Every way in which this can fail is a rung of the ladder in index.html. Nothing here knows anything about the sea: the state
// is the address, and the program reads it there.

const STALL_SECONDS = 20; // without a byte
const ADAPTER_SECONDS = 30; // without an answer
const SLOW_SECONDS = 20; // until the first picture, before the page asks for patience
const LOSS_WINDOW_SECONDS = 120; // in which the page brings back a lost device
const LOSS_TRIES = 2; // at most so often
const LOSS_KEY = 'seastate-device-lost';

// What the program asks of a device beyond a few buffers: WebGPU's own base limits.
const LIMITS = {
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
  element('state').textContent = `seastate '${location.search.slice(1)}'`;
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
  if (typeof WebAssembly !== 'object' || typeof WebAssembly.compileStreaming !== 'function') throw new Rung('no-wasm');
  if (!isSecureContext) throw new Rung('insecure', location.origin);
  if (!navigator.gpu) throw new Rung('no-webgpu', navigator.userAgent);
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
    throw new Rung('limits', low.map(([name, need]) => `${name} is ${adapter.limits[name]}, needed are ${need}`).join('\n'));
  }
}

const megabytes = (bytes) => (bytes / 1e6).toFixed(1);

/** The response again, with its bytes counted while the compiler takes them. */
function counted(response) {
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
    const glue = import(here(names.glue));
    glue.catch(() => {}); // awaited below
    const response = await answer;
    if (!response.ok) throw new Rung('download', `${names.wasm}: ${response.status} ${response.statusText}`);
    const module = await WebAssembly.compileStreaming(counted(response));
    return { glue: await glue, module };
  } catch (error) {
    throw error instanceof Rung ? error : new Rung('download', String(error));
  }
}

/** A lost device comes back with the page, since the address holds the state; but not for ever. */
function recover(handle, reason) {
  try {
    handle.destroy();
  } catch {
    // It was going away anyway.
  }
  const now = Date.now();
  let losses = [];
  try {
    losses = JSON.parse(sessionStorage.getItem(LOSS_KEY) ?? '[]').filter((at) => now - at < LOSS_WINDOW_SECONDS * 1000);
    sessionStorage.setItem(LOSS_KEY, JSON.stringify([...losses, now]));
  } catch {
    losses = Array(LOSS_TRIES).fill(now); // without a memory no second try
  }
  if (losses.length < LOSS_TRIES) {
    console.warn(`seastate: the graphics device was lost (${reason}), loading the page again`);
    location.reload();
  } else {
    show('lost', reason);
  }
}

/** What the program said when it panicked; nothing if it has not. */
function panicText(handle) {
  if (!handle?.has_panicked()) return undefined;
  return handle.panic_message() ?? 'no message';
}

/** Panicked, lost, or drawing? Until the first picture often, then each second. */
function watch(handle) {
  const begun = performance.now();
  let running = false;
  const look = () => {
    try {
      next();
    } catch (error) {
      // A trap inside one of these questions.
      show('panic', panicText(handle) ?? String(error));
    }
  };
  const next = () => {
    const panic = panicText(handle);
    if (panic !== undefined) {
      show('panic', panic);
      return;
    }
    const lost = handle.device_lost();
    if (lost !== undefined) {
      recover(handle, lost);
      return;
    }
    if (!running && handle.frames() > 0) {
      running = true;
      document.body.classList.add('running');
      element('loading').hidden = true;
    } else if (!running && performance.now() - begun > SLOW_SECONDS * 1000) {
      say('Preparing the shaders: a slow graphics card can take a minute…');
    }
    setTimeout(look, running ? 1000 : 100);
  };
  look();
}

/** A trap that no panic announced (memory exhausted, stack overflow). */
function watchTraps() {
  const trapped = (error) => {
    if (error instanceof WebAssembly.RuntimeError && !document.body.dataset.rung) show('panic', String(error));
  };
  addEventListener('error', (event) => trapped(event.error));
  addEventListener('unhandledrejection', (event) => trapped(event.reason));
}

/** Instead of the sea, with `bench=1` (or the number of repetitions) in the address: what it costs on this GPU. */
async function bench(handle) {
  const query = new URLSearchParams(location.search);
  const repeat = Math.max(5, Number(query.get('bench')) || 0);
  query.delete('bench');
  const measured = await handle.bench(query.toString(), repeat, (what) => say(`Measuring: ${what}…`));
  const table = element('bench');
  table.textContent = measured.text;
  table.hidden = false;
  element('loading').hidden = true;
  window.measured = measured;
}

async function boot() {
  document.documentElement.classList.add('booted');
  const abort = new AbortController();
  try {
    checkBrowser();
    watchTraps();
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
      await handle.start(element('sea'));
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
