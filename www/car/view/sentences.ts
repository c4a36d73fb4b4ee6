/** The sentences of the page: one for the prediction, one for the outcome of a press. */
import type { Outcome } from "../movement/outcome.ts";
import { milliseconds } from "./format.ts";

/** What to do, with a mouse or with a finger, which scrolls where it goes up or down. */
export const INVITATIONS = { fine: "Move towards an icon.", coarse: "Draw a finger sideways, towards an icon." };

/** What the ring shows, in status. */
export function prediction(ringed: string | null, leaving: string | null): string {
  if (ringed !== null) return `Heading for ${ringed}.`;
  return leaving === null ? "Not sure yet." : `Leaving ${leaving}.`;
}

/** One press, from the same outcome as the numbers over all presses. */
export function verdict(outcome: Outcome, labels: readonly string[]): string {
  const early = `right ${milliseconds(outcome.lead)} before the press`;
  if (outcome.verdict === "right") return early;
  if (outcome.mistaken === null) return "not sure before the press";
  const expected = labels[outcome.mistaken] ?? "";
  return outcome.lead > 0 ? `wrong at first (${expected}), ${early}` : `wrong, it expected ${expected}`;
}
