// Lines of recorded movements, as the other tables of `npm run evaluate` read them.
import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import { Failure } from "../../../scripts/run.mjs";

/** Reads a line as a track in the plane; throws an Error that names what is wrong with it. */
export function readTrack(text) {
  const track = JSON.parse(text);
  const { targets, target, samples } = track;
  rows(targets, "targets", 4, "[x, y, width, height]");
  rows(samples, "samples", 3, "[t, x, y]");
  if (targets[target] === undefined) throw new Error(`target: must be the place of a target, got ${JSON.stringify(target)}`);
  const back = samples.findIndex(([time], i) => i > 0 && time < samples[i - 1][0]);
  if (back >= 0) throw new Error(`samples[${back}]: the time is before the last one's, ${samples[back][0]}`);
  return track;
}

/** The lines of a file that are not empty, `{ number, text }`. */
export async function readLines(file) {
  try {
    const lines = (await readFile(file, "utf8")).split("\n");
    return lines.map((text, i) => ({ text, number: i + 1 })).filter(({ text }) => text.trim() !== "");
  } catch (error) {
    throw new Failure(`${file} cannot be read: ${error.message}`);
  }
}

/** What a file's tracks are called in tables. */
export function nameOf(file) {
  return basename(file).replace(/\.[^.]*$/, "");
}

/** The set that a track belongs to within its file: ids that end in `-in` or `-out` are kept apart. */
export function partOf({ id = "" }) {
  return { in: " in", out: " out" }[String(id).split("-").at(-1)] ?? "";
}

export function isInside([, x, y], [centerX, centerY, width, height]) {
  return Math.abs(x - centerX) <= width / 2 && Math.abs(y - centerY) <= height / 2;
}

function rows(list, name, length, must) {
  if (!Array.isArray(list) || list.length === 0) throw new Error(`${name}: must be a list that is not empty`);
  list.forEach((row, i) => {
    if (Array.isArray(row) && row.length === length && row.every(Number.isFinite)) return;
    throw new Error(`${name}[${i}]: must be ${must} in numbers, got ${JSON.stringify(row)}`);
  });
}
