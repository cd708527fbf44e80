// The examples of examples.html.
const sea = document.getElementById('first');
const element = (id) => document.getElementById(id);

// The address of this page can hold settings of the first sea, such as ?n=64.
if (location.search) sea.setAttribute('state', `wind=9&fetch=200&${location.search.slice(1)}`);

const show = (event) => {
  element('words').textContent = `${event.detail.words}.`;
};
sea.addEventListener('ready', show);
sea.addEventListener('change', show);

/** Sets one value, and leaves the others as they are. */
async function set(key, value) {
  const state = new URLSearchParams(await sea.getState());
  state.set(key, value);
  await sea.setState(state.toString());
}

element('wind').addEventListener('change', (event) => set('wind', event.target.value));
element('storm').addEventListener('click', () => set('wind', 25));
element('ask').addEventListener('click', async () => {
  const heights = await sea.heights([[0, 0], [50, 0]]);
  element('heights').textContent = heights.map((height) => `${height.toFixed(2)} m`).join(', ');
});
