// A car: the road and what points, the ring that selects, and the models; equal methods show equal numbers.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "./hand.mjs";
import { head, hosted, middles, mouse, nextFrame, open, readMovement, REST } from "./support.mjs";

describe("ride", () => {
  const site = hosted();

  /** A page whose controls are open and set, at its top. */
  async function set(values, options = { reducedMotion: "reduce" }) {
    const opened = await open(site.browser, site.url, options);
    const { page } = opened;
    await page.locator(".controls summary").click();
    await change(page, values);
    return { ...opened, hand: await mouse(page) };
  }

  async function change(page, values) {
    for (const [name, value] of Object.entries(values)) {
      const control = page.locator(`[name=${name}]`);
      if (typeof value === "boolean") await control.setChecked(value);
      else if (await control.evaluate((element) => element.matches("select"))) await control.selectOption(value);
      else await control.fill(String(value));
    }
    await page.evaluate(() => scrollTo(0, 0));
    await nextFrame(page);
  }

  const text = (page, id) => page.evaluate((id) => document.getElementById(id).textContent, id);

  it("shakes what is observed of the visitor's pointer as the road does, and draws it there", async () => {
    const { page, problems, hand, close } = await set({ amplitude: 20, frequency: 8 });
    await page.evaluate(() => {
      window.moves = { mouse: [], shaken: [] };
      addEventListener("pointermove", ({ pointerType, clientX, clientY, timeStamp }) =>
        window.moves[pointerType].push([timeStamp, clientX, clientY]),
      );
    });
    const { end } = await head(page, hand, "fuel", "weather", { seed: 5 });
    const moves = await page.evaluate(() => window.moves);
    assert.ok(
      moves.shaken.length >= moves.mouse.length && moves.mouse.length > 10,
      `${moves.shaken.length}, ${moves.mouse.length}`,
    );
    const at = new Map(moves.shaken.map(([time, x, y]) => [time.toFixed(1), [x, y]]));
    const off = moves.mouse.flatMap(([time, x, y]) => {
      const [shakenX, shakenY] = at.get(time.toFixed(1)) ?? [];
      return shakenX === undefined ? [] : [shakenX - x, shakenY - y];
    });
    const deviation = Math.sqrt(off.reduce((sum, each) => sum + each ** 2, 0) / off.length);
    // a sinusoid of 20 px has 14 px; over a second a sum of eight waves has more or less
    assert.ok(off.length > 20 && deviation > 7 && deviation < 24, `${deviation} px over ${off.length}`);
    const cursor = await page.evaluate(() => {
      const { left, top } = document.querySelector("#hand .arrow").getBoundingClientRect();
      return {
        hidden: document.querySelector("#hand").hidden,
        left,
        top,
        own: getComputedStyle(document.querySelector("#screen")).cursor,
      };
    });
    const [, x, y] = moves.shaken.at(-1);
    assert.deepEqual([cursor.hidden, cursor.own], [false, "none"]);
    assert.ok(Math.hypot(cursor.left - x, cursor.top - y) < 3, `${cursor.left}, ${cursor.top}: ${x}, ${y}`);
    await hand.press(end);
    await page.waitForFunction(() => document.querySelector("#presses").textContent.startsWith("Over 1 press"));
    await change(page, { amplitude: 0 });
    assert.equal(await page.locator("#hand").isHidden(), true);
    assert.deepEqual(problems, []);
    await close();
  });

  it("goes on predicting on a road when the model is to know of it, and when not", async () => {
    const { page, problems, hand, close } = await set({ amplitude: 10, frequency: 6 });
    for (const expected of [true, false]) {
      await change(page, { expected });
      const { shown } = await head(page, hand, "fuel", "weather", { seed: 5 });
      assert.equal(shown.top.id, "weather");
    }
    assert.deepEqual(problems, []);
    await close();
  });

  it("observes a finger on the glass alone, and selects where it lifts", async () => {
    const { page, problems, hand, close } = await set({ device: "touch" });
    const icons = await middles(page);
    const [from, to] = ["fuel", "trip"].map((id) => icons.find((icon) => icon.id === id));
    await hand.play(movement(from, to, to.width, { seed: 3 }));
    assert.equal(await page.locator("#hand").isHidden(), true);
    assert.equal(await text(page, "status"), "Move towards an icon.");
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    assert.equal(await page.locator("#hand[data-device=touch] .fingertip").isVisible(), true);
    for (let step = 1; step <= 20; step += 1) {
      await page.mouse.move(from.x + ((to.x - from.x) * step) / 20, from.y + ((to.y - from.y) * step) / 20);
      await page.waitForTimeout(25);
    }
    await page.mouse.up();
    await page.waitForFunction(() => document.querySelector("#lead").textContent === "Yours, to Trip");
    assert.match(await text(page, "status"), /you pressed/);
    assert.deepEqual(problems, []);
    await close();
  });

  it("observes a hand in mid-air at most sixty times a second, with a tracker's noise", async () => {
    const { page, hand, close } = await set({ device: "air" });
    await page.evaluate(() => {
      window.times = [];
      addEventListener("pointermove", ({ pointerType, timeStamp }) => pointerType === "shaken" && window.times.push(timeStamp));
    });
    await head(page, hand, "fuel", "weather", { seed: 5, rate: 250 });
    const times = await page.evaluate(() => window.times);
    const gaps = times.slice(1).map((time, index) => time - times[index]);
    assert.ok(times.length > 10 && gaps.every((gap) => gap > 16.6), `${Math.min(...gaps)} ms`);
    assert.equal(await page.locator("#hand[data-device=air] .palm").isVisible(), true);
    await close();
  });

  it("selects when the ring closes: names icons, and counts what that saves and what was wrong", async () => {
    const { page, problems, hand, close } = await set({ selecting: true });
    const wanted = () => page.evaluate(() => document.querySelector("[data-wanted]")?.dataset.destination ?? null);
    const next = () => page.waitForFunction(() => document.querySelector("[data-wanted]") !== null);
    await next();
    const first = await wanted();
    const label = await page.locator(`[data-destination=${first}] .label`).textContent();
    assert.equal(await text(page, "status"), `Go to ${label}: it is selected when the ring closes.`);
    const far = (await middles(page)).toSorted((a, b) => Number(a.id === first) - Number(b.id === first));
    const from = far.find((icon) => icon.id !== first && Math.abs(icon.x - far.at(-1).x) > 250);
    await head(page, hand, from.id, first, { seed: 5 });
    await page.waitForFunction(() => /1 selection,/.test(document.querySelector("#tally").textContent));
    assert.match(await text(page, "tally"), /^You: 1 selection, 0 wrong \(0%\), \d\.\d\d s saved in all/);
    assert.match(
      await text(page, "status"),
      new RegExp(`^Selected ${label}( \\d\\.\\d\\d s before the pointer was there| on arrival)\\.$`),
    );
    await next();
    const second = await wanted();
    assert.notEqual(second, first);
    // to another one
    const other = (await middles(page)).find((icon) => {
      const it = far.find(({ id }) => id === first);
      return icon.id !== second && Math.hypot(icon.x - it.x, icon.y - it.y) > 300;
    });
    await head(page, hand, first, other.id, { seed: 6 });
    await page.waitForFunction(() => /2 selections, 1 wrong \(50%\)/.test(document.querySelector("#tally").textContent));
    assert.match(await text(page, "status"), /^Selected .*: wrong, it was to be .*\.$/);
    assert.equal(await text(page, "median"), "–", "nothing was pressed");
    await change(page, { selecting: false });
    assert.equal(await wanted(), null);
    assert.equal(await text(page, "status"), "Move towards an icon.");
    assert.deepEqual(problems, []);
    await close();
  });

  it("shows the same with a simulated hand, whose selections are counted apart", async () => {
    const { page, problems, close } = await set({ selecting: true }, { reducedMotion: "no-preference" });
    await page.waitForFunction(
      () => /^The simulated hand: [12] selection/.test(document.querySelector("#tally").textContent),
      null,
      {
        timeout: 60_000,
      },
    );
    assert.match(await text(page, "status"), /^A simulated hand\. (Selected|Go to) /);
    assert.equal((await page.locator("[data-pressed]").count()) > 0, true);
    await page.mouse.move(300, 300);
    await page.waitForFunction(() => /^You: no selection yet\.$/.test(document.querySelector("#tally").textContent));
    assert.deepEqual(problems, []);
    await close();
  });

  it("shows equal numbers for methods that are equal, whatever the motion model and the prior of the arrival", async () => {
    const { page, problems, hand, close } = await set({});
    const icons = await middles(page);
    const [from, to] = ["help", "radio"].map((id) => icons.find((icon) => icon.id === id));
    const shown = async (values) => {
      await change(page, { ...values, points: 15 });
      await page.waitForTimeout(300);
      await hand.play([[0, from.x, from.y]]);
      await hand.rest(REST);
      await hand.play(movement(from, to, to.width, { seed: 4, share: 0.7 }));
      return (await readMovement(page)).icons.map((icon) => icon.probability);
    };
    const apart = (one, other) => Math.max(...one.map((each, index) => Math.abs(each - other[index])));
    for (const [motion, arrival] of [
      ["constantVelocity", "logNormal"],
      ["equilibriumRevertingVelocity", "fitts"],
      ["brownian", "uniform"],
    ]) {
      const family = {};
      for (const methods of [
        ["pseudoObservation", "algorithm1", "algorithm2"],
        ["bridging", "singleFilter"],
      ]) {
        for (const method of methods) {
          family[method] = await shown({ method, motion, arrival });
          assert.ok(Math.max(...family[method]) > 0.05, method);
          const off = apart(family[method], family[methods[0]]);
          assert.ok(off < 0.015, `${method}, ${methods[0]}, ${motion}, ${arrival}: ${off}`);
        }
      }
    }
    assert.equal(await page.locator("[name=expected]").isDisabled(), true, "the papers' methods know of no road");
    assert.deepEqual(problems, []);
    await close();
  });

  it("has the prior of none among the controls", async () => {
    const { page, hand, close } = await set({ none: 0 });
    await head(page, hand, "fuel", "weather", { seed: 5, share: 0.5 });
    assert.equal((await readMovement(page)).none, 0);
    await change(page, { none: 0.5 });
    await head(page, hand, "fuel", "weather", { seed: 5, share: 0.5 });
    assert.ok((await readMovement(page)).none > 0.05);
    await close();
  });
});
