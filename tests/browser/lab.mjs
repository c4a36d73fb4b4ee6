// What the tests of the lab and those of all pages share: a hand that does what the lab asks for.
import { movement } from "./hand.mjs";
import { mouse, nextFrame } from "./support.mjs";

/** The middle and the size of the target that is asked for, in the viewport. */
export async function asked(page) {
  const { x, y, width, height } = await page.locator("#field .target.asked").boundingBox();
  return { x: x + width / 2, y: y + height / 2, width, height };
}

/** Until everything that was recorded is scored. */
export async function scored(page) {
  await nextFrame(page);
  await page.waitForFunction(() => !document.documentElement.hasAttribute("data-scoring"));
  await nextFrame(page);
}

/** Movements to the targets that are asked for, each with a press. */
export async function makeMovements(page, count, seed = 0) {
  const hand = await mouse(page);
  let from = await asked(page);
  from = { ...from, x: from.x + 60, y: from.y - 120 };
  await hand.play([[0, from.x, from.y]]);
  for (let k = 1; k <= count; k += 1) {
    await hand.rest(0.35);
    const to = await asked(page);
    await hand.play(movement(from, to, to.width, { seed: seed + k }));
    await hand.press(to);
    await nextFrame(page);
    from = to;
  }
  await scored(page);
}
