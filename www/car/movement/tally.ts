/** The numbers over all presses so far, the wrong ones included. */
import type { Outcome } from "./outcome.ts";

export interface Summary {
  readonly presses: number;
  /** Seconds, over all presses. */
  readonly medianLead: number;
  /** Shares of all presses. */
  readonly right: number;
  readonly wrong: number;
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
    const share = (verdict: Outcome["verdict"]) =>
      this.#outcomes.filter((outcome) => outcome.verdict === verdict).length / presses;
    return {
      presses,
      medianLead: median(this.#outcomes.map((outcome) => outcome.lead)),
      right: share("right"),
      wrong: share("wrong"),
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
