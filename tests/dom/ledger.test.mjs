// What came of the movements that ended in a press: outcomes, their numbers, and the lines that learning reads.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { root } from "../../scripts/run.mjs";
import { movement } from "../browser/hand.mjs";
import { AWAY, CORNERS, hosted, logged, MIDDLE, mouse, nextFrame, open, REST, scripted } from "./page.mjs";

const READY = `window.watcher = record("button"); await watcher.ready; await frames(2);`;
const summary = (page) => page.evaluate(() => watcher.ledger.summary());

describe("ledger", () => {
  const site = hosted();

  it("has an outcome for each press, right, wrong or unsure, and their shares", async () => {
    const { page, close } = await open(site, CORNERS, {
      script: `window.watcher = record("button", {
          target: ({ id }) => ({ name: "Button " + id, data: { of: id } }),
        });
        await watcher.ready; await frames(2);`,
    });
    assert.equal(await summary(page), null);
    const hand = await mouse(page);
    const begin = async () => {
      await hand.play([[0, AWAY.x, AWAY.y]]);
      await hand.rest(REST);
    };

    await begin();
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1 }));
    const before = await page.evaluate(() => performance.now());
    await hand.press(MIDDLE.b);
    await nextFrame(page);
    const [right] = await logged(page, "outcome");
    assert.deepEqual(
      [right.target, right.id, right.name, right.data, right.pointerType, right.verdict, right.mistaken],
      ["b", "b", "Button b", { of: "b" }, "mouse", "right", null],
    );
    assert.ok(right.lead > 0.1 && right.lead < 1, `${right.lead}`);
    assert.ok(right.probability > 0.8 && right.probability <= 1, `${right.probability}`);
    assert.ok(Math.abs(right.pressedAt - before) < 250, `${right.pressedAt} and ${before}`);

    await begin();
    const there = movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.75 });
    const [turn, x, y] = there.at(-1);
    const back = movement({ x, y }, MIDDLE.c, 60, { seed: 2 });
    await hand.play([...there, ...back.slice(1).map(([time, ...place]) => [turn + time, ...place])]);
    await hand.press(MIDDLE.c);
    await nextFrame(page);
    const wrong = (await logged(page, "outcome"))[1];
    assert.deepEqual([wrong.target, wrong.verdict, wrong.mistaken], ["c", "wrong", "b"]);
    assert.ok(wrong.lead > 0 && wrong.lead < back.at(-1)[0] + 0.2, `${wrong.lead}`);

    await page.evaluate(() => watcher.update({ threshold: 1, reasons: { hover: false } }));
    await begin();
    await hand.play(movement(AWAY, MIDDLE.a, 60, { seed: 3 }));
    await hand.press(MIDDLE.a);
    await nextFrame(page);
    const unsure = (await logged(page, "outcome"))[2];
    assert.deepEqual([unsure.target, unsure.verdict, unsure.mistaken, unsure.lead], ["a", "unsure", null, 0]);

    const { presses, right: share, wrong: mistakes, lead, calibration } = await summary(page);
    assert.deepEqual([presses, share, mistakes], [3, 1 / 3, 1 / 3]);
    const leads = (await logged(page, "outcome")).map((outcome) => outcome.lead).sort((one, other) => one - other);
    assert.ok(leads.includes(lead) || Math.abs(lead - (right.lead + wrong.lead) / 2) < 1e-9, `${lead} of ${leads}`);
    assert.ok(calibration >= 0 && calibration <= 1, `${calibration}`);
    await close();
  });

  it("counts a press after a rest with the movement before it", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    await hand.play([[0, AWAY.x, AWAY.y]]);
    await hand.rest(REST);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1 }));
    await hand.rest(0.6);
    await hand.play([0, 1, 2, 3].map((k) => [k / 50, MIDDLE.b.x + 4 * (k % 2), MIDDLE.b.y]));
    await hand.press(MIDDLE.b);
    await nextFrame(page);
    const [{ verdict, lead, probability }] = await logged(page, "outcome");
    assert.equal(verdict, "right");
    assert.ok(lead > 0.6, `${lead}`);
    assert.ok(probability > 0.8, `${probability}`);
    await close();
  });

  it("counts neither a press on no target nor a click without a pointer", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    await hand.play(movement(AWAY, { x: 500, y: 400 }, 60, { seed: 1 }));
    await hand.press({ x: 500, y: 400 });
    await page.evaluate(() => document.querySelector("#a").click());
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    await nextFrame(page);
    assert.deepEqual([await logged(page, "outcome"), await summary(page)], [[], null]);
    await close();
  });

  it("counts a press on what is inside of a target, and two pointers each by itself", async () => {
    const { page, step, press, close } = await scripted(site);
    await page.evaluate(() => (document.querySelector("#c").innerHTML = "<i style='display:block;height:50px'>inner</i>"));
    await step({});
    await step({ c: 0.9 });
    await page.evaluate(() => {
      const pen = { pointerId: 12, pointerType: "pen" };
      for (const y of [600, 550, 500]) point("pointermove", [performance.now(), 550, y], pen);
      window.press(550, 350, pen);
    });
    await press({ x: 350, y: 350 });
    assert.deepEqual(
      (await logged(page, "outcome")).map(({ target, verdict, pointerType }) => [target, verdict, pointerType]),
      [
        ["e", "unsure", "pen"],
        ["c", "right", "mouse"],
      ],
    );
    await close();
  });

  it("counts no press that no movement led to: another one on the same target", async () => {
    const { page, step, press, close } = await scripted(site);
    await step({});
    await step({ c: 0.9 });
    for (let k = 0; k < 3; k += 1) await press({ x: 350, y: 350 });
    assert.deepEqual(
      (await logged(page, "outcome")).map(({ verdict }) => verdict),
      ["right"],
    );
    await close();
  });

  it("keeps the last thousand outcomes", async () => {
    const { page, close } = await scripted(site);
    const result = await page.evaluate(async () => {
      for (let k = 0; k < 1010; k += 1) {
        const x = 150 + 100 * (k % 8);
        for (const y of [600, 550, 500]) point("pointermove", [performance.now(), x, y]);
        press(x, 350);
      }
      await frames(2);
      const { outcomes } = watcher.ledger;
      return { length: outcomes.length, first: outcomes[0].target.id, last: outcomes.at(-1).target.id };
    });
    // the first ten are gone; a b c ... in turn
    assert.deepEqual(result, { length: 1000, first: "c", last: "b" });
    await close();
  });

  it("is plain data as JSON, without elements", async () => {
    const { page, step, press, close } = await scripted(site);
    await step({});
    await step({ c: 0.9 });
    await press({ x: 350, y: 350 });
    const text = await page.evaluate(() => JSON.stringify(watcher.ledger));
    const { outcomes, summary: numbers } = JSON.parse(text);
    assert.equal(numbers.presses, 1);
    assert.equal(outcomes.length, 1);
    const [{ id, verdict, pointerType, probability }] = outcomes;
    assert.deepEqual([id, verdict, pointerType, probability], ["c", "right", "mouse", 0.9]);
    assert.ok(
      Object.values(outcomes[0]).every((value) => value === null || typeof value !== "object"),
      text,
    );
    await close();
  });

  it("has no lines unless it records", async () => {
    const { page, close } = await open(site, CORNERS, { script: READY });
    const hand = await mouse(page);
    await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.9 }));
    await hand.press(MIDDLE.b);
    await nextFrame(page);
    assert.deepEqual(await page.evaluate(() => watcher.ledger.lines()), []);
    await close();
  });

  it("records lines that fit learns from and npm run evaluate reads", async () => {
    const { page, close } = await open(site, CORNERS, {
      script: `window.watcher = record("button", { record: true }); await watcher.ready; await frames(2);`,
    });
    const goals = Object.entries(MIDDLE);
    const hands = Array.from({ length: 12 }, (_, k) => {
      const [name, goal] = goals[k % 3];
      const from = goals[(k + 1) % 3][1];
      return { name, goal, samples: movement({ x: from.x - 60, y: from.y + 60 }, goal, 60, { seed: k + 1 }) };
    });
    const lines = await page.evaluate(async (hands) => {
      for (const { goal, samples } of hands) {
        const start = performance.now();
        stroke(samples, start);
        await frames(2);
        press(goal.x, goal.y);
        await frames(2);
      }
      return watcher.ledger.lines();
    }, hands);
    assert.equal(lines.length, 12);
    const tracks = lines.map((line) => JSON.parse(line));
    for (const [k, { targets, target, samples }] of tracks.entries()) {
      const { goal, samples: hand } = hands[k];
      assert.equal(targets.length, 3);
      assert.deepEqual(targets[target].map(Math.round), [goal.x, goal.y, 80, 60]);
      assert.ok(samples.length >= 0.8 * hand.length && samples.length <= hand.length + 1, `${samples.length} of ${hand.length}`);
      for (const [i, [time]] of samples.entries()) if (i > 0) assert.ok(time >= samples[i - 1][0]);
      const [, x, y] = samples.at(-1);
      assert.ok(Math.abs(x - goal.x) < 40 && Math.abs(y - goal.y) < 30);
    }
    const fitted = await page.evaluate(async (tracks) => {
      const [{ fit }, { init, pointerScenario }] = await Promise.all([import("./study.js"), import("./index.js")]);
      await init();
      const scenario = pointerScenario([{ id: "a", x: 0, y: 0, width: 1, height: 1 }]);
      return fit(tracks, scenario, { constants: ["pointing.power.to"], evaluations: 2 });
    }, tracks);
    assert.equal(fitted.tracks, 12);
    await page.evaluate(({ pointing, motion }) => watcher.update({ constants: { pointing, motion } }), fitted.scenario);

    const folder = mkdtempSync(join(tmpdir(), "ledger-"));
    try {
      writeFileSync(join(folder, "page.jsonl"), `${lines.join("\n")}\n`);
      const report = execFileSync("node", ["scripts/tool.mjs", "evaluate", join(folder, "page.jsonl")], {
        cwd: root,
        encoding: "utf8",
      });
      assert.match(report, /\b12\b/);
    } finally {
      rmSync(folder, { recursive: true });
    }
    await close();
  });

  describe("learning", () => {
    /** The shares of the priors that the model was given last. */
    const priors = (page) =>
      page.evaluate(() => {
        const sum = scriptedPredictor.given.reduce((total, { prior }) => total + prior, 0);
        return scriptedPredictor.given.map(({ prior }) => prior / sum);
      });

    for (const [learning, share] of [
      // of the presses that the priors are worth 1/8, and all of those there were
      ["8", 9 / 16],
      ["undefined", 1 / 8],
    ]) {
      it(`has a prior of ${share} for what was pressed eight times, with learning: ${learning}`, async () => {
        const { page, step, press, close } = await scripted(site, `{ learning: ${learning} }`);
        await step({});
        await step({});
        assert.deepEqual(await priors(page), new Array(8).fill(1 / 8));
        for (let k = 0; k < 8; k += 1) {
          await page.evaluate(() => {
            for (const y of [600, 550, 500]) point("pointermove", [performance.now(), 350, y]);
          });
          await press({ x: 350, y: 350 });
        }
        await step({});
        await step({});
        const after = await priors(page);
        assert.ok(Math.abs(after[2] - share) < 1e-9, String(after));
        for (const [index, prior] of after.entries()) if (index !== 2) assert.ok(Math.abs(prior - (1 - share) / 7) < 1e-9);
        await close();
      });
    }
  });
});
