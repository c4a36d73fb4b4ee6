/** A list of numbers: an array or a typed array. */
export type Vector = readonly number[] | Float64Array | Float32Array;

/** A matrix as a list of rows. */
export type Matrix = readonly Vector[];

/**
 * Everything that a predictor is built from. `d` is the number of spatial dimensions, `s` the number of states of the motion
 * model. Any key that is not listed here is an error that names it.
 *
 * @example
 * ```ts
 * const scenario: Scenario = {
 *   motion: { type: "constantVelocity", dimensions: 2, noise: 3000 },
 *   observation: { noise: 1.5 },
 *   initial: { velocity: 1000 },
 *   arrival: { type: "horizon", from: 0.05, to: 0.5 },
 *   quadrature: { rule: "simpson", points: 15 },
 *   method: "pseudoObservation",
 *   destinations: [
 *     { id: "radio", mean: [100, 80], covariance: [[400, 0], [0, 400]], prior: 2 },
 *     { id: "map", center: [600, 300], size: [90, 60], endVelocity: 200 },
 *   ],
 * };
 * ```
 */
export interface Scenario {
  /** How the object moves between observations. */
  readonly motion: Motion;
  /** How it is observed. */
  readonly observation: Observation;
  /** The density of its state before the first observation. */
  readonly initial?: Initial | undefined;
  /** When it arrives: needed by every method but `pointing`, which does not take it. */
  readonly arrival?: Arrival | undefined;
  /** How the arrival time is summed over. @defaultValue Simpson's rule with 15 points */
  readonly quadrature?: Quadrature | undefined;
  /** Which predictor. @defaultValue `"pseudoObservation"` */
  readonly method?: Method | undefined;
  /** The prior probability that it goes to none of the destinations, from 0 to less than 1. @defaultValue 0 */
  readonly none?: number | undefined;
  /** The constants of the method `pointing`, and only for it. {@link pointerScenario} fills them in. */
  readonly pointing?: Pointing | undefined;
  /** How is learnt from `predictor.chosen(id)`. @defaultValue nothing is learnt */
  readonly learning?: Learning | undefined;
  /** Where it may be going: 1 to 1 000 000 of them. */
  readonly destinations: readonly Destination[];
}

/**
 * What is learnt from what is chosen: priors, by counts with a Dirichlet prior; and with the method `pointing` how far the model holds
 * for the user ({@link Learnt}), which alone remains where `strength` is as large as 1e50.
 */
export interface Learning {
  /** How many choices the scenario's own priors are worth. */
  readonly strength: number;
  /** The share of every count that is lost at each choice, from 0 to less than 1. @defaultValue 0 */
  readonly forgetting?: number | undefined;
  /**
   * How many choices the habit at large is worth against the habit after the last choice.
   *
   * @defaultValue the last choice is ignored
   */
  readonly afterLast?: number | undefined;
}

/**
 * Which predictor.
 *
 * | method | what it is |
 * |---|---|
 * | `pseudoObservation` | the same numbers as `algorithm1` and `algorithm2`, at the cost of one filter and a density for each destination and arrival time |
 * | `algorithm1`, `algorithm2` | Liang's algorithms, step by step |
 * | `bridging` | the original bridging distributions: a filter for each destination and arrival time |
 * | `singleFilter` | Ardeshiri's exact form of `bridging` with one filter |
 * | `singleFilterApproximate` | Ardeshiri's Table 1: its denominator is taken as constant |
 * | `pointing` | the model of recorded hands that {@link pointerScenario} uses |
 */
export type Method =
  | "pseudoObservation"
  | "algorithm1"
  | "algorithm2"
  | "bridging"
  | "singleFilter"
  | "singleFilterApproximate"
  | "pointing";

/**
 * The square root of the spectral density of what drives the motion: one number, or one for each axis; or candidates of these,
 * over which predictions are averaged by evidence.
 */
export type MotionNoise =
  | number
  | Vector
  | {
      /** Up to 64 noises, each one number or one for each axis. */
      readonly candidates: readonly (number | Vector)[];
      /** The prior weight of each. @defaultValue all the same */
      readonly weights?: Vector | undefined;
    };

/** What the motion models have in common. */
export interface MotionBase {
  /** Spatial dimensions `d`. */
  readonly dimensions: 1 | 2 | 3;
  /** What drives the motion; for constant velocity with pixels and seconds in px/s^1.5. */
  readonly noise: MotionNoise;
}

/** Position is a random walk: `s = d`. */
export interface Brownian extends MotionBase {
  readonly type: "brownian";
}

/** Velocity is a random walk: `s = 2d`. */
export interface ConstantVelocity extends MotionBase {
  readonly type: "constantVelocity";
  /** For the method `pointing` alone: noise that grows with the speed. @defaultValue 0 */
  readonly speedNoise?: number | undefined;
}

/** Acceleration is a random walk: `s = 3d`. */
export interface ConstantAcceleration extends MotionBase {
  readonly type: "constantAcceleration";
}

