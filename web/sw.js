// Keeps the page for times without a network. Registered by boot.js, but not at local addresses.
//
// A copy is one version whole: this file names its files by their content, and changes when one of them does. With a network
// the page always comes from there, and asks for its own files by name and sum: an old page never meets a new program.

const FILES = [@FILES@];
// Other pages of this origin may be seas, too.
const OURS = `seastate ${registration.scope} `;
const COPY = `${OURS}@SUM@`;
const PATIENCE_MS = 5000; // with a network that does not answer

/** Fetches all of this version, or nothing. */
async function keep() {
  const page = await fetch('./', { cache: 'no-cache' });
  const text = page.ok ? await page.clone().text() : '';
  if (!FILES.every((name) => text.includes(name))) throw new Error('the page is of another version: the next visit tries again');
  const copy = await caches.open(COPY);
  await copy.addAll(FILES);
  await copy.put('./', page);
  await skipWaiting();
}

async function tidy() {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name.startsWith(OURS) && name !== COPY).map((name) => caches.delete(name)));
  await clients.claim();
}

const kept = async (name) => (await caches.open(COPY)).match(name);

async function page(request) {
  const network = fetch(request);
  network.catch(() => {}); // awaited below
  const late = new Promise((resolve) => setTimeout(resolve, PATIENCE_MS));
  try {
    const answer = await Promise.race([network, late]);
    if (answer && answer.status < 500) return answer;
  } catch {
    // No network.
  }
  return (await kept('./')) ?? network;
}

addEventListener('install', (event) => event.waitUntil(keep()));
addEventListener('activate', (event) => event.waitUntil(tidy()));
addEventListener('fetch', (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  const scope = new URL(registration.scope);
  if (request.method !== 'GET' || origin !== scope.origin || !pathname.startsWith(scope.pathname)) return;
  const name = pathname.slice(scope.pathname.length);
  if (request.mode === 'navigate') {
    if (name === '' || name === 'index.html') event.respondWith(page(request));
  } else if (FILES.includes(name)) {
    event.respondWith(kept(name).then((file) => file ?? fetch(request)));
  }
});
