// What loading links ahead asks of a server, and what it saves a user: recorded movements of a mouse, played in Chromium over pages whose
// links are their targets, on a server that counts. `whither/links`, Chromium's own eagerness, ForesightJS, a delay of hover.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { root } from "../scripts/run.mjs";
import { table } from "../scripts/table.mjs";
import { median } from "./measure.mjs";

/** Milliseconds until the server answers. */
const LATENCY = 300;

/** Milliseconds from press to release. */
const PRESS = 80;

/** Milliseconds for which the pointer stays at a movement's start, and after one that leads to no link. */
const STILL = 450;

const WINDOW = { width: 1960, height: 1180 };

/** Pages at a time. */
const AT_ONCE = 3;

/** A rule that the browser acts upon by itself. */
const eagerness = (name) =>
  `<script type="speculationrules">{ "prefetch": [{ "where": { "href_matches": "/d*" }, "eagerness": "${name}" }] }</script>`;

/** A rule for one link, when a page's script wants it. */
const rule = `const load = (url) => {
  const script = document.createElement("script");
  script.type = "speculationrules";
  script.text = JSON.stringify({ prefetch: [{ source: "list", urls: [url] }] });
  document.head.append(script);
};`;

/** What each puts into its pages. */
const CONTENDERS = {
  "whither/links": `<script type="module">import { links } from "/dist/links.js"; await links({ load: "eager" }).watcher.ready; done();</script>`,
  "whither/links, threshold .8": `<script type="module">import { links } from "/dist/links.js";
    await links({ load: "eager", threshold: 0.8 }).watcher.ready; done();</script>`,
  "ForesightJS and a rule": `<script type="module">import { ForesightManager } from "/foresight.js"; ${rule}
    ForesightManager.initialize({});
    for (const element of document.links) ForesightManager.instance.register({ element, callback: () => load(element.href) });
    done();</script>`,
  "hover of 65 ms and a rule": `<script type="module">${rule}
    for (const link of document.links) {
      let timer;
      link.addEventListener("mouseenter", () => (timer = setTimeout(load, 65, link.href)));
      link.addEventListener("mouseleave", () => clearTimeout(timer));
    }
    done();</script>`,
  "rules, eager": `${eagerness("eager")}<script type="module">done();</script>`,
  "rules, moderate": `${eagerness("moderate")}<script type="module">done();</script>`,
  "rules, conservative": `${eagerness("conservative")}<script type="module">done();</script>`,
  nothing: `<script type="module">done();</script>`,
};

/** As many movements of a file, evenly spread, of those that the window has room for and whose last place is on their target alone. */
function movements(file, count) {
  const all = readFileSync(file, "utf8").trim().split("\n").map(JSON.parse);
  const fits = ([x, y]) => x > 0 && y > 0 && x < WINDOW.width && y < WINDOW.height;
  const isOn = ([, x, y], [left, top, width, height]) => 2 * Math.abs(x - left) < width - 2 && 2 * Math.abs(y - top) < height - 2;
  const legal = all.filter(({ targets, target, samples }) => {
    const under = targets.flatMap((one, k) => (isOn(samples.at(-1), one) ? [k] : []));
    return targets.every(fits) && samples.every(([, ...place]) => fits(place)) && under.length === 1 && under[0] === target;
  });
  return Array.from({ length: Math.min(count, legal.length) }, (_, k) => legal[Math.floor((k * legal.length) / count)]);
}

/** A page with the targets of a movement as links; without the true one the movement leads nowhere. */
function pageOf({ targets, target }, part, isWithout) {
  const link = ([x, y, width, height], k) =>
    k === target && isWithout
      ? ""
      : `<a href="/d${k}" style="left: ${x - width / 2}px; top: ${y - height / 2}px; width: ${width}px; height: ${height}px"></a>`;
  return `<!doctype html><meta charset="utf-8"><title>Links</title><link rel="icon" href="data:,">
<style>a { position: absolute; background: #8ac }</style>
<script>window.ready = new Promise((resolve) => (window.done = resolve));</script>${targets.map(link).join("")}${part}`;
}

