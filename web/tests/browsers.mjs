// Starts Chromium and Firefox and opens pages in them, through the same functions. Both use software adapters, so that
// the tests run on machines without a GPU: Chromium uses SwiftShader, Firefox uses Mesa's lavapipe.
import { existsSync } from 'node:fs';
import puppeteer from 'puppeteer-core';

const PATIENCE_MS = Number(process.env.SEASTATE_PATIENCE ?? 120) * 1000; // for software adapters on two cores

const CHROMIUM_FLAGS = [
  '--no-sandbox',
  '--enable-unsafe-webgpu',
  '--use-webgpu-adapter=swiftshader',
  '--enable-features=Vulkan',
  '--use-vulkan=swiftshader',
  '--use-angle=swiftshader',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];
const FIREFOX_PREFS = {
  'dom.webgpu.enabled': true,
  'dom.w3c_touch_events.enabled': 1,
  'gfx.webgpu.ignore-blocklist': true,
  'app.update.enabled': false,
  'browser.shell.checkDefaultBrowser': false,
  'datareporting.policy.dataSubmissionEnabled': false,
};

const KINDS = {
  chromium: {
    paths: [
      process.env.CHROMIUM,
      '/usr/bin/chromium',
      '/usr/bin/chromium-browser',
      '/usr/bin/google-chrome',
      '/opt/google/chrome/chrome',
    ],
    options: { browser: 'chrome', args: CHROMIUM_FLAGS },
  },
  firefox: {
    paths: [process.env.FIREFOX, '/usr/bin/firefox-esr', '/usr/bin/firefox'],
    options: { browser: 'firefox', extraPrefsFirefox: FIREFOX_PREFS },
  },
};
export const NAMES = Object.keys(KINDS);

export async function launch(name) {
  const { paths, options } = KINDS[name];
  const executablePath = paths.find((path) => path && existsSync(path));
  if (!executablePath) throw new Error(`no ${name} found (${paths.filter(Boolean).join(', ')})`);
  const browser = await puppeteer.launch({
    ...structuredClone(options), // puppeteer removes entries from the list of features in it
    executablePath,
    headless: true,
    timeout: PATIENCE_MS,
    protocolTimeout: PATIENCE_MS,
  });
  const strays = [];
  return {
    name,
    version: await browser.version(),
    /** Opens a page; see below. */
    open: (url, settings) => open(browser, url, settings, strays),
    /** Requests that have left the page's origin, and cookies that it has set, since the last call. */
    takeStrays: () => strays.splice(0),
    /** Kills the GPU process; Chromium only. */
    crashGpu: async () => {
      const session = await browser.target().createCDPSession();
      await session.send('Browser.crashGpuProcess');
      await session.detach();
    },
    /** Types and ids of the browser's processes; Chromium only. */
    processes: async () => {
      const session = await browser.target().createCDPSession();
      const { processInfo } = await session.send('SystemInfo.getProcessInfo');
      await session.detach();
      return processInfo;
    },
    close: () => browser.close(),
  };
}

/** Asks until the answer is true, and returns that, or the last answer when patience ends. */
export async function poll(ask) {
  const end = Date.now() + PATIENCE_MS;
  for (;;) {
    // While a page is being loaded again, evaluate() fails.
    const answer = await ask().catch(() => undefined);
    if (answer || Date.now() > end) return answer;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

/**
 * Opens a page with a viewport of `size` CSS pixels. `before` runs in it ahead of its own scripts. The page's console
 * messages are collected in `log`, its errors in `errors`.
 */
async function open(browser, url, { size = [320, 200], before } = {}, strays) {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  await page.setViewport({ width: size[0], height: size[1], deviceScaleFactor: 1 });
  const errors = [];
  const log = [];
  page.on('console', (message) => {
    log.push(`${message.type()}: ${message.text()}`);
    if (message.type() === 'error') errors.push(message.text());
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  const { origin } = new URL(url);
  page.on('request', (request) => {
    const address = new URL(request.url());
    // A page in a frame has an origin of its own, at 127.0.0.1.
    const isLocal = ['about:', 'blob:', 'data:', 'file:'].includes(address.protocol);
    const isOurs = address.origin === origin || address.hostname === '127.0.0.1' || isLocal;
    if (!isOurs) strays.push(`a request to ${address}`);
  });
  page.on('response', (response) => {
    if ('set-cookie' in response.headers()) strays.push(`a cookie from ${response.url()}`);
  });
  if (before) await page.evaluateOnNewDocument(before);
  await page.goto(url, { waitUntil: 'domcontentloaded' });

  const evaluate = (body, ...values) => page.evaluate(body, ...values);
  /** Waits until `body`, run in the page, returns something true, and returns that. `what` names it in errors. */
  async function until(what, body, ...values) {
    const found = await poll(() => evaluate(body, ...values));
    if (found) return found;
    const text = await evaluate(() => document.body.innerText);
    throw new Error(`waited in vain for ${what}; the page says: ${text}; log: ${log.join(' | ')}`);
  }
  return {
    page,
    errors,
    log,
    evaluate,
    until,
    screenshot: async (path) => Buffer.from(await page.screenshot({ path })),
    close: async () => {
      const cookie = await evaluate(() => document.cookie).catch(() => '');
      if (cookie) strays.push(`a cookie: ${cookie}`);
      await page.close();
    },
  };
}
