// Bad input is refused at once, with a code and a path, and changes nothing; callbacks that throw do not stop the watcher.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { hosted, logged, nextFrame, open, ROW, scripted } from "./page.mjs";

/** Options that are refused, as text of the page's script: `[options, code, path]`. */
const OPTIONS = [
  [`{ treshold: 0.5 }`, "unknown-key", "treshold"],
  [`5`, "wrong-type", "options"],
  [`{ threshold: "0.5" }`, "wrong-type", "threshold"],
  [`{ threshold: 0 }`, "out-of-range", "threshold"],
  [`{ threshold: 1.01 }`, "out-of-range", "threshold"],
  [`{ threshold: NaN }`, "not-finite", "threshold"],
  [`{ release: -0.1 }`, "out-of-range", "release"],
  [`{ threshold: 0.5, release: 0.6 }`, "out-of-range", "release"],
  [`{ none: 1 }`, "out-of-range", "none"],
  [`{ none: -0.1 }`, "out-of-range", "none"],
  [`{ rest: 0 }`, "out-of-range", "rest"],
  [`{ rest: Infinity }`, "not-finite", "rest"],
  [`{ root: "main" }`, "wrong-type", "root"],
  [`{ target: 5 }`, "wrong-type", "target"],
  [`{ target: { colour: "red" } }`, "unknown-key", "target.colour"],
  [`{ target: { threshold: 2 } }`, "out-of-range", "target.threshold"],
  [`{ target: { prior: -1 } }`, "out-of-range", "target.prior"],
  [`{ target: { prior: NaN } }`, "not-finite", "target.prior"],
  [`{ target: { hitSlop: "5" } }`, "wrong-type", "target.hitSlop"],
  [`{ target: { hitSlop: { left: NaN } } }`, "not-finite", "target.hitSlop.left"],
  [`{ target: { hitSlop: { middle: 1 } } }`, "unknown-key", "target.hitSlop.middle"],
  [`{ target: { enabled: "no" } }`, "wrong-type", "target.enabled"],
  [`{ target: { id: 7 } }`, "wrong-type", "target.id"],
  [`{ target: { onIntent: 7 } }`, "wrong-type", "target.onIntent"],
  [`{ reasons: { hovering: true } }`, "unknown-key", "reasons.hovering"],
  [`{ reasons: ["hover"] }`, "wrong-type", "reasons"],
  [`{ reasons: { hover: "yes" } }`, "wrong-type", "reasons.hover"],
  [`{ reasons: { hover: { after: -1 } } }`, "out-of-range", "reasons.hover.after"],
  [`{ reasons: { hover: { tabs: 1 } } }`, "unknown-key", "reasons.hover.tabs"],
  [`{ reasons: { pointer: { after: "50" } } }`, "wrong-type", "reasons.pointer.after"],
  [`{ reasons: { keyboard: { tabs: -1 } } }`, "out-of-range", "reasons.keyboard.tabs"],
  [`{ reasons: { press: 1 } }`, "wrong-type", "reasons.press"],
  [`{ reactivate: "always" }`, "out-of-range", "reactivate"],
  [`{ reactivate: -1 }`, "out-of-range", "reactivate"],
  [`{ limit: { running: -1 } }`, "out-of-range", "limit.running"],
  [`{ limit: { perMinute: "2" } }`, "wrong-type", "limit.perMinute"],
  [`{ limit: { perHour: 1 } }`, "unknown-key", "limit.perHour"],
  [`{ limit: 3 }`, "wrong-type", "limit"],
  [`{ pointers: "mouse" }`, "wrong-type", "pointers"],
  [`{ pointers: [3] }`, "wrong-type", "pointers[0]"],
  [`{ raw: 1 }`, "wrong-type", "raw"],
  [`{ load: "never" }`, "out-of-range", "load"],
  [`{ decorate: "yes" }`, "wrong-type", "decorate"],
  [`{ predictor: {} }`, "wrong-type", "predictor"],
  [`{ learning: "much" }`, "wrong-type", "learning"],
  [`{ learning: 0 }`, "out-of-range", "learning"],
  [`{ record: "yes" }`, "wrong-type", "record"],
  [`{ signal: {} }`, "wrong-type", "signal"],
  [`{ onIntent: "log" }`, "wrong-type", "onIntent"],
  [`{ onError: 1 }`, "wrong-type", "onError"],
];

