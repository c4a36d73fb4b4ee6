// `npm run evaluate -- --intents` and `--wandering`, on made-up movements of which it is known what is intended.
import { after, before, describe, test } from "node:test";
import assert from "node:assert/strict";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { capture } from "../../scripts/run.mjs";
import { intervalOf, judge } from "../../tools/evaluate/intents/figures.mjs";
import { approachOf } from "../../tools/evaluate/intents/replay.mjs";
import { chain } from "../../tools/evaluate/intents/wandering.mjs";

const program = "tools/evaluate/intents/intents.mjs";

/** Three targets of 40 px: to the right, farther down, and to the left of where movements begin. */
const targets = [
  [500, 100, 40, 40],
  [500, 500, 40, 40],
  [-300, 100, 40, 40],
];

/** Smooth movements from one place to the next, half a second each, and a tenth on the last one, 100 samples a second. */
function samples(...places) {
  const all = [];
  for (let leg = 1; leg < places.length; leg++) {
    const [[x0, y0], [x1, y1]] = [places[leg - 1], places[leg]];
    for (let i = leg === 1 ? 0 : 1; i <= 50; i++) {
      const u = i / 50;
      const share = u ** 3 * (10 - 15 * u + 6 * u ** 2);
      all.push([(50 * (leg - 1) + i) / 100, x0 + share * (x1 - x0), y0 + share * (y1 - y0)]);
    }
  }
  const [time, x, y] = all.at(-1);
  return [...all, [time + 0.1, x, y]];
}

const straight = { user: "ann", targets, target: 0, samples: samples([100, 100], [500, 100]) };
/** Over the first target, then on to the second. */
const turning = { user: "bob", targets, target: 1, samples: samples([100, 100], [500, 100], [500, 500]) };
/** Never comes to its target. */
const missing = { user: "bob", targets, target: 2, samples: samples([100, 100], [500, 100]) };
const inSpace = { targets: [[0, 0, 0, 10]], target: 0, samples: [[0, 1, 1, 1]] };

