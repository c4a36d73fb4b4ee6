/** The expected paths and forecasts of one vessel: the costliest of what is drawn, so computed seldom enough while it moves. */
import type { Gaussian } from "whither";
import type { Lookout, Moment, Path } from "./lookout.ts";

/** Of the time, at most one part in so many goes into this. */
const SHARE = 8;

export class Outlook {
  paths: readonly Path[] = [];
  forecasts: readonly Gaussian[] = [];
  #of: Moment | null = null;
  #next = 0;

  /** Brings it up to date, unless it moves and was brought up to date a short while ago; true where it is. */
  look(lookout: Lookout, moving: boolean): boolean {
    const { latest } = lookout;
    if (latest === this.#of) return true;
    const began = performance.now();
    if (moving && began < this.#next) return false;
    this.#of = latest;
    this.paths = lookout.paths();
    this.forecasts = lookout.forecasts();
    const ended = performance.now();
    this.#next = ended + SHARE * (ended - began);
    return true;
  }

  /** Whatever it was of, it is of something else now. */
  forget(): void {
    this.#of = null;
    this.#next = 0;
  }
}
