/**
 * A clock that moves only when a test advances it, with the timers and animation frames of a browser.
 *
 * @module
 */
import type { Stop } from "../platform.js";

/** Animation frames a second. */
const FRAMES = 60;

interface Task {
  /** When it is due, in milliseconds. */
  readonly time: number;
  readonly run: () => void;
}

export class Clock {
  #now = 0;
  /** In the order in which they were asked for. */
  readonly #tasks = new Set<Task>();

  /** Milliseconds since the clock was made. */
  get now(): number {
    return this.#now;
  }

  /** How many timers and frames are asked for. */
  get pending(): number {
    return this.#tasks.size;
  }

  /** Calls back after so many milliseconds. */
  wait(milliseconds: number, run: () => void): Stop {
    return this.#add(this.#now + milliseconds, run);
  }

  /** Calls back at the next animation frame: these are at the multiples of 1/60 s. */
  frame(run: () => void): Stop {
    const frame = Math.floor((this.#now * FRAMES) / 1000 + 1e-9) + 1;
    return this.#add((1000 * frame) / FRAMES, run);
  }

  /** Lets time pass, and calls back whatever becomes due: the earliest first, at one time in the order of asking. */
  advance(milliseconds: number): void {
    this.advanceTo(this.#now + milliseconds);
  }

  /** As {@link advance}, until a time; an earlier one than now is now. */
  advanceTo(time: number): void {
    for (let task = this.#next(time); task; task = this.#next(time)) {
      this.#tasks.delete(task);
      this.#now = Math.max(this.#now, task.time);
      task.run();
    }
    this.#now = Math.max(this.#now, time);
  }

  #next(until: number): Task | null {
    let next: Task | null = null;
    for (const task of this.#tasks) if (task.time <= until && (!next || task.time < next.time)) next = task;
    return next;
  }

  #add(time: number, run: () => void): Stop {
    const task = { time, run };
    this.#tasks.add(task);
    return () => this.#tasks.delete(task);
  }
}
