/** The airliner of Rezaie and Li, section IV, as two sequences: one that knows its destination and one that does not. */
import { ConditionallyMarkovSequence, type Gaussian } from "whither";

export const STEPS = 100;
/** Where a waypoint is passed. */
export const WAYPOINT_STEP = 50;
const STEP_SECONDS = 15;
const STATES = 4;
const FLIGHTS = 50;
/** The deviation of a measured position, in metres. */
const MEASURED = 10;
/** Deviations at the origin and the destination (the paper's) and at a waypoint, in m/s and m. */
const END_SPEED = Math.sqrt(10);
const WAYPOINT_SPREAD = 300;
const WAYPOINT_SPEED = 15;
/** Positions in metres, then velocities in m/s. */
const ORIGIN = [2000, 5000, 70, 0] as const;
const DESTINATION = [130_000, 10_000, 70, 0] as const;

/** Metres east and north. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

/** What can be set. */
export interface Settings {
  /** Spectral density of the process noise, `q`, in m²/s³. */
  readonly noise: number;
  /** Deviations of the positions at origin and destination, in metres. */
  readonly origin: number;
  readonly destination: number;
  /** Of the positions at origin and destination, the same for both axes. */
  readonly correlation: number;
  readonly waypoint: Place | null;
}

export const PAPER: Settings = {
  noise: 0.01,
  origin: Math.sqrt(1000),
  destination: Math.sqrt(1000),
  correlation: 0,
  waypoint: null,
};

/** The places of one flight, step by step. */
export type Flight = readonly Place[];

/** One prediction: the expected places from the last measurement on, their densities every tenth step, and the end. */
export interface Prediction {
  readonly path: Flight;
  readonly densities: readonly Gaussian[];
  readonly end: Gaussian;
}

/** Both sequences for one choice of settings, their flights, and one flight that is followed. */
export class Airliner {
  readonly #directed: ConditionallyMarkovSequence;
  readonly #markov: ConditionallyMarkovSequence;
  readonly directed: readonly Flight[];
  readonly markov: readonly Flight[];
  readonly followed: Flight;
  readonly #noise: Flight;

  /** `seed` chooses the flight that is followed. */
  constructor(settings: Settings, seed: number) {
    this.#directed = sequence(settings, directedEnds(settings));
    this.#markov = sequence(settings, markovEnds(settings));
    this.directed = this.#directed.sample({ seed: 1, count: FLIGHTS }).map(places);
    this.markov = this.#markov.sample({ seed: 2, count: FLIGHTS }).map(places);
    const [flight = new Float64Array()] = this.#directed.sample({ seed, count: 1 });
    this.followed = places(flight);
    this.#noise = noise(seed);
  }

