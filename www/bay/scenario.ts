/** What the predictor knows of vessels and harbours. */
import type { Method, Scenario } from "whither";
import { HARBOURS } from "./coast.ts";

/** What can be set. */
export interface Settings {
  readonly method: Method;
  readonly arrival: "uniform" | "horizon";
  /** How freely a vessel changes its velocity, in m/s^1.5. */
  readonly noise: number;
  /** The prior weight of "none of them" against the harbours' 1 together. */
  readonly none: number;
}

export const DEFAULT: Settings = { method: "pseudoObservation", arrival: "uniform", noise: 0.05, none: 0.1 };

/** The methods of the papers; those with the same `model` are ways to compute the same numbers. */
export const METHODS: readonly { readonly method: Method; readonly name: string; readonly accumulates: boolean }[] = [
  { method: "pseudoObservation", name: "Pseudo-observation, closed form (default)", accumulates: false },
  { method: "algorithm1", name: "Liang et al., Algorithm 1", accumulates: true },
  { method: "algorithm2", name: "Liang et al., Algorithm 2", accumulates: true },
  { method: "bridging", name: "Bridging, a filter for each arrival", accumulates: true },
  { method: "singleFilter", name: "Bridging, one filter (Ardeshiri et al.)", accumulates: false },
];

/** The deviation of a reported position, in metres, and about the speed of a vessel, in m/s. */
export const REPORTED = 10;
export const SPEED = 6;
/** A harbour's basin, in metres, and the deviation of the speed on entering it, in m/s. */
export const BASIN_SIZE = 1000;
export const ENTRY_SPEED = 5;
/** Up to four hours from the first report, or up to two hours from every report, in seconds; one arrival time every two minutes. */
const ARRIVAL = { uniform: { from: 1200, to: 14_400 }, horizon: { from: 120, to: 7320 } } as const;
const APART = 120;

export function scenario(settings: Settings): Scenario {
  const { from, to } = ARRIVAL[settings.arrival];
  return {
    motion: { type: "constantVelocity", dimensions: 2, noise: settings.noise },
    observation: { noise: REPORTED },
    initial: { velocity: SPEED },
    arrival: { type: settings.arrival, from, to },
    // all nodes have the same weight, so that their probabilities are a density that can be drawn
    quadrature: { rule: "trapezoid", points: (to - from) / APART + 1 },
    method: settings.method,
    none: settings.none,
    destinations: HARBOURS.map(({ id, x, y }) => ({
      id,
      center: [x, y],
      size: BASIN_SIZE,
      endVelocity: ENTRY_SPEED,
    })),
  };
}
