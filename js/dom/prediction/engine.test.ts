import assert from "node:assert/strict";
import { describe, it } from "node:test";
import type { Outcome } from "../ledger.js";
import { readOptions } from "../options.js";
import type { Target } from "../targets.js";
import { TestPage } from "../testing/page.js";
import type { MakePredictor, PredictedTarget, WatchOptions } from "../types.js";
import { init, PointerPredictor } from "#pointing";
import { Engine, PointerPosterior } from "./engine.js";
import { Movement } from "./movements.js";

await init();
const core: MakePredictor = (targets, options) => new PointerPredictor(targets, options as never);

const target = (key: string, x: number, prior?: number): Target =>
  ({ key, node: { id: key }, settings: { prior }, box: { x, y: 0, width: 40, height: 20 } }) as never;

const [left, right] = [target("left", 0), target("right", 600)];

/** A movement from 300 px to the right, of so many samples. */
function movement(count: number): Movement {
  const made = new Movement({ time: 0, x: 300, y: 10 }, []);
  for (let step = 0; step < count; step++) made.add(sample(step));
  return made;
}

const sample = (step: number) => ({ time: 0.01 * step, x: 300 + 10 * step, y: 10 });

/** A core that logs what its predictors are asked. */
function logged() {
  const log: string[] = [];
  let made = 0;
  const make: MakePredictor = (targets) => {
    const name = made++;
    log.push(`${name} made of ${targets.length}`);
    let count = targets.length;
    return {
      none: 0.25,
      remaining: null,
      observe: (time) => log.push(`${name} observes ${time}`),
      probabilities: (into = new Float64Array(count)) => into.fill(0.75 / count),
      setTargets(next: readonly PredictedTarget[]) {
        count = next.length;
        log.push(`${name} set ${next.map(({ id }) => id).join(" ")}`);
      },
      reset: () => log.push(`${name} reset`),
      free: () => log.push(`${name} freed`),
    } as never;
  };
  return { log, make, take: () => log.splice(0) };
}

/** An engine, with options that may be replaced; `load` loads a core later. */
function open({
  made = null,
  load,
  options = {},
}: {
  made?: MakePredictor | null;
  load?: () => Promise<MakePredictor>;
  options?: WatchOptions;
}) {
  let settings = readOptions({ root: { querySelectorAll() {} } as never, ...options });
  const errors: unknown[] = [];
  const engine = new Engine(
    () => settings,
    made,
    load ?? (() => assert.fail("nothing is to be loaded")),
    (error) => errors.push(error),
  );
  const update = (other: WatchOptions) => {
    settings = readOptions({ root: { querySelectorAll() {} } as never, ...other });
  };
  const list = (active: readonly Target[]) => engine.list(active, settings.learning, () => 0);
  return { engine, errors, list, update };
}

