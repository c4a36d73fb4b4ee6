// Learning constants through `whither/study`, which needs no init().
import assert from "node:assert/strict";
import { test } from "node:test";
import { init, pointerScenario, Predictor, WhitherError } from "whither";
import { fit } from "whither/study";

/** Seeded numbers from 0 to 1 (Marsaglia's xorshift), and normal deviates of them. */
function source(seed) {
  let state = seed;
  const uniform = () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
  return { uniform, normal: () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform()) };
}

/** Brownian walks of deviation 3 for each root of a second that enter the first of two targets. */
function walks(count) {
  const { normal } = source(5);
  const tracks = [];
  while (tracks.length < count) {
    const samples = [[0, 0, 0]];
    const inside = ([, x, y]) => Math.abs(x - 30) <= 20 && Math.abs(y) <= 20;
    while (samples.length < 40 && !inside(samples.at(-1))) {
      const [time, x, y] = samples.at(-1);
      samples.push([time + 1, x + 3 * normal(), y + 3 * normal()]);
    }
    if (!inside(samples.at(-1))) continue;
    tracks.push({
      user: `user ${tracks.length % 4}`,
      targets: [
        [30, 0, 40, 40],
        [-30, 0, 40, 40],
      ],
      target: 0,
      samples,
    });
  }
  return tracks;
}

const walk = {
  motion: { type: "brownian", dimensions: 2, noise: 9 },
  observation: { noise: 0.01 },
  arrival: { type: "uniform", from: 1, to: 40 },
};
const noise = { constants: ["motion.noise"], evaluations: 40 };

async function refuses(promise, code, path, message) {
  await assert.rejects(promise, (error) => {
    assert.ok(error instanceof WhitherError, `no WhitherError but ${error}`);
    assert.deepEqual([error.code, error.path, error.message], [code, path, path === "" ? message : `${path}: ${message}`]);
    return true;
  });
}

test("maximum evidence finds the noise that moved it, before any init", async () => {
  const states = [];
  const progress = (state) => void states.push(state);
  const fitted = await fit(walks(60), walk, { ...noise, progress });
  const [{ path, before, after }] = fitted.constants;
  assert.deepEqual([path, before, fitted.constants.length, fitted.tracks], ["motion.noise", 9, 1, 60]);
  assert.ok(Math.abs(after - 3) < 0.5, `${after}`);
  assert.equal(fitted.scenario.motion.noise, after);
  assert.deepEqual({ ...fitted.scenario, motion: { ...fitted.scenario.motion, noise: 9 } }, walk, "all else is as it was");
  assert.ok(fitted.leftOut.after < fitted.leftOut.before);
  assert.ok(states.length > 4 && states.every(({ share, loss }) => share > 0 && share <= 1 && Number.isFinite(loss)));
  assert.ok(
    states.every(({ share }, k) => k === 0 || share >= states[k - 1].share),
    "it never goes back",
  );
});

test("the pointer's scenario is learnt from, and what comes out predicts", async () => {
  await init();
  const places = [
    [100, 100],
    [500, 80],
    [300, 500],
  ];
  const { normal } = source(7);
  const tracks = Array.from({ length: 20 }, (_, k) => {
    const [x, y] = places[k % 3];
    const samples = Array.from({ length: 31 }, (_, i) => {
      const u = i / 30;
      const way = u ** 3 * (10 - 15 * u + 6 * u * u);
      return [i / 60, 300 + way * (x - 300) + 0.5 * normal(), 250 + way * (y - 250) + 0.5 * normal()];
    });
    return { targets: places.map((place) => [...place, 60, 60]), target: k % 3, samples };
  });
  const targets = places.map(([x, y], i) => ({ id: `icon ${i}`, x, y, width: 60, height: 60 }));
  const { scenario, leftOut } = await fit(tracks, pointerScenario(targets), { constants: ["pointing.power.to"], evaluations: 8 });
  assert.ok(leftOut.after < leftOut.before);
  const predictor = new Predictor(scenario);
  for (const [time, ...position] of tracks[1].samples.slice(0, 20)) predictor.observe(time, position);
  assert.equal(predictor.best.id, "icon 1");
  predictor.free();
});

test("too few tracks are refused with the number that is needed", async () => {
  const message = (has) => `must have at least 20 tracks that enter their target, 10 for each of 2 constants, has ${has}`;
  await refuses(fit(walks(7), walk), "out-of-range", "tracks", message(7));
  await refuses(fit([], walk), "out-of-range", "tracks", message(0));
  const never = { ...walks(1)[0], target: 1 };
  await refuses(fit([never], walk), "out-of-range", "tracks", message(0));
});

