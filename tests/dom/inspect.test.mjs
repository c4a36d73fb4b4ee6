// What a watcher answers to tools that ask a page for its watchers.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { CORNERS, hosted, logged, MIDDLE, mouse, open, reach, scripted } from "./page.mjs";

/** Runs in the page: who answers. */
const ask = () => {
  const found = [];
  window.dispatchEvent(new CustomEvent("whither:inspect", { detail: (inspection) => found.push(inspection) }));
  return found;
};

describe("whither:inspect", () => {
  const site = hosted();

  it("is answered by each watcher once its core is loaded, not while it is paused or after it has stopped", async () => {
    const { page, close } = await open(site, CORNERS, {
      script: `window.ask = ${ask};
        window.one = record("#a", { load: "pointer" });
        window.other = record("#b");
        await other.ready;`,
    });
    const who = () =>
      page.evaluate(() => ask().map(({ watcher }) => (watcher === one ? "one" : watcher === other ? "other" : "?")));
    assert.deepEqual(await who(), ["other"]);
    await (await mouse(page)).play([[0, 300, 300]]);
    await page.evaluate(() => one.ready);
    assert.deepEqual((await who()).sort(), ["one", "other"]);
    await page.evaluate(() => one.pause());
    assert.deepEqual(await who(), ["other"]);
    await page.evaluate(() => one.resume());
    await page.evaluate(() => other.stop());
    assert.deepEqual(await who(), ["one"]);
    await close();
  });

  it("has the options as they are, those of each target, and why one was meant", async () => {
    const { page, step, close } = await scripted(site, `{ threshold: 0.6, target: { prior: 2, hitSlop: { top: 4 } } }`);
    await page.evaluate((ask) => {
      window.inspection = new Function(`return (${ask})()`)()[0];
      watcher.set(document.querySelector("#d"), { name: "fourth" });
    }, String(ask));
    const read = () =>
      page.evaluate(() => {
        const { options, optionsOf, reasonOf } = inspection;
        const [a, c, d] = ["a", "c", "d"].map((id) => document.querySelector(`#${id}`));
        return { options: { ...options }, of: optionsOf(d), other: optionsOf(document.body), reasons: [a, c].map(reasonOf) };
      });
    const hitSlop = { top: 4, right: 0, bottom: 0, left: 0 };
    assert.deepEqual(await read(), {
      options: { threshold: 0.6, release: 0.375, none: 0.2 },
      of: { prior: 2, hitSlop, name: "fourth" },
      other: {},
      reasons: [null, null],
    });
    await page.evaluate(() => watcher.update({ threshold: undefined, none: 0.3 }));
    await step({});
    await step({ c: 0.9 });
    const { options, reasons } = await read();
    assert.deepEqual([options, reasons], [{ threshold: 0.8, release: 0.5, none: 0.3 }, [null, "pointer"]]);
    await close();
  });

  it("reports what a tool throws, and passes over what is no function", async () => {
    const { page, close } = await open(site, CORNERS, { script: `window.watcher = record("button"); await watcher.ready;` });
    await page.evaluate(() => {
      for (const detail of [
        null,
        3,
        () => {
          throw new Error("a tool's mistake");
        },
      ])
        window.dispatchEvent(new CustomEvent("whither:inspect", { detail }));
    });
    assert.deepEqual(
      (await logged(page, "error")).map(({ message }) => message),
      ["a tool's mistake"],
    );
    await reach(await mouse(page), MIDDLE.b);
    assert.deepEqual(
      (await logged(page, "intent")).map(({ target }) => target),
      ["b"],
    );
    await close();
  });
});

describe("data-whither-ignore", () => {
  const site = hosted();

  it("is on what lies over a shape: a press on it is none on the shape", async () => {
    const panel = `<div id="panel" data-whither-ignore style="position:absolute;left:840px;top:80px;width:80px;height:60px"><b>panel</b></div>`;
    const { page, close } = await open(site, panel, {
      script: `const bounds = () => ({ x: 840, y: 80, width: 80, height: 60 });
        window.watcher = record({ id: "shape", bounds });
        await watcher.ready; await frames(2);`,
    });
    const hand = await mouse(page);
    const press = async (to) => {
      await reach(hand, to);
      await hand.press(to);
      return (await logged(page, "outcome")).length;
    };
    assert.equal(await press({ x: 850, y: 90 }), 0);
    await page.evaluate(() => document.querySelector("#panel").remove());
    assert.equal(await press({ x: 850, y: 90 }), 1);
    await close();
  });
});
