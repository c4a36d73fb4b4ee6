// The controls of whither/overlay change a watcher that runs, and are put back.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { openDrawn, scriptedDrawn } from "./drawn.mjs";
import { CORNERS, hosted, logged, until } from "./page.mjs";

describe("controls", () => {
  const site = hosted();

  const open = (page) =>
    page.evaluate(async () => {
      parts("details").at(-1).open = true;
      await frames(3);
      window.options = () => {
        let found;
        dispatchEvent(new CustomEvent("whither:inspect", { detail: ({ options }) => (found = { ...options }) }));
        return found;
      };
    });
  const press = async (page, name, key, times) => {
    await page.evaluate((name) => part(`input[aria-label="${name}"]`).focus(), name);
    for (let k = 0; k < times; k++) await page.keyboard.press(key);
  };

  it("change what is meant, at once, and closing puts back what was", async () => {
    const { page, step, close } = await scriptedDrawn(site, "{ threshold: 0.9, release: 0.5, rest: 30000 }");
    await open(page);
    const meant = async () => (await logged(page, "intent")).map(({ target }) => target);
    await step({});
    await step({ c: 0.8 });
    assert.deepEqual(await meant(), []);
    await press(page, "Threshold", "ArrowLeft", 20);
    assert.deepEqual(await page.evaluate(() => options()), { threshold: 0.7, release: 0.5, none: 0.2 });
    await until(page, "intent");
    assert.deepEqual(await meant(), ["c"]);
    // a release that is stated stays, and is never above the threshold
    await press(page, "Threshold", "ArrowLeft", 30);
    assert.deepEqual(await page.evaluate(() => options()), { threshold: 0.4, release: 0.4, none: 0.2 });
    await press(page, "Release", "ArrowRight", 15);
    assert.deepEqual(await page.evaluate(() => options()), { threshold: 0.55, release: 0.55, none: 0.2 });
    await press(page, "None, prior", "ArrowRight", 10);
    assert.equal(await page.evaluate(() => part("code").textContent), "{ threshold: 0.55, release: 0.55, none: 0.3 }");
    await page.evaluate(() => drawn.close());
    assert.deepEqual(await page.evaluate(() => options()), { threshold: 0.9, release: 0.5, none: 0.2 });
    await close();
  });

  it("change the prior of a target, and reset it", async () => {
    const { page, step, close } = await scriptedDrawn(site, `{ target: { name: "one of many", prior: 2 } }`);
    await open(page);
    await page.evaluate(() => watcher.set(document.querySelector("#c"), { name: "the third" }));
    const given = async () => {
      await step({});
      await step({ c: 0.5 });
      return page.evaluate(() =>
        Object.fromEntries(scriptedPredictor.given.map(({ prior, x }) => ["abcdefgh"[Math.floor(x / 100) - 1], prior])),
      );
    };
    const set = async (id, key) => {
      await page.evaluate((id) => {
        const select = part("select[aria-label^=Target]");
        select.selectedIndex = watcher.targets.findIndex((target) => target.id === id);
        select.dispatchEvent(new Event("change"));
      }, id);
      await press(page, "Prior of the target", key, 1);
    };
    await set("c", "ArrowRight");
    await set("d", "Home");
    const { c, d, a } = await given();
    assert.deepEqual([a, c, d], [2, 4, undefined]);
    await page.evaluate(() => [...parts("button")].find(({ textContent }) => textContent === "Reset").click());
    const after = await given();
    assert.deepEqual([after.a, after.c, after.d], [2, 2, 2]);
    const options = await page.evaluate(() => {
      let found;
      dispatchEvent(
        new CustomEvent("whither:inspect", {
          detail: ({ optionsOf }) => (found = ["c", "d"].map((id) => optionsOf(document.querySelector(`#${id}`)).name)),
        }),
      );
      return found;
    });
    assert.deepEqual(options, ["the third", "one of many"]);
    await close();
  });

  it("copy what was changed as code", async () => {
    const { page, close } = await openDrawn(site, CORNERS, { permissions: ["clipboard-read", "clipboard-write"] });
    await open(page);
    await press(page, "Threshold", "ArrowRight", 5);
    await page.evaluate(() => [...parts("button")].find(({ textContent }) => textContent === "Copy").click());
    await page.waitForFunction(() => parts("button").some(({ textContent }) => textContent === "Copied"));
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), "{ threshold: 0.85 }");
    await close();
  });
});
