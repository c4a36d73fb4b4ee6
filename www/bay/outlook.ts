/** The expected paths and forecasts of one vessel: the costliest of what is drawn, so computed a part a frame, and seldom enough. */
import type { Gaussian } from "whither";
import type { Lookout, Moment, Path } from "./lookout.ts";

/** Of the time while it moves, at most one part in so many goes into this. */
const SHARE = 8;

export class Outlook {
  paths: readonly Path[] = [];
  forecasts: readonly Gaussian[] = [];
  #of: Moment | null = null;
  #parts: Iterator<void> | null = null;
  #spent = 0;
  #next = 0;

  /** Brings it up to date, a part in each call; while the vessel moves, not at once again. True where it is up to date. */
  look(lookout: Lookout, moving: boolean): boolean {
    const { latest } = lookout;
    const began = performance.now();
    if (!this.#parts) {
      if (latest === this.#of) return true;
      if (moving && began < this.#next) return false;
      this.#spent = 0;
      this.#parts = this.#compute(lookout);
    }
    const { done } = this.#parts.next();
    const now = performance.now();
    this.#spent += now - began;
    if (!done) return false;
    this.#parts = null;
    this.#next = now + SHARE * this.#spent;
    return this.#of === latest;
  }

  /** Whatever it was of, it is of something else now. */
  forget(): void {
    this.paths = [];
    this.forecasts = [];
    this.#of = null;
    this.#parts = null;
    this.#next = 0;
  }

  /** What is shown is replaced once all parts are there. */
  *#compute(lookout: Lookout): Generator<void, void, void> {
    const of = lookout.latest;
    const paths: Path[] = [];
    for (const harbour of lookout.likely()) {
      const path = lookout.path(harbour);
      if (path) paths.push(path);
      yield;
    }
    this.forecasts = lookout.forecasts();
    this.paths = paths;
    this.#of = of;
  }
}
