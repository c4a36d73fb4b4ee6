/** How the movement before a press was predicted: the sentence and the numbers over all presses are both made from this. */
import type { Intent } from "./intent.ts";

export interface Outcome {
  readonly chosen: number;
  /** Seconds on the samples' clock. */
  readonly pressed: number;
  /** Right: the chosen icon was ringed and no other one. Wrong: another one was. Unsure: none was. */
  readonly verdict: "right" | "wrong" | "unsure";
  /** The first other icon that was ringed; null where the verdict is not "wrong". */
  readonly mistaken: number | null;
  /** Seconds from the ring that closed around the chosen icon, after the last one around another, to the press; 0 without one. */
  readonly lead: number;
}

/** Judges the rings that closed before a press on `chosen`: one that closes at the press comes too late. */
export function judge(intents: readonly Intent[], chosen: number, pressed: number): Outcome {
  let mistaken: number | null = null;
  let since: number | null = null;
  for (const { target, time } of intents) {
    if (time >= pressed) break;
    if (target === chosen) since ??= time;
    else {
      mistaken ??= target;
      since = null;
    }
  }
  const verdict = mistaken !== null ? "wrong" : since !== null ? "right" : "unsure";
  return { chosen, pressed, verdict, mistaken, lead: since === null ? 0 : pressed - since };
}