const [good] = walks(1);
const broken = (changes) => [good, { ...good, ...changes }];
/** `[what, tracks, scenario, options, code, path, message]` */
const cases = [
  ["no tracks", undefined, walk, {}, "missing-key", "tracks", 'missing key "tracks"'],
  ["no scenario", [good], undefined, {}, "missing-key", "scenario", 'missing key "scenario"'],
  [
    "an unknown option",
    [good],
    walk,
    { constant: [] },
    "unknown-key",
    "constant",
    'unknown key "constant", expected one of "constants", "evaluations", "destination", "progress"',
  ],
  [
    "an unknown key of a track",
    broken({ speed: 1 }),
    walk,
    {},
    "unknown-key",
    "tracks[1].speed",
    'unknown key "speed", expected one of "id", "user", "targets", "target", "samples"',
  ],
  [
    "a target that is not there",
    broken({ target: 2 }),
    walk,
    {},
    "out-of-range",
    "tracks[1].target",
    "must be the place of one of the 2 targets, counted from 0, got 2",
  ],
  [
    "time that runs back",
    broken({
      samples: [
        [1, 0, 0],
        [0.5, 0, 0],
      ],
    }),
    walk,
    {},
    "time-not-increasing",
    "tracks[1].samples[1]",
    "must not be before the sample at 1, got [0.5, 0, 0]",
  ],
  ["no samples", broken({ samples: [] }), walk, {}, "out-of-range", "tracks[1].samples", "must have at least one sample, got []"],
  [
    "a track in space",
    broken({
      targets: [[0, 0, 0, 9]],
      samples: [
        [0, 50, 0, 0],
        [1, 0, 0, 0],
      ],
      target: 0,
    }),
    walk,
    {},
    "wrong-length",
    "tracks[1].targets[0].center",
    "must have 2 numbers, has 3, got [0, 0, 0]",
  ],
  [
    "a scenario that is wrong",
    [good],
    { ...walk, motion: { ...walk.motion, noise: -1 } },
    {},
    "out-of-range",
    "motion.noise",
    "must be greater than 0, got -1",
  ],
  [
    "no such constant",
    walks(20),
    walk,
    { constants: ["motion.speed"] },
    "out-of-range",
    "constants",
    '"motion.speed" must be a number above 0 to be learnt, got nothing',
  ],
  [
    "no evaluation",
    [good],
    walk,
    { evaluations: 0 },
    "out-of-range",
    "evaluations",
    "must be an integer from 1 to 100000, got 0",
  ],
  ["progress that is no function", [good], walk, { progress: 3 }, "wrong-type", "progress", "must be a function"],
];

for (const [what, tracks, scenario, options, code, path, message] of cases) {
  test(`refused: ${what}`, () => refuses(fit(tracks, scenario, options), code, path, message));
}

test("coordinates may be missing, and names numbers", async () => {
  const named = walks(60).map((track, k) => ({ ...track, id: k, user: k % 4 }));
  const [original, numbered] = await Promise.all([fit(walks(60), walk, noise), fit(named, walk, noise)]);
  assert.deepEqual(numbered, original, "by the same users");
  // every fifth sample without one of its coordinates, but for the first and the last
  const holes = named.map((track) => ({
    ...track,
    samples: track.samples.map((sample, k) =>
      k % 5 === 2 && k < track.samples.length - 1 ? sample.map((x, i) => (i === 1 + (k % 2) ? null : x)) : sample,
    ),
  }));
  assert.ok(holes.some(({ samples }) => samples.flat().includes(null)));
  const fitted = await fit(holes, walk, noise);
  assert.equal(fitted.tracks, 60);
  assert.ok(Math.abs(fitted.constants[0].after - 3) < 0.5, `${fitted.constants[0].after}`);
});

test("a search that is stopped gives the best so far", async () => {
  let calls = 0;
  const fitted = await fit(walks(60), walk, { ...noise, progress: () => ++calls < 6 });
  assert.equal(calls, 6);
  assert.ok(fitted.constants[0].after < 9, "it had begun to move towards 3");
});

test("what progress throws comes out, and after it all goes on", async () => {
  const mine = new Error("mine");
  const progress = () => {
    throw mine;
  };
  await assert.rejects(fit(walks(60), walk, { ...noise, progress }), (error) => error === mine);
  const [one, two] = await Promise.all([fit(walks(60), walk, noise), fit(walks(60), walk, noise)]);
  assert.deepEqual(one, two);
});
