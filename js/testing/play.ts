/**
 * A movement in time: real time, or that of a test's fake timers.
 *
 * @module
 */
import { fields, isAbsent, list, notNegative, number, refuse } from "../core/read.js";
import { WhitherError } from "#error";
import type { Sample } from "./hand.js";

/** What {@link move} and {@link dispatch} have in common. */
export interface PlayOptions {
  /** Presses and releases the button where the movement stops. @defaultValue false */
  readonly press?: boolean | undefined;
  /** Seconds from the press to the release. @defaultValue 0.1, as in Card, Moran and Newell's keystroke-level model (1980) */
  readonly hold?: number | undefined;
  /**
   * Called with milliseconds in place of waiting for them, for fake timers: `vi.advanceTimersByTimeAsync`, `jest.advanceTimersByTimeAsync`,
   * `(ms) => mock.timers.tick(ms)`, or `(ms) => page.clock.runFor(ms)`. They are integers; what is left of one is added to the next.
   * `() => {}` plays everything at once. @defaultValue none: time passes by itself
   */
  readonly advanceTimers?: ((milliseconds: number) => unknown) | undefined;
  /** Stops before the next event; the promise is rejected with the signal's reason. @defaultValue none */
  readonly signal?: AbortSignal | undefined;
}

/** Options with their defaults. */
export interface PlaySettings {
  readonly press: boolean;
  readonly hold: number;
  readonly advanceTimers: PlayOptions["advanceTimers"];
  readonly signal: PlayOptions["signal"];
}

const KEYS = ["press", "hold", "advanceTimers", "signal"];

/** Reads the options of both, and gives with them those of `more` keys as they are. */
export function readPlay(given: unknown, more: readonly string[] = []): [PlaySettings, Readonly<Record<string, unknown>>] {
  const options = isAbsent(given) ? {} : fields(given, "", [...KEYS, ...more], "options");
  const { press = false, hold = 0.1, advanceTimers, signal } = options as PlayOptions;
  if (typeof press !== "boolean") refuse("wrong-type", "press", "must be a boolean", press);
  if (!isAbsent(advanceTimers) && typeof advanceTimers !== "function")
    refuse("wrong-type", "advanceTimers", "must be a function", advanceTimers);
  if (!isAbsent(signal) && typeof (signal as Partial<AbortSignal>).throwIfAborted !== "function")
    refuse("wrong-type", "signal", "must be an AbortSignal", signal);
  return [{ press, hold: notNegative(hold, "hold"), advanceTimers, signal }, options];
}

/** Reads samples, of which there is one at least. */
export function readSamples(given: unknown): readonly Sample[] {
  const samples = Array.from(list(given, "samples"), (each, index): Sample => {
    const path = `samples[${index}]`;
    const sample = list(each, path);
    if (sample.length !== 3) refuse("wrong-length", path, "must be [seconds, x, y]", each);
    return [number(sample[0], `${path}[0]`), number(sample[1], `${path}[1]`), number(sample[2], `${path}[2]`)];
  });
  if (samples.length === 0) throw new WhitherError("wrong-length", "samples", "must have at least one sample, got none");
  samples.forEach(([time], index) => {
    const before = samples[index - 1]?.[0] ?? time;
    if (time < before) refuse("time-not-increasing", `samples[${index}][0]`, `must be at least ${before}`, time);
  });
  return samples;
}

/** The time since a movement began. */
interface Clock {
  /** Seconds. */
  now(): number;
  /** Lets time pass until so many seconds. */
  until(seconds: number): Promise<unknown>;
}

const sleep = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

function realTime(): Clock {
  let seconds = 0;
  let read = performance.now();
  const now = () => {
    const time = performance.now();
    seconds += (time - read) / 1000;
    read = time;
    return seconds;
  };
  return {
    now,
    async until(due) {
      const before = now();
      if (due <= before) return;
      await sleep(Math.ceil(1000 * (due - before)));
      // fake timers may have stopped this clock: what was waited for has passed all the same
      if (now() - before < (due - before) / 2) seconds = due;
    },
  };
}

function fakeTime(advance: (milliseconds: number) => unknown): Clock {
  let seconds = 0;
  let advanced = 0;
  return {
    now: () => seconds,
    async until(due) {
      seconds = Math.max(seconds, due);
      const milliseconds = Math.round(1000 * seconds) - advanced;
      advanced += milliseconds;
      if (milliseconds > 0) await advance(milliseconds);
    },
  };
}

/** Samples that are sent together. */
export interface Beat {
  /** When, in seconds since the first sample. */
  readonly time: number;
  readonly samples: readonly Sample[];
}

/**
 * Calls `send` with the samples of each beat when it is due; those of a late one, after which the next is due already, come with that,
 * as from an operating system that is busy. Returns what waits until a later time.
 */
export async function play(
  beats: readonly Beat[],
  { advanceTimers, signal }: PlaySettings,
  send: (samples: readonly Sample[]) => unknown,
): Promise<(seconds: number) => Promise<void>> {
  const clock = advanceTimers ? fakeTime(advanceTimers) : realTime();
  const wait = async (seconds: number) => {
    signal?.throwIfAborted();
    await clock.until(seconds);
    signal?.throwIfAborted();
  };
  let late: readonly Sample[] = [];
  for (const [index, { time, samples }] of beats.entries()) {
    await wait(time);
    const next = beats[index + 1];
    late = [...late, ...samples];
    if (next && next.time <= clock.now()) continue;
    await send(late);
    late = [];
  }
  return wait;
}
