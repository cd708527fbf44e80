// The page in a frame of another page: it leaves scrolling to that page, and answers its messages.
//
// docs/embed.md describes the messages; sea-state.js, which other pages load, sends them. Nothing secret can be asked
// for, so every page that may embed this one may ask. Each answer goes to the page's own origin alone.

const MAX_POINTS = 1000;
const MAX_STATE_LENGTH = 65_536;
const WATCH_MS = 250; // interval at which changes of the state are looked for

const isFramed = window.parent !== window;

/** Waits for the program and returns its handle. */
async function program() {
  while (!window.seastate?.has_first_picture()) await new Promise((resolve) => setTimeout(resolve, 50));
  return window.seastate;
}

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

/**
 * What to set for `text`, a state string or a link. What is shown over the sea stays as it is, unless the text says
 * otherwise.
 */
function stateToSet(text, now) {
  if (typeof text !== 'string' || text.length > MAX_STATE_LENGTH) throw new Error('state: a string is needed');
  const [before, after] = text.split('#')[0].split('?');
  const query = new URLSearchParams(after ?? before);
  const shown = new URLSearchParams(now).get('ui');
  if (!query.has('ui') && shown !== null) query.set('ui', shown);
  // From `?` on, a text is a link that somebody may have kept: without a version it is one of the first.
  return `${after === undefined ? '' : '?'}${query}`;
}

function readPoints(points) {
  const isPoint = (point) => Array.isArray(point) && point.length === 2 && point.every(isNumber);
  if (!Array.isArray(points) || points.length > MAX_POINTS || !points.every(isPoint)) {
    throw new Error(`points: at most ${MAX_POINTS} pairs of finite numbers are needed`);
  }
  return new Float64Array(points.flat());
}

/** What another page can ask for, by name. Each gets the message and returns the answer. */
const ANSWERS = {
  listen: (sea) => describe(sea),
  getState: (sea) => sea.link_state(),
  setState(sea, { state }) {
    sea.set_state(stateToSet(state, sea.link_state()));
    return sea.link_state();
  },
  heights(sea, { points, time }) {
    if (time !== undefined && !isNumber(time)) throw new Error('time: a finite number of seconds is needed');
    return [...sea.heights(readPoints(points), time)];
  },
};

const describe = (sea) => ({ state: sea.link_state(), words: sea.sea_in_words() });

/** The state without the simulated time, which changes by itself. */
function withoutTime(state) {
  const query = new URLSearchParams(state);
  query.delete('t');
  return query.toString();
}

let listener; // origin of the page that wants to hear of changes

/** Tells the other page of every change of the state but of the running time. */
async function tellChanges() {
  const sea = await program();
  let told = withoutTime(sea.link_state());
  setInterval(() => {
    const state = sea.link_state();
    if (state === '' && sea.frames() === 0) return; // between two graphics devices
    if (withoutTime(state) === told) return;
    told = withoutTime(state);
    window.parent.postMessage({ seastate: 1, event: 'change', ...describe(sea) }, listener);
  }, WATCH_MS);
}

async function answer({ source, origin, data }) {
  if (source !== window.parent || typeof data !== 'object' || data === null || data.seastate !== 1) return;
  const { id, call } = data;
  if (!isNumber(id) || typeof call !== 'string') return;
  // A page without an origin of its own (a file, a sandbox) is called null, and can be addressed only as any.
  const target = origin === 'null' ? '*' : origin;
  const reply = (rest) => source.postMessage({ seastate: 1, id, ...rest }, target);
  try {
    if (!Object.hasOwn(ANSWERS, call)) throw new Error(`there is no call ${call.slice(0, 40)}`);
    const value = ANSWERS[call](await program(), data);
    if (call === 'listen') {
      if (listener === undefined) tellChanges();
      listener = target;
    }
    reply({ value });
  } catch (error) {
    reply({ error: String(error.message ?? error) });
  }
}

/**
 * Leaves the wheel to the other page until the visitor has clicked in the frame, and again when the visitor is back in
 * the other page. A finger that moves up or down always scrolls the other page (style.css).
 */
function leaveScrollingToThePage() {
  document.documentElement.classList.add('framed');
  let isActive = false;
  addEventListener('pointerdown', () => (isActive = true), { capture: true });
  addEventListener('blur', () => (isActive = false));
  document.documentElement.addEventListener('pointerleave', () => (isActive = false));
  addEventListener('wheel', (event) => !isActive && event.stopImmediatePropagation(), { capture: true, passive: true });
}

if (isFramed) {
  leaveScrollingToThePage();
  addEventListener('message', answer);
}
