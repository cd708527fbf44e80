// A static server for the tests: the built page, and copies of it with one fault each.
//
// `/` is the page. `/fault/<name>/` is the page in a subfolder, with the fault of that name in FAULTS. `/frame/` shows
// the page in a frame and passes its query on. The headers are those in the file `_headers`.
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

/** The change that each fault makes to a file, by the file's path; `undefined` or `false` for no change. */
const FAULTS = {
  none: () => undefined,
  'wasm-404': (path) => isWasm(path) && { status: 404 },
  'wasm-html': (path) =>
    isWasm(path) && { body: Buffer.from('<!DOCTYPE html><title>Not here</title>'), type: 'text/html' },
  'wasm-stall': (path) => isWasm(path) && { stall: true },
  'wasm-cut': (path) => isWasm(path) && { cut: true },
  'wasm-gzip': (path) => isWasm(path) && { gzip: true },
  'glue-404': (path) => isGlue(path) && { status: 404 },
  // Valid files with other bytes: one more custom section, one more comment.
  'wasm-other': (path) => isWasm(path) && { edit: (body) => Buffer.concat([body, Buffer.from([0, 2, 1, 120])]) },
  'glue-other': (path) => isGlue(path) && { edit: (body) => Buffer.concat([body, Buffer.from('\n// more\n')]) },
  // The program is replaced by stub.js, which reads its role from the address. Its checksum is not checked.
  stub: (path) => {
    if (isGlue(path)) return { file: STUB };
    const edit = (body) => body.toString().replace(/data-glue-integrity="[^"]*"/, 'data-glue-integrity=""');
    return path === 'index.html' && { edit };
  },
};

/** Reads the text of a `_headers` file (a path, and indented below it its headers); returns a path's headers. */
export function readHeaders(text) {
  const rules = [];
  for (const line of text.split('\n').filter(Boolean)) {
    if (!line.startsWith(' ')) {
      rules.push({ path: line, headers: {} });
      continue;
    }
    const colon = line.indexOf(':');
    rules.at(-1).headers[line.slice(0, colon).trim().toLowerCase()] = line.slice(colon + 1).trim();
  }
  const headersOf = (rule, path) => (rule.path === '/*' || rule.path === path ? rule.headers : {});
  return (path) => Object.assign({}, ...rules.map((rule) => headersOf(rule, path)));
}

/** Serves a folder. `edit` gets the path and the bytes of each file and returns its bytes. Port 0 is any free port. */
export async function serve(root, { port = 0, edit = (_, body) => body } = {}) {
  const headersOf = readHeaders(await readFile(join(root, '_headers'), 'utf8'));
  const server = createServer(async (request, response) => {
    const url = new URL(request.url, 'http://localhost');
    let path = decodeURIComponent(url.pathname);
    if (path === '/frame/') {
      response.writeHead(200, { 'content-type': TYPES['.html'] });
      const address = `http://127.0.0.1:${server.address().port}/${url.search}`;
      response.end(`<!DOCTYPE html><title>A frame</title><link rel="icon" href="data:,">
        <iframe src="${address}" width="300" height="180"></iframe>`);
      return;
    }
    let fault = 'none';
    const match = /^\/fault\/([a-z0-9-]+)\/(.*)$/.exec(path);
    if (match) [fault, path] = [match[1], match[2]];
    path = normalize(`/${path}`).slice(1) || 'index.html'; // no path leads above the root
    const change = FAULTS[fault]?.(path) || {};
    const head = {
      'content-type': change.type ?? TYPES[extname(path)] ?? 'application/octet-stream',
      ...headersOf(`/${path}`),
    };
    try {
      if (!(fault in FAULTS) || change.status) throw new Error('not here');
      const whole = change.body ?? edit(path, await readFile(change.file ?? join(root, path)));
      const body = Buffer.from(change.edit ? change.edit(whole) : whole);
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
      response.writeHead(change.status ?? 404, { 'content-type': 'text/plain', 'cache-control': 'no-store' });
      response.end('not here');
    }
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', resolve));
  const origin = `http://127.0.0.1:${server.address().port}`;
  return {
    origin,
    port: server.address().port,
    close: () => {
      server.closeAllConnections();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}
