/**
 * Memory is asked for before a call that takes some: WebAssembly that runs out of it in the middle stops where it is, and the
 * object that was used is lost.
 *
 * @module
 */
import { WhitherError } from "#error";
import { reserve_memory, memory, type Engine } from "./loading/instance.js";
import { MOST_VALUES, plainCopy } from "./plain.js";

/** What any call may take without asking, in bytes. */
const SMALL = 2 ** 20;

/** Memory up to here is had wherever there is WebAssembly. */
const ALWAYS = 64 * SMALL;

/**
 * Asks for so many bytes.
 *
 * @throws {@link WhitherError} `too-large`.
 */
export function reserve(bytes: number): void {
  if (memory().byteLength + bytes + SMALL <= ALWAYS || reserve_memory(bytes + SMALL)) return;
  const much = `${Math.ceil(bytes / SMALL)} MB of memory`;
  throw new WhitherError("too-large", "", `this may take ${much}, more than is left: free() what is not needed any more`);
}

/** Whether so much memory is taken that even what is small has to be asked for. */
export function isScarce(): boolean {
  return memory().byteLength > ALWAYS / 2;
}

/**
 * A plain copy of what a user gave, for WebAssembly, which has the memory for it.
 *
 * @param value - What a user gave.
 * @param name - What every path in an error begins with; nothing for a scenario.
 * @param times - How often all of it is there at once.
 */
export function copyIn(value: unknown, name = "", times = 1): unknown {
  return plainCopy(value, name, (bytes) => reserve(times * bytes));
}

/** Bounds of what a predictor takes, in bytes. */
export interface Bounds {
  /** A movement; and once more when its last arrival time passes. */
  readonly movement: number;
  /** An answer: a state, an arrival time. */
  readonly answer: number;
  /** A change of its destinations. */
  readonly change: number;
  /** The list of its ids. */
  readonly ids: number;
  /** A snapshot. */
  readonly snapshot: number;
}

/** The factors were measured with every method, motion model and kind of destination; tests/js/room.test.mjs holds them. */
export function bounds(engine: Engine): Bounds {
  const [count = 0, text = 0, pairs = 0, nodes = 0, kept = 0, saved = 0] = engine.sizes();
  const movement = 4096 + 24 * kept + 128 * nodes + 256 * count;
  const answer = movement + 72 * pairs + 64 * nodes + 512 * count;
  const ids = 64 * count + text;
  const values = 12 * count + saved;
  // what could not be restored is not written
  const snapshot = values > MOST_VALUES ? Infinity : answer + 64 * values + 24 * ids;
  return { movement, answer, change: 2 * movement + 768 * count, ids, snapshot };
}
