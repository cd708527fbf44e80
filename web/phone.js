// Phones: tells the program which part of the screen is free of notches and bars, and how the device is held.

const EVERY_MS = 300; // interval at which the safe area is measured: no event tells of its changes
const SILENCE_MS = 3000; // without a reading, before the program learns that there are none

const pixels = (style, side) => parseFloat(style.getPropertyValue(`--safe-${side}`)) || 0;

let known = ''; // the safe area that the program has

/** The program, unless the page shows why it does not run: then nothing may be asked of it. */
const program = () => (document.body.dataset.rung ? undefined : window.seastate);

/** Tells the program the safe area of the screen, which style.css takes from the browser. */
function measure() {
  const sea = program();
  if (!sea) return;
  const style = getComputedStyle(document.documentElement);
  const sides = ['top', 'right', 'bottom', 'left'].map((side) => pixels(style, side));
  if (String(sides) === known) return;
  // Until the program has started, it takes nothing, and is told again.
  if (sea.set_safe_area(...sides)) known = String(sides);
}

setInterval(measure, EVERY_MS);

const Orientation = window.DeviceOrientationEvent;
// Nothing is asked here: the program only learns that it may show a button.
const offering = setInterval(() => {
  if (!Orientation || !matchMedia('(pointer: coarse)').matches) {
    clearInterval(offering);
  } else if (program()?.has_first_picture()) {
    program().offer_tilt();
    clearInterval(offering);
  }
}, EVERY_MS);

let isWanted = false; // whether the program wants readings
let silence;

function follow({ alpha, beta, gamma }) {
  // A device without sensors sends one event without angles.
  if (beta === null || gamma === null) return;
  clearTimeout(silence);
  program()?.follow_tilt(alpha ?? 0, beta, gamma);
}

function refuse() {
  stop();
  program()?.refuse_tilt();
}

function stop() {
  isWanted = false;
  clearTimeout(silence);
  removeEventListener('deviceorientation', follow);
}

/** Asks for the sensors where the browser wants that (iOS). It answers only while a tap is being handled. */
const asked = () => Orientation.requestPermission?.() ?? Promise.resolve('granted');

let permission; // the answer to the question that a tap on the program's button has asked

addEventListener(
  'touchend',
  (event) => {
    const button = program()?.tilt_button();
    const finger = event.changedTouches[0];
    if (!button || !finger) return;
    const [x, y, width, height] = button;
    const [right, down] = [finger.clientX - x, finger.clientY - y];
    if (right >= 0 && right <= width && down >= 0 && down <= height) {
      permission = asked();
      permission.catch(() => {}); // awaited when the program has understood the tap, too
    }
  },
  true,
);

addEventListener('seastate-tilt-start', async () => {
  isWanted = true;
  try {
    if ((await (permission ?? asked())) !== 'granted') throw new Error('refused');
    if (!isWanted) return;
    addEventListener('deviceorientation', follow);
    silence = setTimeout(refuse, SILENCE_MS);
  } catch {
    refuse();
  } finally {
    permission = undefined;
  }
});

addEventListener('seastate-tilt-stop', stop);
