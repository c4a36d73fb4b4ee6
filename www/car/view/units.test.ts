import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { bandsOf, stack } from "./bands.ts";
import { ellipse, isInformative } from "../../shared/ellipse.ts";
import { milliseconds, percent, seconds } from "./format.ts";
import { ranking } from "./order.ts";
import { History } from "../history.ts";
import { prediction, sentence } from "./sentences.ts";
import { trail } from "./trail.ts";
import { destinationOf } from "./walk.ts";
import { Status } from "../../shared/status.ts";

describe("format", () => {
  it("never calls the nearly certain certain, nor the possible impossible", () => {
    assert.deepEqual([0, 0.002, 0.0449, 0.5, 0.994, 0.998, 1].map(percent), ["0%", "<1%", "4%", "50%", "99%", ">99%", "100%"]);
  });

  it("gives times with the figures that they are good for", () => {
    assert.equal(seconds(0.3149), "0.31 s");
    assert.equal(milliseconds(0.3149), "315 ms");
  });
});

describe("order of the rows", () => {
  it("is that of their numbers, however near they are", () => {
    assert.deepEqual(ranking([0.1, 0.2, 0.7]), [2, 1, 0]);
    assert.deepEqual(ranking(Float64Array.of(0.3, 0.301, 0.3005)), [1, 2, 0]);
  });

  it("is the reading order where they are equal", () => {
    assert.deepEqual(ranking([0.2, 0.3, 0.2, 0.3]), [1, 3, 0, 2]);
  });
});

describe("sentences", () => {
  it("name what is ringed", () => {
    assert.equal(prediction("Seats"), "Heading for Seats.");
    assert.equal(prediction(null), "Not sure yet.");
  });

  it("report of a press what its numbers are", () => {
    assert.deepEqual(
      [
        sentence({ verdict: "right", mistaken: null, lead: 0.612 }),
        sentence({ verdict: "wrong", mistaken: "Radio", lead: 0.212 }),
        sentence({ verdict: "wrong", mistaken: "Radio", lead: 0 }),
        sentence({ verdict: "unsure", mistaken: null, lead: 0 }),
      ],
      [
        "right 612 ms before the press",
        "wrong at first (Radio), right 212 ms before the press",
        "wrong, it expected Radio",
        "not sure before the press",
      ],
    );
  });
});

describe("status", () => {
  it("are shown at once, and announced seldom, the last of several", async (test) => {
    test.mock.timers.enable({ apis: ["setTimeout"] });
    let now = 0;
    test.mock.method(performance, "now", () => now);
    const [visible, live] = [{ textContent: "" }, { textContent: "" }];
    const status = new Status(visible as HTMLElement, live as HTMLElement);
    status.write("one");
    assert.deepEqual([visible.textContent, live.textContent], ["one", "one"]);
    status.write("two");
    status.write("three");
    assert.deepEqual([visible.textContent, live.textContent], ["three", "one"]);
    now = 700;
    test.mock.timers.tick(700);
    assert.equal(live.textContent, "three");
    status.write("four", true);
    status.show("five");
    assert.deepEqual([visible.textContent, live.textContent], ["five", "four"]);
  });
});

describe("trail", () => {
  it("is widest at the newest place and narrows to a point", () => {
    assert.equal(
      trail(
        [
          { x: 0, y: 0 },
          { x: 10, y: 0 },
          { x: 20, y: 0 },
        ],
        8,
      ),
      "M0 0L10 2L20 4L20 -4L10 -2L0 0Z",
    );
    assert.equal(trail([{ x: 3, y: 3 }], 8), "");
  });
});

describe("arrow keys", () => {
  it("walk in reading order, by rows, and to the first and last", () => {
    const keys = ["ArrowRight", "ArrowLeft", "ArrowUp", "ArrowDown", "Home", "End"];
    assert.deepEqual(
      keys.map((key) => destinationOf(key, 7, 7, 21)),
      [8, 6, 0, 14, 0, 20],
    );
  });

  it("stop at the first and last, and leave other keys alone", () => {
    assert.equal(destinationOf("ArrowLeft", 0, 7, 21), null);
    assert.equal(destinationOf("ArrowDown", 14, 7, 21), null);
    assert.equal(destinationOf("a", 3, 7, 21), null);
  });
});

describe("bands", () => {
  const moment = (time: number, ...probabilities: number[]) => ({
    time,
    probabilities: Float64Array.from(probabilities),
  });
  const labels = ["a", "b", "c", "d", "e", "f"];

  it("put the one in question at the bottom, then the weightiest, then all others as one", () => {
    const bands = bandsOf([moment(0, 0.05, 0.1, 0.2, 0.3, 0.15, 0.2), moment(1, 0.05, 0.1, 0.3, 0.3, 0.05, 0.2)], labels, 1);
    assert.deepEqual(
      bands.map((band) => band.label),
      ["b", "d", "c", "f", "Others"],
    );
    assert.ok(Math.abs((bands[4]?.values[0] ?? 0) - 0.2) < 1e-12);
  });

  it("are stacked", () => {
    assert.deepEqual(
      stack([
        [1, 2],
        [3, 4],
        [5, 6],
      ]),
      [
        [1, 2],
        [4, 6],
        [9, 12],
      ],
    );
  });
});

describe("ellipse", () => {
  it("has the deviations as its axes", () => {
    const { long, short, angle } = ellipse([9, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], 4);
    assert.deepEqual([long, short, Math.abs(angle)], [3, 2, 0]);
  });

  it("lies along the correlation", () => {
    const { long, short, angle } = ellipse([5, 3, 3, 5], 2);
    assert.ok(Math.abs(long - Math.sqrt(8)) < 1e-12);
    assert.ok(Math.abs(short - Math.sqrt(2)) < 1e-12);
    assert.ok(Math.abs(angle - Math.PI / 4) < 1e-12);
  });

  it("is shown once it distinguishes places", () => {
    assert.equal(isInformative({ long: 300, short: 20, angle: 0 }, 800, 430), false);
    assert.equal(isInformative({ long: 60, short: 20, angle: 0 }, 800, 430), true);
  });
});

describe("history", () => {
  /** Two movements, at 1 to 1.2 s and at 3 to 3.2 s. */
  function two(): History {
    const history = new History();
    for (const start of [1, 3]) {
      for (const later of [0, 0.1, 0.2]) history.add({ time: start + later, probabilities: Float64Array.of(later) });
      history.end();
    }
    return history;
  }
  const times = (moments: readonly { time: number }[]) => moments.map(({ time }) => time);

  it("has for a press the movement in which the icon was ringed, else the last one", () => {
    assert.deepEqual(times(two().take(1.15)), [1, 1.1, 1.2]);
    assert.deepEqual(times(two().take(3)), [3, 3.1, 3.2]);
    assert.deepEqual(times(two().take(4)), [3, 3.1, 3.2]);
  });

  it("begins again after a press, and keeps no more than the last seconds of a movement", () => {
    const history = two();
    history.take(4);
    assert.deepEqual(history.current, []);
    for (let time = 5; time < 30; time++) history.add({ time, probabilities: Float64Array.of(1) });
    assert.deepEqual([history.current[0]?.time, history.current.length], [17, 13]);
  });
});
