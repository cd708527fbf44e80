// Replaces the program where a test needs it to fail: `?play=reject|panic|throw|trap|lost|halt|sleep`.
const play = new URLSearchParams(location.search).get('play');

export default async function init() {}

export class WebHandle {
  #frames = 0;
  #began = 0;
  #starts = 0;

  async start(canvas) {
    if (!(canvas instanceof HTMLCanvasElement)) throw new Error('not a canvas');
    if (play === 'reject') throw 'no device: the stub refuses';
    this.#began = performance.now();
    this.#starts += 1;
    if (play === 'sleep') return;
    this.#frames += 1;
  }

  #later() {
    return performance.now() - this.#began > 500;
  }

  destroy() {}

  has_panicked() {
    return play === 'panic' && this.#later();
  }

  panic_message() {
    return 'the stub panicked at src/stub.rs:1';
  }

  device_lost() {
    const isLost = play === 'lost' || (play === 'halt' && this.#starts === 1);
    return isLost && this.#later() ? 'the stub was unplugged' : undefined;
  }

  state() {
    return location.search.slice(1);
  }

  is_picture_complete() {
    return true;
  }

  has_first_picture() {
    if (play === 'throw') throw new WebAssembly.RuntimeError('unreachable in an answer');
    return this.#frames > 0;
  }

  // What the page's other scripts ask of a running program. stub.test.mjs checks that nothing is missing.

  frames() {
    return this.#frames;
  }

  link_state() {
    return this.state();
  }

  set_state() {}

  sea_in_words() {
    return '';
  }

  heights() {
    return new Float64Array();
  }

  open_files() {}

  show_message() {}

  accessible_items() {
    return [];
  }

  announcement() {
    return '';
  }

  perform_widget_action() {}

  set_safe_area() {
    return this.#frames > 0;
  }

  offer_tilt() {}

  tilt_button() {
    return undefined;
  }

  follow_tilt() {}

  refuse_tilt() {}

  async bench() {
    throw new Error('the stub measures nothing');
  }
}

if (play === 'trap') {
  setTimeout(() => {
    throw new WebAssembly.RuntimeError('unreachable executed');
  }, 1500);
}
