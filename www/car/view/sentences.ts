/** The sentences of the page: what is predicted, the one outcome of a press, what was selected. */
import type { Press } from "../press.ts";
import type { Selection, Tally } from "../selecting.ts";
import { percent, seconds } from "../../shared/format.ts";

/** What to do, with a mouse or with a finger, which scrolls where it goes up or down. */
export const INVITATIONS = { fine: "Move towards an icon.", coarse: "Draw a finger sideways, towards an icon." };

/** What the ring shows, in words. */
export function prediction(ringed: string | null): string {
  return ringed === null ? "Not sure yet." : `Heading for ${ringed}.`;
}

/** The outcome of a press, from which the numbers over all presses and the chart are made too. */
export function outcome({ label, verdict, lead, mistaken }: Omit<Press, "index" | "time">, simulated = false): string {
  const who = simulated ? "it" : "you";
  if (verdict === "unsure") return `Lit nothing before ${who} pressed ${label}.`;
  if (lead === 0) return `Lit ${mistaken ?? "another icon"}, and ${who} pressed ${label}.`;
  const lit = `Lit ${label} ${seconds(lead)} before ${who} pressed`;
  return verdict === "wrong" ? `${lit}, after first lighting ${mistaken ?? "another icon"}.` : `${lit}.`;
}

/** Where to go, where the threshold selects. */
export function errand(wanted: string): string {
  return `Go to ${wanted}: it is selected when the ring closes.`;
}

/** What was selected, before it is known what that saved. */
export function selecting(selected: string): string {
  return `Selected ${selected}.`;
}

/** What came of a selection. */
export function selection({ by, saved, measured }: Selection, selected: string, wanted: string): string {
  if (by === "press") return `You pressed ${selected} before any ring had closed.`;
  if (selected !== wanted) return `Selected ${selected}: wrong, it was to be ${wanted}.`;
  if (!measured) return `Selected ${selected}, stopped on the way: ${seconds(saved)} to go, by the model’s expectation.`;
  return saved > 0 ? `Selected ${selected} ${seconds(saved)} before the pointer was there.` : `Selected ${selected} on arrival.`;
}

/** All selections so far. */
export function tally({ selections, wrong, pressed, saved, expected }: Tally): string {
  const of = selections === 1 ? "1 selection" : `${selections} selections`;
  const counted = `${of}, ${wrong} wrong (${percent(wrong / selections)}), ${seconds(saved)} saved in all, ${seconds(saved / selections)} each`;
  const more = [
    pressed > 0 ? `${pressed} pressed by hand` : "",
    expected > 0 ? `${expected} of the times expected by the model, where the hand stopped` : "",
  ].filter((each) => each);
  return `${[counted, ...more].join("; ")}.`;
}
