// What whither/overlay draws and shows, and what its controls do, with Chromium's own mouse and keyboard.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { openDrawn } from "./drawn.mjs";
import { AWAY, buttons, CORNERS, hosted, logged, MIDDLE, mouse, reach, ROW, sleep } from "./page.mjs";

describe("overlay", () => {
  const site = hosted();

  describe("draws", () => {
    it("the boxes of the targets on the screen where they are, after scrolling too, in frames too", async () => {
      const inner = `<!doctype html><style>body { margin: 0 }</style>${buttons(["inner", 30, 40])}`;
      const frame = `<iframe src="inner.html" style="position:absolute;left:400px;top:300px;width:200px;height:200px"></iframe>`;
      const list = `<div id="list" style="position:absolute;left:80px;top:320px;width:200px;height:120px;overflow:auto">
        <div style="height:900px;position:relative">${buttons(["row", 20, 300])}</div></div>`;
      const { page, close } = await openDrawn(site, `<div style="height:3000px">${CORNERS}${list}${frame}</div>`, {
        pages: { "inner.html": inner },
        overlaid: "watcher, { collapsed: true }",
        script: `
          const found = () => [...document.querySelectorAll("button"), frame.contentDocument.querySelector("button")];
          const frame = document.querySelector("iframe");
          if (!frame.contentDocument.querySelector("button")) await new Promise((resolve) => (frame.onload = resolve));
          watcher.add(frame.contentDocument.querySelector("button"));
          window.boxes = () => Object.fromEntries(found().map((element) => {
            const { x, y, width, height } = element.getBoundingClientRect();
            const framed = element.id === "inner" ? frame.getBoundingClientRect() : { x: 0, y: 0 };
            const edge = element.id === "inner" ? 2 : 0;
            return [element.id, { x: x + framed.x + edge, y: y + framed.y + edge, width, height }];
          }));
          window.drawnBoxes = () => Object.entries(boxes()).filter(([, box]) => outlined(box) > 0.3).map(([id]) => id);`,
      });
      const drawn = () =>
        page.evaluate(async () => {
          await frames(4);
          return drawnBoxes().sort();
        });
      // what is added is looked up now and then
      await sleep(0.7);
      assert.deepEqual(await drawn(), ["a", "b", "c", "inner"]);
      const before = await page.evaluate(() => boxes().a);
      await page.evaluate(() => {
        scrollTo(0, 40);
        document.querySelector("#list").scrollTo(0, 280);
      });
      assert.deepEqual(await drawn(), ["a", "b", "c", "inner", "row"]);
      assert.ok((await page.evaluate((box) => outlined(box), before)) < 0.3, "nothing where it was");
      await page.evaluate(() => scrollTo(0, 2000));
      assert.deepEqual(await page.evaluate(async () => (await frames(4), [boxes().a, boxes().c].map(outlined))), [0, 0]);
      await close();
    });

    it("with as many pixels as the screen has, also after the window has another size", async () => {
      const { page, close } = await openDrawn(site, CORNERS, { deviceScaleFactor: 2 });
      const size = () => page.evaluate(async () => (await frames(3), [part("canvas").width, part("canvas").height]));
      assert.deepEqual(await size(), [2000, 1400]);
      await page.setViewportSize({ width: 600, height: 500 });
      assert.deepEqual(await size(), [1200, 1000]);
      await close();
    });

    it("shapes by their bounds, and goes on when one of them throws", async () => {
      const { page, problems, close } = await openDrawn(site, "", {
        watched: `[{ id: "shape", bounds: () => ({ x: 200, y: 200, width: 90, height: 50 }) }, window.broken = {
          id: "broken", bounds() { if (this.is) throw new Error("no bounds"); return { x: 500, y: 200, width: 90, height: 50 }; } }]`,
      });
      const read = () =>
        page.evaluate(async () => (await frames(3), [200, 500].map((x) => outlined({ x, y: 200, width: 90, height: 50 }) > 0.3)));
      assert.deepEqual(await read(), [true, true]);
      await page.evaluate(() => (broken.is = true));
      assert.deepEqual(await read(), [true, false]);
      assert.deepEqual(problems, []);
      await close();
    });

    it("the forecast and the ways while a pointer moves, and no trail where motion is to be reduced", async () => {
      const counted = `<script>
        window.calls = [];
        for (const name of ["arc", "ellipse", "lineTo", "clearRect"]) {
          const original = CanvasRenderingContext2D.prototype[name];
          CanvasRenderingContext2D.prototype[name] = function (...given) { calls.push(name); return original.apply(this, given); };
        }</script>`;
      for (const reducedMotion of ["no-preference", "reduce"]) {
        const { page, close } = await openDrawn(site, CORNERS, { head: counted, reducedMotion });
        const hand = await mouse(page);
        await hand.play([[0, AWAY.x, AWAY.y]]);
        await hand.rest(0.5);
        await page.evaluate(() => (calls.length = 0));
        await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.7 }));
        const last = await page.evaluate(async () => {
          await frames(2);
          const frame = calls.slice(calls.lastIndexOf("clearRect"));
          return Object.fromEntries(
            ["arc", "ellipse", "lineTo"].map((name) => [name, frame.filter((each) => each === name).length]),
          );
        });
        await close();
        assert.equal(last.ellipse, 2);
        assert.ok(last.lineTo >= 20, `${last.lineTo} lines`);
        if (reducedMotion === "reduce") assert.equal(last.arc, 2);
        else assert.ok(last.arc > 2, `${last.arc} dots`);
      }
    });

    it("in the theme that is asked for, else the system's", async () => {
      const ground = (page) => page.evaluate(() => getComputedStyle(part(".panel")).backgroundColor);
      const { page, close } = await openDrawn(site, CORNERS, { colorScheme: "light" });
      const light = await ground(page);
      await page.emulateMedia({ colorScheme: "dark" });
      const dark = await ground(page);
      assert.notEqual(light, dark);
      await page.evaluate(() => (drawn = overlay(watcher, { theme: "light" })));
      assert.equal(await ground(page), light);
      await page.emulateMedia({ colorScheme: "light" });
      await page.evaluate(() => (drawn = overlay(watcher, { theme: "dark" })));
      assert.equal(await ground(page), dark);
      await close();
    });
  });

  describe("shows", () => {
    it("the watcher's probabilities, none and the arrival, and after the movement its last ones", async () => {
      const { page, close } = await openDrawn(site, CORNERS);
      const hand = await mouse(page);
      await hand.play([[0, AWAY.x, AWAY.y]]);
      await hand.rest(0.5);
      await page.evaluate(() => {
        // the overlay draws a frame after it was computed, or in the same
        window.checked = [];
        let before = null;
        const check = () => {
          const { targets, none, moving } = watcher.getSnapshot();
          const percent = (share) => (share > 0 && share < 0.01 ? "<1%" : `${Math.round(100 * share)}%`);
          const now = JSON.stringify([
            ...targets.map(({ target, probability }) => [target.id, percent(probability)]),
            ["none", percent(none)],
          ]);
          const shown = JSON.stringify([...lines().slice(0, targets.length), ["none", lines().at(-1)[1]]]);
          if (moving) checked.push(shown === now || shown === before);
          before = now;
          requestAnimationFrame(check);
        };
        check();
      });
      await hand.play(movement(AWAY, MIDDLE.b, 60, { seed: 1, share: 0.9 }));
      const { checked, shown, probability, none, remaining, arrival } = await page.evaluate(async () => {
        await frames(2);
        const { remaining, none } = watcher;
        const arrival = part(".arrival output").textContent;
        return {
          checked,
          shown: lines(),
          probability: watcher.probability(document.querySelector("#b")),
          none,
          remaining,
          arrival,
        };
      });
      assert.ok(checked.filter(Boolean).length > 10 && checked.filter((same) => !same).length <= 2, JSON.stringify(checked));
      assert.deepEqual(shown[0], ["b", `${Math.round(100 * probability)}%`]);
      assert.ok(Math.abs(Number.parseInt(shown.at(-1)[1], 10) - 100 * none) <= 1, JSON.stringify(shown));
      const milliseconds = (seconds) => `${Math.round(1000 * seconds)} ms`;
      assert.equal(
        arrival,
        `${milliseconds(remaining.mean)} (${milliseconds(remaining.low)} to ${milliseconds(remaining.high)})`,
      );
      await sleep(0.6);
      assert.deepEqual(await page.evaluate(() => [watcher.none, lines()[0], part(".state").textContent]), [
        1,
        shown[0],
        "at rest",
      ]);
      await close();
    });

    it("intents as they come with reason and lead, as the ledger has it; the ledger's numbers and calibration", async () => {
      const { page, close } = await openDrawn(site, CORNERS, {
        options: '{ target: ({ id }) => ({ name: "Button " + id }) }',
      });
      await page.evaluate(() => parts("details").forEach((details) => (details.open = true)));
      const hand = await mouse(page);
      await reach(hand, MIDDLE.a);
      await hand.press(MIDDLE.a);
      await page.evaluate(() => frames(4));
      const [outcome] = await logged(page, "outcome");
      const [intent] = await logged(page, "intent");
      assert.equal(outcome.verdict, "right");
      const lead = `${Math.round(1000 * outcome.lead)} ms`;
      const percent = (share) => `${Math.round(100 * share)}%`;
      const rows = await page.evaluate(() => logLines());
      assert.ok(
        rows.some(([name]) => name === `Button a pointer ${percent(intent.probability)}`),
        JSON.stringify(rows),
      );
      assert.equal(rows[0][1], `lead ${lead}`);
      const summary = await page.evaluate(() => watcher.ledger.summary());
      assert.deepEqual(await page.evaluate(() => figures()), ["100%", "0%", lead, summary.calibration.toFixed(3)]);
      assert.equal(await page.evaluate(() => parts("circle").length), summary.bins.length);
      assert.match(
        await page.evaluate(() => part("[role=img]").getAttribute("aria-label")),
        /^Calibration: predicted \d+%, pressed \d+%/,
      );
      await page.keyboard.press("Tab");
      await page.evaluate(() => frames(4));
      assert.deepEqual((await page.evaluate(() => logLines()))[0], ["Button b focus", "…"]);
      await page.keyboard.press("Tab");
      await page.evaluate(() => frames(4));
      const after = await page.evaluate(() => logLines());
      assert.equal(after[0][0], "Button c focus");
      assert.match(after[1][1], /^left, \d+ ms$/);
      await close();
    });

    it("the intents of what dispatches no events, too: shapes, and watchers that do not decorate", async () => {
      const shape = `{ id: "shape", bounds: () => ({ x: 840, y: 80, width: 80, height: 60 }) }`;
      for (const [watched, options] of [
        [shape, "{}"],
        ['"button"', "{ decorate: false }"],
      ]) {
        const { page, close } = await openDrawn(site, buttons(["shape", 840, 80]), { watched, options });
        const hand = await mouse(page);
        await reach(hand, MIDDLE.b);
        await hand.press(MIDDLE.b);
        await page.evaluate(() => frames(4));
        const [outcome] = await logged(page, "outcome");
        const rows = await page.evaluate(() => logLines());
        assert.match(rows.at(-1)[0], /^shape pointer \d+%$/);
        assert.equal(rows[0][1], `lead ${Math.round(1000 * outcome.lead)} ms`);
        await close();
      }
    });
  });

  describe("watchers", () => {
    it("are those of the page where none is given, later ones too, and one is chosen among several", async () => {
      const { page, close } = await openDrawn(site, CORNERS, { watched: '"#a, #b"', overlaid: "" });
      assert.equal(await page.evaluate(() => part(".watchers").hidden), true);
      await page.evaluate(async () => {
        window.later = record("#c");
        await later.ready;
      });
      const titles = ["1: 2 targets, a", "2: 1 target, c"];
      await page.waitForFunction(
        (titles) =>
          parts(".watchers option")
            .map(({ textContent }) => textContent)
            .join() === titles,
        titles.join(),
      );
      assert.equal(await page.evaluate(() => part(".watchers").hidden), false);
      const drawn = () =>
        page.evaluate(async () => {
          await frames(3);
          const [a, c] = [80, 840].map((x) => outlined({ x, y: x === 80 ? 80 : 560, width: 80, height: 60 }));
          return [a > 0.3, c > 0.3];
        });
      assert.deepEqual(await drawn(), [true, false]);
      await page.evaluate(() => {
        part(".watchers select").selectedIndex = 1;
        part(".watchers select").dispatchEvent(new Event("change"));
      });
      assert.deepEqual(await drawn(), [false, true]);
      await close();
    });

    it("are waited for where there is none yet", async () => {
      const { page, close } = await openDrawn(site, CORNERS, { watched: "[]", overlaid: "[]" });
      await page.evaluate(() => {
        watcher.stop();
        drawn = overlay();
      });
      assert.equal(await page.evaluate(async () => (await frames(2), part(".state").textContent)), "waiting");
      await page.evaluate(() => (window.watcher = record("button", { load: "pointer" })));
      await (await mouse(page)).play([[0, 400, 300]]);
      await page.waitForFunction(() => part(".state").textContent !== "waiting");
      await close();
    });
  });

  describe("is in nobody's way", () => {
    it("a press on the panel is none on what lies under it, and what it covers is not predicted", async () => {
      const { page, close } = await openDrawn(site, `${CORNERS}${buttons(["under", 700, 400, 60, 60])}`);
      const hand = await mouse(page);
      const heading = await page.evaluate(() => {
        const { x, y } = part("h2").getBoundingClientRect();
        return { x: x + 10, y: y + 5 };
      });
      await reach(hand, heading);
      await hand.press(heading);
      await reach(hand, { x: 730, y: 430 });
      assert.equal(await page.evaluate(async () => (await frames(2), watcher.probability(document.querySelector("#under")))), 0);
      assert.deepEqual(await logged(page, "outcome"), []);
      await page.evaluate(() => drawn.close());
      await reach(hand, { x: 730, y: 430 });
      assert.ok(await page.evaluate(async () => (await frames(2), watcher.probability(document.querySelector("#under")) > 0.5)));
      await close();
    });

    it("outside of the panel the page is pressed as before", async () => {
      const { page, close } = await openDrawn(site, CORNERS, {
        script: "window.clicks = []; addEventListener('click', ({ target }) => clicks.push(target.id));",
      });
      const hand = await mouse(page);
      await hand.press(MIDDLE.a);
      await hand.press({ x: 400, y: 300 });
      assert.deepEqual(await page.evaluate(() => [clicks[0], clicks.length]), ["a", 2]);
      await close();
    });

    it("works under a strict Content-Security-Policy, with Trusted Types, and over styles for every element", async () => {
      const policy = "style-src 'self' 'unsafe-inline'; require-trusted-types-for 'script'";
      const head = `<style>* { color: lime !important; font-size: 40px !important; display: inline !important; opacity: 0.2 !important; transform: rotate(3deg) !important }</style>`;
      const { page, close } = await openDrawn(site, CORNERS, { headers: { "content-security-policy": policy }, head });
      const style = await page.evaluate(() => {
        const { color, fontSize, display, opacity } = getComputedStyle(part(".panel"));
        const { position, transform, opacity: around } = getComputedStyle(document.querySelector("whither-overlay"));
        return { color, fontSize, display, opacity, position, transform, around };
      });
      assert.deepEqual(style, {
        color: "rgb(33, 29, 22)",
        fontSize: "13px",
        display: "flex",
        opacity: "1",
        position: "fixed",
        transform: "none",
        around: "1",
      });
      await close();
    });

    it("stays over a dialog that opens later", async () => {
      const { page, close } = await openDrawn(
        site,
        `${ROW}<dialog style="width:100vw;height:100vh;max-width:none;max-height:none;margin:0;padding:0">${CORNERS}</dialog>`,
      );
      await page.evaluate(() => document.querySelector("dialog").showModal());
      await page.evaluate(() => frames(3));
      const top = await page.evaluate(() => {
        const { x, y, width } = part(".panel").getBoundingClientRect();
        // what a modal dialog makes inert is found by no place: what is drawn there shows
        return { x: Math.round(x), y: Math.round(y), width: Math.round(width) };
      });
      const before = await page.screenshot({ clip: { ...top, height: 60 } });
      await page.evaluate(() => drawn.hide());
      const after = await page.screenshot({ clip: { ...top, height: 60 } });
      assert.ok(!before.equals(after));
      await close();
    });
  });
});
