/**
 * The movement that the page shows before there is another one: a simulated hand's, predicted at once. Loaded as the watchers
 * load the core, so that the two share it.
 */
import { PointerPredictor } from "whither/pointing";
import { hand } from "whither/testing";
import { DEFAULTS } from "./model/settings.ts";
import type { Box } from "./geometry.ts";
import type { Moment } from "./history.ts";
import type { Press } from "./press.ts";
import type { Posterior } from "./view/probabilities.ts";

export { init } from "whither/pointing";

export interface Example {
  readonly moments: readonly Moment[];
  readonly press: Press;
  /** What was predicted when the icon had become the likeliest. */
  readonly posterior: Posterior;
}

/** As probable as this is the likeliest, surely. */
const LIKELIEST = 0.5;

/** A steady hand. */
const MANNER = { seed: 5, pace: 3, noise: 0.3, rate: 100, resolution: 0, dwell: 0.1 };

/** From one of the boxes to another, which is pressed. */
export function exampleOf(boxes: readonly Box[], labels: readonly string[], from: number, to: number): Example | null {
  const [start, end, label] = [boxes[from], boxes[to], labels[to]];
  if (!start || !end || label === undefined) return null;
  const size = Math.min(end.width, end.height);
  const samples = hand({ x: start.x, y: start.y }, { x: end.x, y: end.y }, { ...MANNER, size });
  const predictor = new PointerPredictor(
    boxes.map((box, index) => ({ id: String(index), ...box })),
    { none: DEFAULTS.none },
  );
  const moments: Moment[] = [];
  let posterior: Posterior | null = null;
  // the last is the press
  for (const [time, x, y] of samples.slice(0, -1)) {
    predictor.observe(time, [x, y]);
    const probabilities = predictor.probabilities();
    moments.push({ time, probabilities });
    if ((probabilities[to] ?? 0) > LIKELIEST)
      posterior ??= { probabilities, none: predictor.none, remaining: predictor.remaining };
  }
  predictor.free();
  if (!posterior) return null;
  const time = samples.at(-1)?.[0] ?? 0;
  const lit = ({ probabilities }: Moment, index: number) => (probabilities[index] ?? 0) >= DEFAULTS.threshold;
  const first = moments.find((moment) => lit(moment, to))?.time;
  const mistaken = labels.find((_, index) => index !== from && index !== to && moments.some((moment) => lit(moment, index)));
  const verdict = mistaken !== undefined ? "wrong" : first !== undefined ? "right" : "unsure";
  const press = { index: to, label, time, verdict, mistaken: mistaken ?? null, lead: time - (first ?? time) } as const;
  return { moments, press, posterior };
}
