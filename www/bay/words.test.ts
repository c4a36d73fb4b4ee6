import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { AHEAD, deviations, episodes, LIMIT, manner, type Finding, type Kind } from "./anomaly.ts";
import { expected, timeOfDay } from "./clock.ts";
import { HARBOURS } from "./coast.ts";
import { arrival, sentence, type State } from "./words.ts";

const gaussian = (mean: readonly number[], deviation: number) => ({
  mean: Float64Array.from(mean),
  covariance: Float64Array.from({ length: 16 }, (_, i) => (i % 5 === 0 ? deviation ** 2 : 0)),
});

describe("the bay's clock", () => {
  it("gives times of day, over midnight too", () => {
    assert.deepEqual([0, 3599, 3600, 52_320, 86_460, -60].map(timeOfDay), ["00:00", "00:59", "01:00", "14:32", "00:01", "23:59"]);
  });

  it("has a median and an interval of 80%, between the nodes too", () => {
    const times = Float64Array.from({ length: 101 }, (_, i) => 60 * i);
    const even = { times, probabilities: times.map(() => 1 / 101), mean: 3000, deviation: 0 };
    const { low, median, high } = expected(even);
    assert.ok(
      Math.abs(median - 3000) < 1 && Math.abs(low - 576) < 12 && Math.abs(high - 5424) < 12,
      `${low}, ${median}, ${high}`,
    );
    const certain = expected({ times, probabilities: times.map((_, i) => (i === 50 ? 1 : 0)), mean: 3000, deviation: 0 });
    assert.ok(Math.abs(certain.low - 2976) < 1e-6 && Math.abs(certain.high - 3024) < 1e-6);
  });
});

describe("an anomaly", () => {
  it("is measured in deviations, the report's own included", () => {
    assert.equal(deviations({ x: 0, y: 0 }, gaussian([0, 0, 5, 0], 100)), 0);
    assert.ok(Math.abs(deviations({ x: 300, y: 0 }, gaussian([0, 0, 5, 0], 100)) - 300 / Math.hypot(100, 10)) < 1e-9);
    assert.ok(Math.abs(deviations({ x: 30, y: 40 }, gaussian([0, 0, 0, 0], 0)) - 5) < 1e-9);
  });

  it("is called after what the vessel does instead of what was forecast", () => {
    const forecast = gaussian([0, 0, 6, 0], 1);
    assert.equal(manner({ x: 0.5, y: 0 }, forecast), "stopped");
    assert.equal(manner({ x: -5, y: 1 }, forecast), "turned back");
    assert.equal(manner({ x: 1, y: 6 }, forecast), "left its course");
    assert.equal(manner({ x: 12, y: 1 }, forecast), "sped up");
  });

  const finding = (time: number, kind: Kind, error = LIMIT + 1, none = 0): Finding => ({ time, kind, deviations: error, none });

  it("is one episode while it goes on, called after its largest deviation", () => {
    const [one, ...more] = episodes([
      finding(0, "stopped", 7),
      finding(AHEAD, "turned back", 12),
      finding(2 * AHEAD, "left its course", 8),
    ]);
    assert.equal(more.length, 0);
    assert.deepEqual(one, { time: 0, until: 2 * AHEAD, kind: "turned back", deviations: 12, none: 0 });
  });

  it("is another one later, and where none of them is what it goes to", () => {
    const found = episodes([
      finding(0, "stopped"),
      finding(0, "goes where no harbour is", 0, 0.9),
      finding(30, "goes where no harbour is", 0, 0.95),
      finding(5000, "stopped"),
    ]);
    assert.deepEqual(
      found.map(({ time, kind, none }) => [time, kind, none]),
      [
        [0, "stopped", 0],
        [0, "goes where no harbour is", 0.95],
        [5000, "stopped", 0],
      ],
    );
  });
});

describe("the sentence", () => {
  const [orrin] = HARBOURS;
  assert.ok(orrin);
  const state: State = {
    time: 48_600,
    harbour: null,
    leading: orrin,
    probability: 0.7,
    none: 0.1,
    expected: { median: 52_320, low: 51_600, high: 53_460 },
    anomaly: null,
    reports: 40,
  };

  it("names the harbour, how probable it is, and when", () => {
    assert.equal(sentence(state), "13:30: heading for Orrin, 70%; there at 14:32, between 14:20 and 14:51.");
    assert.equal(arrival({ median: 52_320, low: 51_600, high: 53_460 }), "14:32, between 14:20 and 14:51");
  });

  it("does not pretend", () => {
    assert.equal(sentence({ ...state, probability: 0.4 }), "13:30: not sure yet; Orrin leads with 40%.");
    assert.equal(sentence({ ...state, probability: 0.2, none: 0.8 }), "13:30: going to none of them, 80%.");
    assert.equal(sentence({ ...state, reports: 1 }), "13:30: first reported; every harbour is as likely as any other.");
    assert.equal(sentence({ ...state, harbour: orrin }), "13:30: in the harbour of Orrin.");
  });

  it("names what no harbour explains", () => {
    const anomaly = { time: 48_000, until: 48_600, kind: "turned back", deviations: 9, none: 0.2 } as const;
    assert.equal(sentence({ ...state, anomaly }), "13:30: it turned back; Orrin 70%.");
    assert.equal(sentence({ ...state, anomaly, probability: 0.1, none: 0.6 }), "13:30: it turned back; none of them 60%.");
  });
});
