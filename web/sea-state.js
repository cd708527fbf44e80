// The element <sea-state>: an ocean in any page.
//
//   <script type="module" src="https://example.org/seastate/sea-state.js"></script>
//   <sea-state state="wind=14&fetch=300" style="width: 100%; aspect-ratio: 16 / 9"></sea-state>
//
// It is a frame of the page of Seastate that this file lies beside, and talks to it by messages (docs/embed.md). The
// types are in sea-state.d.ts.

const PAGE = new URL('./', import.meta.url);
const NEWEST_VERSION = '2'; // of state strings: src/state/versions.rs
const PATIENCE_MS = 60_000; // for an answer; before the first one, the program has to be downloaded

class SeaState extends HTMLElement {
  static observedAttributes = ['state', 'src', 'ui'];

  #frame;
  #origin;
  #ready;
  #asked = new Map(); // what waits for an answer, by number
  #count = 0;
  #state = '';
  #words = '';
  #hear = (event) => this.#take(event);

  connectedCallback() {
    if (!this.#frame) {
      // Styles are set by script, which policies that forbid inline styles allow.
      if (getComputedStyle(this).display === 'inline') this.style.display = 'block';
      this.#frame = document.createElement('iframe');
      this.#frame.title = this.title || 'A sea, computed in your browser';
      this.#frame.allow = 'fullscreen';
      this.#frame.loading = this.getAttribute('loading') === 'lazy' ? 'lazy' : 'eager';
      Object.assign(this.#frame.style, { width: '100%', height: '100%', border: '0', display: 'block' });
      this.attachShadow({ mode: 'open' }).append(this.#frame);
    }
    addEventListener('message', this.#hear);
    this.#load();
  }

  disconnectedCallback() {
    removeEventListener('message', this.#hear);
    for (const { fail } of this.#asked.values()) fail(new Error('the element was removed'));
    this.#asked.clear();
  }

  attributeChangedCallback(name, old, value) {
    if (old === value || !this.isConnected || !this.#frame) return;
    if (name === 'state') this.setState(value ?? '').catch((error) => this.#report(error));
    else this.#load();
  }

  /** Resolves when the first picture of the sea is drawn. */
  get ready() {
    return this.#ready;
  }

  /** The state string that the sea last told. */
  get state() {
    return this.#state;
  }

  /** The sea in words, as in "Force 5 sea, waves 1.9 m high". */
  get words() {
    return this.#words;
  }

  /** Sets the sea: a state string or a link. Returns the state that the sea then has. */
  async setState(state) {
    await this.#ready;
    return (this.#state = await this.#ask({ call: 'setState', state: String(state) }));
  }

  /** Asks for the state string at this moment. */
  async getState() {
    await this.#ready;
    return (this.#state = await this.#ask({ call: 'getState' }));
  }

  /** Asks for the heights of the sea, m, at points [x east, z south] in m and a time in s (without one: now). */
  async heights(points, time) {
    await this.#ready;
    return this.#ask({ call: 'heights', points, ...(time === undefined ? {} : { time }) });
  }

  #load() {
    const address = new URL(this.getAttribute('src') ?? PAGE, document.baseURI);
    const [before, after] = (this.getAttribute('state') ?? '').split('#')[0].split('?');
    const query = new URLSearchParams(after || before || address.search);
    // A bare state string has the newest version, a link without one the first.
    if (before && !after && !query.has('v')) query.set('v', NEWEST_VERSION);
    if (!query.has('ui')) query.set('ui', this.getAttribute('ui') ?? 'mini');
    address.search = query;
    this.#origin = address.origin;
    this.#frame.src = address;
    this.#ready = this.#listen();
    this.#ready.catch((error) => this.#report(error));
  }

  /** Asks to be told of changes until the page in the frame has loaded its scripts and answers. */
  async #listen() {
    const frame = this.#frame;
    const loaded = new Promise((resolve) => frame.addEventListener('load', resolve, { once: true }));
    await loaded;
    const told = await this.#ask({ call: 'listen' });
    this.#note(told);
    this.dispatchEvent(new CustomEvent('ready', { detail: told }));
  }

  #ask(message) {
    const id = (this.#count += 1);
    return new Promise((resolve, reject) => {
      const forget = () => {
        clearTimeout(late);
        this.#asked.delete(id);
      };
      const finish = (end) => (value) => {
        forget();
        end(value);
      };
      const late = setTimeout(finish(reject), PATIENCE_MS, new Error('the sea does not answer'));
      this.#asked.set(id, { succeed: finish(resolve), fail: finish(reject) });
      this.#frame.contentWindow.postMessage({ seastate: 1, id, ...message }, this.#origin);
    });
  }

  #take({ source, origin, data }) {
    const isFromSea = source === this.#frame?.contentWindow && origin === this.#origin;
    if (!isFromSea || typeof data !== 'object' || data === null || data.seastate !== 1) return;
    if (data.event === 'change') {
      this.#note(data);
      this.dispatchEvent(new CustomEvent('change', { detail: { state: this.#state, words: this.#words } }));
      return;
    }
    const asked = this.#asked.get(data.id);
    if (data.error !== undefined) asked?.fail(new Error(String(data.error)));
    else asked?.succeed(data.value);
  }

  #note({ state, words }) {
    this.#state = String(state);
    this.#words = String(words);
  }

  #report(error) {
    this.dispatchEvent(new CustomEvent('error', { detail: error }));
  }
}

if (!customElements.get('sea-state')) customElements.define('sea-state', SeaState);

export { SeaState };
