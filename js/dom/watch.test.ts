// A watcher without a browser: what its callbacks may do, and what another model is for.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { init, PointerPredictor } from "#pointing";
import { TestPage } from "./testing/page.js";
import type { MakePredictor, PredictedTarget, Predictor, Watcher, WatchOptions } from "./types.js";

await init();
const core: MakePredictor = (targets, options) => new PointerPredictor(targets, options);

/** A page with two buttons, the pointer between them; `head` moves it to the right one. */
async function page(options: WatchOptions) {
  const page = new TestPage({ core });
  const [left, right] = [100, 700].map((x) => page.append("button", { x, y: 280, width: 40, height: 40 }));
  const watcher: Watcher = page.watch("button", { load: "eager", ...options });
  await watcher.ready;
  const head = (from = 400, to = 690) => {
    for (let x = from; Math.abs(x - to) > 5; x += Math.sign(to - from) * 10) {
      page.point("pointermove", x, 300);
      page.advance(10);
    }
  };
  return { page, watcher, left, right, head };
}

/** A model that is sure of one target. */
function sureOf(index: number, made: Predictor[] = []): MakePredictor {
  return (targets) => {
    let list: readonly PredictedTarget[] = targets;
    const predictor: Predictor = {
      observe() {},
      probabilities: (into = new Float64Array(list.length)) => into.fill(0).fill(0.9, index, index + 1),
      none: 0.1,
      remaining: null,
      forecast: () => null,
      path: () => new Float64Array(0),
      setTargets(next) {
        list = next;
      },
      reset() {},
      free() {
        made.splice(made.indexOf(predictor), 1);
      },
    };
    made.push(predictor);
    return predictor;
  };
}

describe("a watcher", () => {
  for (const ending of ["onIntent", "onRelease", "onPrediction"] as const) {
    test(`may be stopped by ${ending}, and nothing is left`, async () => {
      const signals: AbortSignal[] = [];
      const {
        page: at,
        watcher,
        right,
        head,
      } = await page({
        onIntent: ({ signal }) => signals.push(signal),
        [ending]: (detail: { signal?: AbortSignal }) => {
          if (detail.signal) signals.push(detail.signal);
          watcher.stop();
        },
      });
      head();
      head(690, 150);
      assert.deepEqual([at.listening, at.clock.pending, at.errors], [0, 0, []]);
      assert.equal((right as HTMLElement).getAttribute("data-predicted"), null);
      assert.equal((right as HTMLElement).style.length, 0);
      assert.ok(signals.every(({ aborted }) => aborted));
      assert.equal(watcher.best, null);
    });
  }

  test("may lose a target in its onIntent: the signal aborts, and it is not intended any more", async () => {
    const signals: AbortSignal[] = [];
    const { watcher, right, head, left } = await page({
      onIntent: ({ target, signal }) => {
        signals.push(signal);
        watcher.remove(target);
      },
    });
    head();
    assert.deepEqual([watcher.targets, watcher.getSnapshot().intended], [[left], []]);
    assert.equal(signals[0]?.aborted, true);
    assert.equal((right as HTMLElement).getAttribute("data-predicted"), null);
  });

  test("does not intend the only target unless the movement goes there", async () => {
    const at = new TestPage({ core });
    const target = at.append("button", { x: 100, y: 280, width: 40, height: 40 });
    const intents: unknown[] = [];
    const watcher = at.watch("button", { load: "eager", onIntent: (intent) => intents.push(intent.target) });
    await watcher.ready;
    const go = (from: number, to: number) => {
      for (let x = from; Math.abs(x - to) > 5; x += Math.sign(to - from) * 10) {
        at.point("pointermove", x, 300);
        at.advance(10);
      }
    };
    go(400, 900);
    assert.deepEqual(intents, []);
    at.advance(1000);
    go(900, 300);
    assert.deepEqual(intents, [target]);
    watcher.stop();
  });

  test("predicts by another model, and by the core when that is given up, without losing the movement", async () => {
    const made: Predictor[] = [];
    const { page: at, watcher, left, right, head } = await page({ predictor: sureOf(0, made) });
    head(400, 600);
    assert.equal(watcher.best?.target, left);
    watcher.update({ predictor: undefined });
    await Promise.resolve();
    at.point("pointermove", 610, 300);
    at.advance(20);
    await Promise.resolve();
    await Promise.resolve();
    at.point("pointermove", 620, 300);
    at.advance(20);
    assert.equal(watcher.best?.target, right);
    assert.ok((watcher.best?.probability ?? 0) > 0.8);
    assert.deepEqual([made, at.errors], [[], []]);
    watcher.stop();
  });

  test("predicts the first movement though the core comes late", async () => {
    const at = new TestPage({ core });
    const target = at.append("button", { x: 700, y: 280, width: 40, height: 40 });
    const watcher = at.watch("button");
    for (let x = 400; x <= 650; x += 10) {
      at.point("pointermove", x, 300);
      at.advance(5);
    }
    assert.equal(watcher.best, null);
    await watcher.ready;
    at.advance(20);
    assert.equal(watcher.best?.target, target);
    watcher.stop();
  });

  test("keeps an intent while one of its signs holds: a target that it is over does not turn it away", async () => {
    const released: unknown[] = [];
    const { page: at, watcher, right, head } = await page({ onRelease: ({ target }) => released.push(target) });
    head(400, 720);
    assert.deepEqual(watcher.getSnapshot().intended, [right]);
    // it rests there, and goes on
    at.advance(1000);
    assert.deepEqual([watcher.getSnapshot().moving, watcher.getSnapshot().intended, released], [false, [right], []]);
    head(720, 400);
    assert.deepEqual(released, [right]);
  });
});
