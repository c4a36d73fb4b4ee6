/**
 * The movement that the chart shows before there is another one: a simulated hand's, predicted at once. Loaded as the watchers
 * load the core, so that the two share it.
 */
import { PointerPredictor } from "whither/pointing";
import { DEFAULTS, NONE } from "./belief/settings.ts";
import { reach, seeded, type Box } from "./hand.ts";
import type { Moment } from "./history.ts";
import type { Press } from "./press.ts";

export { init } from "whither/pointing";

/** Samples a second. */
const RATE = 100;

/** Seconds from the arrival to the press. */
const DWELL = 0.1;

/** From one of the boxes to another, which is pressed. */
export function exampleOf(
  boxes: readonly Box[],
  labels: readonly string[],
  from: number,
  to: number,
): { moments: readonly Moment[]; press: Press } | null {
  const [start, end, label] = [boxes[from], boxes[to], labels[to]];
  if (!start || !end || label === undefined) return null;
  const hand = reach(start, end, Math.min(end.width, end.height), seeded(5));
  const predictor = new PointerPredictor(
    boxes.map((box, index) => ({ id: String(index), ...box })),
    { none: NONE },
  );
  const moments = Array.from({ length: Math.floor(hand.duration * RATE) }, (_, step): Moment => {
    const { x, y } = hand.at(step / RATE);
    predictor.observe(step / RATE, [x, y]);
    return { time: step / RATE, probabilities: predictor.probabilities() };
  });
  predictor.free();
  const time = hand.duration + DWELL;
  const lit = ({ probabilities }: Moment, index: number) => (probabilities[index] ?? 0) >= DEFAULTS.threshold;
  const first = moments.find((moment) => lit(moment, to))?.time;
  const mistaken = labels.find((_, index) => index !== from && index !== to && moments.some((moment) => lit(moment, index)));
  const verdict = mistaken !== undefined ? "wrong" : first !== undefined ? "right" : "unsure";
  return { moments, press: { index: to, label, time, verdict, mistaken: mistaken ?? null, lead: time - (first ?? time) } };
}
