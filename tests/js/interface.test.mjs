// TypeScript's declarations have the keys, words and error codes that Rust reads, no more and no fewer.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import ts from "typescript";
import { ConditionallyMarkovSequence, handScenario, init, pointerScenario, Predictor, rayScenario } from "whither";
import { changed, read } from "./support.mjs";

await init();

const { bases } = read("errors.json");
const scenario = { build: (from) => new Predictor(from), from: bases.scenario.from };
const pointing = { ...scenario, from: bases.pointing.from };
const pointer = { build: ({ targets, options }) => pointerScenario(targets, options), from: bases.pointer.from };
const ray = { build: ({ targets, options }) => rayScenario(targets, options), from: bases.ray.from };
const hand = { build: ({ targets, options }) => handScenario(targets, options), from: bases.hand.from };
const sequence = { build: (from) => new ConditionallyMarkovSequence(from), from: bases.sequence.from };
const given = { build: (from) => ConditionallyMarkovSequence.fromParameters(from), from: bases.parameters.from };

const box = { id: "a", center: [1, 2], size: 3 };
const remaining = { offset: 0, nodes: 0, near: 0, distance: 20, elapsed: 0, low: -1, high: 1 };

const motion = (type, others = { noise: 1 }) => [
  `Extract<Motion, { type: "${type}" }>`,
  { ...scenario, change: { "/motion": { type, dimensions: 2, ...others }, "/initial": null, "/destinations": [box] } },
  "/motion",
];
const arrival = (type, others) => [
  `Extract<Arrival, { type: ${type} }>`,
  { ...scenario, change: { "/arrival": { type: JSON.parse(type.split(" | ")[0]), ...others } } },
  "/arrival",
];

/** Each object that Rust reads: its type, and where there is one of these. */
const objects = [
  ["Scenario", scenario, ""],
  motion("brownian"),
  motion("constantVelocity"),
  motion("constantAcceleration"),
  motion("integratedOrnsteinUhlenbeck", { noise: 1, damping: 1 }),
  motion("meanReverting", { noise: 1, rate: 1 }),
  motion("equilibriumRevertingVelocity", { noise: 1, stiffness: 1, damping: 1 }),
  motion("custom", {
    drift: [
      [0, 0],
      [0, 0],
    ],
    diffusion: [
      [1, 0],
      [0, 1],
    ],
  }),
  [
    "Extract<MotionNoise, { candidates: unknown }>",
    { ...scenario, change: { "/motion/noise": { candidates: [1] } } },
    "/motion/noise",
  ],
  ["Observation", scenario, "/observation"],
  ["Initial", scenario, "/initial"],
  arrival('"uniform" | "horizon"', { from: 1, to: 2 }),
  arrival('"discrete"', { times: [1], weights: [1] }),
  arrival('"logNormal"', { median: 1, spread: 1 }),
  arrival('"fitts"', { intercept: 1, slope: 1, spread: 1 }),
  ["Quadrature", { ...scenario, change: { "/quadrature": { rule: "monteCarlo" } } }, "/quadrature"],
  ["Learning", { ...scenario, change: { "/learning": { strength: 1 } } }, "/learning"],
  ["Destination", scenario, "/destinations/0"],
  ["Pointing", pointing, "/pointing"],
  ...["timeToGo", "start", "direction", "power"].map((key) => [`Pointing["${key}"]`, pointing, `/pointing/${key}`]),
  ['NonNullable<Pointing["remaining"]>', { ...pointing, change: { "/pointing/remaining": remaining } }, "/pointing/remaining"],
  ["PointerTarget", pointer, "/targets/0"],
  ["PointerOptions", pointer, "/options"],
  ["RayTarget", ray, "/targets/0"],
  ["RayOptions", ray, "/options"],
  ["HandTarget", hand, "/targets/0"],
  ["HandOptions", hand, "/options"],
  ["SequenceParameters", sequence, ""],
  ["GivenSequence", given, ""],
  ['GivenSequence["boundary"]', given, "/boundary"],
];

