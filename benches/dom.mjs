// What watching a page's elements costs its main thread, by the browser's own trace: `whither/dom`, ForesightJS, and nothing.
import { median } from "./measure.mjs";

/** Targets, all of them visible: columns and rows. */
const GRID = [40, 25];
const COUNT = GRID[0] * GRID[1];

/** What is mounted and unmounted again. */
export const ROWS = 10_000;

/** Milliseconds of main thread a frame that `whither/dom` may take. */
export const LIMIT = 1.5;

const CATEGORIES = ["-*", "toplevel", "blink.user_timing", "__metadata"];

/** The tasks of the page's main thread and its marks: `{ tasks: [{ start, end, busy }], marks: [{ name, at }] }`, in milliseconds. */
function read(trace) {
  const { traceEvents } = JSON.parse(trace);
  const marked = traceEvents.find(({ cat, name }) => cat.includes("user_timing") && name.startsWith("bench-"));
  const own = traceEvents.filter(({ pid, tid }) => pid === marked.pid && tid === marked.tid);
  const marks = own
    .filter(({ cat, name }) => cat.includes("user_timing") && name.startsWith("bench-"))
    .map(({ name, ts }) => ({ name: name.slice("bench-".length), at: ts / 1000 }))
    .sort((a, b) => a.at - b.at);
  const tasks = own
    .filter(({ ph, name }) => ph === "X" && name === "ThreadControllerImpl::RunTask")
    .map(({ ts, dur, tdur }) => ({ start: ts / 1000, end: (ts + dur) / 1000, busy: (tdur ?? dur) / 1000 }))
    .sort((a, b) => a.start - b.start);
  return { tasks, marks };
}

/** The milliseconds of processor that tasks took which ended between two moments. */
const spent = (tasks, from, to) => tasks.filter(({ end }) => end > from && end <= to).reduce((sum, { busy }) => sum + busy, 0);

/** One page, watched so: `{ frames: milliseconds each, long, mount, unmount, ... }`. */
async function measurePage(browser, url, name, seconds) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const failed = new Promise((_, reject) => page.on("pageerror", reject));
  failed.catch(() => {});
  const run = async (expression) => Promise.race([failed, page.evaluate(expression)]);
  await page.goto(url);
  await page.addScriptTag({ type: "module", content: 'import "/dom-page.js"; globalThis.isReady = true;' });
  await page.waitForFunction(() => globalThis.isReady);
  const tracked = await run(`prepare("${name}", ${GRID})`);
  await run("wander(2)"); // compiles what runs often
  await browser.startTracing(page, { categories: CATEGORIES });
  const done = await run(`wander(${seconds})`);
  const rows = await run(`mountRows(${ROWS})`);
  const { tasks, marks } = read(await browser.stopTracing());
  await page.close();
  check(name, tracked, done, rows);
  const at = (wanted) => marks.find((mark) => mark.name === wanted).at;
  const edges = marks.filter((mark) => mark.name === "frame" || mark.name === "end").map((mark) => mark.at);
  return {
    frames: edges.slice(1).map((edge, k) => spent(tasks, edges[k], edge)),
    long: tasks.filter(({ end, busy }) => busy > 50 && end > edges[0] && end <= edges.at(-1)).length,
    mount: spent(tasks, at("mount"), at("mounted")),
    unmount: spent(tasks, at("unmount"), at("unmounted")),
    work: done.work / done.frames,
  };
}

/** Fails unless the watcher had all targets and really worked, and let go of what was unmounted. */
function check(name, tracked, { frames, work }, { most, left }) {
  if (name === "none") return;
  const wrong =
    (tracked !== COUNT && `it tracks ${tracked} targets of ${COUNT}`) ||
    (name === "whither" && work < 0.8 * frames && `it predicted in ${work} frames of ${frames}`) ||
    (name === "foresight" && work < 10 && `it called back ${work} times in ${frames} frames`) ||
    (most !== ROWS && `it tracks ${most} rows of ${ROWS} that were mounted`) ||
    (left !== 0 && `it still tracks ${left} rows of ${ROWS} that were unmounted`);
  if (wrong) throw new Error(`${name} on a page of ${COUNT} targets: ${wrong}`);
}

/** By name, medians over pages that take turns: `{ frame, long, mount, unmount }`, milliseconds and a number of tasks. */
export async function measureDom(browser, url, quick) {
  const names = ["none", "whither", "foresight"];
  const pages = Object.fromEntries(names.map((name) => [name, []]));
  for (let round = 0; round < (quick ? 1 : 3); round++) {
    for (const name of names) {
      console.log(`Chromium: ${COUNT} targets on a page, ${name}`);
      pages[name].push(await measurePage(browser, url, name, quick ? 4 : 8));
    }
  }
  const summary = (runs) => ({
    frame: median(runs.flatMap(({ frames }) => frames)),
    high: median(runs.map(({ frames }) => [...frames].sort((a, b) => a - b)[Math.floor(0.95 * frames.length)])),
    long: runs.reduce((sum, { long }) => sum + long, 0),
    mount: median(runs.map(({ mount }) => mount)),
    unmount: median(runs.map(({ unmount }) => unmount)),
  });
  return { count: COUNT, rows: ROWS, ...Object.fromEntries(names.map((name) => [name, summary(pages[name])])) };
}
