// `npm run evaluate -- --intents FILE...`: what whither/dom's intents are worth on recorded movements, by its options.
import { existsSync } from "node:fs";
import { readFile, rm } from "node:fs/promises";
import { availableParallelism } from "node:os";
import { basename, join } from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { Worker } from "node:worker_threads";
import { bundle } from "../../../scripts/bundle.mjs";
import { Failure, main, root } from "../../../scripts/run.mjs";
import { Sums } from "./figures.mjs";
import { LEGEND, print, write } from "./report.mjs";
import { optionsOf, REASONS, rowsOf } from "./rows.mjs";

/** Lines that are scored at once. */
const BATCH = 32;

await main(import.meta.url, async () => {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { users: { type: "boolean" }, grid: { type: "boolean" }, json: { type: "string" } },
  });
  if (!existsSync(join(root, "dist/pointing.js"))) throw new Failure("dist/ has to be there: npm run build");
  const bundled = await bundle(["testing/page.ts", "options.ts"].map((file) => join(root, "js/dom", file)));
  const urlOf = (file) => pathToFileURL(join(bundled, file)).href;
  const { readOptions } = await import(urlOf("options.mjs"));
  const rows = rowsOf(readOptions({ root: { querySelectorAll() {} } }), values.grid);
  const combinations = REASONS.flatMap((reasons) => rows.map((row) => ({ reasons, row })));
  const options = combinations.map(({ row, reasons }) => optionsOf(row, reasons));
  const workers = startWorkers(urlOf("testing/page.mjs"), options);
  try {
    const sets = new Map();
    for (const file of positionals) await score(file, workers, sets, options.length);
    if (sets.size === 0) throw new Failure("nothing to score: no track comes to its target from elsewhere");
    console.log(LEGEND);
    for (const [name, users] of sets) print(name, users, combinations, rows, values.users);
    if (values.json) await write(values.json, sets, combinations);
  } finally {
    for (const worker of workers) await worker.terminate();
    await rm(bundled, { recursive: true });
  }
});

function startWorkers(page, options) {
  const workerData = { page, options };
  const file = new URL("worker.mjs", import.meta.url);
  return Array.from({ length: availableParallelism() }, () => new Worker(file, { workerData }));
}

/** Adds a file's tracks to the sets: by set and user the sums for each of so many options. */
async function score(file, workers, sets, count) {
  const name = basename(file).replace(/\.[^.]*$/, "");
  const lines = (await readLines(file)).map((text, i) => ({ text, number: i + 1 })).filter(({ text }) => text.trim() !== "");
  const batches = Array.from({ length: Math.ceil(lines.length / BATCH) }, (_, i) => lines.slice(BATCH * i, BATCH * (i + 1)));
  const scored = new Array(batches.length);
  let next = 0;
  let done = 0;
  const work = async (worker) => {
    while (next < batches.length) {
      const mine = next++;
      scored[mine] = await ask(worker, batches[mine]);
      done++;
      const tenth = Math.floor((10 * done) / batches.length);
      if (tenth > Math.floor((10 * (done - 1)) / batches.length))
        console.error(`${name}: ${10 * tenth}% of ${lines.length} tracks`);
    }
  };
  await Promise.all(workers.map(work));
  // in the order of the file, however many worked on it
  for (const track of scored.flat()) {
    if (track?.broken) console.error(`${file}:${track.broken}; skipped`);
    else if (track) add(sets, `${name}${track.part}`, track, count);
  }
}

function add(sets, set, { user, scores }, count) {
  const users = sets.get(set) ?? new Map();
  const sums = users.get(user) ?? Array.from({ length: count }, () => new Sums());
  sets.set(set, users.set(user, sums));
  for (let i = 0; i < count; i++) sums[i].add(scores[i]);
}

function ask(worker, lines) {
  return new Promise((resolve, reject) => {
    worker.once("error", reject);
    worker.once("message", (answer) => {
      worker.off("error", reject);
      resolve(answer);
    });
    worker.postMessage(lines);
  });
}

async function readLines(file) {
  try {
    return (await readFile(file, "utf8")).split("\n");
  } catch (error) {
    throw new Failure(`${file} cannot be read: ${error.message}`);
  }
}
