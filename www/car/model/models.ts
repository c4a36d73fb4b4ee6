/** Every model but the default one. Loaded when the first of them is chosen: they need `whither` with all its methods. */
import { init, pointerScenario, type Arrival, type Method, type Motion, type Scenario } from "whither";
import type { PredictedTarget, WatchOptions } from "whither/dom";
import { PaperPredictor } from "./paper-predictor.ts";
import type { Model } from "./settings.ts";

/** The papers' methods set up for hands: constant velocity, in px and seconds; what the papers leave open, wide. */
const HAND_NOISE = 3000;
const HAND_SPEED = 400;
const END_SPEED = 200;
const TIME_TO_GO: Arrival = { type: "horizon", from: 0.05, to: 0.5 };
const TOTAL_TIME: Arrival = { type: "uniform", from: 0.1, to: 2.5 };

/** These accumulate evidence for each arrival time, so the prior must be one of the total duration. */
const ACCUMULATING: readonly Method[] = ["algorithm1", "algorithm2", "bridging"];

/** The options by which a watcher predicts with a model. */
export async function optionsOf(model: Model): Promise<Pick<WatchOptions, "constants" | "predictor">> {
  await init();
  if (model.method === "pointing") return { constants: constantsOf(model), predictor: undefined };
  const accumulates = ACCUMULATING.includes(model.method);
  return {
    constants: undefined,
    predictor: (targets, { none }) =>
      new PaperPredictor((current) => scenarioOf(current, model, none, accumulates), targets, accumulates),
  };
}

function scenarioOf(targets: readonly PredictedTarget[], model: Model, none: number, accumulates: boolean): Scenario {
  return {
    method: model.method,
    motion: { type: "constantVelocity", dimensions: 2, noise: HAND_NOISE * 2 ** model.noise },
    observation: { noise: 1.5 },
    initial: { velocity: HAND_SPEED },
    arrival: accumulates ? TOTAL_TIME : TIME_TO_GO,
    quadrature: { rule: "simpson", points: model.points },
    // Known up to a factor only, its likelihoods cannot be compared with that of "none of them".
    none: model.method === "singleFilterApproximate" ? 0 : none,
    destinations: targets.map(({ id, x, y, width, height, prior }) => ({
      id,
      center: [x, y],
      size: [width, height],
      endVelocity: END_SPEED,
      prior,
    })),
  };
}

/** The tuned constants, with another noise and other quadrature points. */
function constantsOf({ noise, points }: Model): WatchOptions["constants"] {
  const factor = 2 ** noise;
  const { motion, pointing } = pointerScenario([{ id: "", x: 0, y: 0, width: 1, height: 1 }]);
  return {
    motion: louder(motion, factor),
    pointing: pointing && {
      noise: Array.from(pointing.noise, (scale) => scale * factor),
      timeToGo: { points },
    },
  };
}

function louder(motion: Motion, factor: number): { noise?: number } {
  return motion.type === "constantVelocity" && typeof motion.noise === "number" ? { noise: motion.noise * factor } : {};
}