/** Velocity reverts to `drift`: `s = 2d`. */
export interface IntegratedOrnsteinUhlenbeck extends MotionBase {
  readonly type: "integratedOrnsteinUhlenbeck";
  /** The rate at which it does, in 1/s: one number, or one for each axis. */
  readonly damping: number | Vector;
  /** The velocity to which it reverts: one number for each axis. @defaultValue 0 */
  readonly drift?: number | Vector | undefined;
}

/** Position reverts to the destination: `s = d`. */
export interface MeanReverting extends MotionBase {
  readonly type: "meanReverting";
  /** The rate at which it does, in 1/s: one number, or one for each axis. */
  readonly rate: number | Vector;
}

/** `dv = (stiffness (c - x) - damping v) dt + dw` with `c` the destination's centre: `s = 2d`. */
export interface EquilibriumRevertingVelocity extends MotionBase {
  readonly type: "equilibriumRevertingVelocity";
  /** In 1/s^2: one number, or one for each axis. */
  readonly stiffness: number | Vector;
  /** In 1/s: one number, or one for each axis. */
  readonly damping: number | Vector;
}

/** Any linear motion `dx = (A x + b + B c) dt + dw`, `E[dw dw'] = W dt`, with `c` the destination's centre. */
export interface CustomMotion {
  readonly type: "custom";
  /** Spatial dimensions `d`: the first `d` states are the position. */
  readonly dimensions: 1 | 2 | 3;
  /** `A`, `s` by `s`. */
  readonly drift: Matrix;
  /**
   * `W`, `s` by `s`, symmetric positive semidefinite. With `bridging` and `singleFilter` it must lead to each component of
   * the endpoint; the other methods do without.
   */
  readonly diffusion: Matrix;
  /** `b`, `s` numbers. @defaultValue 0 */
  readonly offset?: Vector | undefined;
  /** `B`, `s` by `d`. @defaultValue 0 */
  readonly destinationGain?: Matrix | undefined;
}

/** How the object moves between observations. */
export type Motion =
  | Brownian
  | ConstantVelocity
  | ConstantAcceleration
  | IntegratedOrnsteinUhlenbeck
  | MeanReverting
  | EquilibriumRevertingVelocity
  | CustomMotion;

/** How the object is observed: `y = G x + v`, `v ~ N(0, V)`. */
export interface Observation {
  /** The noise `v`: a standard deviation, one for each observed axis, or the covariance matrix `V`. */
  readonly noise: number | Vector | Matrix;
  /** `G`, one row of `s` numbers for each observed axis. @defaultValue the position */
  readonly matrix?: Matrix | undefined;
}

/**
 * The density of the state at the first observation, before correction by that observation: any Gaussian, or flat in position with
 * a zero-mean velocity and acceleration.
 */
export type Initial =
  | {
      /** `s` numbers. */
      readonly mean: Vector;
      /** `s` by `s`. */
      readonly covariance: Matrix;
      /**
       * Whether the first observation counts as evidence, `p(y_1 | D_i, T)` in Liang (5): the likelihoods are then those of `y_1:k`, and
       * a start near a destination is evidence for it, from the first observation on. With `bridging` and `singleFilter`, whose endpoint
       * is independent of the start, it is evidence for none. By default the likelihoods are those of `y_2:k` given `y_1`: where a
       * movement begins is mostly chance, and a density that is flat in position gives no evidence.
       *
       * @defaultValue false
       */
      readonly evidence?: boolean | undefined;
    }
  | {
      /** The deviation of the velocity, one number or one for each axis. */
      readonly velocity?: number | Vector | undefined;
      /** The deviation of the acceleration, one number or one for each axis. */
      readonly acceleration?: number | Vector | undefined;
    };

/**
 * The prior of the arrival time `T`, in seconds: of `T - t_1`, the time from the first observation; or, with `horizon`, of
 * `T - t_k`, the time to go, at every observation (not for the methods that accumulate evidence: `algorithm1`, `algorithm2`,
 * `bridging`).
 */
export type Arrival =
  | {
      readonly type: "uniform" | "horizon";
      /** The earliest; greater than 0. */
      readonly from: number;
      /** The latest; greater than `from`. */
      readonly to: number;
    }
  | {
      readonly type: "discrete";
      /** Up to 1001 times, each greater than 0. */
      readonly times: Vector;
      /** The weight of each; equal ones by default. They need not sum to one. */
      readonly weights?: Vector;
    }
  | {
      readonly type: "logNormal";
      /** The median. */
      readonly median: number;
      /** The deviation of the logarithm. */
      readonly spread: number;
    }
  | {
      /** Log-normal about Fitts's law, `intercept + slope log2(distance / size + 1)`. */
      readonly type: "fitts";
      readonly intercept: number;
      readonly slope: number;
      /** The deviation of the logarithm. */
      readonly spread: number;
    };

/** How the arrival time is summed over. */
export interface Quadrature {
  /** The rule. @defaultValue `"simpson"` */
  readonly rule?: "simpson" | "trapezoid" | "gaussLegendre" | "monteCarlo" | undefined;
  /** The number of nodes, up to 1001; odd for `simpson`. @defaultValue 15 */
  readonly points?: number | undefined;
  /** For `monteCarlo`: the seed of its random numbers. */
  readonly seed?: number | undefined;
}

