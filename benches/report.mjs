// The tables of `npm run bench`.
import { showSizes } from "../scripts/size.mjs";
import { table } from "../scripts/table.mjs";
import { seldom, seldomGrowth, seldomLimits } from "./cases.mjs";
import { LIMIT } from "./dom.mjs";
import { line } from "./measure.mjs";

const count = (n) => n.toLocaleString("en-GB");
const digits = (x) => (Math.abs(x) < 10 ? x.toFixed(2) : Math.abs(x) < 100 ? x.toFixed(1) : count(Math.round(x)));
const met = (yes) => (yes ? "met" : "missed");

/** Prints everything. */
export function report(result) {
  const { date, machine, node, chromium, numpy, quick } = result;
  const versions = `Node ${node.version.slice(1)}, Chromium ${chromium.version}, ${numpy ? `numpy ${numpy.numpy}` : "no numpy"}`;
  console.log(`\n${date}, ${machine}, ${versions}${quick ? "; quick: rough numbers" : ""}\n`);
  const platforms = [
    ["Node", node.cases],
    ["Chromium", chromium.cases],
    ["native", result.native.cases],
  ];
  const of = (group) => result.cases.filter((one) => one.group === group);
  showUnit([
    ["Node", node.exp],
    ["Chromium", chromium.exp],
    ["native", result.native.exp],
  ]);
  showBudgets(of("budget"), platforms);
  showSeldom(node.seldom);
  showGrowth(of, platforms);
  showObservations(of("observations"), platforms);
  showMethods(of("methods"), platforms);
  showPeers(result, of("methods"), of("budget"));
  showDom(chromium.dom);
  showMemory(result.memory);
  console.log("From `import` to the first prediction, Chromium:\n");
  table(
    ["processor slowed down", "`whither`, ms", "`whither/pointing`, ms"],
    chromium.start.map(({ throttle, whither, pointing }) => [
      throttle === 1 ? "not" : `${throttle} times`,
      digits(whither),
      digits(pointing),
    ]),
  );
  console.log("Size:\n");
  showSizes(result.sizes);
}

function showUnit(platforms) {
  console.log("The unit, a call of `exp`, in nanoseconds: the faster of two loops; and the loop that it has to agree with:\n");
  table(
    ["", "plain", "unrolled", "unit", "check"],
    platforms.map(([name, exp]) => [name, ...[exp.plain, exp.unrolled, exp.unit, exp.check].map(digits)]),
  );
}

function describe({ method, sizes, coupled, pointer }) {
  if (method === "pointing") return `${pointer ? "PointerPredictor" : method}${sizes === "own" ? ", each its size" : ""}`;
  return coupled ? "coupled noise" : sizes === "own" ? "each its size" : "one size";
}

function showBudgets(rows, platforms) {
  console.log("One `observe` and `probabilities(into)`, 2-D, q = 15 (pointing: 14 densities), against N q calls of `exp`:\n");
  const node = platforms[0][1];
  table(
    ["", "N", "Node, µs", ...platforms.map(([name]) => `${name}, ratio`), "at most", "stretch", "in Node"],
    rows.map((one) => [
      describe(one),
      count(one.count),
      digits(node[one.name].microseconds),
      ...platforms.map(([, cases]) => digits(cases[one.name].ratio)),
      one.limit,
      one.stretch,
      met(node[one.name].ratio <= one.limit),
    ]),
  );
}

function showSeldom(results) {
  const { times, limit } = seldomGrowth;
  console.log(
    "What is done once a movement or less, with the step that follows, in ordinary steps of 10 000, Node; and with " +
      `${count(10_000 * times)} the time for each destination against that with 10 000, 1 if linear, at most ${limit}:\n`,
  );
  const names = {
    first: "first observation",
    setTargets: "`setTargets`",
    setDestinations: "`setDestinations`",
    constructing: "constructing",
  };
  const cells = seldom.flatMap((row) =>
    Object.entries(names).flatMap(([key, name]) => {
      const found = results[row.name][key];
      if (!found) return [];
      const { microseconds, ratio, growth } = found;
      const most = seldomLimits[key];
      const kind = row.method === "pointing" ? describe(row) : `${row.method}, ${describe(row)}`;
      return [
        [`${kind}, ${name}`, digits(microseconds), digits(ratio), most, met(ratio <= most), digits(growth), met(growth <= limit)],
      ];
    }),
  );
  table(["", "µs", "steps", "at most", "", `with ${count(10_000 * times)}`, ""], cells);
}

