/** What the visitor can change of the model, and of when the ring closes. */
import type { Arrival, Method, Motion } from "whither";

export const METHODS: readonly { readonly method: Method; readonly label: string }[] = [
  { method: "pointing", label: "Pointing: tuned on recorded hands" },
  { method: "pseudoObservation", label: "Pseudo-observation, closed form" },
  { method: "algorithm1", label: "Algorithm 1, step by step" },
  { method: "algorithm2", label: "Algorithm 2, step by step" },
  { method: "bridging", label: "Bridging distributions" },
  { method: "singleFilter", label: "Bridging with a single filter" },
  { method: "singleFilterApproximate", label: "Single filter, approximate" },
];

export type MotionType = Exclude<Motion["type"], "custom">;

/** The papers' methods take any of these; the pointing model has its own. */
export const MOTIONS: readonly { readonly motion: MotionType; readonly label: string }[] = [
  { motion: "constantVelocity", label: "Constant velocity" },
  { motion: "constantAcceleration", label: "Constant acceleration" },
  { motion: "integratedOrnsteinUhlenbeck", label: "Damped velocity" },
  { motion: "brownian", label: "Brownian" },
  { motion: "meanReverting", label: "Drawn to the icon" },
  { motion: "equilibriumRevertingVelocity", label: "Drawn to the icon, by velocity" },
];

/** Of the total duration, so that every method of the papers takes it, and those that are equal get equal numbers. */
export type ArrivalType = Extract<Arrival["type"], "uniform" | "logNormal" | "fitts">;

export const ARRIVALS: readonly { readonly arrival: ArrivalType; readonly label: string }[] = [
  { arrival: "logNormal", label: "About a second" },
  { arrival: "fitts", label: "By Fitts’s law, distance and size" },
  { arrival: "uniform", label: "Anything up to 4 s" },
];

/** What the model is made of. */
export interface Model {
  readonly method: Method;
  /** Of the papers' methods. */
  readonly motion: MotionType;
  readonly arrival: ArrivalType;
  /** The hand's noise is the default times two to this power. */
  readonly noise: number;
  readonly points: number;
  /** The largest amplitude of a road that the pointing model expects, in px; 0: none. */
  readonly shake: number;
}

export interface Settings extends Model {
  /** The prior probability of "none of them". */
  readonly none: number;
  /** An icon as probable as this is ringed, 50 px before its edge. */
  readonly threshold: number;
}

/** The thresholds that there are recorded figures for. */
export const THRESHOLDS = [0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95] as const;

/** `none` and `threshold` are the defaults of `whither/dom`. */
export const DEFAULTS: Settings = {
  method: "pointing",
  motion: "constantVelocity",
  arrival: "logNormal",
  noise: 0,
  points: 7,
  shake: 0,
  none: 0.2,
  threshold: 0.8,
};

/** Quadrature points that suit a method. */
export function pointsOf(method: Method): number {
  return method === "pointing" ? DEFAULTS.points : 15;
}

export function isSame(one: Model, other: Model): boolean {
  const keys = ["method", "motion", "arrival", "noise", "points", "shake"] as const;
  return keys.every((key) => one[key] === other[key]);
}
