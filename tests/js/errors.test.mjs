// Everything that is refused, as JavaScript gets it: `tests/errors.json`, which Rust reads too (tests/native/errors.rs has what its
// rows are), and what only JavaScript can hand over. After each error all goes on.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ConditionallyMarkovSequence, handScenario, init, pointerScenario, Predictor, rayScenario } from "whither";
import { changed, movement, read, refuses, same, small } from "./support.mjs";

await init();

const { bases, rows } = read("errors.json");

/** How each base is built. */
const build = {
  scenario: (from) => new Predictor(from),
  pointing: (from) => new Predictor(from),
  pointer: ({ targets, options }) => new Predictor(pointerScenario(targets, options)),
  ray: ({ targets, options }) => new Predictor(rayScenario(targets, options)),
  hand: ({ targets, options }) => new Predictor(handScenario(targets, options)),
  snapshot: (from) => Predictor.restore(from),
  sequence: (from) => new ConditionallyMarkovSequence(from),
  parameters: (from) => ConditionallyMarkovSequence.fromParameters(from),
};

/** The arguments of each call, from their names. */
const call = {
  observe: (p, { time, position, noise }) => p.observe(time, position, noise === undefined ? undefined : { noise }),
  arrival: (p, { id }) => p.arrival(id),
  forecast: (p, { time }) => p.forecast(time),
  path: (p, { id, times }) => p.path(id, times),
  addDestination: (p, { destination }) => p.addDestination(destination),
  updateDestination: (p, { id, destination }) => p.updateDestination(id, destination),
  removeDestination: (p, { id }) => p.removeDestination(id),
  setDestinations: (p, { destinations }) => p.setDestinations(destinations),
  chosen: (p, { id }) => p.chosen(id),
  measure: (s, { step, position }) => s.measure(step, position),
  state: (s, { step }) => s.state(step),
  model: (s, { step }) => s.model(step),
  sample: (s, options) => s.sample(options),
  isMarkov: (s, { tolerance }) => s.isMarkov(tolerance),
  isReciprocal: (s, { tolerance }) => s.isReciprocal(tolerance),
};

const act = (subject, row) => call[row.call](subject, changed(row.with, {}));

function begun(base, from = bases[base].from) {
  const subject = build[base](from);
  for (const row of bases[base].before ?? []) act(subject, row);
  return subject;
}

/** All that a call could have changed. */
const everything = (subject) => (subject instanceof Predictor ? subject.snapshot() : [subject.destination(), subject.state(6)]);

bases.snapshot = { from: begun("scenario").snapshot() };

for (const base of Object.keys(bases)) test(`${base}: what is right`, () => begun(base).free());

for (const { base, change = {}, call: name, with: given, code, path, message } of rows) {
  const shown = JSON.stringify(name ? { [name]: given, ...change } : change);
  test(`${base}: ${shown}`, () => {
    const from = changed(bases[base].from, change);
    // as JavaScript prints large numbers
    const expected = message.replace(/got 1e(?=\d)/, "got 1e+");
    if (name === undefined) return refuses(() => build[base](from), code, path, expected);
    const [subject, untouched] = [begun(base, from), begun(base, from)];
    refuses(() => act(subject, { call: name, with: given }), code, path, expected);
    for (const one of [subject, untouched]) act(one, bases[base].after);
    assert.deepEqual(everything(subject), everything(untouched));
  });
}

const [left, middle, right] = small().destinations;
const cyclic = small();
cyclic.motion.itself = cyclic;
let deep = 1;
for (let i = 0; i < 30; i++) deep = [deep];

