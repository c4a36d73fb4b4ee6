// `npm run evaluate -- --intents FILE...`: what whither/dom's intents are worth on recorded movements, by its options; with `--wandering` in
// place of `--intents`: in streams of them, of which some lead to nothing.
import { existsSync } from "node:fs";
import { rm } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { bundle } from "../../../scripts/bundle.mjs";
import { Failure, main, root } from "../../../scripts/run.mjs";
import { StreamSums, Sums } from "./figures.mjs";
import { PEER, SETTINGS } from "./foresight.mjs";
import { Pool } from "./pool.mjs";
import { LEGEND, print, write } from "./report.mjs";
import { optionsOf, REASONS, rowsOf, rowsOfStreams } from "./rows.mjs";
import { printStreams, STREAM_LEGEND, writeStreams } from "./stream-report.mjs";
import { nameOf, readLines, readTrack } from "./tracks.mjs";
import { SHARES } from "./wandering.mjs";

/** Lines that are scored at once. */
const BATCH = 32;

await main(import.meta.url, async () => {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: {
      users: { type: "boolean" },
      grid: { type: "boolean" },
      wandering: { type: "boolean" },
      json: { type: "string" },
    },
  });
  if (!existsSync(join(root, "dist/pointing.js"))) throw new Failure("dist/ has to be there: npm run build");
  const bundled = await bundle(["testing/page.ts", "options.ts"].map((file) => join(root, "js/dom", file)));
  const urlOf = (file) => pathToFileURL(join(bundled, file)).href;
  const { readOptions } = await import(urlOf("options.mjs"));
  const defaults = readOptions({ root: { querySelectorAll() {} } });
  const make = (options) => new Pool(urlOf("testing/page.mjs"), options);
  try {
    await (values.wandering ? wandering : intents)(positionals, defaults, make, values);
  } finally {
    await rm(bundled, { recursive: true });
  }
});

/** The movements one by one. */
async function intents(files, defaults, make, { users, grid, json }) {
  const rows = rowsOf(defaults, grid);
  const own = REASONS.flatMap((reasons) => rows.map((row) => ({ reasons, row })));
  const pool = make(own.map(({ row, reasons }) => optionsOf(row, reasons)));
  const combinations = [...own, ...SETTINGS.map((row) => ({ reasons: PEER, row }))];
  const sets = new Map();
  try {
    for (const file of files) await score(file, pool, sets, combinations.length);
  } finally {
    await pool.stop();
  }
  refuseNothing(sets);
  console.log(LEGEND);
  for (const [name, sums] of sets) print(name, sums, combinations, rows, users);
  if (json) await write(json, sets, combinations);
}

/** Each user's movements in a stream, one for each share of those that wander. */
async function wandering(files, defaults, make, { users, json }) {
  const rows = rowsOfStreams(defaults);
  const pool = make(rows.map((row) => optionsOf(row, {})));
  const sets = new Map();
  try {
    for (const file of files) await scoreStreams(file, pool, sets, rows.length);
  } finally {
    await pool.stop();
  }
  refuseNothing(sets);
  console.log(STREAM_LEGEND);
  for (const [name, sums] of sets) printStreams(name, sums, rows, users);
  if (json) await writeStreams(json, sets, rows);
}

function refuseNothing(sets) {
  if (sets.size === 0) throw new Failure("nothing to score: no track comes to its target from elsewhere");
}

/** Adds a file's tracks to the sets: by set and user the sums for each of so many options. */
async function score(file, pool, sets, count) {
  const lines = await readLines(file);
  const batches = Array.from({ length: Math.ceil(lines.length / BATCH) }, (_, i) => lines.slice(BATCH * i, BATCH * (i + 1)));
  const scored = (await pool.run(batches, `${lines.length} tracks of ${nameOf(file)}`)).flat();
  for (const track of scored) {
    if (track?.broken) console.error(`${file}:${track.broken}; skipped`);
    else if (track) {
      const { user, part, scores } = track;
      const sums = sumsOf(sets, nameOf(file) + part, user, () => scores.map(() => new Sums()));
      for (let i = 0; i < count; i++) sums[i].add(scores[i]);
    }
  }
}

/** Adds a file's users to the sets: by set and user, for each share that wanders the sums for each of so many options. */
async function scoreStreams(file, pool, sets, count) {
  const users = new Map();
  for (const { number, text } of await readLines(file)) {
    try {
      const track = readTrack(text);
      const user = track.user ?? "";
      users.set(user, [...(users.get(user) ?? []), track]);
    } catch (error) {
      console.error(`${file}:${number}: ${error.message}; skipped`);
    }
  }
  const jobs = Array.from(users, ([user, tracks]) => ({ user, tracks }));
  const streams = await pool.run(jobs, `${jobs.length} users of ${nameOf(file)}`);
  streams.forEach((byShare, i) => {
    if (byShare[0].length === 0) return;
    const sums = sumsOf(sets, nameOf(file), jobs[i].user, () =>
      SHARES.map(() => Array.from({ length: count }, () => new StreamSums())),
    );
    byShare.forEach((movements, share) => {
      for (const movement of movements) movement.scores.forEach((each, k) => sums[share][k].add(movement, each));
    });
  });
}

/** A user's sums in a set, made where there are none. */
function sumsOf(sets, set, user, make) {
  const users = sets.get(set) ?? new Map();
  const sums = users.get(user) ?? make();
  sets.set(set, users.set(user, sums));
  return sums;
}
