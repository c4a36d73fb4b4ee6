// What is measured: the same scenarios in Node, in a browser and natively.

/** Seconds between observations. */
export const INTERVAL = 0.016;

/** A scenario of `count` targets spread over so many screens, and what varies between the rows of the table. */
function paperScenario({ count, points = 15, dimensions = 2, sizes = "one", screens = 1, ...varied }) {
  const { method = "pseudoObservation", coupled, length } = varied;
  const extent = [1920, 1080, 600];
  const spread = [0.754877666, 0.569840291, 0.438579022];
  const axes = Array.from({ length: dimensions }, (_, axis) => axis);
  const destinations = Array.from({ length: count }, (_, i) => ({
    id: `d${i}`,
    center: axes.map((axis) => extent[axis] * (0.5 + screens * (fraction(i, spread[axis]) - 0.5))),
    size: axes.map((axis) => side(i, axis, sizes)),
    endVelocity: 200,
  }));
  return {
    motion: coupled ? correlated(dimensions) : { type: "constantVelocity", dimensions, noise: 3000 },
    observation: { noise: 1.5 },
    initial: coupled ? undefined : { velocity: 1000 },
    // The methods that accumulate need a prior on the arrival time itself: movements then end before it has passed.
    arrival: length === undefined ? { type: "horizon", from: 0.05, to: 0.5 } : { type: "uniform", from: 0.7, to: 1.5 },
    quadrature: points === 1 ? { rule: "gaussLegendre", points } : { rule: "simpson", points },
    method,
    destinations,
  };
}

/** Constant velocity whose noise is correlated between the axes. */
function correlated(dimensions) {
  const states = 2 * dimensions;
  const matrix = (entry) => Array.from({ length: states }, (_, i) => Array.from({ length: states }, (_, j) => entry(i, j)));
  return {
    type: "custom",
    dimensions,
    drift: matrix((i, j) => (j === i + dimensions ? 1 : 0)),
    diffusion: matrix((i, j) => (i < dimensions || j < dimensions ? 0 : i === j ? 9e6 : 3e6)),
  };
}

/** Targets for `pointerScenario`. */
export function targets({ count, sizes = "one" }) {
  return Array.from({ length: count }, (_, i) => ({
    id: `d${i}`,
    x: 1920 * fraction(i, 0.754877666),
    y: 1080 * fraction(i, 0.569840291),
    width: side(i, 0, sizes),
    height: side(i, 1, sizes),
  }));
}

function side(i, axis, sizes) {
  return sizes === "one" ? 80 : 40 + 80 * fraction(i, 0.618033989 + 0.1 * axis);
}

/** The scenario of a case of `cases.mjs`. */
export function scenario(one, pointerScenario) {
  return one.method === "pointing" ? pointerScenario(targets(one)) : paperScenario(one);
}

/** A pointer that sweeps over the screen and back for ever. */
export const sweep = Array.from({ length: 256 }, (_, k) => {
  const angle = (2 * Math.PI * k) / 256;
  const jitter = fraction(k, 0.618033989) - 0.5;
  return [960 + 700 * Math.sin(angle) + jitter, 540 + 400 * Math.sin(2 * angle) - jitter, 300 * Math.cos(angle)];
});

/** Exponents like those that the predictor has to do with. */
export function exponents(count) {
  return Float64Array.from({ length: count }, (_, i) => -40 * fraction(i, 0.618033989));
}

/** Evenly spread over (0, 1), without a pattern: the fractional parts of multiples of an irrational number. */
function fraction(i, step) {
  return ((i + 1) * step) % 1;
}
