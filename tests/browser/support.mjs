// What the browser tests share: the built page on a static host, and hands that move Chromium's real pointer.
import { after, before } from "node:test";
import { launch } from "../../scripts/chromium.mjs";
import { serve as serveFolder } from "../../scripts/serve.mjs";
import { folder } from "../../scripts/build-demo.mjs";
import { movement } from "./hand.mjs";

export { launch };

/** Nothing from elsewhere, nothing inline; WebAssembly is all that the package needs. */
export const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; font-src 'self'; img-src 'self'";

/** Serves the built page from a sub-path, as on any shared static host. */
export function serve(policy = POLICY) {
  return serveFolder(folder, { path: "/some/where/", headers: { "content-security-policy": policy } });
}

/** The page's address and a browser, from before the first test of the group in which this is called until after its last. */
export function hosted(policy) {
  const site = {};
  let host;
  before(async () => {
    host = await serve(policy);
    site.url = host.url;
    site.browser = await launch();
  });
  after(async () => {
    await site.browser?.close();
    await host?.close();
  });
  return site;
}

/** Runs in the page: whether it is ready, or has stated why it cannot be. */
export const isReady = () => ["ready", "failed"].some((state) => state in document.documentElement.dataset);

/** A page that is ready, with everything that it must not do collected in `problems`; `keeps` it lets it keep itself for later visits. */
export async function open(browser, url, { keeps = false, ...options } = {}, path = "index.html") {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "dark", ...options });
  const page = await context.newPage();
  if (!keeps) await page.addInitScript(() => delete Navigator.prototype.serviceWorker);
  await page.addInitScript(watchShifts);
  await page.addInitScript(keepShown);
  const problems = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) problems.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (!request.url().startsWith(url)) problems.push(`request elsewhere: ${request.url()}`);
  });
  page.on("requestfailed", (request) => {
    // whoever leaves a page takes back what it has not loaded yet
    if (request.failure()?.errorText !== "net::ERR_ABORTED") problems.push(`request failed: ${request.url()}`);
  });
  page.on("response", (response) => {
    if (response.status() >= 400) problems.push(`${response.status()}: ${response.url()}`);
  });
  await page.goto(url + path);
  await page.waitForFunction(isReady);
  return { page, problems, close: () => context.close() };
}

/** Runs in the page: adds up what moves that should not. */
function watchShifts() {
  window.shifts = [];
  new PerformanceObserver((list) => {
    for (const { value, sources } of list.getEntries()) {
      window.shifts.push({ value, sources: sources.map(({ node }) => node?.id || node?.className || node?.nodeName) });
    }
  }).observe({ type: "layout-shift", buffered: true });
}

/** Every layout shift so far. */
export async function shifts(page) {
  await nextFrame(page);
  return page.evaluate(() => window.shifts);
}

export function nextFrame(page) {
  return page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** The seconds for which a pointer has to stay before what follows is another movement. */
export const REST = 0.35;

/** Runs in the page: `shown()` is what it shows, and `lastShown` what it showed in the last frame of a movement. */
function keepShown() {
  const none = () => Number(document.querySelector("#none")?.style.getPropertyValue("--probability") || 1);
  window.shown = () => {
    const icons = [...document.querySelectorAll("button[data-destination]")].map((icon) => ({
      id: icon.dataset.destination,
      probability: Number(icon.style.getPropertyValue("--probability")),
      predicted: icon.dataset.predicted === "true",
    }));
    const top = icons.reduce((best, icon) => (icon.probability > best.probability ? icon : best));
    const sum = icons.reduce((sum, icon) => sum + icon.probability, none());
    return { icons, none: none(), top, sum, status: document.querySelector("#status").textContent };
  };
  const keep = () => {
    if (none() < 1) window.lastShown = window.shown();
    requestAnimationFrame(keep);
  };
  requestAnimationFrame(keep);
}

/** What the page shows, after the next frame. */
export async function read(page) {
  await nextFrame(page);
  return page.evaluate(() => window.shown());
}

/** The same at the end of a movement: on a machine under load the rest after it may be over before anything is read. */
export async function readMovement(page) {
  await nextFrame(page);
  return page.evaluate(() => window.lastShown);
}

/** Whether what `read` gives sums to one, as far as that is written: by `whither/dom` to three places, and from 1% on. */
export function sumsToOne({ icons, sum }) {
  const written = icons.filter(({ probability }) => probability > 0).length;
  const rounding = 0.0005 * written;
  return sum <= 1 + rounding && sum >= 1 - rounding - 0.01 * (icons.length - written);
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
  const send = (type, timestamp, point, more = {}) =>
    session.send("Input.dispatchMouseEvent", { type, timestamp, x: point.x, y: point.y, ...more });
  let last = 0;
  /** Never earlier than what has been sent. */
  const begin = () => (last = Math.max(last, Date.now() / 1000));
  return {
    /** Samples `[seconds, x, y]`, played to the end; from now on, or on the clock of a movement that this one goes on with. */
    async play(samples, start = begin()) {
      const sent = [];
      for (const [time, x, y] of samples) {
        await until(start + time);
        last = start + time;
        sent.push(send("mouseMoved", last, { x, y }));
      }
      await Promise.all(sent);
      return start;
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

/** Moves the mouse from one icon to another and gives what is then shown. */
export async function head(page, hand, from, to, options) {
  const icons = await middles(page);
  const [start, end] = [from, to].map((id) => icons.find((icon) => icon.id === id));
  await hand.play([[0, start.x, start.y]]);
  await hand.rest(REST);
  await hand.play(movement(start, end, Math.min(end.width, end.height), options));
  return { shown: await readMovement(page), end };
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

/** Until the moment of a sample: how long a hand takes is what is tested, and nothing else is waited for. */
async function until(time) {
  const wait = time * 1000 - Date.now();
  if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
}
