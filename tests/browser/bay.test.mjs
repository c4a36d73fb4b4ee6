// The bay: voyages replayed and steered, and a hundred vessels at once.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { collisions } from "./collisions.mjs";
import { hosted, nextFrame, open } from "./support.mjs";

const BAY = "bay/index.html";
const CALM = { reducedMotion: "reduce" };

/** What the page shows, after the next frame. */
async function shown(page) {
  await nextFrame(page);
  return page.evaluate(() => {
    const text = (selector) => document.querySelector(selector)?.textContent ?? "";
    return {
      rows: [...document.querySelectorAll("#rows .row")].map((row) => ({
        name: row.querySelector(".row-name").textContent,
        figure: row.querySelector(".row-figure").textContent,
        share: Number(row.style.getPropertyValue("--share")),
      })),
      status: text("#status"),
      clock: text("#clock"),
      heading: text("#arrival-harbour"),
      time: text("#arrival-time"),
      interval: text("#arrival-interval"),
      anomalies: [...document.querySelectorAll("#anomalies .found")].map((item) => item.textContent),
    };
  });
}

/** Goes to a share of the voyage, and waits for what that takes to compute. */
async function scrub(page, share) {
  const last = Number(await page.locator("#time").getAttribute("max"));
  await page.locator("#time").fill(String(Math.round(share * last)));
  const time = await page.locator("#time").getAttribute("aria-valuetext");
  await settled(page);
  return { ...(await shown(page)), at: time };
}

/** Until nothing is left to compute: that goes on over several frames. */
async function settled(page) {
  await nextFrame(page);
  await page.waitForFunction(() => document.querySelector("#chart").ariaBusy === "false", null, { timeout: 60_000 });
}

async function choose(page, voyage) {
  await page.locator("#voyage").selectOption(voyage);
  await settled(page);
}

const minutes = (time) => Number(time.slice(0, 2)) * 60 + Number(time.slice(3, 5));

const middle = async (page, selector) => {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  return { x: x + width / 2, y: y + height / 2 };
};

/** Where a harbour is in the window: its place in kilometres on a chart of one scale. */
async function harbour(page, east, north) {
  const { x, y, width, height } = await page.locator("#chart").boundingBox();
  const scale = Math.min(width / 84, height / 54);
  return { x: x + width / 2 + east * scale, y: y + height / 2 - (north - 18) * scale };
}

const KELDER = [26.6, 28.2];

