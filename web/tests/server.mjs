// A static server for the tests: the built page, and the same page with one thing broken.
//
// `/` is the page. `/fault/<name>/` is the page in another folder with the fault of that name, so that no browser has to
// intercept anything, and the page is seen to work from a subfolder.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.jpg': 'image/jpeg',
  '.png': 'image/png',
  '.wasm': 'application/wasm',
};
const STUB = fileURLToPath(new URL('stub.js', import.meta.url));

const isWasm = (path) => path.endsWith('.wasm');
const isGlue = (path) => /^seastate-[0-9a-f]+\.js$/.test(path);

/** What each fault does to a file: `undefined` leaves it alone. */
const FAULTS = {
  none: () => undefined,
  'wasm-404': (path) => isWasm(path) && { status: 404 },
  'wasm-html': (path) => isWasm(path) && { body: Buffer.from('<!DOCTYPE html><title>Not here</title>'), type: 'text/html' },
  'wasm-stall': (path) => isWasm(path) && { stall: true },
  'wasm-cut': (path) => isWasm(path) && { cut: true },
  'wasm-gzip': (path) => isWasm(path) && { gzip: true },
  'glue-404': (path) => isGlue(path) && { status: 404 },
  // The program is replaced by stub.js, which reads in the address what it has to play.
  stub: (path) => isGlue(path) && { file: STUB },
};

export async function serve(root) {
  const server = createServer(async (request, response) => {
    let path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    let fault = 'none';
    const match = /^\/fault\/([a-z0-9-]+)\/(.*)$/.exec(path);
    if (match) [fault, path] = [match[1], match[2]];
    path = normalize(`/${path}`).slice(1) || 'index.html'; // nothing above the root
    const change = FAULTS[fault]?.(path) || {};
    const head = { 'content-type': change.type ?? TYPES[extname(path)] ?? 'application/octet-stream', 'cache-control': 'no-store' };
    try {
      if (!(fault in FAULTS) || change.status) throw new Error('not here');
      const body = change.body ?? (await readFile(change.file ?? join(root, path)));
      if (change.gzip) {
        const packed = gzipSync(body, { level: 1 });
        response.writeHead(200, { ...head, 'content-encoding': 'gzip', 'content-length': packed.length });
        response.end(packed);
      } else if (change.stall || change.cut) {
        response.writeHead(200, { ...head, 'content-length': body.length });
        response.write(body.subarray(0, Math.floor(body.length / 2)));
        if (change.cut) setTimeout(() => response.destroy(), 300);
      } else {
        response.writeHead(200, { ...head, 'content-length': body.length });
        response.end(body);
      }
    } catch {
      response.writeHead(change.status ?? 404, { 'content-type': 'text/plain' });
      response.end('not here');
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const origin = `http://127.0.0.1:${server.address().port}`;
  return {
    origin,
    close: () => {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}
