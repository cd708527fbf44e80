// The service worker: keeps an offline copy of the page. boot.js registers it, except on development hosts.
//
// A copy holds all files of one version, and later the optional files (in folders) that were fetched once. Their names contain a hash of their content, so this file changes when one of
// them changes. With a network, the page itself always comes from the network and asks for its own files by name and
// checksum: an old page never loads a new program.

const FILES = [@FILES@]; // scripts/finish.sh fills in the names, and the checksum of index.html below
// Prefix of the names of this page's offline copies: other pages of the same origin may keep copies, too.
const OURS = `seastate ${registration.scope} `;
const COPY = `${OURS}@SUM@`;
const PATIENCE_MS = 5000; // wait for the network before the offline copy is used

/** Stores an offline copy of all files of this version, or of none if one cannot be fetched. */
async function keep() {
  const page = await fetch('./', { cache: 'no-cache' });
  const text = page.ok ? await page.clone().text() : '';
  if (!FILES.every((name) => text.includes(name))) {
    throw new Error('index.html belongs to another version; the next visit tries again');
  }
  const copy = await caches.open(COPY);
  await copy.addAll(FILES);
  await copy.put('./', page);
  await skipWaiting();
}

/** Deletes the offline copies of the page's other versions. */
async function tidy() {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name.startsWith(OURS) && name !== COPY).map((name) => caches.delete(name)));
  await clients.claim();
}

const kept = async (name) => (await caches.open(COPY)).match(name);

/** An optional file from the network, which is kept, or its offline copy. */
async function optional(request) {
  try {
    const answer = await fetch(request);
    if (answer.ok) await (await caches.open(COPY)).put(request, answer.clone());
    return answer;
  } catch (reason) {
    const file = await kept(request);
    if (file) return file;
    throw reason;
  }
}

/** The page from the network, or its offline copy if the network fails, is late or answers with a server error. */
async function page(request) {
  const network = fetch(request);
  network.catch(() => {}); // awaited below
  const late = new Promise((resolve) => setTimeout(resolve, PATIENCE_MS));
  try {
    const answer = await Promise.race([network, late]);
    if (answer && answer.status < 500) return answer;
  } catch {
    // Without a network the offline copy is used.
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
  } else if (name.includes('/')) {
    event.respondWith(optional(request));
  }
});
