// `npm run hands -- FILE...`: the hand of whither/testing beside recorded movements, each from and to where a recorded one was.
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { build } from "./build.mjs";
import { figuresOf, mean, ROWS } from "./hand-figures.mjs";
import { Failure, main } from "./run.mjs";
import { table } from "./table.mjs";

/** A recording begins when the pointer first moves; so does this. */
function fromFirstMovement(samples, rate) {
  const begin = Math.max(0, samples[1][0] - 1 / rate);
  return samples.map(([time, x, y], index) => [index === 0 ? 0 : time - begin, x, y]);
}

/** A simulated movement for each track, with its number as the seed. */
function simulated(hand, tracks, rate = 60) {
  return tracks.map((track, index) => {
    const [cx, cy, width, height] = track.targets[track.target];
    const [, x, y] = track.samples[0];
    const box = { x: cx - width / 2, y: cy - height / 2, width, height };
    const samples = hand({ x, y }, box, { seed: index + 1, rate, mistakes: true });
    return { ...track, samples: fromFirstMovement(samples, rate) };
  });
}

/** The share of the time to the last entry in which the true target is the most probable one, and the mean log loss. */
function predicted({ PointerPredictor }, tracks) {
  const scores = tracks.flatMap((track) => {
    const figures = figuresOf(track);
    if (figures === null) return [];
    const targets = track.targets.map(([x, y, width, height], id) => ({ id: String(id), x, y, width, height }));
    const predictor = new PointerPredictor(targets);
    const all = track.samples.filter(([time]) => time <= figures.duration);
    let [on, time, loss] = [0, 0, 0];
    all.forEach(([t, x, y], k) => {
      predictor.observe(t, [x, y]);
      const weight = ((all[k + 1]?.[0] ?? t) - (all[k - 1]?.[0] ?? t)) / 2;
      const p = predictor.probabilities()[track.target];
      if (predictor.best.index === track.target) on += weight;
      time += weight;
      loss -= Math.log(Math.max(1e-4, p)) / all.length;
    });
    predictor.free();
    return [{ on: on / time, loss }];
  });
  return `${(100 * mean(scores.map(({ on }) => on))).toFixed(1)}, ${mean(scores.map(({ loss }) => loss)).toFixed(2)}`;
}

/** The tracks of a file on a plane, without those to one place again and again, whose ids end in `-in`. */
function read(file) {
  const lines = readFileSync(file, "utf8").split("\n");
  const tracks = lines.filter((text) => text.trim() !== "").map((text) => JSON.parse(text));
  return tracks.filter(({ id, samples }) => samples[0].length === 3 && !id?.endsWith("-in"));
}

/** The table: a pair of columns for each file. */
export async function compare(files) {
  const { hand } = await import("whither/testing");
  const pointing = await import("whither/pointing");
  await pointing.init();
  const sets = files.flatMap((file) => {
    const tracks = read(file);
    const name = basename(file, ".jsonl");
    return [
      { name: `${name}, recorded`, tracks },
      { name: "simulated", tracks: simulated(hand, tracks) },
    ].map((set) => ({ ...set, figures: set.tracks.map(figuresOf).filter((one) => one !== null) }));
  });
  const rows = [
    ["movements", ...sets.map(({ figures }) => figures.length)],
    ...ROWS.map(([name, of]) => [name, ...sets.map(({ figures }) => of(figures))]),
    ["predicted, % of the time; log loss", ...sets.map(({ tracks }) => predicted(pointing, tracks))],
  ];
  table(["", ...sets.map(({ name }) => name)], rows);
}

await main(import.meta.url, async () => {
  const files = process.argv.slice(2);
  if (files.length === 0) throw new Failure("npm run hands -- FILE...: files of tracks as npm run evaluate reads them");
  await build();
  await compare(files);
});
