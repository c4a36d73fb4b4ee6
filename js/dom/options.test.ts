import assert from "node:assert/strict";
import { afterEach, describe, it } from "node:test";
import { readOptions, readTarget } from "./options.js";

const ROOT = { querySelectorAll: () => [] } as never as Document;
const read = (options: object) => readOptions({ root: ROOT, ...options });
const error = (code: string, path: string) => ({ name: "WhitherError", code, path });

/** What each option is that is left out. */
const DEFAULTS = {
  root: ROOT,
  threshold: 0.8,
  release: 0.5,
  none: 0.2,
  rest: 300,
  target: {},
  reasons: { pointer: 0, hover: 130, viewport: null, keyboard: null, press: true, focus: true, touch: true, scroll: true },
  reactivate: null,
  limit: { running: Infinity, perMinute: Infinity },
  pointers: ["mouse", "pen", "touch"],
  raw: false,
  load: "pointer",
  decorate: true,
  learning: null,
  record: false,
};

const call = () => {};
const { signal } = new AbortController();
const constants = {};

/** What is legal, and what it is read as: `[options, path, value]`. */
const LEGAL: readonly (readonly [options: object, path: string, value: unknown])[] = [
  [{ threshold: 1 }, "threshold", 1],
  [{ threshold: 0.4 }, "release", 0.25],
  [{ threshold: 0.4, release: 0.4 }, "release", 0.4],
  [{ none: 0 }, "none", 0],
  [{ rest: 150 }, "rest", 150],
  [{ target: call }, "target", call],
  [{ target: { hitSlop: 8 } }, "target.hitSlop", [8, 8, 8, 8]],
  [{ target: { hitSlop: { left: 4, top: 1 } } }, "target.hitSlop", [1, 0, 0, 4]],
  [{ target: { hitSlop: { right: 2, bottom: 3 } } }, "target.hitSlop", [0, 2, 3, 0]],
  [{ reasons: { pointer: true } }, "reasons.pointer", 0],
  [{ reasons: { pointer: false } }, "reasons.pointer", null],
  [{ reasons: { pointer: { after: 50 } } }, "reasons.pointer", 50],
  [{ reasons: { hover: true } }, "reasons.hover", 130],
  [{ reasons: { hover: false } }, "reasons.hover", null],
  [{ reasons: { hover: { after: 0 } } }, "reasons.hover", 0],
  [{ reasons: { viewport: true } }, "reasons.viewport", 0],
  [{ reasons: { viewport: { after: 900 } } }, "reasons.viewport", 900],
  [{ reasons: { keyboard: true } }, "reasons.keyboard", 1],
  [{ reasons: { keyboard: { tabs: 3 } } }, "reasons.keyboard", 3],
  [{ reasons: { press: false } }, "reasons.press", false],
  [{ reasons: { focus: false } }, "reasons.focus", false],
  [{ reasons: { touch: false } }, "reasons.touch", false],
  [{ reasons: { scroll: false } }, "reasons.scroll", false],
  [{ reasons: { hover: false } }, "reasons.focus", true],
  [{ reactivate: "never" }, "reactivate", Infinity],
  [{ reactivate: "movement" }, "reactivate", null],
  [{ reactivate: 0 }, "reactivate", 0],
  [{ limit: { running: 1 } }, "limit", { running: 1, perMinute: Infinity }],
  [{ limit: { perMinute: 0 } }, "limit", { running: Infinity, perMinute: 0 }],
  [{ pointers: [] }, "pointers", []],
  [{ pointers: ["pen"] }, "pointers", ["pen"]],
  [{ raw: true }, "raw", true],
  [{ load: "eager" }, "load", "eager"],
  [{ load: "idle" }, "load", "idle"],
  [{ load: "pointer" }, "load", "pointer"],
  [{ decorate: false }, "decorate", false],
  [{ learning: true }, "learning", 5],
  [{ learning: false }, "learning", null],
  [{ learning: 0.5 }, "learning", 0.5],
  [{ record: true }, "record", true],
  [{ constants }, "constants", constants],
  [{ predictor: call }, "predictor", call],
  [{ learnt: constants }, "learnt", constants],
  [{ signal }, "signal", signal],
  ...["onIntent", "onRelease", "onPrediction", "onOutcome", "onError"].map((key) => [{ [key]: call }, key, call] as const),
];