/** Targets that are refused. */
const bounds = (text) => `{ id: "v", bounds: () => (${text}) }`;
const TARGETS = [
  [`"nav a["`, "out-of-range", "targets"],
  [`""`, "out-of-range", "targets"],
  [`5`, "wrong-type", "targets"],
  [`null`, "wrong-type", "targets"],
  [`[document.body, 5]`, "wrong-type", "targets[1]"],
  [`[{ id: "v" }]`, "missing-key", "targets[0].bounds"],
  [`[{ id: "v", bounds: 5 }]`, "wrong-type", "targets[0].bounds"],
  [`[{ bounds: () => ({ x: 0, y: 0, width: 1, height: 1 }) }]`, "missing-key", "targets[0].id"],
  [`[${bounds("{ x: NaN, y: 0, width: 1, height: 1 }")}]`, "not-finite", "targets[0].bounds().x"],
  [`[${bounds("{ x: 0, y: 0, width: NaN, height: 1 }")}]`, "not-finite", "targets[0].bounds().width"],
  [`[${bounds("{ x: 0, y: 0, width: 1 }")}]`, "missing-key", "targets[0].bounds().height"],
  [`[${bounds("null")}]`, "missing-key", "targets[0].bounds().x"],
  [
    `[${bounds("{ x: 0, y: 0, width: 1, height: 1 }")}, ${bounds("{ x: 0, y: 0, width: 1, height: 1 }")}]`,
    "duplicate-id",
    "target.id",
  ],
];

