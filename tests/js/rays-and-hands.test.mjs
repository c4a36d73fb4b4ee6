// `rayScenario`, `rayMap` and `handScenario`, and the programs of docs/rays-and-hands.md.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { handScenario, init, pointerScenario, Predictor, rayMap, rayScenario } from "whither";
import { capture, root } from "../../scripts/run.mjs";
import { close, refuses } from "./support.mjs";

await init();

const lamps = [
  { id: "lamp", azimuth: -30, elevation: 5, width: 6, height: 8 },
  { id: "door", azimuth: 30, elevation: 0, width: 10, height: 20 },
];
const icons = [
  { id: "radio", x: 40, y: 30, width: 20, height: 24 },
  { id: "map", x: 160, y: 90, width: 20, height: 24 },
];

/** The probabilities, none and the time to the entry after each observation. */
function answers(scenario, observations) {
  const predictor = new Predictor(scenario);
  const found = observations.map(([time, ...position]) => {
    predictor.observe(time, position);
    const { mean = 0, low = 0, high = 0 } = predictor.remaining ?? {};
    return [...predictor.probabilities(), predictor.none, mean, low, high];
  });
  predictor.free();
  return found;
}

test("a ray in degrees and in radians, a hand in millimetres and in metres have the same answers", () => {
  const way = Array.from({ length: 30 }, (_, k) => [k / 60, 1 - (1 - k / 40) ** 2]);
  const cases = [
    [rayScenario, lamps, "radians", Math.PI / 180, way.map(([time, share]) => [time, 2 + 28 * share, -60 + 60 * share])],
    [
      handScenario,
      icons,
      "metres",
      1 / 1000,
      way.map(([time, share]) => [time, 90 + 70 * share, 240 - 150 * share, 300 - 300 * share]),
    ],
  ];
  for (const [scenario, targets, unit, size, observations] of cases) {
    const scaled = ({ id, ...numbers }) => ({
      id,
      ...Object.fromEntries(Object.entries(numbers).map(([key, x]) => [key, x * size])),
    });
    for (const noise of [undefined, 2]) {
      const expected = answers(scenario(targets, { none: 0.2, noise }), observations);
      const options = { none: 0.2, noise: noise && noise * size, unit };
      const small = observations.map(([time, ...position]) => [time, ...position.map((x) => x * size)]);
      answers(scenario(targets.map(scaled), options), small).forEach((found, k) =>
        close(found, expected[k], 1e-9, `${unit} after ${k}`),
      );
      assert.ok(expected.at(-1)[1] > 0.5, `${unit}: ${expected.at(-1)}`);
    }
  }
});

test("a target's third axis may be left out", () => {
  const complete = icons.map((icon) => ({ ...icon, z: 0, depth: 20 }));
  assert.deepEqual(handScenario(icons), handScenario(complete));
  assert.deepEqual(handScenario([{ ...icons[0], z: null, depth: undefined }]), handScenario(complete.slice(0, 1)));
});

test("scenarios state their unit, and are as any other", () => {
  const units = [pointerScenario(icons), rayScenario(lamps), handScenario(icons)].map(({ pointing }) => pointing.unit);
  assert.deepEqual(units, [1, 0.1, 0.5]);
  const given = {
    ...rayScenario(lamps),
    destinations: [
      { id: "lamp", center: [-30, 5], size: [6, 8], prior: 3 },
      { id: "door", center: [30, 0], size: 5 },
    ],
  };
  assert.deepEqual(new Predictor(given).probabilities(), Float64Array.of(0.75, 0.25));
});

test("the map keeps angles from its middle", () => {
  const map = rayMap([0, 0, -3]);
  // as in tests/native/devices.rs
  for (const [direction, expected] of [
    [
      [0, 0, -1],
      [0, 0],
    ],
    [
      [1, 0, -1],
      [45, 0],
    ],
    [
      [0, -2, -2],
      [0, -45],
    ],
    [
      [-1, 0, 0],
      [-90, 0],
    ],
    [
      [0, 1, 0],
      [0, 90],
    ],
    [Float32Array.of(3, 4, 0), [54, 72]],
    [
      [0, 0, 1],
      [180, 0],
    ],
  ]) {
    close(map(direction), expected, 1e-12, String(direction));
  }
  close(rayMap([0, 0, -1], { unit: "radians" })([0, 1, 0]), [0, Math.PI / 2], 1e-12);
  close(rayMap([1, 0, 0])([0, 0, 1]), [90, 0], 1e-12);
  close(rayMap([1, 0, 0])([1, 1, 0]), [0, 45], 1e-12);
  for (const [middle, above] of [
    [
      [0, 1, 0],
      [0, 0, 1],
    ],
    [
      [0, -1, 0],
      [0, 0, -1],
    ],
  ]) {
    close(rayMap(middle)([1, 0, 0]), [90, 0], 1e-12);
    close(rayMap(middle)(above), [0, 90], 1e-12);
  }
});

test("a direction that is none is refused by name", () => {
  refuses(() => rayMap(), "wrong-length", "middle", "must have 3 numbers, has 0");
  refuses(() => rayMap([0, 0]), "wrong-length", "middle", "must have 3 numbers, has 2");
  refuses(() => rayMap([0, 0, 0]), "out-of-range", "middle", "must have finite numbers and a direction, got [0, 0, 0]");
  const words = 'must be one of "degrees", "radians", got "turns"';
  refuses(() => rayMap([0, 0, -1], { unit: "turns" }), "out-of-range", "options.unit", words);
  const map = rayMap([0, 0, -1]);
  refuses(() => map([0, NaN, 0]), "out-of-range", "direction", "must have finite numbers and a direction, got [0, NaN, 0]");
  refuses(() => map([0, "1", 0]), "out-of-range", "direction", "must have finite numbers and a direction, got [0, 1, 0]");
  refuses(() => map("ahead"), "wrong-length", "direction", "must have 3 numbers, has 5");
});

const page = readFileSync(new URL("../../docs/rays-and-hands.md", import.meta.url), "utf8");
const [ray, pose, hand, frames, ...others] = [...page.matchAll(/^```js\n(.*?)^```/gms)].map(([, code]) => code);

test("there are two programs, each in two parts", () => assert.deepEqual([frames !== undefined, others.length], [true, 0]));

for (const [name, program] of Object.entries({ ray: ray + pose, hand: hand + frames })) {
  test(`the program for a ${name} prints what its comments state`, async () => {
    const { code, output } = await capture("node", ["--input-type=module", "--eval", program], { cwd: root });
    assert.equal(code, 0, output);
    const promised = [...program.matchAll(/^console\.log\(.*\); \/\/ (.*)$/gm)].map(([, comment]) => comment);
    assert.ok(promised.length > 0);
    assert.deepEqual(output.trim().split("\n"), promised);
  });
}