/** What is refused: `[options, code, path]`. */
const WRONG: readonly (readonly [options: object, code: string, path: string])[] = [
  [{ treshold: 0.5 }, "unknown-key", "treshold"],
  [{ root: "main" }, "wrong-type", "root"],
  [{ root: 5 }, "wrong-type", "root"],
  [{ threshold: "0.5" }, "wrong-type", "threshold"],
  [{ threshold: 0 }, "out-of-range", "threshold"],
  [{ threshold: 1.01 }, "out-of-range", "threshold"],
  [{ threshold: Number.NaN }, "not-finite", "threshold"],
  [{ release: true }, "wrong-type", "release"],
  [{ release: 0 }, "out-of-range", "release"],
  [{ release: 0.81 }, "out-of-range", "release"],
  [{ threshold: 0.5, release: 0.6 }, "out-of-range", "release"],
  [{ none: "0" }, "wrong-type", "none"],
  [{ none: 1 }, "out-of-range", "none"],
  [{ none: -0.1 }, "out-of-range", "none"],
  [{ rest: 0 }, "out-of-range", "rest"],
  [{ rest: "300" }, "wrong-type", "rest"],
  [{ rest: Infinity }, "not-finite", "rest"],
  [{ target: 5 }, "wrong-type", "target"],
  [{ target: { colour: "red" } }, "unknown-key", "target.colour"],
  [{ target: { id: 7 } }, "wrong-type", "target.id"],
  [{ target: { name: 7 } }, "wrong-type", "target.name"],
  [{ target: { prior: -1 } }, "out-of-range", "target.prior"],
  [{ target: { prior: Number.NaN } }, "not-finite", "target.prior"],
  [{ target: { threshold: 2 } }, "out-of-range", "target.threshold"],
  [{ target: { hitSlop: "5" } }, "wrong-type", "target.hitSlop"],
  [{ target: { hitSlop: -1 } }, "out-of-range", "target.hitSlop"],
  [{ target: { hitSlop: [1, 2, 3, 4] } }, "wrong-type", "target.hitSlop"],
  [{ target: { hitSlop: { left: Number.NaN } } }, "not-finite", "target.hitSlop.left"],
  [{ target: { hitSlop: { middle: 1 } } }, "unknown-key", "target.hitSlop.middle"],
  [{ target: { enabled: "no" } }, "wrong-type", "target.enabled"],
  [{ target: { onIntent: 7 } }, "wrong-type", "target.onIntent"],
  [{ reasons: ["hover"] }, "wrong-type", "reasons"],
  [{ reasons: { hovering: true } }, "unknown-key", "reasons.hovering"],
  [{ reasons: { pointer: { after: "50" } } }, "wrong-type", "reasons.pointer.after"],
  [{ reasons: { pointer: {} } }, "missing-key", "reasons.pointer.after"],
  [{ reasons: { hover: "yes" } }, "wrong-type", "reasons.hover"],
  [{ reasons: { hover: { after: -1 } } }, "out-of-range", "reasons.hover.after"],
  [{ reasons: { hover: { tabs: 1 } } }, "unknown-key", "reasons.hover.tabs"],
  [{ reasons: { viewport: 100 } }, "wrong-type", "reasons.viewport"],
  [{ reasons: { keyboard: { tabs: -1 } } }, "out-of-range", "reasons.keyboard.tabs"],
  [{ reasons: { keyboard: { after: 1 } } }, "unknown-key", "reasons.keyboard.after"],
  [{ reasons: { press: 1 } }, "wrong-type", "reasons.press"],
  [{ reasons: { focus: "no" } }, "wrong-type", "reasons.focus"],
  [{ reasons: { touch: {} } }, "wrong-type", "reasons.touch"],
  [{ reasons: { scroll: 0 } }, "wrong-type", "reasons.scroll"],
  [{ reactivate: "always" }, "out-of-range", "reactivate"],
  [{ reactivate: "toString" }, "out-of-range", "reactivate"],
  [{ reactivate: -1 }, "out-of-range", "reactivate"],
  [{ reactivate: true }, "wrong-type", "reactivate"],
  [{ limit: 3 }, "wrong-type", "limit"],
  [{ limit: { running: -1 } }, "out-of-range", "limit.running"],
  [{ limit: { perMinute: "2" } }, "wrong-type", "limit.perMinute"],
  [{ limit: { perHour: 1 } }, "unknown-key", "limit.perHour"],
  [{ pointers: "mouse" }, "wrong-type", "pointers"],
  [{ pointers: [3] }, "wrong-type", "pointers[0]"],
  [{ raw: 1 }, "wrong-type", "raw"],
  [{ load: "never" }, "out-of-range", "load"],
  [{ load: 1 }, "wrong-type", "load"],
  [{ decorate: "yes" }, "wrong-type", "decorate"],
  [{ constants: 5 }, "wrong-type", "constants"],
  [{ predictor: {} }, "wrong-type", "predictor"],
  [{ learning: "much" }, "wrong-type", "learning"],
  [{ learnt: 0.8 }, "wrong-type", "learnt"],
  [{ learning: 0 }, "out-of-range", "learning"],
  [{ record: "yes" }, "wrong-type", "record"],
  [{ signal: {} }, "wrong-type", "signal"],
  ...["onIntent", "onRelease", "onPrediction", "onOutcome", "onError"].map(
    (key) => [{ [key]: "log" }, "wrong-type", key] as const,
  ),
];

