// A site for the tests of whither/links: a real server that counts requests, and hands that move Chromium's mouse over its links.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { after, before } from "node:test";
import { launch } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

/** Where links are, in px: far enough apart that a hand means one of them. */
const PLACES = [
  [120, 60],
  [480, 60],
  [840, 60],
  [120, 560],
  [480, 560],
  [840, 560],
];

/** The place between them from which every hand comes. */
const START = { x: 500, y: 320 };

/** Links to these addresses, or elements as they are written. */
export function linksTo(...hrefs) {
  const place = (k) => `position: absolute; left: ${PLACES[k][0]}px; top: ${PLACES[k][1]}px; font: 30px sans-serif`;
  return hrefs
    .map((href, k) =>
      href.startsWith("<")
        ? href.replace(/^<\w+/, `$& style="${place(k)}"`)
        : `<a style="${place(k)}" href="${href}">Link ${k}</a>`,
    )
    .join("\n");
}

/**
 * A server: `requests` has every request for a document, `{ path, purpose, dest, ended: "sent" | "aborted" | null }`. The query of an
 * address is what its answer is like: `wait` in milliseconds, `status`, and `max-age`. `posted` is what was sent as a beacon.
 */
async function serve() {
  const site = { requests: [], posted: [], pages: new Map() };
  const server = createServer((request, response) => {
    const { pathname, search, searchParams } = new URL(request.url, "http://localhost");
    if (pathname.startsWith("/dist/")) {
      response.writeHead(200, { "content-type": "text/javascript" }).end(readFileSync(join(root, pathname)));
      return;
    }
    if (request.method === "POST") {
      let body = "";
      request.on("data", (part) => (body += part)).on("end", () => site.posted.push(JSON.parse(body)));
      response.end();
      return;
    }
    const page = site.pages.get(pathname);
    if (!page) {
      const entry = {
        path: pathname + search,
        purpose: request.headers["sec-purpose"] ?? request.headers.purpose ?? null,
        dest: request.headers["sec-fetch-dest"],
        tags: request.headers["sec-speculation-tags"] ?? null,
        ended: null,
        time: performance.now(),
      };
      site.requests.push(entry);
      response.on("finish", () => (entry.ended = "sent")).on("close", () => (entry.ended ??= "aborted"));
    }
    const age = searchParams.get("max-age");
    const headers = {
      "content-type": "text/html; charset=utf-8",
      "cache-control": age ? `max-age=${age}` : "no-store",
      ...page?.headers,
    };
    const answer = () => {
      const text = `<!doctype html><title>${pathname}</title><link rel="icon" href="data:,"><h1>${pathname}</h1>`;
      response.writeHead(Number(searchParams.get("status") ?? 200), headers).end(page?.html ?? text);
    };
    if (searchParams.has("wait")) setTimeout(answer, Number(searchParams.get("wait")));
    else answer();
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  site.url = `http://localhost:${server.address().port}`;
  site.close = () => new Promise((closed) => server.close(closed).closeAllConnections());
  return site;
}

/** The site and a browser, from before the first test of the group in which this is called until after its last. */
export function hosted() {
  const site = {};
  before(async () => Object.assign(site, await serve(), { browser: await launch() }));
  after(async () => {
    await site.browser?.close();
    await site.close?.();
  });
  return site;
}

let opened = 0;

/**
 * Opens a page of the site with this body, on which `ahead` is `links(options)` (text), `prefetches` and `errors` what its callbacks got;
 * `first` (text) runs before that. `init` runs before any script of the page. The requests are those from then on.
 */
export async function open(t, site, body, { options = "", first = "", headers = {}, init, nonce = "" } = {}) {
  const context = await site.browser.newContext({ viewport: { width: 1000, height: 700 } });
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  t.after(async () => {
    await context.close();
    assert.deepEqual(problems, []);
  });
  if (init) await page.addInitScript(init);
  const path = `/page-${opened++}`;
  const html = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Links</title><link rel="icon" href="data:,">
</head><body>${body}
<script type="module"${nonce && ` nonce="${nonce}"`}>import { links } from "/dist/links.js";
window.links = links;
window.prefetches = [];
window.errors = [];
const onPrefetch = ({ url, mechanism, reason, probability }) => prefetches.push({ url, mechanism, reason, probability });
const onError = (error) => errors.push(String(error));
${first}
window.ahead = links({ load: "eager", onPrefetch, onError, ${options} });
await ahead.watcher.ready;
addEventListener("pagehide", () => navigator.sendBeacon("/stats", JSON.stringify(ahead.stats())));
window.isReady = true;</script></body></html>`;
  site.pages.set(path, { html, headers });
  await page.goto(site.url + path);
  await page.waitForFunction(() => window.isReady);
  site.requests.length = site.posted.length = 0;
  const hand = await mouse(page);
  const place = async (target) => {
    const { x, y, width, height } = await page.locator(target).first().boundingBox();
    return { x: x + width / 2, y: y + height / 2, size: Math.min(width, height) };
  };
  return {
    page,
    problems,
    hand,
    /** The hand comes from the middle towards a link, up to a share of the way; the link has to be meant before it is there. */
    async reach(target, share = 0.7, { seed = 3 } = {}) {
      const to = await place(target);
      await hand.play([[0, START.x, START.y]]);
      await hand.rest(REST);
      await hand.play(movement(START, to, to.size, { seed, share }));
      await nextFrame(page);
      return to;
    },
    /** From where it is towards a link: away to where no link is, fast. */
    async turnAway(from) {
      await hand.play(movement(from, { x: 500, y: 320 }, 60, { seed: 9 }));
      await hand.rest(REST + 0.1);
      await nextFrame(page);
    },
    stats: () => page.evaluate(() => ahead.stats()),
    prefetches: () => page.evaluate(() => prefetches),
  };
}

/** Waits until something is so; fails after a while. */
export async function until(what, isSo, milliseconds = 5000) {
  const end = performance.now() + milliseconds;
  while (!(await isSo())) {
    if (performance.now() > end) assert.fail(`it took too long: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
