// Prediction on the built page: Chromium's mouse heads for every icon, and the page predicts it before the mouse is there.
import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { movement } from "./hand.mjs";
import { head, hosted, middles, mouse, open, read, readMovement, REST, sumsToOne } from "./support.mjs";

/** Shares of the screen's width and height; some lie outside of it. */
const STARTS = [
  [0.5, 1.08],
  [-0.02, 0.7],
  [1.01, 0.2],
  [0.286, 0.335],
  [0.714, 0.66],
  [0.43, -0.08],
];

describe("pointing", () => {
  const site = hosted();
  let opened;
  before(async () => (opened = await open(site.browser, site.url)));

  it("has the right icon on top at 80% of the movement time in at least 95% of the movements", async (test) => {
    const { page, problems } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    assert.equal(icons.length, 21);
    const box = await page.locator("#screen").boundingBox();
    const wrong = [];
    let count = 0;
    for (const [across, down] of STARTS) {
      const from = { x: box.x + across * box.width, y: box.y + down * box.height };
      for (const icon of icons) {
        count += 1;
        await hand.play([[0, from.x, from.y]]);
        await hand.rest(REST);
        await hand.play(movement(from, icon, Math.min(icon.width, icon.height), { seed: count, share: 0.8 }));
        const shown = await readMovement(page);
        assert.ok(sumsToOne(shown), `probabilities and none sum to ${shown.sum}`);
        if (shown.top.id !== icon.id) wrong.push(`${Math.round(from.x)},${Math.round(from.y)} to ${icon.id}: ${shown.top.id}`);
      }
    }
    test.diagnostic(
      `${count - wrong.length} of ${count} right at 80% of the time${wrong.map((each) => `\n  wrong: ${each}`).join("")}`,
    );
    assert.ok(wrong.length <= 0.05 * count, wrong.join("\n"));
    assert.deepEqual(problems, []);
  });

  it("rings the icon that it is sure of, and announces it at once", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const { shown } = await head(page, hand, "fuel", "seats", { seed: 5 });
    assert.ok(shown.top.probability >= 0.8, `${shown.top.id} ${shown.top.probability}`);
    assert.deepEqual(
      shown.icons.filter((icon) => icon.predicted).map((icon) => icon.id),
      ["seats"],
    );
    assert.equal(shown.status, "Heading for Seats.");
    await page.waitForFunction(() => document.querySelector("#announcement").textContent === "Heading for Seats.");
  });

  it("reports one outcome of a press: its sentence, the chart and the numbers agree", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    await hand.press((await middles(page)).find((icon) => icon.id === "seats"));
    const { median, right, wrong, status, announced, caption, chart } = await outcome(page);
    const [, early] = /^Lit Seats (\d\.\d\d s) before you pressed\.$/.exec(status) ?? assert.fail(status);
    assert.ok(Number.parseFloat(early) > 0.15, status);
    assert.deepEqual([median, right, wrong], [early, "100%", "0%"]);
    assert.equal(announced, status);
    assert.equal(caption, "Yours, to Seats");
    assert.equal(chart, `Probabilities over the movement, stacked: Seats lit ${early} before the press`);
    await page.waitForTimeout(1500);
    assert.equal((await outcome(page)).status, status, "it stays until the next movement");
  });

  it("counts a press on another icon than the one that it had ringed", async () => {
    const { page, problems } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "seats");
    const toward = icons.find((icon) => icon.id === "parking");
    const pressed = icons.find((icon) => icon.id === "trip");
    await hand.rest(REST);
    const there = movement(from, toward, toward.width, { seed: 6, share: 0.8 });
    const [turn, x, y] = there.at(-1);
    const back = movement({ x, y }, pressed, pressed.width, { seed: 7 });
    await hand.play([...there, ...back.slice(1).map(([time, ...place]) => [turn + time, ...place])]);
    await hand.press(pressed);
    const { status, right, wrong, presses } = await outcome(page);
    assert.match(status, /^Lit Trip \d\.\d\d s before you pressed, after first lighting [A-Z]\w+\.$/);
    assert.deepEqual([right, wrong], ["50%", "50%"]);
    assert.match(presses, /^Over 2 presses\. Learnt from them: your movements count (0|1)\.\d\d times as much as at first\.$/);
    assert.doesNotMatch(presses, /1\.00/, "they teach something");
    assert.deepEqual(problems, []);
  });

  for (const [name, rest] of [
    ["a hover of 120 ms", 0.12],
    ["a rest", 0.5],
  ]) {
    it(`does not lose a right prediction to ${name} before the press, nor to a hand that comes to rest`, async () => {
      const { page, close } = await open(site.browser, site.url);
      const hand = await mouse(page);
      const { end } = await head(page, hand, "fuel", "seats", { seed: 5 });
      await hand.rest(rest);
      await hand.play([0, 8, 16, 8].map((aside, step) => [step / 50, end.x + aside, end.y - aside]));
      await hand.press(end);
      const { status, median, right } = await outcome(page);
      const [, early] = /^Lit Seats (\d\.\d\d s) before you pressed\.$/.exec(status) ?? assert.fail(status);
      assert.ok(Number.parseFloat(early) >= rest, status);
      assert.deepEqual([median, right], [early, "100%"]);
      await close();
    });
  }

  it("shows in every frame a sentence that fits the ring, and rows in the order of their numbers", async () => {
    const { page, close } = await open(site.browser, site.url);
    await page.evaluate(() => {
      window.frames = [];
      const number = (text) => ({ "<1%": 0.5, ">99%": 99.5 })[text] ?? Number.parseInt(text, 10);
      const watch = () => {
        const ringed = [...document.querySelectorAll("[data-predicted=true] .label")].map((label) => label.textContent);
        const rows = [...document.querySelectorAll(".row-figure")].map((figure) => number(figure.textContent));
        window.frames.push({ ringed, rows, status: document.querySelector("#status").textContent });
        requestAnimationFrame(watch);
      };
      requestAnimationFrame(watch);
    });
    const hand = await mouse(page);
    for (const [index, [from, to]] of [
      ["fuel", "seats"],
      ["help", "phone"],
      ["navigation", "weather"],
    ].entries()) {
      await head(page, hand, from, to, { seed: index });
    }
    const frames = (await page.evaluate(() => window.frames)).filter(({ status }) => status !== "Move towards an icon.");
    await close();
    assert.ok(frames.some(({ ringed }) => ringed.length === 1) && frames.some(({ status }) => status === "Not sure yet."));
    for (const { ringed, rows, status } of frames) {
      if (ringed.length === 0) assert.equal(status, "Not sure yet.");
      else assert.equal(status, `Heading for ${ringed.join()}.`);
      assert.deepEqual(
        rows,
        rows.toSorted((a, b) => b - a),
      );
    }
  });

  it("keeps the light for most of a second after a press, then lets it fade", async () => {
    const { page, close } = await open(site.browser, site.url);
    const hand = await mouse(page);
    const { end } = await head(page, hand, "fuel", "seats", { seed: 5 });
    await page.evaluate(() => {
      window.glow = new Promise((resolve) => {
        const seats = document.querySelector("[data-destination=seats]");
        const screen = document.querySelector("#screen");
        const light = () => Number(getComputedStyle(seats).getPropertyValue("--light-share"));
        let [pressed, light0, opened, dimming] = [null, null, null, 0];
        addEventListener("pointerdown", () => (pressed = performance.now()), { capture: true });
        const watch = (now) => {
          if (pressed !== null) light0 ??= light();
          if (pressed !== null && !seats.matches("[data-predicted], [data-held]")) opened ??= now - pressed;
          if (opened !== null && screen.hasAttribute("data-fading") && light() < light0 && light() > 0.1) dimming += 1;
          if (opened !== null && !screen.hasAttribute("data-fading"))
            resolve({ light0, opened, dark: now - pressed, dimming, light: light() });
          else requestAnimationFrame(watch);
        };
        requestAnimationFrame(watch);
      });
    });
    await hand.press(end);
    const { light0, opened: ring, dark, dimming, light } = await page.evaluate(() => window.glow);
    await close();
    assert.ok(light0 > 0.8, `lit to ${light0} at the press`);
    assert.ok(ring >= 600, `the ring opened after ${ring} ms`);
    assert.ok(dark > ring + 200 && dimming >= 2 && light < 0.1, `it faded until ${dark} ms, over ${dimming} frames, to ${light}`);
  });

  it("learns from every sample once, also when the browser hands over many at a time", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "help");
    const to = icons.find((icon) => icon.id === "media");
    const samples = movement(from, to, to.width, { seed: 11, share: 0.8 });
    await page.evaluate(() => {
      window.most = 0;
      addEventListener("pointermove", (event) => (window.most = Math.max(window.most, event.getCoalescedEvents().length)));
    });
    const shown = [];
    const most = [];
    for (const busy of [false, true]) {
      await hand.play([[0, from.x, from.y]]);
      await hand.rest(REST);
      // A page that has no time for events finds them all in one afterwards.
      const work = page.evaluate(
        (until) => {
          while (Date.now() < until);
        },
        busy ? Date.now() + 1000 : 0,
      );
      await Promise.all([work, hand.play(samples)]);
      shown.push(await readMovement(page));
      most.push(await page.evaluate(() => window.most));
    }
    assert.equal(shown[1].top.id, "media");
    assert.ok(most[1] > 20, `at most ${most[1]} samples came at once`);
    for (const [index, icon] of shown[0].icons.entries()) {
      assert.ok(
        Math.abs(icon.probability - shown[1].icons[index].probability) < 0.02,
        `${icon.id}: ${icon.probability}, ${shown[1].icons[index].probability}`,
      );
    }
  });

  it("ends the movement where the page is hidden, and begins another when it is visible again", async () => {
    const { page, problems, close } = await open(site.browser, site.url);
    const hand = await mouse(page);
    const { shown } = await head(page, hand, "fuel", "seats", { seed: 5 });
    assert.ok(shown.top.probability >= 0.8, `${shown.top.id} ${shown.top.probability}`);
    await page.evaluate(() => {
      Object.defineProperty(document, "hidden", { value: true, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
      delete document.hidden;
    });
    const hidden = await read(page);
    assert.deepEqual(
      hidden.icons.filter((icon) => icon.predicted),
      [],
    );
    assert.ok(hidden.icons.every((icon) => Math.abs(icon.probability - hidden.icons[0].probability) < 1e-4));
    // at once, without a rest: the observations before would favour the seats
    const icons = await middles(page);
    const [seats, trip] = ["seats", "trip"].map((id) => icons.find((icon) => icon.id === id));
    await hand.play(movement(seats, trip, Math.min(trip.width, trip.height), { seed: 2 }));
    assert.equal((await readMovement(page)).top.id, "trip");
    assert.deepEqual(problems, []);
    await close();
  });

  it("starts afresh after a rest", async () => {
    const { page } = opened;
    const hand = await mouse(page);
    const icons = await middles(page);
    const from = icons.find((icon) => icon.id === "navigation");
    const via = icons.find((icon) => icon.id === "apps");
    const to = icons.find((icon) => icon.id === "radio");
    await hand.play([[0, from.x, from.y]]);
    await hand.rest(REST);
    await hand.play(movement(from, via, via.width, { seed: 8 }));
    await hand.rest(REST);
    const back = movement(via, to, to.width, { seed: 9, share: 0.8 });
    await hand.play(back);
    const afterDetour = await readMovement(page);
    await hand.play([[0, 640, 780]]);
    await hand.rest(REST);
    await hand.play([[0, via.x, via.y]]);
    await hand.rest(REST);
    await hand.play(back);
    const direct = await readMovement(page);
    assert.equal(afterDetour.top.id, "radio");
    for (const [index, icon] of direct.icons.entries()) {
      assert.ok(Math.abs(icon.probability - afterDetour.icons[index].probability) < 0.02, icon.id);
    }
  });
});

/** What the page shows of the last press and of all. */
function outcome(page) {
  return page.evaluate(() => {
    const text = (id) => document.getElementById(id).textContent;
    const [median, right, wrong, presses] = ["median", "early-right", "early-wrong", "presses"].map(text);
    const chart = document.getElementById("chart").getAttribute("aria-label");
    return {
      median,
      right,
      wrong,
      presses,
      status: text("status"),
      announced: text("announcement"),
      caption: text("lead"),
      chart,
    };
  });
}
