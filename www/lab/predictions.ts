/** What each method predicts along a movement. The papers' methods and the pointing model are the package's own. */
import { pointerScenario, Predictor, type Arrival, type Method as Papers, type Scenario } from "whither";
import { foresight } from "./foresight.ts";
import type { Prediction } from "./metrics.ts";
import type { MethodId } from "./methods.ts";
import type { Movement } from "./movement.ts";
import { expected, extrapolation, named, nearest, type Extrapolation } from "./peers.ts";

/** The papers' methods as `npm run evaluate` sets them up for a pointer: constant velocity, in px and seconds. */
const HAND = {
  motion: { type: "constantVelocity", dimensions: 2, noise: 3000 },
  observation: { noise: 1.5 },
  initial: { velocity: 200 },
} as const;
const END_SPEED = 200;
const TIME_TO_GO: Arrival = { type: "horizon", from: 0.05, to: 0.5 };
/** For those that accumulate evidence for each arrival time, so that it has to be one of the total duration. */
const TOTAL_TIME: Arrival = { type: "uniform", from: 0.1, to: 2.5 };
const ACCUMULATING: readonly Papers[] = ["algorithm1", "algorithm2", "bridging"];

/** Constants in place of those of `pointerScenario`, as `fit` gives them. */
export type Constants = Partial<Omit<Scenario, "destinations">>;

/** The most probable target after each of the first samples, with the probabilities where a method has them; null where it cannot be applied. */
export function predict(id: MethodId, movement: Movement, length: number, best: Extrapolation): Prediction[] | null {
  switch (id) {
    case "nearest":
      return named(nearest(movement, length));
    case "extrapolation":
      return named(extrapolation(movement, length, best));
    case "foresight":
      return named(foresight(movement, length));
    case "predicted":
      return named(expected(movement, length));
    case "pointing":
      return byPointing(movement, length);
    default:
      return run(papers(id, movement), movement, length);
  }
}

/** The pointing model, with other constants too. */
export function byPointing(movement: Movement, length: number, constants: Constants = {}): Prediction[] {
  const targets = movement.targets.map(([x, y, width, height], i) => ({ id: String(i), x, y, width, height }));
  return run({ ...pointerScenario(targets), ...constants }, movement, length);
}

function papers(method: Papers, { targets }: Movement): Scenario {
  return {
    ...HAND,
    method,
    arrival: ACCUMULATING.includes(method) ? TOTAL_TIME : TIME_TO_GO,
    destinations: targets.map(([x, y, width, height], i) => ({
      id: String(i),
      center: [x, y],
      size: [width, height],
      endVelocity: END_SPEED,
    })),
  };
}

function run(scenario: Scenario, { samples }: Movement, length: number): Prediction[] {
  const predictor = new Predictor(scenario);
  try {
    return samples.slice(0, length).map(([time, x, y]) => {
      predictor.observe(time, [x, y]);
      return { top: predictor.best?.index ?? null, probabilities: predictor.probabilities() };
    });
  } finally {
    predictor.free();
  }
}
