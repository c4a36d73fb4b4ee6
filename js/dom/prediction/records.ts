/**
 * What came of the movements that ended in a press, and the numbers over them.
 *
 * @module
 */
import type { Ledger, LedgerSummary, Outcome } from "../ledger.js";
import { idOf, type Target } from "../targets.js";
import type { Press } from "./outcome.js";

const MOST = 1000;
const BINS = 10;

/** The outcomes of a watcher. */
export class Records implements Ledger {
  readonly #outcomes: Outcome[] = [];
  readonly #lines: string[] = [];
  /** Of each bin how often there was a most probable target in it, the sum of its probabilities, and how often it was pressed. */
  readonly #bins = Array.from({ length: BINS }, () => ({ count: 0, sum: 0, pressed: 0 }));
  readonly #choices = new Map<string, number>();

  get outcomes(): readonly Outcome[] {
    return this.#outcomes;
  }

  /** How often a target was pressed, by its id. */
  presses(target: Target): number {
    return this.#choices.get(idOf(target) ?? "") ?? 0;
  }

  add({ target, outcome, leaders, line }: Press): void {
    push(this.#outcomes, outcome);
    if (line) push(this.#lines, line);
    if (outcome.id) this.#choices.set(outcome.id, this.presses(target) + 1);
    for (const leader of leaders) {
      const bin = this.#bins[Math.min(BINS - 1, Math.floor(BINS * leader.probability))];
      if (!bin) continue;
      bin.count++;
      bin.sum += leader.probability;
      if (leader.target === target) bin.pressed++;
    }
  }

  summary(): LedgerSummary | null {
    const presses = this.#outcomes.length;
    if (presses === 0) return null;
    const share = (verdict: Outcome["verdict"]) =>
      this.#outcomes.filter((outcome) => outcome.verdict === verdict).length / presses;
    const count = this.#bins.reduce((total, bin) => total + bin.count, 0);
    const error = this.#bins.reduce((total, { sum, pressed }) => total + Math.abs(sum - pressed), 0);
    const lead = median(this.#outcomes.map((outcome) => outcome.lead));
    const calibration = count > 0 ? error / count : null;
    const bins = this.#bins
      .filter((bin) => bin.count > 0)
      .map((bin) => ({ frames: bin.count, probability: bin.sum / bin.count, pressed: bin.pressed / bin.count }));
    return { presses, right: share("right"), wrong: share("wrong"), lead, calibration, bins };
  }

  toJSON(): unknown {
    const outcomes = this.#outcomes.map(({ id, name, time, pointerType, verdict, lead, probability }) => {
      return { id, name, time, pointerType, verdict, lead, probability };
    });
    return { summary: this.summary(), outcomes };
  }

  lines(): string[] {
    return [...this.#lines];
  }
}

function push<T>(list: T[], item: T): void {
  if (list.push(item) > MOST) list.shift();
}

function median(values: number[]): number {
  const sorted = values.sort((a, b) => a - b);
  const middle = sorted.length / 2;
  return ((sorted[Math.ceil(middle) - 1] ?? 0) + (sorted[Math.floor(middle)] ?? 0)) / 2;
}