/** Each key that holds one of some words. */
const words = [
  ["Method", "/method"],
  ['Motion["type"]', "/motion/type"],
  ['Arrival["type"]', "/arrival/type"],
  ['NonNullable<Quadrature["rule"]>', "/quadrature/rule"],
  ["AngleUnit", "/options/unit", ray],
  ["LengthUnit", "/options/unit", hand],
];

const source = readFileSync(new URL("../../src/error.rs", import.meta.url), "utf8");
const rustCodes = [...source.matchAll(/Self::\w+ => "([a-z-]+)"/g)].map(([, code]) => code);

/** The words in unions of strings, each given as a type of the package. */
function literals(types) {
  const declarations = fileURLToPath(new URL("../../dist/types/index.d.ts", import.meta.url));
  const { target, module } = { target: ts.ScriptTarget.ESNext, module: ts.ModuleKind.ESNext };
  const options = { strict: true, skipLibCheck: true, target, module, moduleResolution: ts.ModuleResolutionKind.Bundler };
  const names = types.flatMap((type) => type.match(/\b[A-Z]\w+/g)).filter((name) => !/^(Extract|Keys|NonNullable)$/.test(name));
  const text = [
    `import type { ${[...new Set(names)].join(", ")} } from ${JSON.stringify(declarations.replace(/\.d\.ts$/, ".js"))};`,
    "type Keys<T> = T extends unknown ? keyof T : never;",
    ...types.map((type, i) => `export type T${i} = ${type};`),
  ].join("\n");
  const name = fileURLToPath(new URL("declared.ts", import.meta.url));
  const host = ts.createCompilerHost(options);
  const { getSourceFile, fileExists } = host;
  host.getSourceFile = (file, ...others) =>
    file === name ? ts.createSourceFile(file, text, target) : getSourceFile(file, ...others);
  host.fileExists = (file) => file === name || fileExists(file);
  const program = ts.createProgram([name], options, host);
  const file = program.getSourceFile(name);
  const wrong = program.getSemanticDiagnostics(file).map(({ messageText }) => ts.flattenDiagnosticMessageText(messageText, "\n"));
  assert.deepEqual(wrong, []);
  const checker = program.getTypeChecker();
  const exported = checker.getExportsOfModule(checker.getSymbolAtLocation(file));
  return types.map((_, i) => {
    const type = checker.getDeclaredTypeOfSymbol(exported.find((symbol) => symbol.name === `T${i}`));
    return (type.isUnion() ? type.types : [type]).map(({ value }) => value).sort();
  });
}

const declared = literals([...objects.map(([type]) => `Keys<${type}>`), ...words.map(([type]) => type), "ErrorCode"]);

/** The words that Rust takes, from the error of one that it does not. */
function legal({ build, from, change = {} }, wrong, pattern) {
  build(changed(from, change));
  let message = "";
  try {
    build(changed(from, { ...change, ...wrong }));
  } catch (error) {
    message = error.message;
  }
  const [, list] = pattern.exec(message) ?? assert.fail(`no list of words in ${JSON.stringify(message)}`);
  return list
    .split(", ")
    .map((word) => JSON.parse(word))
    .sort();
}

objects.forEach(([type, where, pointer], i) => {
  test(`the keys of ${type}`, () => {
    assert.deepEqual(declared[i], legal(where, { [`${pointer}/?`]: 1 }, /expected one of (.*)$/));
  });
});

words.forEach(([type, pointer, where = scenario], i) => {
  test(`the words of ${type}`, () => {
    assert.deepEqual(declared[objects.length + i], legal(where, { [pointer]: "?" }, /must be one of (.*), got/));
  });
});

test("the error codes", () => {
  assert.deepEqual(declared.at(-1), rustCodes.sort());
});