describe("posterior of a pointer", () => {
  it("has the probabilities of the core, in the order of the targets, and the best of them", () => {
    const { engine, list } = open({ made: core });
    const posterior = new PointerPosterior(engine);
    const active = [left, right];
    assert.ok(posterior.compute(movement(20), active, list(active)));
    assert.ok(posterior.probability(right) > 0.8 && posterior.probability(left) < 0.1);
    assert.equal(posterior.best(), right);
    assert.ok(Math.abs(posterior.probability(left) + posterior.probability(right) + posterior.none - 1) < 1e-9);
    assert.equal(posterior.probability(target("other", 0)), 0);
    assert.equal(posterior.last, sample(19).time);
    posterior.free();
  });

  it("of a movement observed piece by piece is that of all of it at once, to the bit", () => {
    const { engine, list } = open({ made: core });
    const active = [left, right];
    const [pieces, once] = [new PointerPosterior(engine), new PointerPosterior(engine)];
    const growing = movement(1);
    pieces.compute(growing, active, list(active));
    for (let step = 1; step < 20; step++) {
      growing.add(sample(step));
      if (step % 3 === 0) pieces.compute(growing, active, list(active));
    }
    pieces.compute(growing, active, list(active));
    once.compute(movement(20), active, list(active));
    assert.deepEqual(pieces.probabilities, once.probabilities);
    for (const each of [pieces, once]) each.free();
  });

  it("observes each sample once, and begins afresh with each movement", () => {
    const { make, take } = logged();
    const { engine, list } = open({ made: make });
    const posterior = new PointerPosterior(engine);
    const active = [left];
    const first = movement(2);
    posterior.compute(first, active, list(active));
    first.add(sample(2));
    posterior.compute(first, active, list(active));
    posterior.compute(movement(1), active, list(active));
    assert.deepEqual(take(), [
      "0 made of 1",
      "0 reset",
      "0 observes 0",
      "0 observes 0.01",
      "0 observes 0.02",
      "0 reset",
      "0 observes 0",
    ]);
  });

  it("has what was sampled before the core was loaded", async () => {
    const { make, take } = logged();
    let loads = 0;
    const load = () => {
      loads++;
      return Promise.resolve(make);
    };
    const { engine, list } = open({ load });
    const posterior = new PointerPosterior(engine);
    const active = [left];
    const growing = movement(2);
    assert.equal(posterior.compute(growing, active, list(active)), false);
    assert.equal(posterior.compute(growing, active, list(active)), false);
    await new Promise(setImmediate);
    growing.add(sample(2));
    assert.equal(posterior.compute(growing, active, list(active)), true);
    assert.deepEqual([loads, take()], [1, ["0 made of 1", "0 reset", "0 observes 0", "0 observes 0.01", "0 observes 0.02"]]);
  });

  it("gives its predictor other targets only where these have changed", () => {
    const { make, take } = logged();
    const { engine, list } = open({ made: make });
    const posterior = new PointerPosterior(engine);
    const way = movement(1);
    const both = [left, right];
    for (let frame = 0; frame < 3; frame++) posterior.compute(way, both, list(both));
    assert.deepEqual(take(), ["0 made of 2", "0 reset", "0 observes 0"]);
    const one = [right];
    for (let frame = 0; frame < 3; frame++) posterior.compute(way, one, list(one));
    assert.deepEqual(take(), ["0 set right"]);
    assert.deepEqual([posterior.probability(left), posterior.probability(right)], [0, 0.75]);
    engine.relist();
    posterior.compute(way, one, list(one));
    assert.deepEqual(take(), ["0 set right"]);
  });

  it("has no best target where there is none", () => {
    const { engine, list } = open({ made: core });
    const posterior = new PointerPosterior(engine);
    assert.equal(posterior.best(), null);
    const nothing: Target[] = [];
    assert.equal(posterior.compute(movement(5), nothing, list(nothing)), true);
    assert.deepEqual([posterior.best(), posterior.none], [null, 1]);
    posterior.free();
  });
});

