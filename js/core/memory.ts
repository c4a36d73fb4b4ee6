/**
 * Memory is reserved before a call that allocates: WebAssembly that runs out of it in the middle stops there, and the object
 * that was used is lost.
 *
 * @module
 */
import { WhitherError } from "#error";
import { MOST_VALUES, toBytes } from "./bytes.js";
import { memory, reserve_memory, type Engine } from "./loading/instance.js";

/** What any call may allocate without reserving it, in bytes. */
const SMALL = 2 ** 20;

/** Memory up to this size is available wherever WebAssembly is. */
const ALWAYS = 64 * SMALL;

/**
 * Reserves so many bytes.
 *
 * @throws {@link WhitherError} `too-large`.
 */
export function reserve(bytes: number): void {
  if (memory().byteLength + bytes + SMALL <= ALWAYS || reserve_memory(bytes + SMALL)) return;
  const much = `${Math.ceil(bytes / SMALL)} MB of memory`;
  throw new WhitherError("too-large", "", `this may take ${much}, more than is left: free() what is not needed any more`);
}

/** A view of all memory; where that has grown since, it has no length any more. */
let all: Uint8Array | null = null;
let scarce = false;

/** Whether so much memory is in use that even a small allocation has to be reserved. */
export function isScarce(): boolean {
  if (all === null || all.length === 0) {
    all = new Uint8Array(memory());
    scarce = all.length > ALWAYS / 2;
  }
  return scarce;
}

/**
 * A user's value as bytes, for WebAssembly, with the memory for it reserved.
 *
 * @param value - A user's value.
 * @param name - The beginning of every path in an error; empty for a scenario.
 * @param times - How many copies WebAssembly holds at once.
 */
export function copyIn(value: unknown, name = "", times = 1): Uint8Array {
  return toBytes(value, name, (bytes) => reserve(times * bytes));
}

/** Upper bounds of what a predictor allocates, in bytes. */
export interface Bounds {
  /** For a movement; and once more when its last arrival time passes. */
  readonly movement: number;
  /** For an answer: a state, an arrival time. */
  readonly answer: number;
  /** For a change of its destinations. */
  readonly change: number;
  /** For the list of its ids. */
  readonly ids: number;
  /** For a snapshot. */
  readonly snapshot: number;
}

/** The factors are measured, with every method, motion model and kind of destination; tests/js/short-memory.test.mjs checks them. */
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
