// whither/links prerenders in Chromium. Under a debugger Chromium does not, and playwright-core is one: so the browser is started by
// itself, the page moves a pointer that it makes up, and the server is given what happens.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathOfChromium } from "../../scripts/chromium.mjs";
import { root } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { until } from "./links-site.mjs";

const START = { x: 400, y: 500 };
const LINK = { x: 400, y: 60, size: 60 };

/** Milliseconds for which the pointer stays, so that what follows is another movement. */
const STILL = 450;

/** Whether it can be done now. */
function attempt(run) {
  try {
    run();
    return true;
  } catch {
    return false;
  }
}

/** Runs in the page: a pointer moves to the link until it is prerendered, turns away, comes back and clicks. */
async function moveAndClick({ there, back, still }) {
  const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
  const move = (clientX, clientY) => {
    const options = { clientX, clientY, pointerId: 1, pointerType: "mouse", bubbles: true, composed: true };
    document.elementFromPoint(clientX, clientY).dispatchEvent(new PointerEvent("pointermove", options));
  };
  const play = async (samples) => {
    const start = performance.now();
    for (const [time, x, y] of samples) {
      await sleep(start + 1000 * time - performance.now());
      move(x, y);
    }
  };
  /** Whether the document lives, or not, as is wanted, before long. */
  const lives = async (wanted) => {
    for (let k = 0; k < 50; k++) {
      const { isOpen } = await fetch("/state").then((response) => response.json());
      if (isOpen === wanted) return true;
      await sleep(20);
    }
    return false;
  };
  /** Again, where this machine was too slow for one movement. */
  const reach = async () => {
    do {
      move(there[0][1], there[0][2]);
      await sleep(still);
      await play(there);
    } while (!(await lives(true)));
  };
  await reach();
  do await play(back);
  while (!(await lives(false)));
  await reach();
  await fetch("/note?clicked");
  document.links[0].click();
}

/** Runs in the document that is prerendered: it has a connection for as long as it lives, and watches links of its own. */
async function live() {
  const note = (text) => fetch(`/note?${text}`);
  note(`runs, prerendering ${document.prerendering}`);
  fetch("/open").catch(() => {});
  document.addEventListener("prerenderingchange", () => note("activated"));
  const { links } = await import("/dist/links.js");
  const onPrefetch = () => note(`prefetches, prerendering ${document.prerendering}`);
  links({ reasons: { viewport: { after: 0 } }, onPrefetch });
}

test("a document is prerendered above its threshold, dropped when the pointer turns away, and there when the link is followed", async (t) => {
  const notes = [];
  const requests = [];
  let opened = 0;
  const documents = {
    "/": `<style>a { position: absolute; left: 340px; top: 30px; width: 120px; height: 60px; background: gold }</style>
      <a href="/next" aria-label="Next"></a>
      <script type="module">import { links } from "/dist/links.js";
        const ahead = links({ load: "eager", keep: 60_000, threshold: 0.7, prerender: { threshold: 0.8 } });
        await ahead.watcher.ready;
        (${moveAndClick})(${JSON.stringify({
          there: movement(START, LINK, LINK.size, { seed: 3 }),
          back: movement(LINK, START, 60, { seed: 9 }),
          still: STILL,
        })});</script>`,
    "/next": `<a href="/after">After</a><script type="module">(${live})()</script>`,
    "/after": "",
  };
  const server = createServer((request, response) => {
    const { pathname, search } = new URL(request.url, "http://localhost");
    if (pathname.startsWith("/dist/")) {
      response.writeHead(200, { "content-type": "text/javascript" }).end(readFileSync(join(root, pathname)));
    } else if (pathname === "/open") {
      opened++;
      response.on("close", () => opened--);
    } else if (pathname === "/state") {
      response.end(JSON.stringify({ isOpen: opened > 0 }));
    } else if (pathname === "/note") {
      notes.push(decodeURIComponent(search.slice(1)));
      response.end();
    } else {
      requests.push([pathname, request.headers["sec-purpose"] ?? ""]);
      const headers = { "content-type": "text/html; charset=utf-8", "cache-control": "no-store" };
      response.writeHead(200, headers).end(`<!doctype html><link rel="icon" href="data:,">${documents[pathname] ?? ""}`);
    }
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  const profile = mkdtempSync(join(tmpdir(), "whither-prerender-"));
  const quiet = ["--no-first-run", "--disable-component-update", "--disable-sync"];
  const own = ["--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=800,700", `--user-data-dir=${profile}`];
  const address = `http://localhost:${server.address().port}/`;
  const browser = spawn(await pathOfChromium(), [...own, ...quiet, address], { stdio: "ignore" });
  const ended = once(browser, "exit");
  t.after(async () => {
    browser.kill();
    await ended;
    server.close().closeAllConnections();
    // its helpers write for a while yet
    await until("the profile's end", () => attempt(() => rmSync(profile, { recursive: true, force: true })), 20_000);
  });
  await until("the last request", () => requests.some(([path]) => path === "/after"), 60_000).catch((error) => {
    error.message += ` of ${JSON.stringify({ notes, requests, opened })}`;
    throw error;
  });
  const runs = notes.filter((note) => note === "runs, prerendering true");
  assert.ok(runs.length >= 2, "it is prerendered again after it has ended");
  assert.deepEqual(notes.slice(runs.length), ["clicked", "activated", "prefetches, prerendering false"]);
  assert.deepEqual([...new Set(requests.map(String))], ["/,", "/next,prefetch", "/after,prefetch"]);
});