describe("options", () => {
  afterEach(() => {
    Reflect.deleteProperty(globalThis, "document");
  });

  it("have defaults, also where they are stated as undefined", () => {
    assert.deepEqual(read({}), DEFAULTS);
    const absent = Object.fromEntries(Object.keys(DEFAULTS).map((key) => [key, undefined]));
    assert.deepEqual(read({ ...absent, root: ROOT, onIntent: undefined }), DEFAULTS);
  });

  it("have the document as their root by default, without any options too", () => {
    Object.assign(globalThis, { document: ROOT });
    for (const given of [undefined, {}]) assert.equal(readOptions(given).root, ROOT);
  });

  it("are read as what they stand for", () => {
    for (const [options, path, value] of LEGAL) {
      const found = path.split(".").reduce((at, key) => at[key] as never, read(options) as never as Record<string, unknown>);
      assert.deepEqual(found, value, JSON.stringify(options));
    }
  });

  it("are refused with a code, a path and the value where they are wrong", () => {
    for (const [options, code, path] of WRONG) {
      assert.throws(() => read(options), error(code, path), JSON.stringify(options));
    }
    for (const none of [5, "options", [], true]) assert.throws(() => readOptions(none), error("wrong-type", "options"));
    assert.throws(() => read({ limit: { running: -1 } }), { message: "limit.running: must be at least 0, got -1" });
    assert.throws(() => read({ load: "never" }), { message: 'load: must be one of eager, idle, pointer, got "never"' });
  });

  it("have every key in the tables of this test", () => {
    const keys = [...Object.keys(DEFAULTS), "constants", "predictor", "learnt", "signal"];
    keys.push("onIntent", "onRelease", "onPrediction", "onOutcome", "onError");
    let message = "";
    try {
      read({ unknown: 1 });
    } catch (thrown) {
      ({ message } = thrown as Error);
    }
    assert.deepEqual(
      Array.from(message.matchAll(/"(\w+)"/g), ([, key]) => key)
        .slice(1)
        .toSorted(),
      keys.toSorted(),
    );
    for (const key of keys)
      assert.ok(
        WRONG.some(([options]) => key in options),
        key,
      );
  });
});

describe("options of a target", () => {
  it("have only what is stated, so that it hides nothing else", () => {
    assert.deepEqual(readTarget(null, "options"), {});
    assert.deepEqual(readTarget({ id: "a", prior: undefined, data: [1] }, "options"), { id: "a", data: [1] });
  });

  it("have errors at the path that they are read at", () => {
    assert.throws(() => readTarget({ threshold: 2 }, "options"), error("out-of-range", "options.threshold"));
    assert.throws(() => readTarget(5, "options"), error("wrong-type", "options"));
  });
});
