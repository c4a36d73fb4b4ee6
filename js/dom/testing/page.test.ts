// The page without a browser, and a watcher on it from the first movement to the stop.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Intent, Outcome } from "../types.js";
import { init, PointerPredictor } from "#pointing";
import { Clock } from "./clock.js";
import { TestPage } from "./page.js";

await init();
const core = (targets: never, options: never) => new PointerPredictor(targets, options);

describe("a clock", () => {
  test("runs what is due in the order of its time, and of asking", () => {
    const clock = new Clock();
    const ran: string[] = [];
    clock.wait(20, () => ran.push(`20 at ${clock.now}`));
    clock.wait(10, () => ran.push(`10 at ${clock.now}`));
    clock.wait(10, () => ran.push("10 again"));
    clock.wait(15, () => ran.push("never"))();
    clock.advance(9);
    assert.deepEqual(ran, []);
    clock.advance(11);
    assert.deepEqual(ran, ["10 at 10", "10 again", "20 at 20"]);
    assert.equal(clock.pending, 0);
  });

  test("has 60 frames a second, and asks for the next one in a frame", () => {
    const clock = new Clock();
    let frames = 0;
    const again = () => {
      frames++;
      clock.frame(again);
    };
    clock.frame(again);
    clock.advance(1000);
    assert.equal(frames, 60);
  });
});

describe("a page without a browser", () => {
  test("leads a watcher from a movement to an intent, a press and an outcome, and nothing is left", async () => {
    const page = new TestPage({ core });
    const [left, right] = [100, 700].map((x) => page.append("button", { x, y: 280, width: 40, height: 40 }));
    const intents: Intent[] = [];
    const outcomes: Outcome[] = [];
    const watcher = page.watch("button", {
      load: "eager",
      onIntent: (intent) => intents.push(intent),
      onOutcome: (outcome) => outcomes.push(outcome),
    });
    assert.deepEqual(watcher.targets, [left, right]);
    await watcher.ready;
    page.advance(50);
    for (let x = 400; x <= 710; x += 10) {
      page.point("pointermove", x, 300);
      page.advance(10);
      if (x === 600) assert.ok(watcher.probability(right as Element) > 0.8);
    }
    page.point("pointerdown", 710, 300);
    assert.deepEqual(
      intents.map(({ target, reason }) => [target, reason]),
      [[right, "pointer"]],
    );
    assert.equal(outcomes[0]?.verdict, "right");
    assert.ok(page.listening > 0);
    watcher.stop();
    assert.deepEqual([page.listening, page.clock.pending, page.errors], [0, 0, []]);
    assert.equal((right as HTMLElement).style.length, 0);
  });

  test("hides, covers and removes elements", async () => {
    const page = new TestPage({ core });
    const button = page.append("button", { x: 300, y: 0, width: 40, height: 40 });
    const watcher = page.watch("button", { load: "eager" });
    await watcher.ready;
    let x = 0;
    const probability = () => {
      for (let i = 0; i < 5; i++) {
        page.point("pointermove", (x += 5), 20);
        page.advance(20);
      }
      return watcher.probability(button);
    };
    assert.ok(probability() > 0.5);
    page.show(button, false);
    assert.equal(probability(), 0);
    page.show(button, true);
    assert.ok(probability() > 0.5);
    const cover = page.append("div", { x: 290, y: 0, width: 100, height: 100 });
    assert.equal(probability(), 0);
    page.remove(cover);
    assert.ok(probability() > 0.5);
    page.remove(button);
    assert.equal(probability(), 0);
    assert.deepEqual(watcher.targets, []);
    watcher.stop();
  });
});