/** What JSON cannot hold: `[what, scenario, code, path, message]` */
const scenarios = [
  ["no scenario", undefined, "wrong-type", "", "must be an object, got nothing"],
  ["an undefined key is absent", small({ method: undefined, none: null }), null],
  [
    "a hole in a centre",
    small({ destinations: [{ ...left, center: [1, ,] }] }),
    "wrong-type",
    "destinations[0].center[1]",
    "must be a number, got nothing",
  ],
  [
    "a bigint",
    small({ none: 0n }),
    "wrong-type",
    "none",
    "must be plain data (numbers, strings, lists, objects), got 0n, a bigint",
  ],
  [
    "a symbol",
    small({ destinations: [{ ...left, id: Symbol("x") }] }),
    "wrong-type",
    "destinations[0].id",
    "must be plain data (numbers, strings, lists, objects), got a symbol",
  ],
  [
    "a function",
    small({ observation: () => 1 }),
    "wrong-type",
    "observation",
    "must be plain data (numbers, strings, lists, objects), got a function",
  ],
  [
    "a scenario that is a function",
    () => small(),
    "wrong-type",
    "",
    "must be plain data (numbers, strings, lists, objects), got a function",
  ],
  [
    "big integers",
    small({ destinations: [{ ...left, center: BigInt64Array.of(1n, 2n) }] }),
    "wrong-type",
    "destinations[0].center[0]",
    "must be plain data (numbers, strings, lists, objects), got 1n, a bigint",
  ],
  [
    "a list that is too long, behind others",
    small({ destinations: [left, { ...middle, size: [1, 2], center: new Float64Array(1_000_001) }] }),
    "too-large",
    "destinations[1].center",
    "must have no more than 1000000 items, has 1000001",
  ],
  [
    "half of a pair of units in a key",
    small({ learning: { "é\ud83d": 1 } }),
    "unknown-key",
    "learning.é\ufffd",
    'unknown key "é\ufffd", expected one of "strength", "forgetting", "afterLast"',
  ],
  ["an object that refers to itself", cyclic, "wrong-type", "motion.itself", "must be plain data, refers to itself"],
  [
    "a list that is too deep",
    small({ destinations: deep }),
    "wrong-type",
    `destinations${"[0]".repeat(23)}`,
    "must be plain data, is nested more than 24 deep",
  ],
  [
    "a huge sparse list",
    small({ destinations: new Array(2 ** 32 - 1) }),
    "too-large",
    "destinations",
    "must have no more than 1000000 items, has 4294967295",
  ],
  [
    "more values than memory",
    small({ destinations: new Array(1000).fill(new Array(1e6).fill(0)) }),
    "too-large",
    "destinations[16][777185]",
    "must have no more than 16777216 values in all",
  ],
  [
    "a text longer than memory",
    small({ method: "x".repeat(2 ** 27) }),
    "too-large",
    "method",
    "must have no more than 67108864 characters in all",
  ],
];

for (const [what, scenario, code, path, message] of scenarios) {
  test(`scenario: ${what}`, () => {
    if (code === null) new Predictor(scenario);
    else refuses(() => new Predictor(scenario), code, path, message);
  });
}

/** The same in mid-movement: `[what, call, code, path, message]` */
const uses = [
  [
    "a time that is a bigint",
    (p) => p.observe(3n, [1, 2]),
    "wrong-type",
    "time",
    "must be plain data (numbers, strings, lists, objects), got 3n, a bigint",
  ],
  ["a position that is null", (p) => p.observe(3, null), "missing-key", "position", 'missing key "position"'],
  ["ten coordinates", (p) => p.observe(3, new Float32Array(10)), "wrong-length", "position", "must have 2 numbers, has 10"],
  [
    "a huge sparse position",
    (p) => p.observe(3, new Array(2 ** 32 - 1)),
    "too-large",
    "position",
    "must have no more than 1000000 items, has 4294967295",
  ],
  [
    "a position that claims a huge length",
    (p) => p.observe(3, { length: 2 ** 53 }),
    "wrong-type",
    "position",
    "must be a list, got an object",
  ],
  [
    "a coordinate that is a bigint",
    (p) => p.observe(3, [1n, 2]),
    "wrong-type",
    "position[0]",
    "must be plain data (numbers, strings, lists, objects), got 1n, a bigint",
  ],
  ["an array of another kind to write to", (p) => p.probabilities([0, 0, 0]), "wrong-type", "into", "must be a Float64Array"],
  [
    "an array of another kind of number",
    (p) => p.logLikelihoods(new Float32Array(3)),
    "wrong-type",
    "into",
    "must be a Float64Array",
  ],
  ["nothing to write to", (p) => p.probabilities(null), "wrong-type", "into", "must be a Float64Array"],
  [
    "an array that is too short",
    (p) => p.probabilities(new Float64Array(2)),
    "wrong-length",
    "into",
    "must have 3 numbers, has 2",
  ],
];

