/** The numbers over all presses so far, the wrong ones included. */
import type { Outcome } from "./history.ts";

export interface Summary {
  readonly presses: number;
  /** Seconds. */
  readonly medianLead: number;
  /** Shares of all presses: those for which the first early selection was the pressed one, and was not. */
  readonly earlyRight: number;
  readonly earlyWrong: number;
}

export class Tally {
  readonly #outcomes: Outcome[] = [];

  add(outcome: Outcome): void {
    this.#outcomes.push(outcome);
  }

  /** Null before the first press. */
  summary(): Summary | null {
    const presses = this.#outcomes.length;
    if (presses === 0) return null;
    const early = this.#outcomes.filter((outcome) => outcome.early !== null);
    const right = early.filter((outcome) => outcome.early === outcome.chosen).length;
    return {
      presses,
      medianLead: median(this.#outcomes.map((outcome) => outcome.lead)),
      earlyRight: right / presses,
      earlyWrong: (early.length - right) / presses,
    };
  }
}

function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  const middle = sorted.length / 2;
  const lower = sorted[Math.ceil(middle) - 1] ?? 0;
  const upper = sorted[Math.floor(middle)] ?? 0;
  return (lower + upper) / 2;
}
