/** Every model but the default one. Loaded when the first of them is chosen: they need `whither` with all its methods. */
import { init, pointerScenario, type Arrival, type Method, type Motion, type Scenario } from "whither";
import type { MakePredictor, PredictedTarget, WatchOptions } from "whither/dom";
import { PaperPredictor } from "./paper-predictor.ts";
import type { ArrivalType, Model, MotionType } from "./settings.ts";

/** The motion models set up for hands, in px and seconds, and how the noise of each is scaled by a factor. */
const MOTIONS: Record<MotionType, (factor: number) => Motion> = {
  brownian: (factor) => ({ type: "brownian", dimensions: 2, noise: 400 * factor }),
  constantVelocity: (factor) => ({ type: "constantVelocity", dimensions: 2, noise: 3000 * factor }),
  constantAcceleration: (factor) => ({ type: "constantAcceleration", dimensions: 2, noise: 30_000 * factor }),
  integratedOrnsteinUhlenbeck: (factor) => ({
    type: "integratedOrnsteinUhlenbeck",
    dimensions: 2,
    noise: 3000 * factor,
    damping: 1,
  }),
  meanReverting: (factor) => ({ type: "meanReverting", dimensions: 2, noise: 400 * factor, rate: 2 }),
  equilibriumRevertingVelocity: (factor) => ({
    type: "equilibriumRevertingVelocity",
    dimensions: 2,
    noise: 3000 * factor,
    stiffness: 20,
    damping: 8,
  }),
};

/** Priors of the total duration: wide, and long enough for a slow hand. */
const ARRIVALS: Record<ArrivalType, Arrival> = {
  uniform: { type: "uniform", from: 0.1, to: 4 },
  logNormal: { type: "logNormal", median: 1, spread: 0.6 },
  fitts: { type: "fitts", intercept: 0.2, slope: 0.25, spread: 0.6 },
};

const HAND_SPEED = 400;
const END_SPEED = 200;

/** These filter for each destination from the first sample on, so they begin again where one has moved. */
const ACCUMULATING: readonly Method[] = ["algorithm1", "algorithm2", "bridging"];

/** The options by which a watcher predicts with a model. */
export async function optionsOf(model: Model): Promise<Pick<WatchOptions, "constants" | "predictor">> {
  await init();
  if (model.method === "pointing") return { constants: constantsOf(model), predictor: undefined };
  return { constants: undefined, predictor: predictorOf(model) };
}

/** A method of the papers, as a watcher makes it. */
export function predictorOf(model: Model): MakePredictor {
  const accumulates = ACCUMULATING.includes(model.method);
  return (targets, { none }) => new PaperPredictor((current) => scenarioOf(current, model, none), targets, accumulates);
}

function scenarioOf(targets: readonly PredictedTarget[], model: Model, none: number): Scenario {
  const moves = model.motion !== "brownian" && model.motion !== "meanReverting";
  return {
    method: model.method,
    motion: MOTIONS[model.motion](2 ** model.noise),
    observation: { noise: 1.5 },
    initial: moves ? { velocity: HAND_SPEED } : {},
    arrival: ARRIVALS[model.arrival],
    quadrature: { rule: "simpson", points: model.points },
    // Known up to a factor only, its likelihoods cannot be compared with that of "none of them".
    none: model.method === "singleFilterApproximate" ? 0 : none,
    destinations: targets.map(({ id, x, y, width, height, prior }) => ({
      id,
      center: [x, y],
      size: [width, height],
      ...(moves ? { endVelocity: END_SPEED } : {}),
      prior,
    })),
  };
}

/** The tuned constants, with another noise, other quadrature points and the road's shake. */
function constantsOf({ noise, points, shake }: Model): WatchOptions["constants"] {
  const factor = 2 ** noise;
  const { motion, pointing } = pointerScenario([{ id: "", x: 0, y: 0, width: 1, height: 1 }]);
  return {
    motion: louder(motion, factor),
    pointing: pointing && {
      noise: Array.from(pointing.noise, (scale) => scale * factor),
      timeToGo: { points },
      shake,
    },
  };
}

function louder(motion: Motion, factor: number): { noise?: number } {
  return motion.type === "constantVelocity" && typeof motion.noise === "number" ? { noise: motion.noise * factor } : {};
}
