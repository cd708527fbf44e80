// Both browsers behind one small face. Both draw WebGPU on the processor, so that a machine without a graphics card can run
// the tests: Chromium with SwiftShader, Firefox with the lavapipe driver of Mesa.
import { existsSync } from 'node:fs';
import puppeteer from 'puppeteer-core';

const PATIENCE = Number(process.env.SEASTATE_PATIENCE ?? 120) * 1000; // software adapters on two cores

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
    paths: [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome', '/opt/google/chrome/chrome'],
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
  // A copy: the driver takes features out of the list that it is given.
  const browser = await puppeteer.launch({ ...structuredClone(options), executablePath, headless: true, timeout: PATIENCE, protocolTimeout: PATIENCE });
  return {
    name,
    version: await browser.version(),
    open: (url, settings) => open(browser, url, settings),
    crashGpu: async () => {
      const session = await browser.target().createCDPSession();
      await session.send('Browser.crashGpuProcess');
      await session.detach();
    },
    processes: async () => {
      const session = await browser.target().createCDPSession();
      const { processInfo } = await session.send('SystemInfo.getProcessInfo');
      await session.detach();
      return processInfo;
    },
    close: () => browser.close(),
  };
}

const strays = [];

/** Requests that have left the page's origin, and cookies that it has set, since the last call. */
export const takeStrays = () => strays.splice(0);

/** Opens a page; `before` runs in it ahead of its own scripts. What it logs as an error is kept in `errors`. */
async function open(browser, url, { size = [320, 200], before } = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(PATIENCE);
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
    // The page in a frame has an origin of its own.
    const isOurs = address.origin === origin || address.hostname === '127.0.0.1' || ['about:', 'blob:', 'data:', 'file:'].includes(address.protocol);
    if (!isOurs) strays.push(`a request to ${address}`);
  });
  page.on('response', (response) => {
    if ('set-cookie' in response.headers()) strays.push(`a cookie from ${response.url()}`);
  });
  if (before) await page.evaluateOnNewDocument(before);
  await page.goto(url, { waitUntil: 'domcontentloaded' });

  const evaluate = (body, ...values) => page.evaluate(body, ...values);
  /** Waits until `body` gives something true in the page, and returns it. */
  async function until(what, body, ...values) {
    const end = Date.now() + PATIENCE;
    for (;;) {
      // A page that is just being loaded again cannot answer.
      const found = await evaluate(body, ...values).catch(() => undefined);
      if (found) return found;
      if (Date.now() > end) throw new Error(`waited in vain for ${what}; the page says: ${await evaluate(() => document.body.innerText)}; log: ${log.join(' | ')}`);
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
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
