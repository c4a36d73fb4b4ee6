/** A Gaussian density of the state: all positions, then all velocities, then all accelerations. */
export interface Gaussian {
  /** The mean, one number for each of the `s` states. */
  readonly mean: Float64Array;
  /** The covariance, `s * s` numbers, row by row. */
  readonly covariance: Float64Array;
}

/** From `s` numbers and `s * s` numbers. */
export function gaussian(numbers: Float64Array): Gaussian {
  const states = Math.round(Math.sqrt(numbers.length + 0.25) - 0.5);
  return { mean: numbers.slice(0, states), covariance: numbers.slice(states) };
}
