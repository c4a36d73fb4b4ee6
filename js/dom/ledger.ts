/**
 * What came of the movements that ended in a press. Kept in memory alone; only the page's own code can give it away. There is
 * nothing to record before the part that predicts is loaded, so the records are there.
 *
 * @module
 */
import type { Learnt } from "../core/learnt.js";
import type { WatchTarget } from "./types.js";

/** How a press was predicted. */
export interface Outcome<T extends WatchTarget = WatchTarget> {
  /** What was pressed. */
  readonly target: T;
  readonly id: string | undefined;
  readonly name: string | undefined;
  readonly data: unknown;
  /** When, in milliseconds on the clock of `performance.now()`. */
  readonly time: number;
  readonly pointerType: string;
  /** Right: the target was intended before the press, and no other one in this movement. Wrong: another one was. Unsure: none was. */
  readonly verdict: "right" | "wrong" | "unsure";
  /** The first other target that was intended; null where the verdict is not "wrong", and where it is no longer watched. */
  readonly mistaken: T | null;
  /** Seconds from the intent of the target, after the last one of another, to the press; 0 without one. */
  readonly lead: number;
  /** Its posterior probability before the press. */
  readonly probability: number;
  /** What is known of the user after it, for the option of that name on the next visit; null without `learning`. */
  readonly learnt: Learnt | null;
}

/** A tenth of the probabilities that the most probable target had, a frame of a movement each. */
export interface CalibrationBin {
  /** In how many frames it was in this tenth. */
  readonly frames: number;
  /** The mean of its probabilities. */
  readonly probability: number;
  /** The share of the frames in which it was the one that was pressed then. */
  readonly pressed: number;
}

/** The numbers over all presses of a ledger. */
export interface LedgerSummary {
  readonly presses: number;
  /** Shares of all presses. */
  readonly right: number;
  readonly wrong: number;
  /** The median lead, in seconds. */
  readonly lead: number;
  /** Expected calibration error of the most probable target's probability, over ten bins; null before there is one. */
  readonly calibration: number | null;
  /** The calibration by tenths of the probability, those that have frames, the lowest first. */
  readonly bins: readonly CalibrationBin[];
}

/** The outcomes of a watcher. */
export interface Ledger<T extends WatchTarget = WatchTarget> {
  /** The last thousand, oldest first. */
  readonly outcomes: readonly Outcome<T>[];
  /** The numbers over these, and the calibration over all; null before the first press. */
  summary(): LedgerSummary | null;
  /** Plain data: the summary, and the outcomes without their elements. */
  toJSON(): unknown;
  /** With `record`, the movements of the last thousand presses as lines of JSON that `npm run evaluate` and `fit` of `whither/study` read. */
  lines(): string[];
}

/** A ledger of records that there are later. */
export function ledgerOf(records: () => Ledger | undefined): Ledger {
  return {
    get outcomes() {
      return records()?.outcomes ?? [];
    },
    summary: () => records()?.summary() ?? null,
    toJSON: () => records()?.toJSON() ?? { summary: null, outcomes: [] },
    lines: () => records()?.lines() ?? [],
  };
}
