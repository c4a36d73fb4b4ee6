/**
 * A page without a browser for the unit tests of `whither/menu`: that of `whither/dom`, with a posterior that a test sets and elements that answer
 * where they are.
 *
 * @module
 */
import { TestPage } from "../../dom/testing/page.js";
import type { Bounds, PredictedTarget, Predictor } from "../../dom/types.js";
import type { Platform } from "../platform.js";

/** Within so many turns of promises a watcher has what it loads here. */
const TICKS = 20;

export class MenuPage {
  /** The probability of all targets together, from the next frame on. */
  probability = 0.9;
  /** The targets that a predictor was given last. */
  targets: readonly PredictedTarget[] = [];
  readonly page = new TestPage({ core: (targets) => this.#predictor(targets) });
  #place = { x: 0, y: 0 };
  /** No two posteriors are the same. */
  #computed = 0;

  /** The platform of `whither/menu` that it is. */
  get platform(): Platform {
    const { page } = this;
    return {
      window: page.window,
      wait: (milliseconds, run) => page.wait(milliseconds, run),
      listen: (target, listeners) => page.listen(target, listeners),
      watch: (targets, options) => page.watch(targets, options),
      report: (error) => page.report(error),
    };
  }

  /** Appends an element with a box, which may have another element as its parent. */
  append(box: Bounds, parent?: Element): Element {
    const element = this.page.append("li", box, parent && { parent: parent as never });
    return Object.assign(element, { getBoundingClientRect: () => (element as never as { box: DOMRect }).box });
  }

  /** Moves the mouse in steps of 10 px and 10 ms, each an event on whatever is there. */
  async move(x: number, y: number, fields: Readonly<Record<string, unknown>> = {}): Promise<void> {
    const { x: fromX, y: fromY } = this.#place;
    const steps = Math.max(1, Math.ceil(Math.hypot(x - fromX, y - fromY) / 10));
    for (let i = 1; i <= steps; i++) {
      this.at(fromX + ((x - fromX) * i) / steps, fromY + ((y - fromY) * i) / steps, fields);
      // what a watcher loads
      for (let tick = 0; tick < TICKS; tick++) await null;
      this.page.advance(10);
    }
  }

  /** One event of the mouse: the element that it enters is given `pointerenter`, too. */
  at(x: number, y: number, fields: Readonly<Record<string, unknown>> = {}): void {
    const { page } = this;
    const mouse = { pointerId: 1, pointerType: "mouse", buttons: 0, relatedTarget: null, ...fields };
    const before = page.at(this.#place.x, this.#place.y);
    this.#place = { x, y };
    const now = page.at(x, y);
    if (now !== before && now) now.dispatchEvent(Object.assign(new Event("pointerenter"), { ...mouse, clientX: x, clientY: y }));
    page.point("pointermove", x, y, mouse);
  }

  #predictor(targets: readonly PredictedTarget[]): Predictor {
    this.targets = targets;
    return {
      observe() {},
      probabilities: (into = new Float64Array(this.targets.length)) =>
        into.fill((this.probability + 1e-9 * ++this.#computed) / this.targets.length),
      none: 0.1,
      remaining: null,
      forecast: () => null,
      path: () => new Float64Array(),
      setTargets: (given) => {
        this.targets = given;
      },
      reset() {},
      free() {},
    };
  }
}
