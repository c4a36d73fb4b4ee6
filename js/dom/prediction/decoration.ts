/**
 * The probabilities on a page's elements, as `--probability`.
 *
 * @module
 */
import type { Target } from "../targets.js";

const PROPERTY = "--probability";

/** Below this nothing is written. */
const LEAST = 0.01;

export class Decoration {
  /** What is written. */
  readonly #written = new Map<Target, string>();

  /** Writes the probabilities of targets, and takes back what was written on others. */
  write(targets: readonly Target[], probabilities: ArrayLike<number>): void {
    const others = new Set(this.#written.keys());
    for (let i = 0; i < targets.length; i++) {
      const probability = probabilities[i] as number;
      if (probability < LEAST) continue;
      const target = targets[i] as Target;
      const text = probability.toFixed(3);
      others.delete(target);
      if (this.#written.get(target) === text) continue;
      this.#written.set(target, text);
      styleOf(target)?.setProperty(PROPERTY, text);
    }
    for (const target of others) this.erase(target);
  }

  /** Takes back what was written on one. */
  erase(target: Target): void {
    if (!this.#written.delete(target)) return;
    const style = styleOf(target);
    style?.removeProperty(PROPERTY);
    if (style?.length === 0) target.element?.removeAttribute("style");
  }
}

function styleOf({ element }: Target): CSSStyleDeclaration | undefined {
  return (element as Partial<ElementCSSInlineStyle> | null)?.style;
}
