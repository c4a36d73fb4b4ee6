// The reasons beside the posterior: signs that are certain or cheap, with Chromium's own mouse, finger and keyboard.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { AWAY, buttons, CORNERS, hosted, logged, MIDDLE, mouse, nextFrame, open, read, sleep, until } from "./page.mjs";

/** A watcher for which one reason alone counts, besides what is stated. */
const only = (reasons) => {
  const none = { pointer: false, hover: false, press: false, focus: false, touch: false, scroll: false };
  return `window.watcher = record("button, input", { reasons: ${JSON.stringify({ ...none, ...reasons })} });
    await watcher.ready; await frames(3);`;
};

const reasons = async (page) => (await logged(page, "intent")).map(({ target, reason }) => [target, reason]);

describe("reasons", () => {
  const site = hosted();

  describe("hover", () => {
    it("comes after 130 ms over a target, not for what is crossed, and aborts when the pointer goes", async () => {
      const { page, close } = await open(site, CORNERS, {
        script: `${only({ hover: undefined })}
          document.querySelector("#a").addEventListener("pointerover", () => (window.over = performance.now()));`,
      });
      await page.mouse.move(AWAY.x, AWAY.y);
      await page.mouse.move(MIDDLE.b.x, MIDDLE.b.y);
      await page.mouse.move(MIDDLE.a.x, MIDDLE.a.y);
      await until(page, "intent");
      const [intent] = await logged(page, "intent");
      assert.deepEqual(await reasons(page), [["a", "hover"]]);
      const wait = intent.time - (await page.evaluate(() => over));
      assert.ok(wait >= 125 && wait < 600, `after ${wait} ms`);
      await page.mouse.move(AWAY.x, AWAY.y);
      await sleep(0.45);
      assert.notEqual((await logged(page, "intent"))[0].aborted, null);
      await close();
    });

    it("waits as long as it is asked to", async () => {
      const { page, close } = await open(site, CORNERS, {
        script: `${only({ hover: { after: 300 } })}
          document.querySelector("#a").addEventListener("pointerover", () => (window.over = performance.now()));`,
      });
      await page.mouse.move(AWAY.x, AWAY.y);
      await page.mouse.move(MIDDLE.a.x, MIDDLE.a.y);
      await until(page, "intent");
      const wait = (await logged(page, "intent"))[0].time - (await page.evaluate(() => over));
      assert.ok(wait >= 295 && wait < 800, `after ${wait} ms`);
      await close();
    });

    it("has the box that hitSlop enlarges, but what is directly under the pointer comes first", async () => {
      const body = buttons(["a", 300, 300], ["b", 385, 300]);
      const { page, close } = await open(site, body, {
        script: `window.watcher = record("button", {
            reasons: { pointer: false, press: true, focus: false },
            target: ({ id }) => id === "a" ? { hitSlop: 30 } : {},
          });
          await watcher.ready; await frames(3);`,
      });
      await page.mouse.move(100, 600);
      await page.mouse.move(100, 500);
      await nextFrame(page);
      await page.mouse.move(260, 330);
      await sleep(0.2);
      assert.deepEqual(await reasons(page), [], "40 px beside it");
      await page.mouse.move(275, 330);
      await sleep(0.2);
      assert.deepEqual(await reasons(page), [["a", "hover"]]);
      await page.mouse.down();
      await page.mouse.up();
      assert.deepEqual(await logged(page, "outcome"), [], "a press beside it is none on it");
      await page.mouse.move(395, 330);
      await sleep(0.2);
      assert.deepEqual(await reasons(page), [
        ["a", "hover"],
        ["b", "hover"],
      ]);
      await close();
    });

    it("has the box of a virtual target, with its hitSlop", async () => {
      const { page, close } = await open(site, `<canvas width="900" height="600" style="display:block"></canvas>`, {
        script: `
          window.shape = { id: "shape", bounds: () => ({ x: 300, y: 300, width: 50, height: 50 }) };
          window.watcher = record(shape, { reasons: { pointer: false }, target: { hitSlop: { left: 40 } } });
          await watcher.ready; await frames(3);`,
      });
      for (const [x, expected] of [
        [365, []],
        [270, [["shape", "hover"]]],
      ]) {
        await page.mouse.move(x, 500);
        await sleep(0.4);
        await page.mouse.move(x, 325);
        await sleep(0.25);
        assert.deepEqual(await reasons(page), expected);
      }
      await close();
    });
  });

  describe("press", () => {
    it("comes with the press of a mouse and is released as pressed", async () => {
      const { page, close } = await open(site, CORNERS, { script: only({ press: undefined }) });
      await page.mouse.move(MIDDLE.a.x, MIDDLE.a.y);
      await page.mouse.down();
      await nextFrame(page);
      assert.deepEqual(await reasons(page), [["a", "press"]]);
      await page.mouse.up();
      await nextFrame(page);
      assert.deepEqual(
        (await logged(page, "release")).map(({ target, pressed, aborted }) => [target, pressed, aborted]),
        [["a", true, false]],
      );
      await close();
    });

    it("is none beside the targets, with another button, or where it is no reason", async () => {
      const { page, close } = await open(site, CORNERS, { script: only({ press: undefined }) });
      await page.mouse.click(AWAY.x, AWAY.y);
      await page.mouse.click(MIDDLE.a.x, MIDDLE.a.y, { button: "right" });
      await page.evaluate(() => watcher.update({ reasons: { pointer: false, hover: false, press: false, focus: false } }));
      await page.mouse.click(MIDDLE.a.x, MIDDLE.a.y);
      await nextFrame(page);
      assert.deepEqual(await reasons(page), []);
      await close();
    });
  });

  describe("focus", () => {
    it("comes once for each focus by the keyboard, and aborts when that moves on", async () => {
      const { page, close } = await open(site, CORNERS, { script: only({ focus: undefined }) });
      await page.keyboard.press("Tab");
      await page.keyboard.press("Tab");
      await page.keyboard.press("Shift+Tab");
      await nextFrame(page);
      const intents = await logged(page, "intent");
      assert.deepEqual(
        intents.map(({ target, reason, aborted }) => [target, reason, aborted !== null]),
        [
          ["a", "focus", true],
          ["b", "focus", true],
          ["a", "focus", false],
        ],
      );
      assert.deepEqual([intents[0].probability, intents[0].remaining], [0, null]);
      await close();
    });

    it("does not come from a press", async () => {
      const { page, close } = await open(site, CORNERS, { script: only({ focus: undefined }) });
      await page.mouse.click(MIDDLE.a.x, MIDDLE.a.y);
      assert.equal(await page.evaluate(() => document.activeElement.id), "a");
      await page.keyboard.press("Tab");
      await nextFrame(page);
      assert.deepEqual(await reasons(page), [["b", "focus"]]);
      await close();
    });

    it("comes for a target that has the focus inside of it", async () => {
      const body = `<div class="card" id="card"><a href="#x" id="inner">inside</a></div>`;
      const { page, close } = await open(site, body, { script: `window.watcher = record(".card"); await frames(3);` });
      await page.keyboard.press("Tab");
      await nextFrame(page);
      assert.deepEqual(await reasons(page), [["card", "focus"]]);
      await close();
    });
  });

  describe("keyboard", () => {
    const body = [..."abcdef"].map((id) => `<button id="${id}">${id}</button>`).join("");

    it("comes for what is so many tab stops ahead of the focus", async () => {
      const { page, close } = await open(site, body, { script: only({ keyboard: { tabs: 2 } }) });
      await page.keyboard.press("Tab");
      await nextFrame(page);
      assert.deepEqual((await reasons(page)).sort(), [
        ["b", "keyboard"],
        ["c", "keyboard"],
      ]);
      await page.keyboard.press("Tab");
      await nextFrame(page);
      const intents = await logged(page, "intent");
      assert.deepEqual(
        intents.filter(({ target }) => target === "d").map(({ reason }) => reason),
        ["keyboard"],
      );
      assert.ok(!intents.some(({ target }) => "aef".includes(target)));
      await close();
    });

    it("counts tab stops that are no targets, and leaves out what is none", async () => {
      const stops = `<button id="a">a</button><div id="x" tabindex="0">x</div><button id="b" tabindex="-1">b</button>
        <button id="c" disabled>c</button><button id="d">d</button><button id="e">e</button>`;
      const { page, close } = await open(site, stops, { script: only({ keyboard: { tabs: 2 } }) });
      await page.keyboard.press("Tab");
      await nextFrame(page);
      assert.deepEqual(await reasons(page), [["d", "keyboard"]]);
      await close();
    });

    it("goes the other way when the focus does", async () => {
      const { page, close } = await open(site, body, { script: only({ keyboard: { tabs: 1 } }) });
      await page.evaluate(() => document.querySelector("#e").focus());
      await page.evaluate(() => (log.length = 0));
      await page.keyboard.press("Shift+Tab");
      await nextFrame(page);
      assert.ok(
        (await reasons(page)).some(([target]) => target === "c"),
        String(await reasons(page)),
      );
      await close();
    });
  });

  it("does not come by touch where that is no reason", async () => {
    const { page, close } = await open(site, CORNERS, { hasTouch: true, script: only({}) });
    const session = await page.context().newCDPSession(page);
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ ...MIDDLE.a, id: 1 }] });
    await sleep(0.15);
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    assert.deepEqual(await reasons(page), []);
    await close();
  });

  it("comes by viewport for what has been visible so long, and for nothing that is not", async () => {
    const body = `${buttons(["a", 80, 80], ["b", 80, 1500], ["c", 80, 3000])}<div style="height:4000px"></div>`;
    const { page, close } = await open(site, body, { script: only({ viewport: { after: 200 } }) });
    await sleep(0.3);
    assert.deepEqual(await reasons(page), [["a", "viewport"]]);
    await page.evaluate(() => scrollTo({ top: 1300, behavior: "instant" }));
    await sleep(0.05);
    await page.evaluate(() => scrollTo({ top: 2800, behavior: "instant" }));
    await sleep(0.35);
    assert.deepEqual(await reasons(page), [
      ["a", "viewport"],
      ["c", "viewport"],
    ]);
    await close();
  });

  it("comes by viewport as soon as that is a reason, and is not put off by other options that change", async () => {
    const { page, close } = await open(site, CORNERS, { script: only({}) });
    await page.evaluate(async () => {
      watcher.update({ reasons: { viewport: { after: 250 } } });
      const start = performance.now();
      while (performance.now() < start + 400) {
        watcher.update({ threshold: 0.7 });
        await frames(2);
      }
    });
    assert.deepEqual((await reasons(page)).filter(([, reason]) => reason === "viewport").length, 3);
    await close();
  });

  it("are hover, press and focus alone where the core cannot be loaded, and onError is called once", async () => {
    for (const failing of ["pointing-bytes.js", "pointing.js"]) {
      const { page, problems, close } = await open(site, CORNERS);
      await page.route(`**/${failing}`, (route) => route.abort());
      await page.evaluate(async () => {
        window.watcher = record("button", { load: "pointer" });
        await frames(3);
      });
      const hand = await mouse(page);
      await hand.play([
        [0, AWAY.x, AWAY.y],
        [0.05, 500, 300],
        [0.1, MIDDLE.a.x, MIDDLE.a.y],
      ]);
      await sleep(0.25);
      await page.mouse.click(MIDDLE.b.x, MIDDLE.b.y);
      await page.keyboard.press("Tab");
      await nextFrame(page);
      assert.deepEqual(await reasons(page), [
        ["a", "hover"],
        ["b", "press"],
        ["c", "focus"],
      ]);
      const errors = await logged(page, "error");
      assert.equal(errors.length, 1, JSON.stringify(errors));
      assert.ok(errors[0].message.length > 10);
      assert.equal((await read(page)).best, null);
      assert.equal(
        await page.evaluate(() =>
          watcher.ready.then(
            () => "fulfilled",
            () => "rejected",
          ),
        ),
        "rejected",
      );
      assert.ok(
        problems.every((problem) => problem.includes("Failed to load resource")),
        problems.join(),
      );
      problems.length = 0;
      await close();
    }
  });

  it("come where a Content-Security-Policy forbids WebAssembly, and the error has its code", async () => {
    const { page, problems, close } = await open(site, CORNERS, {
      headers: { "content-security-policy": "script-src 'self' 'unsafe-inline'" },
      script: `window.watcher = record("button", { reasons: { pointer: false } }); await frames(3);`,
    });
    await page.mouse.move(MIDDLE.a.x, MIDDLE.a.y);
    await sleep(0.25);
    assert.deepEqual(await reasons(page), [["a", "hover"]]);
    assert.deepEqual(
      (await logged(page, "error")).map(({ code }) => code),
      ["wasm-unavailable"],
    );
    problems.length = 0;
    await close();
  });
});