describe("the intents of recorded movements", () => {
  let folder;
  let output;
  let rows;
  let users;
  before(async () => {
    folder = await mkdtemp(join(tmpdir(), "whither-intents-"));
    const file = join(folder, "made-up.jsonl");
    await writeFile(file, [straight, turning, missing, inSpace].map((track) => JSON.stringify(track)).join("\n"));
    const report = join(folder, "report.json");
    const run = await capture("node", [program, "--users", "--json", report, file]);
    assert.equal(run.code, 0, run.output);
    output = run.output;
    [{ rows, users }] = JSON.parse(await readFile(report, "utf8")).intents;
  });
  after(() => rm(folder, { recursive: true }));

  const row = (list, reasons, { threshold = 0.8, none = 0.2, after = 0 } = {}) =>
    list.find((r) => r.reasons === reasons && r.threshold === threshold && r.none === none && r.after === after);

  test("by user: straight ahead is early, first and held; over another one is a wrong intent first", () => {
    const ann = row(users.ann, "pointer alone");
    const { movements, wrong, early, first, before: intended, held } = ann;
    assert.deepEqual(
      { movements, wrong, early, first, intended, held },
      { movements: 1, wrong: 0, early: 1, first: 1, intended: 1, held: 1 },
    );
    // the pointer is in the box after .41 s, and the press is at .6
    assert.ok(Math.abs(ann.leadToPress - ann.leadToEntry - 0.19) < 1e-9, `${ann.leadToPress} ${ann.leadToEntry}`);
    assert.ok(ann.leadToEntry > 0.05 && ann.leadToEntry < 0.35, ann.leadToEntry);
    const bob = row(users.bob, "pointer alone");
    assert.deepEqual([bob.movements, bob.wrong, bob.early, bob.first], [1, 1, 1, 0]);
    // in 1.1 seconds
    assert.ok(Math.abs(bob.wrongPerMinute - 60 / 1.1) < 1e-9, bob.wrongPerMinute);
  });

  test("by set: the sum over users", () => {
    const both = row(rows, "pointer alone");
    const { movements, wrong, early, first } = both;
    assert.deepEqual({ movements, wrong, early, first }, { movements: 2, wrong: 0.5, early: 1, first: 0.5 });
    assert.ok(Math.abs(both.wrongPerMinute - 60 / (0.6 + 1.1)) < 1e-9, both.wrongPerMinute);
    // withheld: the first target is intended on the way to the second
    assert.equal(row(users.bob, "pointer alone").withheld, 1);
    assert.equal(both.withheld, (row(users.ann, "pointer alone").withheld + 1) / 2);
  });

  test("with a threshold of .95 or a holding time of 100 ms the lead is shorter", () => {
    const lead = (options) => row(users.ann, "pointer alone", options).leadToPress;
    assert.ok(lead({ threshold: 0.95 }) < lead({}) && lead({}) < lead({ threshold: 0.5 }));
    assert.ok(Math.abs(lead({}) - lead({ after: 100 }) - 0.1) < 0.02);
  });

  test("ForesightJS is given the same: what its line meets, the earlier the farther ahead, and nothing is taken back", () => {
    const peer = (list, ahead = 120) => list.find((r) => r.trajectoryPredictionTime === ahead);
    const ann = peer(users.ann);
    assert.deepEqual([ann.movements, ann.wrong, ann.early, ann.first, ann.held, ann.withheld], [1, 0, 1, 1, 1, 0]);
    // a line of 120 ms, a frame and the filter's delay
    assert.ok(ann.leadToEntry > 0.06 && ann.leadToEntry < 0.14, ann.leadToEntry);
    assert.ok(peer(users.ann, 40).leadToEntry < ann.leadToEntry && ann.leadToEntry < peer(users.ann, 200).leadToEntry);
    const bob = peer(users.bob);
    assert.deepEqual([bob.wrong, bob.early, bob.first, bob.withheld], [1, 1, 0, 1]);
    // from before the first target until the press, at 1.1 s
    assert.ok(bob.wrongSeconds > 0.6 && bob.wrongSeconds < 0.9, bob.wrongSeconds);
    assert.match(output, /made-up: 2 movements of 2 users, ForesightJS \d+\.\d+/);
  });

  test("the tables have the defaults first, and a line for whatever is varied; broken lines are named", () => {
    assert.match(output, /made-up: 2 movements of 2 users, pointer alone/);
    assert.match(output, /made-up: 2 movements of 2 users, all default reasons/);
    const line = (start) =>
      output
        .split("\n")
        .find((each) => each.startsWith(`| ${start}`))
        .split("|")
        .map((cell) => cell.trim());
    assert.deepEqual(line("default: threshold 0.8, none 0.2, pointer.after 0").slice(5, 7), ["100.0", "50.0"]);
    for (const name of ["threshold 0.95", "none 0.05", "pointer.after 100", "release 0.1", "bob"])
      assert.equal(line(name).length, 14, name);
    assert.match(output, /made-up\.jsonl:4: samples\[0\]: must be \[t, x, y\].*; skipped/);
  });

  test("a file that is not there, and one without a movement, are failures", async () => {
    const none = await capture("node", [program, join(folder, "none.jsonl")]);
    assert.equal(none.code, 1);
    assert.match(none.output, /none\.jsonl cannot be read/);
    const file = join(folder, "nowhere.jsonl");
    await writeFile(file, JSON.stringify(missing));
    const nothing = await capture("node", [program, file]);
    assert.equal(nothing.code, 1);
    assert.match(nothing.output, /nothing to score/);
  });
});