/** What the two forms of a destination have in common. */
export interface DestinationBase {
  /** Its name; no two are the same. */
  readonly id: string;
  /** Its weight before any observation; only the ratios matter. @defaultValue 1 */
  readonly prior?: number | undefined;
  /** An arrival prior of its own instead of the scenario's. */
  readonly arrival?: Arrival | undefined;
}

/** A destination as a Gaussian density of the endpoint. */
export interface GaussianDestination extends DestinationBase {
  /** The first `d` to `s` components of the state on arrival. */
  readonly mean: Vector;
  /** Their covariance. */
  readonly covariance: Matrix;
}

/** A destination as a box. */
export interface BoxDestination extends DestinationBase {
  /** Its centre, `d` numbers. */
  readonly center: Vector;
  /** Its sides, one number or one for each axis: a covariance of `size^2 / 12`, that of a uniform density over the box. */
  readonly size: number | Vector;
  /** Adds a zero-mean velocity of this deviation to the endpoint. @defaultValue none: the endpoint is a position */
  readonly endVelocity?: number | undefined;
}

/** Where the object may be going. */
export type Destination = GaussianDestination | BoxDestination;

/** The constants of the method `pointing`, in pixels, or the length that `unit` states, and seconds. */
export interface Pointing {
  /** Noise scales of the way to go, each with the same weight, in px/s^1.5. */
  readonly noise: Vector;
  /** Noise along the way for each px/s of speed. */
  readonly alongNoise: number;
  /** Noise across the way for each px/s of speed. */
  readonly acrossNoise: number;
  /** The nodes of the time to go and their weights. */
  readonly timeToGo: {
    /** The first node, in seconds. */
    readonly from: number;
    /** The last node, in seconds. */
    readonly to: number;
    /** How many there are, spaced evenly in the logarithm. */
    readonly points: number;
    /** The median at 950 px/s, in seconds. */
    readonly median: number;
    /** The deviation of the logarithm. */
    readonly spread: number;
    /** How the median changes with the speed: as this power of it. */
    readonly speedExponent: number;
  };
  /** The evidence of the starting position: a density that falls with this power of the distance. */
  readonly start: {
    readonly exponent: number;
    /** Where it stops growing towards the start, in px. */
    readonly core: number;
    /** The radius over which it sums to one, in px. */
    readonly reach: number;
  };
  /** The evidence of the direction from the start. */
  readonly direction: {
    readonly power: number;
    /** Angles in radians. */
    readonly core: number;
    readonly wide: number;
    /** How far, in px, until it counts half. */
    readonly distance: number;
    /** How much farther for each px/s of speed, in seconds. */
    readonly time: number;
  };
  /** The power to which the density is raised, from the start to later. */
  readonly power: {
    readonly from: number;
    readonly to: number;
    /** The time constant, in seconds. */
    readonly time: number;
  };
  /** How near counts as there: as a share of the target's sides. */
  readonly near: number;
  /**
   * The distance from the start within which a pointer comes to count as resting where it was first observed: the evidence of the
   * start then fades, and the target that it rests on grows likely. By the time `t` it should have come
   * `restDistance (1 - power.time / t)^2`. 0: it never rests.
   *
   * @defaultValue 0; `pointerScenario` sets 45
   */
  readonly restDistance?: number | undefined;
  /**
   * The largest amplitude of shake that is expected, in units of length, as of a hand in a moving car: 2 to 8 Hz, how much and how
   * fast is followed. @defaultValue 0, none
   */
  readonly shake?: number | undefined;
  /** How the weight of "none" grows with the power. */
  readonly noneGain: number;
  /** What is added to the log weight of "none" once the pointer moves. @defaultValue 0 */
  readonly noneOffset?: number | undefined;
  /** The share of the probability of "none" that stays at its prior. @defaultValue 0 */
  readonly noneShare?: number | undefined;
  /** The share of probability that is spread over all destinations alike. */
  readonly uniform: number;
  /**
   * The length that the formulas take for a px: the median of the time to go holds at 950 of them a second, and what lies at the start
   * itself counts as one of them away. Only a scenario in another unit of length has to state it.
   *
   * @defaultValue 1
   */
  readonly unit?: number | undefined;
  /**
   * The time to the entry into the target: its logarithm's median is
   * `offset + nodes E[ln R] + near E[distance / (distance + e)] + elapsed t / (t + 1 s)`, with `e` the way to the edge of a target
   * and `t` the time since the first observation; its interval from the median times `exp(low)` to that times `exp(high)`, which holds
   * about four fifths of recorded mouse samples, but not with a tenth on each side.
   *
   * @defaultValue the posterior of the time-to-go nodes, which is too early
   */
  readonly remaining?:
    | {
        readonly offset: number;
        readonly nodes: number;
        readonly near: number;
        readonly distance: number;
        readonly elapsed: number;
        readonly low: number;
        readonly high: number;
      }
    | undefined;
}
