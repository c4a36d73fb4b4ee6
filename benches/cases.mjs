// The rows of the tables. Each is one `observe` and `probabilities(into)` in mid-movement.

/** The densities for each destination under "pointing": two noise scales times seven times to go. */
const POINTING = 14;

/** Observations in a movement of the methods that accumulate. */
const LENGTH = 40;

const PAPERS = ["pseudoObservation", "singleFilterApproximate", "algorithm1", "bridging", "algorithm2", "singleFilter"];

/** What a step may cost, against as many `Math.exp` as there are pairs of destination and node. */
const budgets = [
  { count: 21, limit: 0.6, stretch: 0.45 },
  { count: 10_000, limit: 0.3, stretch: 0.2 },
  { count: 21, sizes: "own", limit: 0.9, stretch: 0.7 },
  { count: 10_000, sizes: "own", limit: 0.55, stretch: 0.45 },
  { count: 21, coupled: true, limit: 10, stretch: 3 },
  { count: 10_000, coupled: true, limit: 0.5, stretch: 0.3 },
  // At most the same cost for each density.
  { count: 21, method: "pointing", limit: 0.6, stretch: 0.45 },
  { count: 10_000, method: "pointing", limit: 0.3, stretch: 0.2 },
  { count: 21, sizes: "own", method: "pointing", limit: 0.9, stretch: 0.7 },
  { count: 10_000, sizes: "own", method: "pointing", limit: 0.55, stretch: 0.45 },
];

/** What is done once a movement or less: how many ordinary steps of 10 000 it may cost. */
export const seldomLimits = { first: 3, setTargets: 5, setDestinations: 40, constructing: 50 };

/** It is measured with so many times as many destinations too: how much longer it may take for each of them. */
export const seldomGrowth = { times: 5, limit: 1.5 };

/** The rows of its table; `pointer` is the class of `whither/pointing`. */
export const seldom = [{ method: "pseudoObservation" }, { method: "pointing" }, { method: "pointing", pointer: true }].flatMap(
  (kind) => ["one", "own"].map((sizes) => complete({ group: "seldom", ...kind, sizes, count: 10_000 })),
);

/**
 * `{ group, name, count, pairs, ... }`: `length` is that of a movement, where it has to end; `before` the number of
 * observations that come before what is measured.
 */
export function cases({ quick = false } = {}) {
  const counts = quick ? [6, 21, 100, 1000, 10_000] : [6, 21, 100, 1000, 10_000, 100_000];
  const both = ["pseudoObservation", "pointing"];
  const times = (list, rows) => list.flatMap((count) => rows.map((row) => ({ count, ...row })));
  const groups = {
    destinations: both.flatMap((method) => counts.map((count) => ({ method, count }))),
    nodes: [1, 5, 15, 31, 51].map((points) => ({ count: 1000, points })),
    dimensions: [1, 2, 3].map((dimensions) => ({ count: 1000, dimensions })),
    // the same as on the screen, but spread over a map a hundred screens wide and high
    map: (quick ? [10_000] : [10_000, 100_000]).map((count) => ({ count, screens: 100 })),
    observations: both.flatMap((method) =>
      (quick ? [100, 10_000] : [100, 10_000, 1_000_000]).map((before) => ({ method, count: 21, before })),
    ),
    methods: times(quick ? [21] : [6, 21, 100], [
      ...PAPERS.map((method) => ({ method, length: LENGTH })),
      { method: "pointing" },
    ]),
    // last, when everything is compiled as well as it will be
    budget: budgets,
  };
  return Object.entries(groups).flatMap(([group, rows]) => rows.map((row) => complete({ group, ...row })));
}

function complete(row) {
  const filled = { points: 15, dimensions: 2, sizes: "one", coupled: false, method: "pseudoObservation", ...row };
  const { group, method, count, points, dimensions, sizes, coupled, before } = filled;
  const pointing = method === "pointing";
  const name = [
    group,
    method,
    `N ${count}`,
    pointing ? "" : `q ${points}`,
    dimensions === 2 ? "" : `d ${dimensions}`,
    sizes === "own" ? "own sizes" : "",
    coupled ? "coupled" : "",
    before === undefined ? "" : `after ${before}`,
    row.pointer ? "PointerPredictor" : "",
  ];
  return { ...filled, name: name.filter((part) => part !== "").join(", "), pairs: count * (pointing ? POINTING : points) };
}