describe("predictors", () => {
  it("of a finger that is gone are those of the next one, and one is kept", () => {
    const { make, take } = logged();
    const { engine, list } = open({ made: make });
    const both = [left, right];
    const fingers = [0, 1].map(() => new PointerPosterior(engine));
    for (const finger of fingers) finger.compute(movement(0), both, list(both));
    assert.deepEqual(take(), ["0 made of 2", "0 reset", "1 made of 2", "1 reset"]);
    for (const finger of fingers) finger.free();
    assert.deepEqual(take(), ["1 freed"]);
    const one = [right];
    new PointerPosterior(engine).compute(movement(1), one, list(one));
    assert.deepEqual(take(), ["0 set right", "0 reset", "0 observes 0"]);
  });

  it("are made anew with other options, for a movement under way too, and all are freed", () => {
    const { make, take } = logged();
    const { engine, list } = open({ made: make });
    const active = [left];
    const [one, other] = [new PointerPosterior(engine), new PointerPosterior(engine)];
    const way = movement(1);
    one.compute(way, active, list(active));
    other.compute(movement(0), active, list(active));
    other.free();
    take();
    engine.renew();
    assert.deepEqual(take(), ["1 freed"]);
    one.compute(way, active, list(active));
    assert.deepEqual(take(), ["0 freed", "2 made of 1", "2 reset", "2 observes 0"]);
    engine.renew();
    one.free();
    one.free();
    assert.deepEqual(take(), ["2 freed"]);
  });

  it("are the options' in place of the core's, and the core is loaded where they no longer are", async () => {
    const [own, loaded] = [logged(), logged()];
    const { engine, list, update } = open({ load: () => Promise.resolve(loaded.make), options: { predictor: own.make } });
    const posterior = new PointerPosterior(engine);
    const active = [left];
    const way = movement(0);
    assert.equal(posterior.compute(way, active, list(active)), true);
    update({});
    engine.renew();
    assert.equal(posterior.compute(way, active, list(active)), false);
    await new Promise(setImmediate);
    assert.equal(posterior.compute(way, active, list(active)), true);
    assert.deepEqual(
      [own.take(), loaded.take()],
      [
        ["0 made of 1", "0 reset", "0 freed"],
        ["0 made of 1", "0 reset"],
      ],
    );
  });

  it("that are refused are asked for once, until the options are others", () => {
    let asked = 0;
    const refusing: MakePredictor = () => {
      asked++;
      throw new Error("refused");
    };
    const { engine } = open({ made: refusing });
    assert.throws(() => engine.borrow([]), { message: "refused" });
    assert.equal(engine.borrow([]), null);
    assert.equal(asked, 1);
    engine.renew();
    assert.throws(() => engine.borrow([]), { message: "refused" });
  });

  it("whose core cannot be loaded are reported, once", async () => {
    const error = new Error("offline");
    const { engine, errors } = open({ load: () => Promise.reject(error) });
    engine.borrow([]);
    await new Promise(setImmediate);
    assert.equal(engine.borrow([]), null);
    await new Promise(setImmediate);
    assert.deepEqual(errors, [error]);
  });

  it("are given what the options have for them", () => {
    let given: unknown;
    const make: MakePredictor = (_, options) => {
      given = options;
      return core([], { none: 0, constants: undefined, learning: false });
    };
    const constants = {} as never;
    open({ made: make, options: { none: 0.2, constants, learning: 3 } })
      .engine.borrow([])
      ?.free();
    assert.deepEqual(given, { none: 0.2, constants, learning: true });
  });
});

describe("targets of a predictor", () => {
  const [rare, often] = [target("rare", 0, 1), target("often", 600, 3)];

  it("have their centre, size and prior, by default 1", () => {
    const { list } = open({});
    assert.deepEqual(list([often, left]), [
      { id: "often", x: 620, y: 10, width: 40, height: 20, prior: 3 },
      { id: "left", x: 20, y: 10, width: 40, height: 20, prior: 1 },
    ]);
  });

  it("are the same list until what can be pointed at has changed, or priors may have", () => {
    const { engine, list } = open({});
    const active = [rare, often];
    const first = list(active);
    assert.equal(list(active), first);
    assert.notEqual(list([rare, often]), first);
    const again = list(active);
    engine.relist();
    assert.notEqual(list(active), again);
  });

  it("have priors (learning a_i + n_i) / (learning + sum n), but for what is common to them", () => {
    const { engine } = open({});
    const presses = (each: Target) => (each === rare ? 2 : 0);
    const [a, b] = engine.list([rare, often], 4, presses).map(({ prior }) => prior) as [number, number];
    // of 4: 1 and 3, by the shares 1/4 and 3/4; and 2 presses
    assert.ok(Math.abs(a / (a + b) - 0.5) < 1e-12);
    assert.ok(Math.abs(b / (a + b) - 0.5) < 1e-12);
    engine.relist();
    assert.deepEqual(
      engine.list([rare, often], null, presses).map(({ prior }) => prior),
      [1, 3],
    );
  });
});

