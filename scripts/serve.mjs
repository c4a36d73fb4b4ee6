// A server of static files, with no more features than common static hosts.
import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createGzip } from "node:zlib";
import { pipeline } from "node:stream";
import { extname, join, normalize, sep } from "node:path";
import { Failure } from "./run.mjs";

const types = {
  ".css": "text/css",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".json": "application/json",
  ".md": "text/plain; charset=utf-8",
  ".mjs": "text/javascript",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
  ".woff2": "font/woff2",
};

/** What gzip makes smaller. */
const compressible = /^(text|image\/svg|application\/(json|wasm|manifest))/;

/** The port that the variable PORT names. */
export function wantedPort() {
  const port = Number(process.env.PORT ?? 8080);
  if (Number.isInteger(port) && port >= 0 && port <= 65535) return port;
  throw new Failure(`PORT is ${JSON.stringify(process.env.PORT)}: it must be a number from 0 to 65535`);
}

/**
 * Serves `folder` on this machine, at `path` (`/sub/path/`); a `port` of 0 is any that is free.
 * `headers` go with every answer.
 */
export function serve(folder, { port = 0, path = "/", headers = {} } = {}) {
  const server = createServer((request, response) => {
    const file = fileAt(folder, path, request.url);
    if (file === null) {
      response.writeHead(404, { "content-type": "text/plain", ...headers }).end("not found\n");
      return;
    }
    const type = types[extname(file)] ?? "application/octet-stream";
    const packed = compressible.test(type) && /\bgzip\b/.test(request.headers["accept-encoding"] ?? "");
    const encoding = packed ? { "content-encoding": "gzip", vary: "accept-encoding" } : {};
    response.writeHead(200, { "content-type": type, "cache-control": "no-cache", ...encoding, ...headers });
    pipeline(packed ? [createReadStream(file), createGzip(), response] : [createReadStream(file), response], () => {});
  });
  return new Promise((resolve, reject) => {
    server.on("error", (error) => {
      const taken = `port ${port} is taken: stop what uses it, or choose another (PORT=8081 npm start)`;
      reject(error.code === "EADDRINUSE" ? new Failure(taken) : error);
    });
    server.listen(port, "127.0.0.1", () => {
      const url = `http://localhost:${server.address().port}${path}`;
      resolve({ url, close: () => new Promise((closed) => server.close(closed).closeAllConnections()) });
    });
  });
}

/** The file that an address means; null for none, and for any outside the folder. */
function fileAt(folder, path, url) {
  let address;
  try {
    address = decodeURIComponent(new URL(url, "http://localhost").pathname);
  } catch {
    return null;
  }
  if (!address.startsWith(path)) return null;
  const file = normalize(join(folder, address.slice(path.length)));
  if (file !== normalize(folder) && !file.startsWith(normalize(folder + sep))) return null;
  const page = existsSync(file) && statSync(file).isDirectory() ? join(file, "index.html") : file;
  return existsSync(page) && statSync(page).isFile() ? page : null;
}
