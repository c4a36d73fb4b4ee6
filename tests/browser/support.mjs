// What the browser tests share: the built page on a static host, Chromium, and hands that move its real pointer.
import assert from "node:assert/strict";
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const BUILT = fileURLToPath(new URL("../../www/dist/", import.meta.url));

/** A sub-path, as on any shared static host. */
const BASE = "/some/where/";

const TYPES = {
  ".css": "text/css",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".svg": "image/svg+xml",
  ".woff2": "font/woff2",
};

/** Nothing from elsewhere, nothing inline; WebAssembly is all that the package asks for. */
const POLICY = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; font-src 'self'; img-src 'self'";

/** Serves the built page from a sub-path until closed. */
export async function serve(policy = POLICY) {
  assert.ok(existsSync(join(BUILT, "index.html")), "www/dist is missing: npm run build:demo makes it");
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const path = normalize(pathname.slice(BASE.length) || "index.html");
    const file = join(BUILT, path);
    if (!pathname.startsWith(BASE) || path.startsWith("..") || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", "content-security-policy": policy });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${server.address().port}${BASE}`, close: () => server.close() };
}

/** The first Chromium of the usual names; CHROMIUM names another one. */
export function launch() {
  const usual = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
  const executablePath = process.env["CHROMIUM"] ?? usual.find((path) => existsSync(path));
  assert.ok(executablePath, "no Chromium: install it (Debian: apt-get install chromium) or name it in CHROMIUM");
  const quiet = ["quic", "background-networking", "component-update", "sync", "gpu"].map((name) => `--disable-${name}`);
  return chromium.launch({ executablePath, args: ["--no-sandbox", "--no-first-run", ...quiet] });
}

/** A page that is ready, with everything that it must not do collected in `sins`. */
export async function open(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  const sins = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) sins.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => sins.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (!request.url().startsWith(url)) sins.push(`request elsewhere: ${request.url()}`);
  });
  page.on("requestfailed", (request) => sins.push(`request failed: ${request.url()}`));
  page.on("response", (response) => {
    if (response.status() >= 400) sins.push(`${response.status()}: ${response.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => document.querySelector("#none").textContent !== "–" || document.documentElement.dataset.failed);
  return { page, sins, close: () => context.close() };
}

/** What the page shows, after the next frame. */
export function read(page) {
  return page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const icons = [...document.querySelectorAll("button[data-destination]")].map((icon) => ({
      id: icon.dataset.destination,
      probability: Number(icon.style.getPropertyValue("--probability")),
      predicted: icon.dataset.predicted === "true",
    }));
    const none = Number(document.querySelector("#none").style.getPropertyValue("--probability"));
    const top = icons.reduce((best, icon) => (icon.probability > best.probability ? icon : best));
    return { icons, none, top, sum: icons.reduce((sum, icon) => sum + icon.probability, none), status: document.querySelector("#status").textContent };
  });
}

/** The middles of all icons in the viewport. */
export function middles(page) {
  return page.evaluate(() =>
    [...document.querySelectorAll("button[data-destination]")].map((icon) => {
      const { x, y, width, height } = icon.getBoundingClientRect();
      return { id: icon.dataset.destination, x: x + width / 2, y: y + height / 2, width, height };
    }),
  );
}

/**
 * Chromium's own mouse: its events are trusted. Each carries the moment that it is meant for, so that a machine under load
 * blurs nothing; they are sent in real time.
 */
export async function mouse(page) {
  const session = await page.context().newCDPSession(page);
  const send = (type, timestamp, point, more = {}) => session.send("Input.dispatchMouseEvent", { type, timestamp, x: point.x, y: point.y, ...more });
  let last = 0;
  /** Never earlier than what has been sent. */
  const begin = () => (last = Math.max(last, Date.now() / 1000));
  return {
    /** Samples `[seconds from now, x, y]`, played to the end. */
    async play(samples) {
      const start = begin();
      const sent = [];
      for (const [time, x, y] of samples) {
        await until(start + time);
        last = start + time;
        sent.push(send("mouseMoved", last, { x, y }));
      }
      await Promise.all(sent);
    },
    async rest(seconds) {
      await until(begin() + seconds);
    },
    async press(point) {
      const button = { button: "left", clickCount: 1 };
      const time = begin();
      await send("mousePressed", time, point, { ...button, buttons: 1 });
      await send("mouseReleased", time, point, button);
    },
  };
}

/** A finger on the glass, dragged through `[seconds, x, y]`, first to last. */
export async function drag(page, samples, beforeLift = async () => {}) {
  const session = await page.context().newCDPSession(page);
  const start = Date.now() / 1000;
  for (const [index, [time, x, y]] of samples.entries()) {
    await until(start + time);
    const type = index === 0 ? "touchStart" : "touchMove";
    await session.send("Input.dispatchTouchEvent", { type, timestamp: start + time, touchPoints: [{ x, y, id: 1 }] });
  }
  await beforeLift();
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}

async function until(time) {
  const wait = time * 1000 - Date.now();
  if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
}
