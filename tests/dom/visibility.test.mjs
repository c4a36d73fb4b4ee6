// What cannot be pointed at has no probability within two frames, and has one again when it can be.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { movement } from "../browser/hand.mjs";
import { GOAL, hosted, open, RIVALS, START, STYLE } from "./aim.mjs";
import { mouse, nextFrame, REST } from "./support.mjs";

const TARGET = '<button class="target at" id="target"></button>';

/** The target in an iframe. */
const FRAMED = {
  body: '<iframe id="around" src="inner.html" class="place" style="border: 0; left: 650px; top: 300px; width: 100px; height: 100px"></iframe>',
  pages: {
    "inner.html": `<!doctype html><style>body { margin: 0 }</style>${STYLE}
      <button class="target place" id="target" style="left: 20px; top: 20px"></button>`,
  },
  first: `if (around.contentDocument.readyState !== "complete" || around.contentDocument.URL === "about:blank")
      await new Promise((resolve) => around.addEventListener("load", resolve));
    window.kept = around.contentDocument.getElementById("target");`,
  watched: '[...document.querySelectorAll(".target"), kept]',
};

/** How the target vanishes and comes back: JavaScript that runs on the page. */
const vanishing = {
  "display: none": ['target.style.display = "none"', 'target.style.display = ""'],
  "display: none of an ancestor, by a class": {
    head: "<style>.closed { display: none }</style>",
    body: `<div id="around">${TARGET}</div>`,
    change: ['around.className = "closed"', 'around.className = ""'],
  },
  "display: none by a rule that nothing in the tree shows": [
    'document.styleSheets[0].insertRule("#target { display: none }")',
    "document.styleSheets[0].deleteRule(0)",
  ],
  "visibility: hidden": ['target.style.visibility = "hidden"', 'target.style.visibility = ""'],
  "visibility: hidden of an ancestor": {
    body: `<div id="around">${TARGET}</div>`,
    change: ['around.style.visibility = "hidden"', 'around.style.visibility = ""'],
  },
  "the hidden attribute": ["target.hidden = true", "target.hidden = false"],
  inert: ["target.inert = true", "target.inert = false"],
  "an inert ancestor": {
    body: `<div id="around">${TARGET}</div>`,
    change: ["around.inert = true", "around.inert = false"],
  },
  disabled: ["target.disabled = true", "target.disabled = false"],
  "a disabled fieldset": {
    body: `<fieldset id="around" style="border: 0; margin: 0; padding: 0">${TARGET}</fieldset>`,
    change: ["around.disabled = true", "around.disabled = false"],
  },
  "aria-disabled": ['target.setAttribute("aria-disabled", "true")', 'target.removeAttribute("aria-disabled")'],
  "pointer-events: none": ['target.style.pointerEvents = "none"', 'target.style.pointerEvents = ""'],
  "no area": ['target.style.cssText += "width: 0; height: 0"', 'target.style.cssText += "width: 60px; height: 60px"'],
  "clipped by an ancestor": {
    body: `<div id="around" class="place" style="left: 660px; top: 310px; width: 80px; height: 80px; overflow: hidden">
      <button class="target place" id="target" style="left: 10px; top: 10px"></button></div>`,
    change: ['around.style.height = "8px"', 'around.style.height = "80px"'],
  },
  "scrolled out of its container": {
    body: `<div id="around" class="place" style="left: 660px; top: 310px; width: 80px; height: 80px; overflow: auto">
      <div style="height: 1000px"><button class="target place" id="target" style="left: 10px; top: 10px"></button></div></div>`,
    change: ["around.scrollTop = 100", "around.scrollTop = 0"],
  },
  "a modal dialog opens": {
    body: `${TARGET}<dialog id="dialog" style="width: 100px; margin-top: 500px">A dialog</dialog>`,
    change: ["dialog.showModal()", "dialog.close()"],
    rivals: false,
  },
  "something else fills the screen": {
    body: `${TARGET}<div id="elsewhere">Something else</div>`,
    change: ["elsewhere.requestFullscreen()", "document.exitFullscreen()"],
    rivals: false,
  },
  covered: {
    body: `${TARGET}<div id="cover" class="place" hidden style="left: 650px; top: 300px; width: 100px; height: 100px; background: #ddd"></div>`,
    change: ["cover.hidden = false", "cover.hidden = true"],
  },
  "data-whither-ignore": {
    body: `<div id="around">${TARGET}</div>`,
    change: ['around.dataset.whitherIgnore = ""', "delete around.dataset.whitherIgnore"],
  },
  "moved off the screen": ['target.style.left = "-500px"', 'target.style.left = ""'],
  "in a closed <details>": {
    body: `<details id="around" open><summary>A summary</summary>${TARGET}</details>`,
    change: ["around.open = false", "around.open = true"],
  },
  "content-visibility: hidden of an ancestor": {
    body: `<div id="around">${TARGET}</div>`,
    change: ['around.style.contentVisibility = "hidden"', 'around.style.contentVisibility = ""'],
  },
  "in an iframe that is hidden": {
    ...FRAMED,
    change: ['around.style.visibility = "hidden"', 'around.style.visibility = ""'],
  },
  "in an iframe that is covered": {
    ...FRAMED,
    body: `${FRAMED.body}<div id="cover" class="place" hidden style="left: 640px; top: 290px; width: 120px; height: 120px; background: #ddd"></div>`,
    change: ["cover.hidden = false", "cover.hidden = true"],
  },
  "in an iframe behind a modal dialog": {
    ...FRAMED,
    body: `${FRAMED.body}<dialog id="dialog" style="width: 100px; margin-top: 500px">A dialog</dialog>`,
    change: ["dialog.showModal()", "dialog.close()"],
    rivals: false,
  },
  "out of the document": ["window.kept = target; kept.remove()", "document.body.append(kept)"],
  "not enabled any more": ["watcher.set(target, { enabled: false })", "watcher.set(target, null)"],
};

