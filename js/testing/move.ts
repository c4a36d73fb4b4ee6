/**
 * Movements of the mouse of a browser that is driven from outside.
 *
 * @module
 */
import { refuse } from "../core/read.js";
import type { Sample } from "./hand.js";
import { type PlayOptions, play, readPlay, readSamples } from "./play.js";

/** What is used of a mouse: `page.mouse` of Playwright and of Puppeteer have it. */
export interface Mouse {
  /** Moves to a place in the viewport, px. */
  move(x: number, y: number): Promise<unknown>;
  /** Presses the left button. */
  down(): Promise<unknown>;
  /** Releases it. */
  up(): Promise<unknown>;
}

/**
 * Moves a browser's mouse through samples, each at its time, and is fulfilled when the last has been sent. Where the browser is too slow
 * for all of them, those that are late are left out, so that the movement takes as long as it should.
 *
 * @param mouse - `page.mouse` of Playwright or Puppeteer.
 * @param samples - What {@link hand} returns, or recorded ones: `[seconds, x, y]`, px in the viewport.
 * @param options - Whether it presses, and how time passes.
 * @throws {@link WhitherError} (as a rejection) `missing-key`, `unknown-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`,
 * `time-not-increasing`, with the path of what is wrong, before anything moves.
 *
 * @example
 * ```ts
 * import { expect, test } from "@playwright/test";
 * import { hand, move } from "whither/testing";
 *
 * test("the menu is open before it is pressed", async ({ page }) => {
 *   await page.goto("/");
 *   const menu = page.getByRole("button", { name: "Menu" });
 *   await move(page.mouse, hand({ x: 600, y: 700 }, await menu.boundingBox(), { seed: 1, share: 0.9 }));
 *   await expect(menu).toHaveAttribute("data-predicted");
 * });
 * ```
 */
export async function move(mouse: Mouse, samples: readonly Sample[], options: PlayOptions = {}): Promise<void> {
  for (const method of ["move", "down", "up"] as const) {
    if (typeof (mouse as Mouse | null | undefined)?.[method] !== "function")
      refuse("wrong-type", "mouse", "must have the methods move, down and up", mouse);
  }
  const [settings] = readPlay(options);
  const all = readSamples(samples);
  const [begin] = all[0] as Sample;
  const beats = all.map((sample) => ({ time: sample[0] - begin, samples: [sample] }));
  let place: Sample | undefined;
  const wait = await play(beats, settings, async (due) => {
    const [, x, y] = due.at(-1) as Sample;
    if (x !== place?.[1] || y !== place[2]) await mouse.move(x, y);
    place = due.at(-1);
  });
  if (!settings.press) return;
  const [end] = all.at(-1) as Sample;
  await mouse.down();
  await wait(end - begin + settings.hold);
  await mouse.up();
}
