// `PointerPredictor` of whither/pointing against the `Predictor` of whither with `pointerScenario`: the same probabilities to the
// bit, whatever happens on the way.
import assert from "node:assert/strict";
import { test } from "node:test";
import { init, pointerScenario, Predictor } from "whither";
import * as pointing from "whither/pointing";
import { close, golden, refuses, same } from "./support.mjs";

await Promise.all([init(), pointing.init()]);

const { PointerPredictor } = pointing;

/** Even numbers from 0 to 1, the same in every run (mulberry32). */
function draws(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Targets anywhere on a screen, in so many sizes, with priors where `weighted`. */
function targetsOf(draw, count, sizes, weighted = false) {
  const size = (k) => ({ width: 40 + 7 * k, height: 24 + (k % 3) });
  return Array.from({ length: count }, (_, i) => ({
    id: `target ${i}`,
    x: 1600 * draw(),
    y: 900 * draw(),
    ...size(Math.floor(sizes * draw())),
    ...(weighted ? { prior: draw() < 0.2 ? 0 : 3 * draw() } : {}),
  }));
}

/** A movement of a trembling hand, with rests, equal times and pauses: `[time, [x, y]]`. */
function movementOf(draw, count) {
  let [time, x, y, vx, vy] = [1e4 * draw(), 1600 * draw(), 900 * draw(), 0, 0];
  return Array.from({ length: count }, () => {
    const step = draw() < 0.2 ? 0 : draw() < 0.05 ? 2 : 0.004 + 0.02 * draw();
    [vx, vy] = draw() < 0.1 ? [0, 0] : [vx + 300 * (draw() - 0.5), vy + 300 * (draw() - 0.5)];
    [time, x, y] = [time + step, x + vx * step + draw() - 0.5, y + vy * step + draw() - 0.5];
    return [time, [x, y]];
  });
}

/** The destinations of a scenario for targets, priors with them. */
function destinationsOf(targets) {
  const { destinations } = pointerScenario(targets.map(({ prior, ...target }) => target));
  return destinations.map((destination, i) => ({ ...destination, prior: targets[i].prior ?? 1 }));
}

/** Both predictors. */
function pairOf(targets, none = 0) {
  const scenario = pointerScenario(
    targets.map(({ prior, ...target }) => target),
    { none },
  );
  const predictor = new Predictor({ ...scenario, destinations: destinationsOf(targets) });
  return { predictor, pointer: new PointerPredictor(targets, { none }) };
}

const numbers = (gaussian) => [...gaussian.mean, ...gaussian.covariance];

/** All that both answer; states within 1e-9, in units of the screen. */
function agree({ predictor, pointer }, targets, time, what) {
  same(pointer.probabilities(), predictor.probabilities(), what);
  same([pointer.none], [predictor.none], `${what}: none`);
  assert.deepEqual(pointer.best, predictor.best, what);
  const [remaining, expected] = [pointer.remaining, predictor.remaining];
  if (expected === null) assert.equal(remaining, null, what);
  else same(Object.values(remaining), Object.values(expected), `${what}: remaining`);
  for (const later of [0, 0.02, 0.3, 5]) {
    const [found, wanted] = [pointer, predictor].map((p) => numbers(p.forecast(time + later)));
    close(found, wanted, 1e-9, `${what}: forecast`);
  }
  const { id } = targets[targets.length >> 1];
  const times = [time, time + 0.05, time + 1];
  close(pointer.path(id, times), predictor.path(id, times), 1e-9, `${what}: path`);
}

const CASES = {
  "21 targets of one size": { count: 21, sizes: 1 },
  "21 targets of one size, none .05": { count: 21, sizes: 1, none: 0.05 },
  "one target": { count: 1, sizes: 1, none: 0.3 },
  "40 targets in 3 sizes with priors": { count: 40, sizes: 3, none: 0.1, weighted: true },
  "60 targets in 30 sizes": { count: 60, sizes: 30, weighted: true },
  "1000 targets of one size": { count: 1000, sizes: 1, length: 12 },
  "1000 targets in 200 sizes": { count: 1000, sizes: 200, none: 0.02, length: 12 },
};

for (const [name, { count, sizes, none, weighted, length = 60 }] of Object.entries(CASES)) {
  test(`the same as Predictor: ${name}`, () => {
    for (const seed of [1, 2, 3]) {
      const draw = draws(seed);
      const targets = targetsOf(draw, count, sizes, weighted);
      const pair = pairOf(targets, none);
      same(pair.pointer.probabilities(), pair.predictor.probabilities(), "before");
      assert.equal(pair.pointer.best, null);
      assert.equal(pair.pointer.forecast(0), null);
      movementOf(draw, length).forEach(([time, position], k) => {
        for (const p of Object.values(pair)) p.observe(time, position);
        if (k % 4 < 2) agree(pair, targets, time, `seed ${seed}, observation ${k}`);
      });
      for (const p of Object.values(pair)) p.free();
    }
  });
}

test("the same as Predictor: other targets in mid-movement, a second movement, copies", () => {
  const draw = draws(7);
  let targets = targetsOf(draw, 30, 4, true);
  const pair = pairOf(targets, 0.1);
  for (let round = 0; round < 8; round++) {
    for (const [time, position] of movementOf(draw, 12)
      .map(([t, p]) => [(t % 10) + 100 * round, p])
      .sort((a, b) => a[0] - b[0])) {
      for (const p of Object.values(pair)) p.observe(time, position);
      agree(pair, targets, time, `round ${round}`);
    }
    // some move, some stay, some come and go
    targets = [...targetsOf(draw, 5 + round, 2 + round, true), ...targets.slice(10)].map((target, i) => ({
      ...target,
      id: `${i}`,
    }));
    pair.pointer.setTargets(targets);
    pair.predictor.setDestinations(destinationsOf(targets));
    same(pair.pointer.probabilities(), pair.predictor.probabilities(), `changed in round ${round}`);
    if (round % 3 === 2) for (const p of Object.values(pair)) p.reset();
    const copy = pair.pointer.clone();
    same(copy.probabilities(), pair.pointer.probabilities(), "copied");
    pair.pointer.free();
    pair.pointer = copy;
  }
});

test("the same as Predictor: missing axes, and numbers beyond any screen", () => {
  const draw = draws(11);
  const targets = targetsOf(draw, 12, 2);
  const pair = pairOf(targets, 0.05);
  movementOf(draw, 40).forEach(([time, [x, y]], k) => {
    const position = [k % 5 === 1 ? null : x, k % 7 === 3 ? undefined : y];
    for (const p of Object.values(pair)) p.observe(time, position);
    agree(pair, targets, time, `observation ${k}`);
  });
  for (const far of [1e5, -1e8, 1e20, 1e49]) {
    const far2 = pairOf(targets, 0.05);
    for (let k = 0; k < 6; k++) {
      for (const p of Object.values(far2)) {
        p.observe(0.01 * k, [k * far, 300]);
        assert.equal(p.probabilities().length, 12);
      }
      same(far2.pointer.probabilities(), far2.predictor.probabilities(), `${far} at ${k}`);
      assert.deepEqual(far2.pointer.best, far2.predictor.best);
    }
  }
});

for (const name of ["grid21", "none", "repeats", "ring12", "sizes40"]) {
  test(`pointing-${name}`, () => {
    const { scenario, observations, expected } = golden(`pointing-${name}`);
    const targets = scenario.destinations.map(({ id, center: [x, y], size, prior }) => {
      const [width, height] = typeof size === "number" ? [size, size] : size;
      return { id, x, y, width, height, prior };
    });
    // constants that the case does not have are not those of a screen
    const { restDistance = 0, noneOffset = 0, noneShare = 0 } = scenario.pointing;
    const constants = { ...scenario, pointing: { ...scenario.pointing, restDistance, noneOffset, noneShare } };
    const pointer = new PointerPredictor(targets, { constants });
    observations.forEach(([time, ...position], k) => {
      pointer.observe(time, position);
      close(pointer.probabilities(), expected.probabilities[k], 1e-9, `probabilities after ${k}`);
      close([pointer.none], [expected.none[k]], 1e-9, `none after ${k}`);
    });
  });
}

test("constants are those that fit learns, or any part of them", () => {
  const draw = draws(13);
  const targets = targetsOf(draw, 9, 2);
  const scenario = pointerScenario(targets, { none: 0.2 });
  const learnt = {
    ...scenario,
    motion: { ...scenario.motion, noise: 900, speedNoise: 1.5 },
    observation: { noise: [0.4, 0.7] },
    initial: { velocity: [30, 60] },
    pointing: {
      ...scenario.pointing,
      noise: [300, 900, 5000],
      alongNoise: 2,
      timeToGo: { ...scenario.pointing.timeToGo, points: 5, median: 0.3 },
      remaining: { ...scenario.pointing.remaining, offset: 0.2 },
    },
  };
  const part = {
    motion: { noise: 900, speedNoise: 1.5 },
    observation: learnt.observation,
    initial: learnt.initial,
    pointing: { noise: [300, 900, 5000], alongNoise: 2, timeToGo: { points: 5, median: 0.3 }, remaining: { offset: 0.2 } },
  };
  const predictor = new Predictor(learnt);
  const pointers = [
    new PointerPredictor(targets, { constants: learnt }),
    new PointerPredictor(targets, { none: 0.2, constants: learnt }),
    new PointerPredictor(targets, { none: 0.2, constants: part }),
  ];
  const plain = new PointerPredictor(targets, { none: 0.2, constants: { motion: {}, pointing: null } });
  for (const [time, position] of movementOf(draw, 30)) {
    for (const p of [predictor, plain, ...pointers]) p.observe(time, position);
    for (const pointer of pointers) agree({ predictor, pointer }, targets, time, "learnt");
  }
  assert.notDeepEqual(plain.probabilities(), pointers[0].probabilities());
});

test("none is that of the options, else that of the constants", () => {
  const target = { id: "only", x: 10, y: 10, width: 9, height: 9 };
  const noneOf = (options) => new pointing.PointerPredictor([target], options).none;
  assert.deepEqual([{}, { constants: { none: 0.1 } }, { none: 0.2, constants: { none: 0.1 } }].map(noneOf), [0, 0.1, 0.2]);
});

test("without any target it goes on observing: those that come later are as if they had been there from the start", () => {
  for (const seed of [17, 18, 19]) {
    const draw = draws(seed);
    const targets = targetsOf(draw, 30, 4, true);
    const always = new PointerPredictor(targets, { none: 0.1 });
    // empty from the start, emptied in mid-movement, and with others before
    const late = new PointerPredictor([], { none: 0.1 });
    const emptied = new PointerPredictor(targets, { none: 0.1 });
    const replaced = new PointerPredictor(targetsOf(draw, 7, 2), { none: 0.1 });
    const all = [late, emptied, replaced];
    for (let round = 0; round < 2; round++) {
      const movement = movementOf(draw, 50);
      movement.forEach(([time, position], k) => {
        if (k === 10) for (const pointer of all) pointer.setTargets([]);
        for (const pointer of [always, ...all]) pointer.observe(time, position);
        // each at the beginning, in mid-movement and at its end
        if ([0, 1, 11, 30].includes(k) || k === movement.length - 1) {
          for (const pointer of all) {
            const copy = pointer.clone();
            copy.setTargets(targets);
            const what = `seed ${seed}, round ${round}, observation ${k}`;
            same([...copy.probabilities(), copy.none], [...always.probabilities(), always.none], what);
            assert.deepEqual([copy.best, copy.remaining], [always.best, always.remaining], what);
            same(numbers(copy.forecast(time + 0.1)), numbers(always.forecast(time + 0.1)), what);
            copy.free();
          }
        }
      });
      for (const pointer of [always, ...all]) pointer.reset();
    }
    for (const pointer of [always, ...all]) pointer.free();
  }
});

test("without any target nothing is probable but none of them", () => {
  const target = { id: "only", x: 10, y: 10, width: 9, height: 9 };
  const empty = new PointerPredictor([]);
  const emptied = new PointerPredictor([target], { none: 0.05 });
  const isResting = (pointer, time) => {
    assert.deepEqual([pointer.probabilities(), pointer.none, pointer.best], [new Float64Array(0), 1, null]);
    assert.deepEqual([pointer.remaining, pointer.forecast(time + 1)], [null, null]);
    const into = new Float64Array(0);
    assert.equal(pointer.probabilities(into), into);
    refuses(() => pointer.probabilities(new Float64Array(1)), "wrong-length", "into", "must have 0 numbers, has 1");
    refuses(() => pointer.path("only", [time]), "unknown-id", "id", 'no target "only", there are none');
  };
  isResting(empty, 0);
  for (let k = 0; k < 5; k++) {
    for (const pointer of [empty, emptied]) pointer.observe(k / 60, [100 * k, 100]);
    if (k === 2) emptied.setTargets([]);
    isResting(empty, k / 60);
    if (k >= 2) isResting(emptied, k / 60);
  }
  assert.equal(new PointerPredictor([], { none: 0.3 }).none, 1);
  emptied.reset();
  isResting(emptied, 0);
  emptied.setTargets([target]);
  assert.deepEqual([emptied.none, emptied.best], [0.05, null]);
  refuses(
    () => empty.setTargets([{ ...target, prior: 0 }]),
    "out-of-range",
    "targets",
    "the priors must have a finite sum above 0, it is 0",
  );
  isResting(empty, 1);
});

test("targets of any kind of object, with the same errors as others", () => {
  const target = { id: "a", x: 200, y: 300, width: 80, height: 60 };
  class Icon {
    #x = 200;
    id = "a";
    y = 300;
    width = 80;
    height = 60;
    get x() {
      return this.#x;
    }
  }
  const others = { ...target, id: "b", x: 700, prior: null };
  const expected = new PointerPredictor([target, others]);
  const kinds = [
    new Icon(),
    Object.create({ ...target, colour: "red" }),
    Object.assign(Object.create({ colour: "red" }), target),
    { ...target, colour: undefined, prior: undefined },
    Object.freeze({ [Symbol("mine")]: 1, height: 60, width: 80, y: 300, x: 200, id: "a" }),
  ];
  for (const kind of kinds) {
    const pointer = new PointerPredictor([kind, others]);
    for (const [k, p] of [pointer, expected].entries()) {
      p.reset();
      for (const time of [0, 0.02]) p.observe(time, [500 - 1000 * time, 400]);
      assert.equal(p.best.index, 0, `${k}`);
    }
    same(pointer.probabilities(), expected.probabilities());
    pointer.free();
  }
  const before = [...expected.probabilities()];
  const unknown = 'unknown key "colour", expected one of "id", "x", "y", "width", "height", "prior"';
  const wrong = [
    [{ ...target, colour: "red" }, "unknown-key", "targets[1].colour", unknown],
    [{ ...target, id: 1, colour: null }, "unknown-key", "targets[1].colour", unknown],
    [Object.assign([], target), "wrong-type", "targets[1]", "must be an object, got []"],
    [Object.assign(new Uint8Array(1), target), "wrong-type", "targets[1]", "must be an object, got [0]"],
    [null, "wrong-type", "targets[1]", "must be an object, got nothing"],
    [{ ...target, id: "b" }, "duplicate-id", "targets[1].id", 'the id "b" is taken by targets[0]'],
    [{ ...target, width: 0 }, "out-of-range", "targets[1].width", "must be greater than 0, got 0"],
  ];
  for (const [bad, ...error] of wrong) {
    refuses(() => expected.setTargets([others, bad]), ...error);
    same(expected.probabilities(), before);
  }
});

test("a car's shake is followed alike, from movement to movement and in snapshots", () => {
  const draw = draws(11);
  const targets = targetsOf(draw, 21, 3);
  const constants = { pointing: { shake: 20 } };
  const pair = {
    predictor: new Predictor(pointerScenario(targets, { shake: 20 })),
    pointer: new PointerPredictor(targets, { constants }),
  };
  const plain = new PointerPredictor(targets);
  let apart = 0;
  for (let round = 0; round < 3; round++) {
    const [turn, from, to] = [2 * Math.PI * draw(), targets[round], targets[round + 7]];
    for (let k = 0; k < 30; k++) {
      const [time, way] = [k / 60, (k / 29) ** 2 * (3 - (2 * k) / 29)];
      const shake = 20 * Math.sin(turn + 2 * Math.PI * 6 * time);
      const position = [from.x + way * (to.x - from.x) + shake, from.y + way * (to.y - from.y) - shake];
      for (const each of [pair.predictor, pair.pointer, plain]) each.observe(time, position);
      agree(pair, targets, time, `round ${round}, observation ${k}`);
      apart = Math.max(apart, ...plain.probabilities().map((p, i) => Math.abs(p - pair.pointer.probabilities()[i])));
      if (k === 11) {
        pair.predictor = Predictor.restore(JSON.parse(JSON.stringify(pair.predictor.snapshot())));
        pair.pointer = pair.pointer.clone();
      }
    }
    for (const each of [pair.predictor, pair.pointer, plain]) each.reset();
  }
  assert.ok(apart > 0.2, `${apart}`);
  refuses(
    () => new PointerPredictor(targets, { constants: { pointing: { shake: -1 } } }),
    "out-of-range",
    "pointing.shake",
    "must be at least 0, got -1",
  );
  refuses(() => pointerScenario(targets, { shake: -1 }), "out-of-range", "pointing.shake", "must be at least 0, got -1");
});