describe("a user's movements in one stream", () => {
  const seconds = (movements) => movements.reduce((sum, { begin, end }) => sum + end - begin, 0);

  test("each begins where and when the last one ended, after a pause, and its targets move with it", () => {
    const movements = chain([straight, missing, turning, straight], "ann");
    assert.equal(movements.length, 3);
    for (let i = 1; i < movements.length; i++) {
      const [before, { begin, samples }] = [movements[i - 1], movements[i]];
      assert.equal(begin, before.end);
      assert.deepEqual(samples[0].slice(1), before.samples.at(-1).slice(1));
    }
    for (const { press, end, samples, draw, entry, targets: moved, target } of movements) {
      assert.ok(end - press >= 0.1 && end - press <= 2 && draw >= 0 && draw < 1);
      assert.equal(press, samples.at(-1)[0]);
      assert.ok(entry > samples[0][0] && entry < press);
      const [[, x, y], [tx, ty, ...size]] = [samples.at(-1), moved[target]];
      assert.ok(Math.hypot(x - tx, y - ty) < 1e-9);
      assert.deepEqual(size, [40, 40]);
    }
  });

  test("is the same in every run, and another for another user", () => {
    const draws = (user) => chain([straight, turning, straight], user).map(({ draw, end }) => [draw, end]);
    assert.deepEqual(draws("ann"), draws("ann"));
    assert.notDeepEqual(draws("ann"), draws("bob"));
  });

  test("has wrong intents of what is passed over, in a minute of it, and right ones where there is a press", async () => {
    const folder = await mkdtemp(join(tmpdir(), "whither-streams-"));
    const file = join(folder, "made-up.jsonl");
    const tracks = [
      ...Array.from({ length: 12 }, () => ({ ...turning, user: "bob" })),
      ...Array.from({ length: 8 }, () => straight),
    ];
    await writeFile(file, [...tracks, inSpace].map((track) => JSON.stringify(track)).join("\n"));
    const report = join(folder, "report.json");
    const run = await capture("node", [program, "--wandering", "--users", "--json", report, file]);
    assert.equal(run.code, 0, run.output);
    assert.match(run.output, /made-up\.jsonl:21: samples\[0\].*; skipped/);
    const [{ set, shares }] = JSON.parse(await readFile(report, "utf8")).wandering;
    await rm(folder, { recursive: true });
    assert.equal(set, "made-up");
    const bobs = chain(
      tracks.filter(({ user }) => user === "bob"),
      "bob",
    );
    const anns = chain(
      tracks.filter(({ user }) => user === "ann"),
      "ann",
    );
    for (const { share, rows, users } of shares) {
      const wandered = [...anns, ...bobs].filter(({ draw }) => draw < share).length;
      const [all, bob, ann] = [rows, users.bob, users.ann].map(([first]) => first);
      assert.deepEqual([all.movements, all.wandered], [20 - wandered, wandered]);
      // the first target is passed over on every way to the second one, pressed or not
      assert.ok(bob.false >= 0.8 && bob.false <= 1.3, `${bob.false}`);
      const wrong = bob.wrong * bob.movements + bob.false * bob.wandered;
      assert.ok(Math.abs(bob.wrongPerMinute - (60 * wrong) / seconds(bobs)) < 1e-9, bob.wrongPerMinute);
      assert.deepEqual([ann.early, ann.first, ann.before, ann.wrong], [1, 1, 1, 0]);
      const own = ann.movements / (ann.movements + ann.false * ann.wandered);
      assert.ok(Math.abs(ann.right - own) < 1e-9, `${ann.right}`);
    }
    const [half, most] = shares;
    assert.ok(half.rows[0].wandered < most.rows[0].wandered);
    const line = (start) => run.output.split("\n").filter((each) => each.startsWith(`| ${start}`)).length;
    assert.deepEqual(["default: threshold", "threshold 0.9, none 0.5", "bob"].map(line), [2, 2, 2]);
  });

  test("an interval is over users that are drawn, always the same ones", () => {
    const mean = (drawn) => drawn.reduce((sum, x) => sum + x, 0) / drawn.length;
    const users = Array.from({ length: 50 }, (_, i) => i / 49);
    const [low, high] = intervalOf(users, mean);
    // a mean of 50 numbers spread evenly over 0 to 1 deviates by .042
    assert.ok(low > 0.4 && low < 0.44 && high > 0.56 && high < 0.6, `${low} ${high}`);
    assert.deepEqual(intervalOf(users, mean), [low, high]);
    assert.equal(intervalOf([1], mean), null);
  });
});

describe("what a movement led to", () => {
  test("the press is the last sample in the target, the entry the beginning of that visit", () => {
    const at = (...xs) => approachOf({ targets: [[100, 0, 20, 20]], target: 0, samples: xs.map((x, i) => [i, x, 0]) });
    assert.deepEqual(at(0, 50, 95, 100), { press: 3, entry: 2 });
    assert.deepEqual(at(0, 95, 130, 105, 100, 140), { press: 4, entry: 3 });
    assert.equal(at(0, 50), null);
    assert.equal(at(95, 100, 101), null);
  });

  test("an intent counts from before the press, is early before the entry, first before all others, held to the end", () => {
    const intent = (right, begin, end = null) => ({ right, begin, end });
    const shares = (...intents) => {
      const { wrong, before: intended, early, first, held } = judge({ entry: 2, press: 3 }, intents);
      return { wrong, intended, early, first, held };
    };
    const none = { wrong: 0, intended: false, early: false, first: false, held: false };
    assert.deepEqual(shares(), none);
    assert.deepEqual(shares(intent(true, 3)), none);
    assert.deepEqual(shares(intent(true, 2.5)), { ...none, intended: true });
    assert.deepEqual(shares(intent(true, 1)), { wrong: 0, intended: true, early: true, first: true, held: true });
    assert.deepEqual(shares(intent(true, 1, 1.5)), { wrong: 0, intended: true, early: true, first: true, held: false });
    assert.deepEqual(shares(intent(false, 1, 2), intent(true, 1.5)), {
      wrong: 1,
      intended: true,
      early: true,
      first: false,
      held: true,
    });
    const wrongSeconds = judge({ entry: 2, press: 3 }, [intent(false, 1, 1.5), intent(false, 2), intent(true, 0)]).wrongSeconds;
    assert.equal(wrongSeconds, 1.5);
    assert.deepEqual(judge({ entry: 2, press: 3 }, [intent(true, 0.5)]).leads, { press: 2.5, entry: 1.5 });
  });
});