/** The exponent of a power law through the points. */
const exponent = (points) => line(points.map((point) => point.map(Math.log)));

function showGrowth(of, platforms) {
  const headings = ["", "N", "q", "d", ...platforms.map(([name]) => `${name}, µs`), "Node, ns a pair", "Node, ratio"];
  const cells = (one) => [
    one.method,
    count(one.count),
    one.method === "pointing" ? 14 : one.points,
    one.dimensions,
    ...platforms.map(([, cases]) => digits(cases[one.name].microseconds)),
    digits((1000 * platforms[0][1][one.name].microseconds) / one.pairs),
    digits(platforms[0][1][one.name].ratio),
  ];
  console.log("Growth with N, q and d, one size:\n");
  table(headings, [...of("destinations"), ...of("nodes"), ...of("dimensions")].map(cells));
  console.log("The same on a map, a hundred screens wide and high, where most destinations can be left out:\n");
  table(headings, of("map").map(cells));
  console.log("The lines through it: `µs = fixed + each N`, or q; and the exponent of a power law from N = 1000, or q = 5:\n");
  const fits = [
    ["N, pseudoObservation", of("destinations").filter(({ method }) => method !== "pointing"), "count", 1000],
    ["N, pointing", of("destinations").filter(({ method }) => method === "pointing"), "count", 1000],
    ["q, pseudoObservation", of("nodes"), "points", 5],
  ];
  const fitted = fits.flatMap(([name, rows, key, least]) =>
    platforms.map(([platform, cases]) => {
      const points = rows.map((one) => [one[key], cases[one.name].microseconds]);
      const straight = line(points);
      const power = exponent(points.filter(([x]) => x >= least));
      const { slope, intercept, explained } = straight;
      return [`${name}, ${platform}`, digits(intercept), slope.toPrecision(3), explained.toFixed(5), power.slope.toFixed(3)];
    }),
  );
  table(["", "fixed, µs", "each, µs", "R²", "exponent"], fitted);
}

function showObservations(rows, platforms) {
  // the lengths are measured one after another, so the fit is through what each took against `exp` in its own rounds
  console.log("A step after many observations, N = 21, µs; the exponent, of the ratio to `exp`, is 0 if flat:\n");
  const methods = [...new Set(rows.map(({ method }) => method))];
  const befores = [...new Set(rows.map(({ before }) => before))];
  const cells = methods.flatMap((method) =>
    platforms.map(([platform, cases]) => {
      const times = befores.map((before) => {
        const one = rows.find((row) => row.method === method && row.before === before);
        return { before, ...cases[one.name] };
      });
      const power = exponent(times.map(({ before, ratio }) => [before, ratio]));
      return [`${method}, ${platform}`, ...times.map(({ microseconds }) => digits(microseconds)), power.slope.toFixed(3)];
    }),
  );
  table(["", ...befores.map((before) => `after ${count(before)}`), "exponent"], cells);
}

function showMethods(rows, platforms) {
  console.log("By method, q = 15, µs:\n");
  const counts = [...new Set(rows.map((row) => row.count))];
  const columns = counts.flatMap((n) => platforms.map(([name, cases]) => ({ n, name, cases })));
  const methods = [...new Set(rows.map(({ method }) => method))];
  table(
    ["method", ...columns.map(({ n, name }) => `N = ${n}, ${name}`)],
    methods.map((method) => {
      const time = ({ n, cases }) => cases[rows.find((row) => row.method === method && row.count === n).name].microseconds;
      return [method, ...columns.map((column) => digits(time(column)))];
    }),
  );
}

