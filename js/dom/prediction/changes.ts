/**
 * What may have changed on the page since the layout was last read, as far as the browser reports it. Nothing is read here.
 *
 * @module
 */
import type { Platform, Stop } from "../platform.js";

export class Changes {
  /** Elements may have moved. */
  moved = true;
  /** Styles and attributes may be others, too. */
  restyled = true;
  /** What is under a resting pointer may be something else. */
  scrolled = false;
  readonly #platform: Platform;
  readonly #changed: () => void;

  /** `changed` asks for a frame. */
  constructor(platform: Platform, changed: () => void) {
    this.#platform = platform;
    this.#changed = changed;
  }

  /** Elements may have moved. */
  move(): void {
    this.moved = true;
    this.#changed();
  }

  /** Everything may have changed. */
  outdate(): void {
    this.restyled = true;
    this.move();
  }

  /** Listens to what moves elements and restyles them in a window. */
  listen(view: Window): Stop {
    const resize = () => this.move();
    const scroll = () => {
      this.scrolled = true;
      this.move();
    };
    const restyled = () => this.outdate();
    const { visualViewport } = view;
    const stops = [
      this.#platform.listen(view, {
        resize,
        scroll,
        load: restyled,
        transitionend: restyled,
        animationend: restyled,
        fullscreenchange: restyled,
      }),
      visualViewport && this.#platform.listen(visualViewport, { resize, scroll }),
    ];
    return () => {
      for (const stop of stops) stop?.();
    };
  }

  /** Whether all of it was written by a watcher, this one or another. */
  isDecoration(records: readonly MutationRecord[]): boolean {
    return records.every(({ attributeName, oldValue, target }) => {
      if (attributeName !== "style") return attributeName === "data-predicted";
      return withoutDecoration(oldValue) === withoutDecoration((target as Element).getAttribute("style"));
    });
  }
}

function withoutDecoration(style: string | null): string | null {
  return style?.replace(/--probability:[^;]*;?/, "").trim() || null;
}
