/** What the visitor can change, and the scenario that follows from it. */
import { pointerScenario, type Arrival, type Method, type Motion, type PointerTarget, type Scenario } from "whither";

export const METHODS: readonly { readonly method: Method; readonly label: string }[] = [
  { method: "pointing", label: "Pointing: tuned on recorded hands" },
  { method: "pseudoObservation", label: "Pseudo-observation, closed form" },
  { method: "algorithm1", label: "Algorithm 1, step by step" },
  { method: "algorithm2", label: "Algorithm 2, step by step" },
  { method: "bridging", label: "Bridging distributions" },
  { method: "singleFilter", label: "Bridging with a single filter" },
  { method: "singleFilterApproximate", label: "Single filter, approximate" },
];

export interface Settings {
  readonly method: Method;
  /** The hand's noise is the default times two to this power. */
  readonly noise: number;
  readonly points: number;
  /** An icon as probable as this is ringed. */
  readonly threshold: number;
}

export const DEFAULTS: Settings = { method: "pointing", noise: 0, points: 7, threshold: 0.8 };

/** Quadrature points that suit a method. */
export function pointsOf(method: Method): number {
  return method === "pointing" ? DEFAULTS.points : 15;
}

/** The probability of "none of them" before any observation: about that of one icon more. */
const NONE = 0.05;

/** The papers' methods set up for hands: constant velocity, in px and seconds; what the papers leave open, wide. */
const HAND_NOISE = 3000;
const HAND_SPEED = 400;
const END_SPEED = 200;
const TIME_TO_GO: Arrival = { type: "horizon", from: 0.05, to: 0.5 };
const WHOLE_TIME: Arrival = { type: "uniform", from: 0.1, to: 2.5 };

/** These accumulate evidence for each arrival time, so the prior must be one of the total duration. */
export const ACCUMULATING: readonly Method[] = ["algorithm1", "algorithm2", "bridging"];

export function scenarioOf(targets: readonly PointerTarget[], settings: Settings): Scenario {
  const factor = 2 ** settings.noise;
  if (settings.method === "pointing") return pointing(targets, settings.points, factor);
  return {
    method: settings.method,
    motion: { type: "constantVelocity", dimensions: 2, noise: HAND_NOISE * factor },
    observation: { noise: 1.5 },
    initial: { velocity: HAND_SPEED },
    arrival: ACCUMULATING.includes(settings.method) ? WHOLE_TIME : TIME_TO_GO,
    quadrature: { rule: "simpson", points: settings.points },
    // Known up to a factor only, its likelihoods cannot be compared with that of "none of them".
    none: settings.method === "singleFilterApproximate" ? 0 : NONE,
    destinations: targets.map(({ id, x, y, width, height }) => ({
      id,
      center: [x, y],
      size: [width, height],
      endVelocity: END_SPEED,
    })),
  };
}

function pointing(targets: readonly PointerTarget[], points: number, factor: number): Scenario {
  const scenario = pointerScenario(targets, { none: NONE });
  return {
    ...scenario,
    motion: louder(scenario.motion, factor),
    pointing: scenario.pointing && {
      ...scenario.pointing,
      noise: Array.from(scenario.pointing.noise, (noise) => noise * factor),
      timeToGo: { ...scenario.pointing.timeToGo, points },
    },
  };
}

function louder(motion: Motion, factor: number): Motion {
  return motion.type === "constantVelocity" && typeof motion.noise === "number"
    ? { ...motion, noise: motion.noise * factor }
    : motion;
}
