/** What the visitor can change. */
import type { Method } from "whither";

export const METHODS: readonly { readonly method: Method; readonly label: string }[] = [
  { method: "pointing", label: "Pointing: tuned on recorded hands" },
  { method: "pseudoObservation", label: "Pseudo-observation, closed form" },
  { method: "algorithm1", label: "Algorithm 1, step by step" },
  { method: "algorithm2", label: "Algorithm 2, step by step" },
  { method: "bridging", label: "Bridging distributions" },
  { method: "singleFilter", label: "Bridging with a single filter" },
  { method: "singleFilterApproximate", label: "Single filter, approximate" },
];

/** What the model is made of. */
export interface Model {
  readonly method: Method;
  /** The hand's noise is the default times two to this power. */
  readonly noise: number;
  readonly points: number;
}

/** The prior probability of "none of them": about that of one icon more. */
export const NONE = 0.05;

export interface Settings extends Model {
  /** An icon as probable as this is ringed, 50 px before its edge. */
  readonly threshold: number;
}

export const DEFAULTS: Settings = { method: "pointing", noise: 0, points: 7, threshold: 0.8 };

/** Quadrature points that suit a method. */
export function pointsOf(method: Method): number {
  return method === "pointing" ? DEFAULTS.points : 15;
}

export function isSame(one: Model, other: Model): boolean {
  return one.method === other.method && one.noise === other.noise && one.points === other.points;
}
