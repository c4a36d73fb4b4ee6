/**
 * `whither/testing`: movements as a person makes them with a mouse, the same for the same seed, to test pages with: in Playwright and
 * Puppeteer by a real browser's mouse, in a page or jsdom by events, in real time or with fake timers.
 *
 * It needs nothing of the rest of the package, and nothing happens at import.
 *
 * @example
 * ```ts
 * import { dispatch, hand, move } from "whither/testing";
 *
 * const samples = hand({ x: 100, y: 600 }, { x: 700, y: 80, width: 90, height: 40 }, { seed: 3 });
 *
 * // Playwright or Puppeteer: await move(page.mouse, samples, { press: true });
 * // a page or jsdom:
 * await dispatch(document, samples, { press: true });
 * ```
 *
 * @module
 */
export { type ErrorCode, WhitherError } from "#error";
export { type DispatchOptions, dispatch } from "../testing/dispatch.js";
export { type Box, type HandOptions, hand, type Point, type Sample } from "../testing/hand.js";
export { type Mouse, move } from "../testing/move.js";
export type { PlayOptions } from "../testing/play.js";
export { random } from "../testing/random.js";