async function serve() {
  const { build } = await import("esbuild");
  const entry = { contents: 'export { ForesightManager } from "js.foresight";', resolveDir: root };
  const { outputFiles } = await build({ stdin: entry, bundle: true, format: "esm", write: false, outdir: "/" });
  const site = { pages: new Map(), requests: new Map() };
  const server = createServer((request, response) => {
    const [, visit, path] = request.url.match(/^\/v(\d+)(\/.*)$/) ?? [null, null, request.url];
    const script = { "content-type": "text/javascript" };
    if (path === "/foresight.js") return response.writeHead(200, script).end(outputFiles[0].contents);
    if (path.startsWith("/dist/")) return response.writeHead(200, script).end(readFileSync(join(root, path)));
    if (visit) return response.writeHead(200, { "content-type": "text/html" }).end(site.pages.get(visit));
    const from = request.headers.referer?.match(/\/v(\d+)\//)?.[1];
    if (!from) return response.writeHead(404).end();
    const made = { path, time: performance.now(), isAhead: request.headers["sec-purpose"] !== undefined, isCancelled: false };
    site.requests.get(from).push(made);
    response.on("close", () => (made.isCancelled = !response.writableFinished));
    setTimeout(
      () => response.writeHead(200, { "content-type": "text/html", "cache-control": "no-store" }).end("<title>d</title>"),
      LATENCY,
    );
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const url = `http://localhost:${server.address().port}`;
  return Object.assign(site, { url, close: () => new Promise((closed) => server.close(closed).closeAllConnections()) });
}

const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));

let visits = 0;

/** Plays a movement over a page: the requests, and in what time the link's document began to arrive. */
async function visit(browser, site, movement, part, isWithout) {
  const name = String(visits++);
  site.pages.set(name, pageOf(movement, part, isWithout));
  site.requests.set(name, []);
  // a window of its own, with a cache of its own
  const context = await browser.newContext({ viewport: WINDOW });
  const page = await context.newPage();
  await page.goto(`${site.url}/v${name}/`);
  await page.evaluate(() => window.ready);
  const session = await context.newCDPSession(page);
  const send = (type, more) => session.send("Input.dispatchMouseEvent", { type, ...more });
  const [, x0, y0] = movement.samples[0];
  await send("mouseMoved", { x: x0, y: y0 });
  await sleep(STILL);
  const start = Date.now();
  const sent = [];
  for (const [time, x, y] of movement.samples) {
    await sleep(start + 1000 * time - Date.now());
    sent.push(send("mouseMoved", { x, y, timestamp: start / 1000 + time }));
  }
  await Promise.all(sent);
  let [wait, clicked] = [null, Infinity];
  if (isWithout) {
    await sleep(STILL);
  } else {
    const [, x, y] = movement.samples.at(-1);
    const button = { x, y, button: "left", clickCount: 1 };
    await send("mousePressed", { ...button, buttons: 1 });
    await sleep(PRESS);
    clicked = performance.now();
    const arrived = page.waitForURL(`**/d${movement.target}`, { waitUntil: "commit" });
    await send("mouseReleased", button);
    await arrived;
    wait = performance.now() - clicked;
  }
  await sleep(LATENCY + 50);
  await context.close();
  const ahead = site.requests.get(name).filter((request) => request.isAhead);
  const right = (request) => !isWithout && request.path === `/d${movement.target}`;
  const used = ahead.find((request) => right(request) && !request.isCancelled);
  return {
    wait,
    lead: used ? clicked - used.time : null,
    wasted: ahead.filter((request) => !right(request) && !request.isCancelled).length,
    cancelled: ahead.filter((request) => request.isCancelled).length,
  };
}

/** Prints a table for each file of movements. */
export async function measureLinks(browser, files, count) {
  const site = await serve();
  try {
    for (const file of files) {
      const all = movements(file, count);
      const jobs = all.flatMap((movement) =>
        Object.keys(CONTENDERS).flatMap((name) => [false, true].map((isWithout) => ({ movement, name, isWithout }))),
      );
      const results = [];
      const work = async () => {
        for (let job = jobs.shift(); job; job = jobs.shift()) {
          results.push({ ...job, ...(await visit(browser, site, job.movement, CONTENDERS[job.name], job.isWithout)) });
        }
      };
      await Promise.all(Array.from({ length: AT_ONCE }, work));
      console.log(`\n${file}: ${all.length} movements`);
      report(results, all.length);
    }
  } finally {
    await site.close();
  }
}

function report(results, count) {
  const rows = Object.keys(CONTENDERS).map((name) => {
    const [on, off] = [false, true].map((isWithout) => results.filter((one) => one.name === name && one.isWithout === isWithout));
    const per = (list, key) => ((100 * list.reduce((sum, one) => sum + one[key], 0)) / count).toFixed(0);
    const leads = on.flatMap(({ lead }) => lead ?? []);
    const [lead, wait] = [leads, on.map((one) => one.wait)].map((times) => (times.length > 0 ? median(times).toFixed(0) : "-"));
    return [
      name,
      ((100 * leads.length) / count).toFixed(0),
      lead,
      wait,
      per(on, "wasted"),
      per(on, "cancelled"),
      per(off, "wasted"),
      per(off, "cancelled"),
    ];
  });
  const heads = [
    "for 100 movements",
    "asked for before the click",
    "lead, ms",
    "wait, ms",
    "wasted",
    "cancelled",
    "to no link: wasted",
    "cancelled",
  ];
  table(heads, rows);
}
