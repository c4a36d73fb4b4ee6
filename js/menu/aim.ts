/**
 * Whether a pointer that has left a trigger is on its way to the panel: the posterior of `whither/dom`, with the panel as targets that
 * nothing else on the page knows.
 *
 * A panel is no target of one size: who goes to a menu goes to one of its items, and who goes to a card to a part of it. So it is divided
 * into cells about as large as an item, which share its prior probability, and the panel's probability is their sum. The trigger is one
 * target more, for the way back. What else there is on the page, such as the trigger's siblings, is none of them: as targets of their own
 * they let more panels go that the pointer was on its way to, and hold no fewer that it was not (docs/menu.md).
 *
 * @module
 */
import type { VirtualTarget, Watcher } from "#dom";
import type { HoldSettings } from "./options.js";
import type { Platform } from "./platform.js";
import type { Box } from "./types.js";

/** A cell is about as large as an item of a menu (px), and there are at most so many across and down. */
const CELL = { width: 80, height: 40 };
const MOST = { across: 4, down: 16 };

/** The prior weight of the way back to the trigger, where that of all panels is 1. */
const BACK = 0.1;

export class Aim {
  readonly #watcher: Watcher;
  readonly #trigger: VirtualTarget;
  #cells: readonly VirtualTarget[] = [];
  #loaded = false;

  /** Follows pointers from now on; `changed` is called when there is another posterior, or none any more. */
  constructor(platform: Platform, settings: HoldSettings, trigger: Box, changed: () => void) {
    const { none, rest, constants, predictor, onError = platform.report } = settings;
    this.#trigger = { id: "trigger", bounds: trigger };
    this.#watcher = platform.watch([this.#trigger], {
      load: "eager",
      decorate: false,
      reasons: { pointer: false, hover: false, press: false, focus: false, touch: false, scroll: false },
      pointers: ["mouse", "pen"],
      none,
      rest,
      constants,
      predictor,
      target: (target) => ({ prior: target === this.#trigger ? BACK : 1 / this.#cells.length }),
      onPrediction: changed,
      onError,
    });
    this.#watcher.ready.then(
      () => {
        this.#loaded = true;
      },
      () => {},
    );
  }

  /** Whether the core is there, without which there is no posterior. */
  get loaded(): boolean {
    return this.#loaded;
  }

  /** The probability of the panels and of the way back; null between movements. */
  get probability(): number | null {
    if (!this.#watcher.getSnapshot().moving) return null;
    return [this.#trigger, ...this.#cells].reduce((sum, target) => sum + this.#watcher.probability(target), 0);
  }

  /** Takes panels as what the pointer may be on its way to, from the next posterior on. */
  at(panels: readonly Box[]): void {
    this.#watcher.remove(...this.#cells);
    this.#cells = panels.flatMap(cellsOf).map((bounds, i) => ({ id: `cell ${i}`, bounds }));
    this.#watcher.add(...this.#cells);
  }

  stop(): void {
    this.#watcher.stop();
  }
}

/** The cells of a panel as large as it is now; they grow with it. */
function cellsOf(panel: Box): Box[] {
  const { width, height } = panel();
  const across = count(width / CELL.width, MOST.across);
  const down = count(height / CELL.height, MOST.down);
  return Array.from({ length: across * down }, (_, i) => () => {
    const box = panel();
    const [w, h] = [box.width / across, box.height / down];
    return { x: box.x + (i % across) * w, y: box.y + Math.floor(i / across) * h, width: w, height: h };
  });
}

function count(fitting: number, most: number): number {
  return Math.max(1, Math.min(most, Math.round(fitting)));
}
