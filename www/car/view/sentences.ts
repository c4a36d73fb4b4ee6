/** The sentences of the page: one for the prediction, one for the outcome of a press. */
import type { Press } from "../press.ts";
import { milliseconds } from "./format.ts";

/** What to do, with a mouse or with a finger, which scrolls where it goes up or down. */
export const INVITATIONS = { fine: "Move towards an icon.", coarse: "Draw a finger sideways, towards an icon." };

/** What the ring shows, in words. */
export function prediction(ringed: string | null): string {
  return ringed === null ? "Not sure yet." : `Heading for ${ringed}.`;
}

/** One press, from the same outcome as the numbers over all presses. */
export function sentence({ verdict, lead, mistaken }: Omit<Press, "index" | "label" | "time">): string {
  const early = `right ${milliseconds(lead)} before the press`;
  if (verdict === "right") return early;
  if (mistaken === null) return "not sure before the press";
  return lead > 0 ? `wrong at first (${mistaken}), ${early}` : `wrong, it expected ${mistaken}`;
}
