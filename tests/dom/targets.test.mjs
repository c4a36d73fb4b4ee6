// What can be watched: live selectors, elements, iterables, virtual targets, and what holds for each of them.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { buttons, CORNERS, hosted, logged, MIDDLE, mouse, nextFrame, open, reach, ROW, scripted } from "./page.mjs";

const names = (page) => page.evaluate(() => watcher.targets.map(nameOf));
const targets = async (page, kind = "intent") => (await logged(page, kind)).map(({ target }) => target);

describe("targets", () => {
  const site = hosted();

  it("follows a live selector: what is added, what comes to match, what is taken away", async () => {
    const { page, close } = await open(site, `${CORNERS}<i id="later"></i>`, {
      script: `window.watcher = record("button, .also"); await watcher.ready; await frames(2);`,
    });
    assert.deepEqual(await names(page), ["a", "b", "c"]);
    await page.evaluate(async () => {
      const style = "position:absolute;left:80px;top:300px;width:80px;height:60px";
      document.querySelector("#b").insertAdjacentHTML("beforebegin", `<div><button id="new" style="${style}">new</button></div>`);
      await frames(3);
    });
    assert.deepEqual(await names(page), ["a", "new", "b", "c"]);
    await reach(await mouse(page), { x: 120, y: 330 });
    assert.deepEqual(await targets(page), ["new"]);
    await page.evaluate(async () => {
      document.querySelector("#new").parentElement.remove();
      document.querySelector("#later").className = "also";
      document.querySelector("#a").remove();
      await frames(3);
    });
    assert.deepEqual(await names(page), ["b", "c", "later"]);
    await page.evaluate(async () => {
      document.querySelector("#later").className = "";
      await frames(3);
    });
    assert.deepEqual(await names(page), ["b", "c"]);
    await close();
  });

  it("takes an element, and any iterable of elements and virtual targets", async () => {
    const { page, close } = await open(site, CORNERS);
    const result = await page.evaluate(() => {
      const [a, b, c] = document.querySelectorAll("button");
      const shape = { id: "shape", bounds: () => ({ x: 1, y: 2, width: 30, height: 40 }) };
      function* some() {
        yield b;
        yield shape;
      }
      const given = [a, shape, [c, a], new Set([a, c, shape]), document.querySelectorAll("button"), some(), []];
      return given.map((targets) => {
        const watcher = record(targets);
        const found = watcher.targets.map(nameOf);
        watcher.stop();
        return found;
      });
    });
    assert.deepEqual(result, [["a"], ["shape"], ["c", "a"], ["a", "c", "shape"], ["a", "b", "c"], ["b", "shape"], []]);
    await close();
  });

  it("intends virtual targets on a canvas, where they are now", async () => {
    const { page, close } = await open(site, `<canvas width="1000" height="700" style="display:block"></canvas>`, {
      script: `
        window.shapes = [
          { id: "sun", x: 840, y: 80 },
          { id: "moon", x: 840, y: 560 },
        ].map((shape) => Object.assign(shape, { bounds: () => ({ x: shape.x, y: shape.y, width: 80, height: 60 }) }));
        window.watcher = record(shapes); await watcher.ready; await frames(2);`,
    });
    const hand = await mouse(page);
    await reach(hand, MIDDLE.b);
    assert.deepEqual(await targets(page), ["sun"]);
    assert.ok(await page.evaluate(() => watcher.best.target === shapes[0]), "the same object");
    await hand.press(MIDDLE.b);
    await nextFrame(page);
    assert.deepEqual(
      (await logged(page, "outcome")).map(({ target, verdict }) => [target, verdict]),
      [["sun", "right"]],
    );
    // they change places
    await page.evaluate(() => {
      [shapes[0].y, shapes[1].y] = [560, 80];
      log.length = 0;
    });
    await reach(hand, MIDDLE.b);
    assert.deepEqual(await targets(page), ["moon"]);
    await page.evaluate(async () => {
      shapes[1].bounds = () => ({ x: 840, y: 80, width: 0, height: 0 });
      log.length = 0;
      await frames(2);
    });
    await reach(hand, MIDDLE.b);
    assert.ok(!(await targets(page)).includes("moon"), "one without size cannot be meant");
    await close();
  });

  it("tells apart elements with the same id attribute and the same href", async () => {
    const place = (x, y) => `style="position:absolute;left:${x}px;top:${y}px;width:80px;height:60px"`;
    const body = `<a id="same" data-name="first" href="/x" ${place(80, 80)}>1</a><a id="same" data-name="second" href="/x" ${place(840, 80)}>2</a>`;
    const { page, problems, close } = await open(site, body, {
      script: `window.watcher = record("a"); await watcher.ready; await frames(2);`,
    });
    const hand = await mouse(page);
    await reach(hand, MIDDLE.b);
    await reach(hand, MIDDLE.a);
    assert.deepEqual(
      (await logged(page, "intent")).map(({ target, id }) => [target, id]),
      [
        ["second", "same"],
        ["first", "same"],
      ],
    );
    assert.deepEqual(problems, []);
    await close();
  });

  it("looks for a selector in its root: an element, a shadow root", async () => {
    const { page, close } = await open(
      site,
      `<div id="part">${CORNERS}</div><button id="other">other</button><div id="host"></div>`,
    );
    const result = await page.evaluate(async () => {
      const root = document.querySelector("#host").attachShadow({ mode: "open" });
      root.innerHTML = '<button id="in">in</button>';
      const watchers = [record("button", { root: document.querySelector("#part") }), record("button", { root })];
      const before = watchers.map((watcher) => watcher.targets.map(nameOf));
      root.append(Object.assign(document.createElement("button"), { id: "too" }));
      await frames(3);
      return [...before, watchers[1].targets.map(nameOf)];
    });
    assert.deepEqual(result, [["a", "b", "c"], ["in"], ["in", "too"]]);
    await close();
  });

  it("looks in another root from an update on, also where nothing is yet", async () => {
    const { page, close } = await open(site, `<div id="host"></div>`);
    const result = await page.evaluate(async () => {
      const root = document.querySelector("#host").attachShadow({ mode: "open" });
      const watcher = record("button");
      watcher.update({ root });
      root.append(Object.assign(document.createElement("button"), { id: "late" }));
      document.body.append(Object.assign(document.createElement("button"), { id: "elsewhere" }));
      await frames(3);
      return watcher.getSnapshot().moving || watcher.targets.map(nameOf);
    });
    assert.deepEqual(result, ["late"]);
    await close();
  });

  it("leaves out what data-whither-ignore takes out, now and later", async () => {
    const { page, step, close } = await scripted(
      site,
      "{}",
      `<div data-whither-ignore="">${ROW}</div>${buttons(["free", 10, 10])}`,
    );
    await step({});
    await step({ c: 0.9 });
    assert.deepEqual(await targets(page), []);
    await page.evaluate(async () => {
      document.querySelector("[data-whither-ignore]").removeAttribute("data-whither-ignore");
      await frames(3);
    });
    await step({});
    await step({ c: 0.9 });
    assert.deepEqual(await targets(page), ["c"]);
    await page.evaluate(async () => {
      document.querySelector("#d").setAttribute("data-whither-ignore", "");
      await frames(3);
    });
    await step({ d: 0.9 });
    assert.deepEqual(await targets(page), ["c"]);
    await close();
  });

  it("has options for each as an object or as a function of it", async () => {
    const { page, close } = await open(site, CORNERS);
    const result = await page.evaluate(async () => {
      const given = async (target) => {
        const watcher = record("button", { predictor: scriptedPredictor, target });
        await frames(3);
        for (let k = 0; k < 3; k += 1) await scriptedStep({});
        watcher.stop();
        return scriptedPredictor.given.map(({ x, y, width, height, prior }) => [x, y, width, height, prior]);
      };
      const each = ({ id }) =>
        ({ a: { prior: 5, enabled: false }, b: { prior: 2, hitSlop: { left: 20, bottom: 8 } }, c: null })[id];
      return [await given({ prior: 3, hitSlop: 10 }), await given(each)];
    });
    assert.deepEqual(result[0], [
      [120, 110, 100, 80, 3],
      [880, 110, 100, 80, 3],
      [880, 590, 100, 80, 3],
    ]);
    assert.deepEqual(result[1], [
      [870, 114, 100, 68, 2],
      [880, 590, 80, 60, 1],
    ]);
    await close();
  });
});