  /** What both make of the followed flight once its first `measured` steps were measured. */
  predict(measured: number): { directed: Prediction; markov: Prediction } {
    const predict = (sequence: ConditionallyMarkovSequence): Prediction => {
      sequence.reset();
      for (let step = 1; step <= measured; step += 1) {
        const truth = at(this.followed, step);
        const error = at(this.#noise, step);
        sequence.measure(step, [truth.x + error.x, truth.y + error.y]);
      }
      const states = Array.from({ length: STEPS + 1 - measured }, (_, i) => sequence.state(measured + i));
      return {
        path: states.map(({ mean }) => ({ x: mean[0] ?? 0, y: mean[1] ?? 0 })),
        densities: states.filter((_, i) => (measured + i) % 10 === 0),
        end: sequence.destination(),
      };
    };
    return { directed: predict(this.#directed), markov: predict(this.#markov) };
  }

  /** Theorem 3.2 for the sequence that knows its destination. */
  kind(): string {
    if (this.#directed.isMarkov()) return "Markov";
    return this.#directed.isReciprocal() ? "reciprocal, not Markov" : "not reciprocal";
  }

  free(): void {
    this.#directed.free();
    this.#markov.free();
  }
}

/** The pinned states' steps, mean and covariance. */
interface Pins {
  readonly pins: readonly number[];
  readonly mean: readonly number[];
  readonly covariance: readonly (readonly number[])[];
}

function sequence(settings: Settings, { pins, mean, covariance }: Pins): ConditionallyMarkovSequence {
  return new ConditionallyMarkovSequence({
    motion: { type: "constantVelocity", dimensions: 2, noise: Math.sqrt(settings.noise) },
    timeStep: STEP_SECONDS,
    steps: STEPS,
    pins,
    pinnedMean: mean,
    pinnedCovariance: covariance,
    observation: { noise: MEASURED },
  });
}

/** Origin and destination as they are set, and between them the waypoint, independent of both. */
function directedEnds({ origin, destination, correlation, waypoint }: Settings): Pins {
  const deviations = [
    [origin, origin, END_SPEED, END_SPEED],
    ...(waypoint ? [[WAYPOINT_SPREAD, WAYPOINT_SPREAD, WAYPOINT_SPEED, WAYPOINT_SPEED]] : []),
    [destination, destination, END_SPEED, END_SPEED],
  ].flat();
  const last = deviations.length - STATES;
  const between = (i: number, j: number) => {
    if (i === j) return 1;
    const corners = Math.min(i, j) < 2 && Math.max(i, j) - Math.min(i, j) === last;
    return corners ? correlation : 0;
  };
  const seconds = STEPS * STEP_SECONDS;
  const velocity = [(DESTINATION[0] - ORIGIN[0]) / seconds, (DESTINATION[1] - ORIGIN[1]) / seconds];
  return {
    pins: waypoint ? [0, WAYPOINT_STEP, STEPS] : [0, STEPS],
    mean: [...ORIGIN, ...(waypoint ? [waypoint.x, waypoint.y, ...velocity] : []), ...DESTINATION],
    covariance: deviations.map((one, i) => deviations.map((other, j) => one * other * between(i, j))),
  };
}

/** The joint density that nearly constant velocity gives origin and destination: `x_N = F x_0 + e`, `e ~ N(0, Q)` over all steps. */
function markovEnds({ noise, origin }: Settings): Pins {
  const h = STEPS * STEP_SECONDS;
  const [position, speed] = [origin ** 2, END_SPEED ** 2];
  // for one axis: position and velocity at the start, at the end
  const axis = [
    [position, 0, position, 0],
    [0, speed, h * speed, speed],
    [position, h * speed, position + h * h * speed + (noise * h ** 3) / 3, h * speed + (noise * h * h) / 2],
    [0, speed, h * speed + (noise * h * h) / 2, speed + noise * h],
  ];
  const entry = (i: number, j: number) => (i % 2 === j % 2 ? (axis[i >> 1]?.[j >> 1] ?? 0) : 0);
  const indices = Array.from({ length: 2 * STATES }, (_, i) => i);
  const [x, y, u, v] = ORIGIN;
  return {
    pins: [0, STEPS],
    mean: [...ORIGIN, x + h * u, y + h * v, u, v],
    covariance: indices.map((i) => indices.map((j) => entry(i, j))),
  };
}

/** Measurement errors: the steps of a sequence at rest. */
function noise(seed: number): Flight {
  const still = new ConditionallyMarkovSequence({
    motion: { type: "brownian", dimensions: 2, noise: 1 },
    timeStep: 1,
    steps: 1,
    pinnedMean: [0, 0, 0, 0],
    pinnedCovariance: [0, 1, 2, 3].map((i) => [0, 1, 2, 3].map((j) => (i === j ? MEASURED ** 2 : 0))),
    observation: { noise: 1 },
  });
  const drawn = still.sample({ seed: seed + 1, count: STEPS + 1 });
  still.free();
  return drawn.map((numbers) => ({ x: numbers[0] ?? 0, y: numbers[1] ?? 0 }));
}

function places(states: Float64Array): Flight {
  const count = states.length / STATES;
  return Array.from({ length: count }, (_, k) => ({ x: states[k * STATES] ?? 0, y: states[k * STATES + 1] ?? 0 }));
}

export function at(flight: Flight, step: number): Place {
  return flight[step] ?? { x: 0, y: 0 };
}