describe("the bay", () => {
  const site = hosted();
  const opened = (options = CALM) => open(site.browser, site.url, options, BAY);

  for (const [voyage, name] of [
    ["saltby", "Saltby"],
    ["pellness", "Pellness"],
  ]) {
    it(`has ${name} on top early, and the arrival in its interval, on the way there`, async (test) => {
      const { page, problems, close } = await opened();
      await choose(page, voyage);
      const arrived = await scrub(page, 1);
      assert.match(arrived.status, new RegExp(`in the harbour of ${name}`));
      const early = await scrub(page, 0.35);
      assert.equal(early.rows[0].name, name);
      assert.ok(early.rows[0].share > 0.5, early.rows[0].figure);
      for (const share of [0.35, 0.5, 0.7]) {
        const { interval, heading, time, anomalies, at } = await scrub(page, share);
        const [low, high] = interval.match(/\d\d:\d\d/g).map(minutes);
        test.diagnostic(`${at}: ${heading} ${time}, ${interval}; it is there at ${arrived.at}`);
        assert.equal(heading, `At ${name}`);
        assert.ok(low <= minutes(time) && minutes(time) <= high, interval);
        if (voyage === "saltby")
          assert.ok(low <= minutes(arrived.at) && minutes(arrived.at) <= high, `${interval}, not ${arrived.at}`);
        assert.deepEqual(anomalies, []);
      }
      assert.deepEqual(problems, []);
      await close();
    });
  }

  it("follows a vessel that changes its mind", async () => {
    const { page, problems, close } = await opened();
    await choose(page, "mind");
    assert.equal((await scrub(page, 0.33)).rows[0].name, "Kelder");
    assert.equal((await scrub(page, 0.75)).rows[0].name, "Wrenmouth");
    assert.match((await scrub(page, 1)).status, /in the harbour of Wrenmouth/);
    assert.deepEqual(problems, []);
    await close();
  });

  it("marks a vessel that turns back, one that stops and one that goes to none of them, with what each does", async () => {
    const { page, problems, close } = await opened();
    await choose(page, "back");
    assert.deepEqual((await scrub(page, 0.45)).anomalies, []);
    const back = await scrub(page, 0.6);
    assert.match(back.anomalies[0], /^1\. \d\d:\d\d turned back: [\d.]+ deviations from its forecast$/);
    assert.match((await scrub(page, 0.9)).status, /going to none of them, \d+%|>99%/);
    await choose(page, "stops");
    assert.match((await scrub(page, 0.5)).anomalies[0], / stopped: /);
    await choose(page, "none");
    const { rows, status, anomalies } = await scrub(page, 0.95);
    assert.equal(rows.at(-1).name, "None of them");
    assert.ok(rows.at(-1).share > 0.9, rows.at(-1).figure);
    assert.match(status, /going to none of them/);
    assert.match(anomalies.at(-1), /goes where no harbour is/);
    assert.deepEqual(problems, []);
    await close();
  });

  it("plays on the bay's clock, faster where that is set, and stops where it is paused", async () => {
    const { page, problems, close } = await opened();
    await scrub(page, 0.1);
    /** Minutes of the bay in a second of the page's, over a while. */
    const played = () =>
      page.evaluate(async () => {
        const play = document.querySelector("#play");
        const place = () => Number(document.querySelector("#time").value) / 12;
        const from = { place: place(), time: performance.now() };
        play.click();
        while (performance.now() - from.time < 1500) await new Promise(requestAnimationFrame);
        play.click();
        return ((place() - from.place) / (performance.now() - from.time)) * 1000;
      });
    const slow = await played();
    assert.ok(slow > 8.5 && slow <= 10.1, `${slow} minutes a second at 600 times`);
    await page.locator("#speed").selectOption("1200");
    const fast = await played();
    assert.ok(fast > 17 && fast <= 20.2, `${fast} minutes a second at 1200 times`);
    const { clock } = await shown(page);
    await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
    assert.equal((await shown(page)).clock, clock);
    assert.deepEqual(problems, []);
    await close();
  });

  it("states in every frame what its numbers are, and announces where it pauses", async () => {
    const { page, problems, close } = await opened();
    await scrub(page, 0.3);
    await page.locator("#play").click();
    const frames = await page.evaluate(async () => {
      const frames = [];
      const text = (selector) => document.querySelector(selector).textContent;
      while (frames.length < 40) {
        await new Promise(requestAnimationFrame);
        const [name, figure] = [text(".row-name"), text(".row-figure")];
        frames.push({ clock: text("#clock"), status: text("#status"), name, figure, time: text("#arrival-time") });
      }
      return frames;
    });
    for (const { clock, status, name, figure, time } of frames) {
      assert.ok(status.startsWith(`${clock.slice(0, 5)}: `), `${status} at ${clock}`);
      assert.ok(status.includes(name) && status.includes(figure), `${status} beside ${name} ${figure}`);
      if (status.includes("there at")) assert.ok(status.includes(`there at ${time}`), `${status} beside ${time}`);
    }
    await page.locator("#play").click();
    await page.waitForFunction(
      () => document.querySelector("#announcement").textContent === document.querySelector("#status").textContent,
    );
    assert.deepEqual(problems, []);
    await close();
  });

  it("changes no number between methods that are equal, and some between those that are not", async () => {
    const { page, problems, close } = await opened();
    await scrub(page, 0.4);
    await page.locator("#controls summary").click();
    const by = async (method) => {
      await page.locator("#method").selectOption(method);
      await page.waitForFunction(() => document.querySelector("#cost").textContent.endsWith("ms a report"));
      return scrub(page, 0.4);
    };
    const first = await by("pseudoObservation");
    assert.deepEqual(await by("algorithm1"), first);
    assert.deepEqual(await by("algorithm2"), first);
    const bridging = await by("bridging");
    assert.deepEqual(await by("singleFilter"), bridging);
    assert.notDeepEqual(bridging.rows, first.rows);
    assert.deepEqual(problems, []);
    await close();
  });

  it("cannot be set to what the library refuses, and goes back to how it was", async () => {
    const { page, problems, close } = await opened();
    const first = await scrub(page, 0.4);
    await page.locator("#controls summary").click();
    await page.locator("#prior").selectOption("horizon");
    assert.equal(await page.locator("#method option[value=bridging]").isDisabled(), true);
    assert.notDeepEqual((await scrub(page, 0.4)).rows, first.rows);
    await page.locator("#noise").fill("-0.5");
    await page.locator("#none").fill("-0.2");
    const loose = await scrub(page, 0.4);
    assert.ok(loose.rows[0].share < first.rows[0].share - 0.2, `${loose.rows[0].share}`);
    await page.locator("#model [type=reset]").click();
    assert.deepEqual(await scrub(page, 0.4), first);
    assert.deepEqual(problems, []);
    await close();
  });

  describe("at the helm", () => {
    it("puts the harbour on top to which a mouse drags the vessel, and marks a sharp turn", async () => {
      const { page, problems, close } = await opened();
      await choose(page, "own");
      const from = await middle(page, "#vessel");
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      const end = await harbour(page, ...KELDER);
      await page.mouse.move(end.x, end.y, { steps: 5 });
      await page.waitForFunction(
        () =>
          document.querySelector(".row-name").textContent === "Kelder" &&
          Number(document.querySelector(".row").style.getPropertyValue("--share")) > 0.8,
      );
      await page.waitForFunction(() => document.querySelector("#clock").textContent > "12:20");
      await page.mouse.move(from.x, from.y, { steps: 2 });
      await page.waitForFunction(() => /turned back/.test(document.querySelector("#anomalies").textContent));
      await page.mouse.move(end.x, end.y, { steps: 2 });
      await page.waitForFunction(() => /in the harbour of Kelder/.test(document.querySelector("#status").textContent));
      await page.mouse.up();
      // the bay's clock runs only while the vessel is held
      const { clock } = await shown(page);
      await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.equal((await shown(page)).clock, clock);
      // and what was steered can be replayed
      assert.ok((await scrub(page, 0.2)).rows.slice(0, 2).some(({ name }) => name === "Kelder"));
      assert.deepEqual(problems, []);
      await close();
    });

    it("takes over a voyage where it is", async () => {
      const { page, problems, close } = await opened();
      await scrub(page, 0.4);
      const { clock } = await shown(page);
      const from = await middle(page, "#vessel");
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(from.x + 120, from.y + 30, { steps: 4 });
      await page.waitForFunction(
        (before) => document.querySelector("#clock").textContent.slice(0, 5) > before,
        clock.slice(0, 5),
      );
      await page.mouse.up();
      assert.equal(await page.locator("#voyage").inputValue(), "own");
      assert.ok((await middle(page, "#vessel")).x > from.x);
      assert.deepEqual(problems, []);
      await close();
    });

    it("is reached by the keyboard", async () => {
      const { page, problems, close } = await opened();
      await choose(page, "own");
      /** On the chart, wherever that has been scrolled to. */
      const at = async () => {
        const [vessel, chart] = [await middle(page, "#vessel"), await middle(page, "#chart")];
        return { x: vessel.x - chart.x, y: vessel.y - chart.y };
      };
      const from = await at();
      for (let touch = 0; touch < 12; touch += 1) await page.locator("#vessel").press("ArrowUp");
      await page.waitForFunction(() => Number(document.querySelector(".row").style.getPropertyValue("--share")) > 0.3);
      const { rows, clock } = await shown(page);
      assert.ok(["Wrenmouth", "Tern Quay"].includes(rows[0].name), rows[0].name);
      assert.ok(minutes(clock) >= 12 * 60 + 12, clock);
      const to = await at();
      assert.ok(to.y < from.y - 30 && Math.abs(to.x - from.x) < 2, `${from.y} to ${to.y}`);
      assert.deepEqual(problems, []);
      await close();
    });

    it("never leaves the water", async () => {
      const { page, problems, close } = await opened();
      await choose(page, "own");
      await page.locator("#speed").selectOption("1200");
      const from = await middle(page, "#vessel");
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      const inland = await harbour(page, -41, 40);
      await page.mouse.move(inland.x, inland.y, { steps: 3 });
      let last = { x: Number.NaN, y: Number.NaN };
      for (let now = await middle(page, "#vessel"); now.x !== last.x || now.y !== last.y; now = await middle(page, "#vessel")) {
        last = now;
        await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 250)));
      }
      await page.mouse.up();
      assert.ok(Math.hypot(last.x - inland.x, last.y - inland.y) > 60, "it is still at sea");
      assert.ok(Math.hypot(last.x - from.x, last.y - from.y) > 100, "it has sailed");
      assert.deepEqual(problems, []);
      await close();
    });

    it("steers by a finger on the vessel and scrolls by one beside it", async () => {
      const { page, problems, close } = await opened({
        ...CALM,
        viewport: { width: 390, height: 844 },
        hasTouch: true,
        isMobile: true,
      });
      await choose(page, "own");
      const session = await page.context().newCDPSession(page);
      const swipe = async (from, to) => {
        await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [from] });
        for (let step = 1; step <= 12; step += 1) {
          const at = { x: from.x + ((to.x - from.x) * step) / 12, y: from.y + ((to.y - from.y) * step) / 12 };
          await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [at] });
          await nextFrame(page);
        }
        await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
        await nextFrame(page);
      };
      const vessel = await middle(page, "#vessel");
      await swipe(vessel, { x: vessel.x + 40, y: vessel.y - 120 });
      assert.equal(await page.evaluate(() => scrollY), 0);
      const after = await middle(page, "#vessel");
      assert.ok(after.y < vessel.y - 10, `${vessel.y} to ${after.y}`);
      const { clock } = await shown(page);
      await swipe({ x: 60, y: vessel.y }, { x: 60, y: vessel.y - 200 });
      await page.waitForFunction(() => scrollY > 50);
      assert.equal((await shown(page)).clock, clock);
      assert.deepEqual(problems, []);
      await close();
    });
  });

  it("follows a hundred vessels at once: boards in order, books kept", async (test) => {
    const { page, problems, close } = await opened();
    await page.locator("#hundred").click();
    await settled(page);
    const at = async (share) => {
      await scrub(page, share);
      return page.evaluate(() => ({
        atSea: Number.parseInt(document.querySelector("#at-sea").textContent, 10),
        right: document.querySelector("#right").textContent,
        within: document.querySelector("#within").textContent,
        marked: document.querySelector("#marked").textContent,
        throughput: Number(document.querySelector("#throughput").textContent.replaceAll(",", "")),
        boards: [...document.querySelectorAll(".berth")].map((berth) => ({
          times: [...berth.querySelectorAll(".berth-line:not(.empty) .berth-time")].map((time) => time.textContent),
          vessels: [...berth.querySelectorAll(".berth-line:not(.empty) .berth-vessel")].map((vessel) => vessel.textContent),
        })),
      }));
    };
    const early = await at(0.14);
    assert.equal(early.atSea, 100);
    assert.equal(early.boards.length, 6);
    for (const { times } of early.boards) assert.deepEqual(times, [...times].sort());
    const vessels = early.boards.flatMap((board) => board.vessels);
    assert.ok(vessels.length >= 12, `${vessels.length} on the boards`);
    assert.equal(new Set(vessels).size, vessels.length);

    const chosen = page.locator(".berth-vessel:enabled").last();
    const name = await chosen.textContent();
    await chosen.click();
    assert.ok((await shown(page)).status.startsWith(`${name}, `));
    assert.equal(await chosen.getAttribute("aria-pressed"), "true");

    const late = await at(1);
    test.diagnostic(
      `right at half way: ${late.right}; within the interval: ${late.within}; marked: ${late.marked}; ${late.throughput} reports a second`,
    );
    const [right, half] = late.right.match(/\d+/g).map(Number);
    assert.equal(half, 94);
    assert.ok(right / half > 0.85, late.right);
    const [within] = late.within.match(/\d+/g).map(Number);
    assert.ok(within / half > 0.6, late.within);
    assert.match(late.marked, /^6 of 6 that call nowhere, \d others$/);
    assert.ok(late.throughput > 100, `${late.throughput}`);

    const again = await at(0.14);
    assert.deepEqual(again.boards, early.boards);
    await page.locator("#one").click();
    assert.match((await shown(page)).status, /^\d\d:\d\d: /);
    assert.equal(await page.locator("#master").isVisible(), false);
    assert.deepEqual(problems, []);
    await close();
  });

  it("follows the vessel of the hundred that is clicked on the chart", async () => {
    const { page, problems, close } = await opened();
    await page.locator("#hundred").click();
    await settled(page);
    await page.waitForFunction(() => document.querySelector("#at-sea").textContent.startsWith("100"));
    const before = (await shown(page)).status.split(",")[0];
    const { x, y, width, height } = await page.locator("#chart").boundingBox();
    let name = before;
    for (let step = 0; name === before && step < 40; step += 1) {
      await page.mouse.click(x + width * (0.3 + 0.01 * step), y + height * 0.75);
      name = (await shown(page)).status.split(",")[0];
    }
    assert.notEqual(name, before);
    assert.match(name, /^[A-Z][a-z]+ [A-Z][a-z]+$/);
    assert.deepEqual(problems, []);
    await close();
  });

  it("moves by itself only for those who do not mind, and shows a voyage under way to all", async () => {
    for (const [reducedMotion, plays] of [
      ["no-preference", "Pause"],
      ["reduce", "Play"],
    ]) {
      const { page, problems, close } = await opened({ reducedMotion });
      assert.equal(await page.locator("#play").textContent(), plays);
      const { rows } = await shown(page);
      assert.ok(rows[0].share > 0.5, `${rows[0].name} ${rows[0].figure}`);
      assert.deepEqual(problems, []);
      await close();
    }
  });

  for (const width of [1280, 390, 360]) {
    it(`has no text over another, cut or outside while one vessel is followed, as it is and at 200%, at ${width} px`, async () => {
      const { page, problems, close } = await opened({ ...CALM, viewport: { width, height: 800 } });
      await choose(page, "back");
      await scrub(page, 0.9);
      await page.locator("#controls summary").click();
      assert.deepEqual(await page.evaluate(collisions), []);
      await page.evaluate(() => (document.documentElement.style.fontSize = "200%"));
      assert.deepEqual(await page.evaluate(collisions), []);
      assert.deepEqual(problems, []);
      await close();
    });
  }

  it("shows lines of code that run", () => {
    const source = readFileSync(new URL("../../www/bay/example.js", import.meta.url), "utf8");
    const { stdout, stderr } = spawnSync(process.execPath, ["--input-type=module", "--eval", source], { encoding: "utf8" });
    assert.equal(stderr, "");
    assert.match(stdout, /id: 'Saltby'/);
  });
});