function showPeers({ native, node, chromium, numpy }, methods, budget) {
  console.log("Peers, 21 destinations, q = 15, in the same run:\n");
  const named = (method) => methods.find((one) => one.method === method && one.count === 21).name;
  const natively = (method) => native.cases[named(method)].microseconds;
  const inNode = (method) => node.cases[named(method)].microseconds;
  const screen = node.cases[budget.find(({ limit, count, sizes }) => limit && count === 21 && sizes === "one").name];
  const ours = "pseudoObservation";
  const rows = [
    ["N q calls of `Math.exp`", "Node", screen.microseconds / screen.ratio, screen.microseconds],
    ["Algorithm 1 in Rust", "native", natively("algorithm1"), natively(ours)],
    ["original bridging in Rust", "native", natively("bridging"), natively(ours)],
    ["original bridging, in wasm", "Node", inNode("bridging"), inNode(ours)],
    ["`kalman-filter`, a step for each destination", "Node", node.kalmanFilter.microseconds, node.kalmanFilter.ours],
    ["ForesightJS, a pointer event", "Chromium", chromium.foresight.microseconds, chromium.foresight.ours],
  ];
  if (numpy) rows.splice(1, 0, ["Algorithm 1 in numpy, against native", "Python", numpy.microseconds, natively(ours)]);
  table(
    ["", "where", "theirs, µs", "ours, µs", "times"],
    rows.map(([name, where, theirs, own]) => [name, where, digits(theirs), digits(own), digits(theirs / own)]),
  );
  if (numpy) {
    const times = numpy.microseconds / natively(ours);
    const same = `its probabilities are ours to ${numpy.difference.toExponential(0)}`;
    console.log(`Against numpy at least 500 times is wanted: ${met(times >= 500)}; ${same}.\n`);
  } else {
    console.log("Algorithm 1 in numpy is missing: pip install numpy, or set PYTHON to a Python that has it.\n");
  }
}

function showDom({ count: targets, rows, none, ...watchers }) {
  console.log(
    `A page of ${count(targets)} visible targets under a pointer at 1 kHz: ms of its main thread (processor time) beyond those ` +
      "without a watcher, long tasks as they are:\n",
  );
  const names = { whither: "`whither/dom`", foresight: "ForesightJS" };
  const beyond = (one, key) => digits(one[key] - none[key]);
  table(
    ["", "a frame, median", "at most", "", "a frame, 95%", "long tasks", `mounting ${count(rows)} rows`, "unmounting"],
    [
      ["without, in all", digits(none.frame), "", "", digits(none.high), none.long, digits(none.mount), digits(none.unmount)],
      ...Object.entries(watchers).map(([key, one]) => [
        names[key],
        beyond(one, "frame"),
        ...(key === "whither" ? [LIMIT, met(one.frame - none.frame <= LIMIT)] : ["", ""]),
        beyond(one, "high"),
        one.long,
        beyond(one, "mount"),
        beyond(one, "unmount"),
      ]),
    ],
  );
}

function showMemory({ taken, growth }) {
  console.log("Memory in wasm, in bytes:\n");
  const methods = Object.keys(taken);
  const bytes = (x) => count(Math.round(x));
  const row = (name, of, limit) => {
    const budget = limit ? `${count(limit)}: ${methods.map((method) => met(of(method) <= limit)).join(", ")}` : "";
    return [name, ...methods.map((method) => bytes(of(method))), budget];
  };
  const { observations } = growth[methods[0]];
  table(
    ["", ...methods, "at most"],
    [
      row("a predictor of 21", (method) => taken[method].predictor, 16_000),
      row("a clone of it", (method) => taken[method].clone),
      row("one more destination", (method) => taken[method].destination, 64),
      row("one more, each of its own size", (method) => taken[method].own),
      row("one more beyond 5000", (method) => taken[method].many),
      row(`growth over ${count(observations)} observations`, (method) => growth[method].grown),
    ],
  );
}