describe("a watcher's predictors", () => {
  const BOX = { x: 600, y: 280, width: 40, height: 40 };

  it("observe the movement from its first sample on, which was before anything was loaded", async () => {
    const { make, log } = logged();
    const page = new TestPage({ core: make });
    page.append("button", BOX);
    const watcher = page.watch("button");
    for (let x = 0; x < 100; x += 20) {
      page.point("pointermove", x, 300);
      page.advance(10);
    }
    await watcher.ready;
    page.advance(20);
    const times = log.filter((line) => line.includes("observes")).map((line) => Number(line.split(" ").at(-1)));
    assert.deepEqual(times, [0, 0.01, 0.02, 0.03, 0.04]);
    watcher.stop();
  });

  it("serve one finger after the other, and are freed at the end", async () => {
    const { make, log, take } = logged();
    const page = new TestPage({ core: make });
    page.append("button", BOX);
    const watcher = page.watch("button", { load: "eager" });
    await watcher.ready;
    for (let pointerId = 10; pointerId < 15; pointerId++) {
      const finger = { pointerId, pointerType: "touch" };
      page.point("pointerdown", 100, 300, finger);
      for (let x = 100; x < 200; x += 20) {
        page.point("pointermove", x, 300, finger);
        page.advance(16);
      }
      page.point("pointerup", 200, 300, finger);
      page.advance(16);
    }
    assert.equal(log.filter((line) => line.includes("made")).length, 1);
    assert.equal(take().filter((line) => line.includes("freed")).length, 0);
    watcher.stop();
    assert.deepEqual(take(), ["0 freed"]);
  });

  it("learn what is pressed where that is asked for", async () => {
    const press = async (learning: boolean) => {
      const priors: number[][] = [];
      const make: MakePredictor = (targets, options) => {
        priors.push(targets.map(({ prior }) => prior));
        const made = core(targets, options);
        const setTargets = made.setTargets.bind(made);
        made.setTargets = (next) => {
          priors.push(next.map(({ prior }) => prior));
          setTargets(next);
        };
        return made;
      };
      const page = new TestPage({ core: make });
      page.append("button", { ...BOX, x: 0 }, { attributes: { id: "left" } });
      page.append("button", BOX, { attributes: { id: "right" } });
      const watcher = page.watch("button", { load: "eager", learning });
      await watcher.ready;
      page.advance(20);
      for (let visit = 0; visit < 2; visit++) {
        for (let x = 300; x <= 620; x += 20) {
          page.point("pointermove", x, 300);
          page.advance(10);
        }
        page.point("pointerdown", 620, 300);
        page.advance(1000);
      }
      watcher.stop();
      const [a, b] = priors.at(-1) as [number, number];
      return b / (a + b);
    };
    // 2.5 of 5 before the press, and 3.5 of 6 after it
    assert.ok(Math.abs((await press(true)) - 3.5 / 6) < 1e-12);
    assert.equal(await press(false), 0.5);
  });

  it("learn from presses how far the model holds for the user, where that is asked for, and go on with it on the next visit", async () => {
    const visit = async (options: WatchOptions) => {
      const page = new TestPage({ core });
      page.append("button", { ...BOX, x: 0 }, { attributes: { id: "left" } });
      page.append("button", BOX, { attributes: { id: "right" } });
      const errors: unknown[] = [];
      const learnt: (Outcome["learnt"] | undefined)[] = [];
      const onOutcome = (outcome: Outcome) => learnt.push(outcome.learnt);
      const watcher = page.watch("button", { load: "eager", onOutcome, onError: (error) => errors.push(error), ...options });
      await watcher.ready;
      page.advance(20);
      for (let x = 200; x <= 620; x += 14) {
        page.point("pointermove", x, 300);
        page.advance(10);
      }
      const probability = watcher.best?.probability ?? 0;
      page.point("pointerdown", 620, 300);
      page.advance(1000);
      watcher.stop();
      return { learnt: learnt[0], probability, errors };
    };
    const first = await visit({ learning: true });
    assert.equal(first.learnt?.movements, 1);
    assert.notEqual(first.learnt?.confidence, 1);
    assert.notEqual(first.learnt?.mean, 0, "it knows when the pointer entered");
    const second = await visit({ learning: 5, learnt: JSON.parse(JSON.stringify(first.learnt)) });
    assert.equal(second.learnt?.movements, 2);
    assert.deepEqual([first.errors, second.errors], [[], []]);
    const without = await visit({ learnt: { confidence: 0.3 } });
    assert.equal(without.learnt, null);
    assert.ok(without.probability < first.probability);
    // what is no such object is reported, and nothing is lost by it
    const damaged = await visit({ learning: true, learnt: { confidence: 99 } });
    assert.deepEqual(damaged.errors.map(String), ["WhitherError: learnt.confidence: must be from 0.2 to 3, got 99"]);
    assert.deepEqual(damaged.learnt, first.learnt);
    assert.equal(damaged.probability, first.probability);
  });
});
