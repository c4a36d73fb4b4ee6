// A hand that goes to a target, on a page whose layout changes on the way.
import assert from "node:assert/strict";
import { before } from "node:test";
import { init, PointerPredictor } from "whither/pointing";
import { movement } from "../browser/hand.mjs";
import { hosted as site, mouse, nextFrame, open as openPage, REST } from "./support.mjs";

/** Where the hand comes from, and where the target is once the layout has changed: px in the window. */
export const START = { x: 90, y: 350 };
export const GOAL = { x: 700, y: 350 };

/** The side of a target. */
const SIDE = 60;

/** What a target looks like. */
export const STYLE = `<style>
  .target { width: ${SIDE}px; height: ${SIDE}px; margin: 0; padding: 0; border: 0; box-sizing: border-box; font-size: 16px; background: #8ac }
  .place { position: absolute }
  .at { position: absolute; left: ${GOAL.x - SIDE / 2}px; top: ${GOAL.y - SIDE / 2}px }
</style>`;

/** Targets beside the goal, which do not move. */
export const RIVALS = [
  [700, 200],
  [850, 350],
]
  .map(([x, y], k) => {
    const place = `position: fixed; z-index: 1; left: ${x - SIDE / 2}px; top: ${y - SIDE / 2}px`;
    return `<button class="target" id="rival-${k}" style="${place}"></button>`;
  })
  .join("");

/** `hosted` of support.mjs, with `whither/pointing` in this process too. */
export function hosted() {
  before(init);
  return site();
}

/**
 * A page with a watcher. `watched` is JavaScript for the targets and `options` for further options. On the page `predictions`
 * collects what `onPrediction` gets, as `{ moving, best, probability, intended }` with ids, and `intents` the ids of what was
 * intended.
 */
export async function open(site, body, { watched = '".target"', options = "{}", head = "", first = "", ...more } = {}) {
  const script = `
    ${first}
    const name = (target) => target.id;
    window.predictions = [];
    window.intents = [];
    window.watcher = whither.watch(${watched}, {
      load: "eager",
      ...${options},
      onPrediction: ({ moving, best, intended }) => {
        const { probability = 0, target = null } = best ?? {};
        predictions.push({ moving, best: target && name(target), probability, intended: intended.map(name) });
      },
      onIntent: ({ target }) => intents.push(name(target)),
    });
    await watcher.ready;`;
  return openPage(site, body, { head: STYLE + head, script, ...more });
}

/** The mistake of reading no position again. */
export const STALE = (before) => before;

/** The boxes of all targets in the window, in iframes and shadow roots too, as the browser's inspector has them. */
async function boxes(page) {
  const found = [];
  for (const frame of page.frames()) {
    for (const handle of await frame.$$(".target")) {
      const box = await handle.boundingBox();
      if (box === null) continue;
      const { x, y, width, height } = box;
      found.push({ id: await handle.getAttribute("id"), x: x + width / 2, y: y + height / 2, width, height });
    }
  }
  return found;
}

/** The most probable of these boxes for a movement. */
function expected(targets, samples) {
  const predictor = new PointerPredictor(targets, { none: 0.05 });
  for (const [time, x, y] of samples) predictor.observe(time, [x, y]);
  const { id } = predictor.best;
  predictor.free();
  return id;
}

/** Whether the pointer is over the target, in whatever frame or shadow root that is. */
async function isOver(page, id) {
  for (const frame of page.frames()) if (await frame.$(`#${id}:hover`)) return true;
  return false;
}

/**
 * Moves the mouse from START to GOAL. A third on the way, or before the movement with `early`, `change(page)` puts the target
 * there; then it has to be the most probable one. That `mistakes`, positions made of those before and after the change, would make
 * another target the most probable one is checked too, so that no test passes with them.
 */
export async function aim(
  page,
  change,
  { early = false, mistakes = [STALE], target = "target", map = (point) => point, seed = 3 } = {},
) {
  const hand = await mouse(page);
  const samples = movement(START, GOAL, SIDE, { seed });
  const sent = (from, to) => samples.slice(from, to).map(([time, x, y]) => [time, ...Object.values(map({ x, y }))]);
  const [third, most] = [0.35, 0.8].map((share) => Math.round(samples.length * share));
  await hand.play([[0, ...Object.values(map(START))]]);
  await hand.rest(REST);
  const stale = await boxes(page);
  if (early) {
    await change(page);
    await hand.rest(REST);
  }
  await page.evaluate(() => (predictions.length = 0));
  const start = await hand.play(sent(0, third));
  await Promise.all([hand.play(sent(third, most), start), early ? null : change(page)]);
  await nextFrame(page);
  const all = await page.evaluate(() => predictions);
  const last = all.findLast(({ best }) => best !== null);
  await hand.play(sent(most), start);
  await nextFrame(page);

  assert.ok(await isOver(page, target), "the test's own mistake: the pointer does not end over the target");
  const way = samples.slice(0, most);
  const now = await boxes(page);
  for (const mistake of mistakes) {
    assert.notEqual(expected(mistake(stale, now), way), target, "the test's own mistake: it cannot fail");
  }
  assert.equal(last?.best, target);
  const moving = all.map((one) => one.moving);
  assert.ok(!moving.slice(moving.indexOf(true), moving.lastIndexOf(true)).includes(false), "it is one movement");
  assert.ok(last.probability > 0.5, `its probability is ${last.probability}`);
}