describe("errors", () => {
  const site = hosted();

  /** What each text throws, as `[name, code, path, message]`; null for nothing. */
  const thrown = (page, texts) =>
    page.evaluate(
      (texts) =>
        texts.map((text) => {
          try {
            new Function(text)();
            return null;
          } catch (error) {
            return [error.name, error.code, error.path, error.message];
          }
        }),
      texts,
    );

  /** Asserts that each of a table's calls throws with its code and path, in a message that begins with the path and has what is legal. */
  function assertThrown(results, table) {
    const found = results.map((result) => result?.slice(0, 3));
    assert.deepEqual(
      found.map((each, index) => [table[index][0], ...(each ?? ["nothing"])]),
      table.map(([text, code, path]) => [text, "WhitherError", code, path]),
    );
    for (const [, , path, message] of results)
      assert.ok(message.startsWith(`${path}: `) && message.length > path.length + 12, message);
  }

  it("are thrown by watch for each bad option", async () => {
    const { page, close } = await open(site, ROW);
    const html = await page.evaluate(() => document.documentElement.outerHTML);
    assertThrown(
      await thrown(
        page,
        OPTIONS.map(([options]) => `whither.watch("button", ${options})`),
      ),
      OPTIONS,
    );
    assert.equal(await page.evaluate(() => document.documentElement.outerHTML), html);
    await close();
  });

  it("are thrown by update for each bad option, and nothing has changed", async () => {
    const { page, step, close } = await scripted(site);
    assertThrown(
      await thrown(
        page,
        OPTIONS.map(([options]) => `watcher.update(${options})`),
      ),
      OPTIONS,
    );
    assertThrown(
      await thrown(page, [`watcher.update({ threshold: 0.1, rest: "long" })`]),
      [["", "wrong-type", "rest"]].map((each) => [...each]),
    );
    await step({});
    await step({ c: 0.79 });
    assert.deepEqual(await logged(page, "intent"), [], "the threshold is what it was");
    await step({ c: 0.8 });
    assert.equal((await logged(page, "intent")).length, 1);
    await close();
  });

  it("are thrown by watch for each bad target", async () => {
    const { page, close } = await open(site, ROW);
    assertThrown(
      await thrown(
        page,
        TARGETS.map(([targets]) => `whither.watch(${targets})`),
      ),
      TARGETS,
    );
    const [[, code, path]] = await thrown(page, [`whither.watch({ id: "v", bounds: 5 })`]);
    assert.deepEqual([code, path], ["wrong-type", "targets.bounds"]);
    await close();
  });

  it("are thrown by add, and nothing was added", async () => {
    const { page, close } = await open(site, ROW, { script: `window.watcher = record("button");` });
    const shape = bounds("{ x: 0, y: 0, width: 1, height: 1 }");
    const table = [
      [`"button"`, "wrong-type", "targets[0]"],
      [`document.body, null`, "wrong-type", "targets[1]"],
      [`document.body, { id: "v" }`, "missing-key", "targets[1].bounds"],
      [`document.body, ${shape}, ${shape}`, "duplicate-id", "target.id"],
      [`document.body, ${bounds("{ x: 0, y: NaN, width: 1, height: 1 }")}`, "not-finite", "targets[1].bounds().y"],
    ];
    assertThrown(
      await thrown(
        page,
        table.map(([targets]) => `watcher.add(${targets})`),
      ),
      table,
    );
    assert.equal(await page.evaluate(() => watcher.targets.length), 8);
    await close();
  });

  it("are thrown by set, and nothing has changed", async () => {
    const { page, step, close } = await scripted(site, `{ target: ({ id }) => ({ id }) }`);
    const c = `document.querySelector("#c")`;
    const table = [
      [`${c}, { colour: 1 }`, "unknown-key", "options.colour"],
      [`${c}, { threshold: 0 }`, "out-of-range", "options.threshold"],
      [`${c}, { threshold: 0.1, prior: "2" }`, "wrong-type", "options.prior"],
      [`${c}, { threshold: 0.1, id: "d" }`, "duplicate-id", "target.id"],
      [`${c}, 5`, "wrong-type", "options"],
      [`5, {}`, "unknown-id", "target"],
    ];
    assertThrown(
      await thrown(
        page,
        table.map(([given]) => `watcher.set(${given})`),
      ),
      table,
    );
    await step({});
    await step({ c: 0.5 });
    assert.deepEqual(await logged(page, "intent"), []);
    await close();
  });

  it("are thrown for ids that a function gives twice, and for what else it returns", async () => {
    const { page, close } = await open(site, ROW);
    const table = [
      [`() => ({ id: "same" })`, "duplicate-id", "target.id"],
      [`() => ({ prior: "much" })`, "wrong-type", "target.prior"],
      [`() => 5`, "wrong-type", "target"],
    ];
    assertThrown(
      await thrown(
        page,
        table.map(([target]) => `whither.watch("button", { target: ${target} })`),
      ),
      table,
    );
    await close();
  });

  it("go to onError where what goes wrong comes later: bounds that become NaN, ids that become the same", async () => {
    const { page, step, close } = await scripted(site, `{ target: ({ id }) => ({ id: id === "late" ? "c" : id }) }`);
    await page.evaluate(async () => {
      window.place = 300;
      watcher.add({ id: "v", bounds: () => ({ x: window.place, y: 20, width: 30, height: 30 }) });
      await frames(2);
      window.place = NaN;
      document.body.append(Object.assign(document.createElement("button"), { id: "late" }));
      await frames(3);
    });
    await step({});
    await step({ c: 0.9 });
    const errors = await logged(page, "error");
    assert.deepEqual(errors.map(({ code }) => code).sort(), ["duplicate-id", "not-finite"]);
    assert.deepEqual(
      (await logged(page, "intent")).map(({ target }) => target),
      ["c"],
    );
    await close();
  });

  it("go to onError once where the model refuses its constants, and every other reason goes on", async () => {
    const { page, close } = await open(site, ROW, {
      script: `window.watcher = record("button", { constants: { motion: { nois: 3 } } }); await watcher.ready; await frames(2);`,
    });
    await page.mouse.move(60, 600);
    for (let step = 0; step <= 10; step += 1) await page.mouse.move(60 + 29 * step, 600 - 25 * step);
    await page.waitForFunction(() => log.some(({ kind }) => kind === "intent"));
    const [intent] = await logged(page, "intent");
    assert.deepEqual([intent.target, intent.reason], ["c", "hover"]);
    assert.deepEqual(
      (await logged(page, "error")).map(({ code, path }) => [code, path]),
      [["unknown-key", "motion.nois"]],
    );
    await page.evaluate(() => watcher.update({ constants: { motion: { noise: 700 } } }));
    for (let step = 0; step <= 10; step += 1) await page.mouse.move(350 + 29 * step, 350 + 25 * step);
    await nextFrame(page);
    assert.notEqual(await page.evaluate(() => watcher.best), null);
    await close();
  });

  describe("of callbacks", () => {
    const throwing = `(name) => () => { throw new RangeError("from " + name); }`;

    it("go to onError, and the watcher goes on", async () => {
      const { page, step, close } = await scripted(
        site,
        `{ onIntent: (${throwing})("onIntent"), onRelease: (${throwing})("onRelease"), onPrediction: (${throwing})("onPrediction"),
           onOutcome: (${throwing})("onOutcome") }`,
      );
      await page.evaluate(() =>
        watcher.subscribe(() => {
          throw new RangeError("from a listener");
        }),
      );
      await step({});
      await step({ c: 0.9 });
      await step({ d: 0.9 });
      await page.evaluate(() => {
        point("pointerdown", [performance.now(), 450, 350]);
        point("pointerup", [performance.now(), 450, 350]);
      });
      await nextFrame(page);
      const errors = (await logged(page, "error")).map(({ message }) => message);
      for (const name of ["onIntent", "onRelease", "onPrediction", "onOutcome", "a listener"]) {
        assert.ok(errors.includes(`from ${name}`), `${name}: ${errors}`);
      }
      assert.equal(errors.filter((message) => message === "from onIntent").length, 2, "once for each call");
      assert.equal(await page.evaluate(() => watcher.ledger.outcomes.length), 1);
      await close();
    });

    it("are reported once as uncaught errors where there is no onError", async () => {
      const error = `window.error ??= new RangeError("from the page")`;
      const { page, problems, step, close } = await scripted(
        site,
        `{ onError: undefined, onIntent: () => { throw (${error}); } }`,
      );
      await step({});
      await step({ c: 0.9 });
      await step({ d: 0.9 });
      await step({ e: 0.9 });
      assert.deepEqual(problems, ["error: from the page"]);
      assert.equal((await page.evaluate(() => watcher.getSnapshot().intended.map(nameOf))).at(-1), "e");
      problems.length = 0;
      await close();
    });

    it("that onError itself throws are reported, and the watcher goes on", async () => {
      const { page, problems, step, close } = await scripted(
        site,
        `{ onIntent: () => { throw new RangeError("first"); }, onError: (error) => { throw new TypeError("of " + error.message); } }`,
      );
      await step({});
      await step({ c: 0.9 });
      await nextFrame(page);
      assert.ok(problems.length >= 1 && problems.every((problem) => /first/.test(problem)), problems.join());
      problems.length = 0;
      await close();
    });

    it("of the function target come at once from watch, and to onError for what is added later", async () => {
      const { page, close } = await open(site, ROW);
      const results = await thrown(page, [`whither.watch("button", { target: () => { throw new RangeError("from target"); } })`]);
      assert.deepEqual([results[0][0], results[0][3]], ["RangeError", "from target"]);
      await page.evaluate(async () => {
        window.watcher = record("button", {
          target: ({ id }) => {
            if (id === "late") throw new RangeError("from target");
            return {};
          },
        });
        document.body.append(Object.assign(document.createElement("button"), { id: "late" }));
        await frames(3);
      });
      assert.deepEqual(
        (await logged(page, "error")).map(({ message }) => message),
        ["from target"],
      );
      await close();
    });
  });
});