/** What may look like one of those. */
const staying = {
  "partly covered, its middle too": `${TARGET}
    <div class="place" style="left: 690px; top: 310px; width: 60px; height: 60px; background: #ddd"></div>`,
  "covered by what lets the pointer through": `${TARGET}
    <div class="place" style="left: 650px; top: 300px; width: 100px; height: 100px; pointer-events: none; background: #dddc"></div>`,
  "covered by its own content": TARGET.replace("</", '<span style="display: block; margin: -10px; height: 80px"></span></'),
  "an input under its label": `<input class="target at" id="target" type="checkbox">
    <label for="target" class="place" style="left: 650px; top: 300px; width: 100px; height: 100px; background: #ddd"></label>`,
  "a label around its input": `<label class="target at" id="target"><input type="checkbox" style="width: 60px; height: 60px; margin: 0"></label>`,
  "a link that goes on in another line": `<p class="place" style="margin: 0; left: 570px; top: 330px; width: 160px; font: 20px/40px monospace">
    <span>aaaa aa</span> <a href="#" id="target" class="target" style="display: inline; background: none; font: inherit">link here</a> aa aaa</p>`,
  "in the modal dialog that is open": `<dialog id="dialog" style="border: 0; padding: 0; margin: 0; left: 670px; top: 320px">
    <button class="target" id="target"></button></dialog><script>dialog.showModal()</script>`,
  "slotted into a shadow root": `<div><template shadowrootmode="open"><slot></slot></template>${TARGET}</div>`,
};

describe("visibility", () => {
  const site = hosted();

  /** Half the speed, so that there are frames enough. */
  const way = movement(START, GOAL, 60, { seed: 5 }).map(([time, x, y]) => [2 * time, x, y]);
  const at = (share) => Math.round(way.length * share);

  /** Runs the change, as in the handler of a press, and returns what there is after two frames. */
  async function changed(page, change) {
    const session = await page.context().newCDPSession(page);
    const expression = `(async () => {
      await (${change.includes(";") ? `(() => { ${change} })()` : change});
      for (let k = 0; k < 2; k++) await new Promise((resolve) => requestAnimationFrame(resolve));
      await new Promise((resolve) => setTimeout(resolve));
      const it = window.kept ?? document.getElementById("target");
      const { moving, best, intended } = watcher.getSnapshot();
      return {
        moving,
        isBest: best?.target === it,
        isIntended: intended.includes(it),
        probability: watcher.probability(it),
        since: predictions.length,
        intents: intents.filter((id) => id === "target").length,
      };
    })()`;
    const options = { expression, awaitPromise: true, returnByValue: true, userGesture: true };
    const { result, exceptionDetails } = await session.send("Runtime.evaluate", options);
    assert.equal(exceptionDetails, undefined);
    return result.value;
  }

  for (const [name, given] of Object.entries(vanishing)) {
    const { body, change, rivals = true, ...more } = Array.isArray(given) ? { body: TARGET, change: given } : given;
    it(`vanishes and comes back: ${name}`, async () => {
      const { page, close } = await open(site, (rivals ? RIVALS : "") + body, more);
      const hand = await mouse(page);
      await hand.play([way[0]]);
      await hand.rest(REST);
      const start = await hand.play(way.slice(0, at(0.45)));
      const before = await changed(page, "0");
      assert.ok(before.moving);
      assert.ok(before.probability > 0.05, `its probability is ${before.probability} before`);

      const play = (from, to) => hand.play(way.slice(at(from), at(to)), start);
      const [gone] = await Promise.all([changed(page, change[0]), play(0.45, 0.6)]);
      await nextFrame(page);
      const meanwhile = (await page.evaluate(() => predictions)).slice(gone.since);
      const intents = await page.evaluate('intents.filter((id) => id === "target").length');
      await Promise.all([changed(page, change[1]), play(0.6, 0.8)]);
      await play(0.8, 0.9);
      await nextFrame(page);
      const later = (await page.evaluate(() => predictions)).slice(gone.since);
      await close();

      const { since, intents: earlier, ...then } = gone;
      assert.deepEqual(then, { moving: true, isBest: false, isIntended: false, probability: 0 });
      assert.ok(meanwhile.length > 0 || !rivals, `there are ${meanwhile.length} predictions meanwhile`);
      assert.ok(meanwhile.every(({ best, intended }) => best !== "target" && !intended.includes("target")));
      assert.equal(intents, earlier);
      assert.equal(later.findLast(({ best }) => best !== null)?.best, "target", "it is back");
    });
  }

  for (const [name, body] of Object.entries(staying)) {
    it(`stays: ${name}`, async () => {
      const { page, close } = await open(site, RIVALS + body);
      const hand = await mouse(page);
      await hand.play([way[0]]);
      await hand.rest(REST);
      await hand.play(way.slice(0, at(0.8)));
      await nextFrame(page);
      const last = await page.evaluate(() => predictions.findLast(({ best }) => best !== null));
      await close();
      assert.equal(last?.best, "target");
      assert.ok(last.probability > 0.5, `its probability is ${last.probability}`);
    });
  }
});