for (const [what, use, code, path, message] of uses) {
  test(`in mid-movement: ${what}`, () => {
    const [predictor, untouched] = [new Predictor(small()), new Predictor(small())];
    for (const [time, ...position] of movement) for (const one of [predictor, untouched]) one.observe(time, position);
    refuses(() => use(predictor), code, path, message);
    for (const one of [predictor, untouched]) one.observe(2.4, [520, 300]);
    same(predictor.probabilities(), untouched.probabilities(), "as if nothing had happened");
    assert.deepEqual(predictor.destinations, untouched.destinations);
  });
}

test("the places of snapshots and targets that are not there", () => {
  refuses(() => Predictor.restore(undefined), "bad-snapshot", "snapshot", "must be what snapshot() returned, got nothing");
  for (const scenario of [pointerScenario, rayScenario, handScenario]) {
    refuses(() => scenario(), "missing-key", "targets", 'missing key "targets"');
  }
});

test("a sequence that was freed", () => {
  const sequence = new ConditionallyMarkovSequence(bases.sequence.from);
  sequence.free();
  refuses(() => sequence.destination(), "freed", "", "this sequence was freed");
  refuses(() => sequence.free(), "freed", "", "this sequence was freed");
  sequence[Symbol.dispose]();
});

test("what a user's own getter or proxy throws comes through, and everything goes on", () => {
  const own = new Error("mine");
  const thrower = () => {
    throw own;
  };
  const predictor = new Predictor(small());
  predictor.observe(0, [400, 300]);
  const getter = Object.defineProperty({}, "motion", { get: thrower, enumerable: true });
  const proxy = new Proxy({}, { ownKeys: thrower, get: thrower });
  for (const bad of [getter, proxy, small({ destinations: proxy }), small({ destinations: new Proxy([], { get: thrower }) })]) {
    for (let i = 0; i < 1000; i++) {
      assert.throws(
        () => new Predictor(bad),
        (error) => error === own,
      );
    }
    assert.throws(
      () => predictor.setDestinations(bad),
      (error) => error === own,
    );
    assert.throws(
      () => predictor.observe(1, [1, 2], { noise: bad }),
      (error) => error === own,
    );
    assert.throws(
      () => Predictor.restore(bad),
      (error) => error === own,
    );
  }
  assert.throws(
    () => predictor.observe(1, proxy),
    (error) => error === own,
  );
  assert.throws(() => new Predictor(new Proxy({}, { ownKeys: () => ["a", "a"] })), TypeError);
  predictor.observe(1, [420, 300]);
});

test("a getter that calls back into the same predictor", () => {
  const [predictor, plain] = [new Predictor(small()), new Predictor(small())];
  predictor.observe(0, [400, 300]);
  plain.observe(0, [400, 300]);
  const position = {
    length: 2,
    get 0() {
      predictor.observe(0.5, [410, 300]);
      return 420;
    },
    1: 300,
  };
  predictor.observe(1, position);
  plain.observe(0.5, [410, 300]);
  plain.observe(1, [420, 300]);
  same(predictor.probabilities(), plain.probabilities(), "as one after the other");
  const nosy = {
    ...left,
    get center() {
      predictor.setDestinations([middle, right]);
      return left.center;
    },
  };
  predictor.setDestinations([nosy, right]);
  assert.deepEqual(predictor.destinations, ["left", "right"]);
  const suicidal = {
    length: 2,
    get 0() {
      predictor.free();
      return 1;
    },
    1: 2,
  };
  refuses(() => predictor.observe(2, suicidal), "freed", "", "this predictor was freed");
});
