/**
 * One trigger and its panel.
 *
 * @module
 */
import { dispose as disposeName } from "../core/lifetime.js";
import { isShown } from "./boxes.js";
import { Follower, hovers, NOWHERE, type Place, placeOf } from "./follow.js";
import { Hold } from "./hold.js";
import { type HeldOpenSettings, readElement, readHeldOpen } from "./options.js";
import { browser, type Platform, type Stop } from "./platform.js";
import type { HeldOpen, HeldOpenOptions, Panel, Why } from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/**
 * Holds a panel open while the pointer is on its way to it: a submenu, a hover card, a tooltip, any popover beside its trigger.
 *
 * The pointer on the trigger or on the panel keeps it open. Off both, the posterior of `whither/dom` decides: `onClose` is called as soon as it
 * falls below `release`, however the panel lies; when the pointer rests; and at `bound` at the latest. Fingers and the keyboard are the
 * page's own: neither opens or closes anything here, and what is focused by the keyboard stays.
 *
 * @param trigger - What the pointer comes from.
 * @param panel - What it may be on its way to. Only an open one is held: what is not rendered, or has `visibility: hidden`, is not open.
 * @param options - At least what closes the panel.
 * @throws {@link WhitherError} for an unknown option, a value that is not legal, a trigger that is no element.
 *
 * @example
 * ```ts
 * const card = document.querySelector("#card") as HTMLElement;
 * const held = heldOpen(document.querySelector("#user") as Element, card, {
 *   onOpen: () => card.showPopover(),
 *   onClose: () => card.hidePopover(),
 * });
 * held.stop();
 * ```
 */
export function heldOpen(trigger: Element, panel: Panel, options: HeldOpenOptions): HeldOpen {
  return heldOpenOn(browser(), trigger, panel, options);
}

/** As {@link heldOpen}, on any platform; null for none. */
export function heldOpenOn(platform: Platform | null, trigger: Element, panel: Panel, options: HeldOpenOptions): HeldOpen {
  return platform ? new PageHeldOpen(platform, trigger, panel, options) : nowhere();
}

class PageHeldOpen implements HeldOpen {
  readonly #platform: Platform;
  readonly #trigger: Element;
  readonly #panel: Panel;
  readonly #hold: Hold;
  #given: HeldOpenOptions;
  #settings: HeldOpenSettings;
  /** While a pointer is followed. */
  #follower: Follower | null = null;
  #zone: "trigger" | "panel" | "outside" = "outside";
  #over: EventTarget | null = null;
  #opening: Stop | null = null;
  #listening: Stop | null = null;
  #signalled: Stop | null = null;

  constructor(platform: Platform, trigger: Element, panel: Panel, options: HeldOpenOptions) {
    this.#platform = platform;
    this.#settings = readHeldOpen(options);
    this.#given = { ...options };
    this.#trigger = readElement(trigger, "trigger");
    this.#panel = typeof panel === "function" ? panel : readElement(panel, "panel");
    this.#hold = new Hold(platform, () => this.#settings, {
      trigger,
      panels: () => this.#panels(),
      lost: (why, probability) => this.#lost(why, probability),
    });
    this.#listening = platform.listen(trigger, {
      pointerenter: (event: PointerEvent) => this.#engage(event),
      // of a pointer that was on it before this began
      pointermove: (event: PointerEvent) => this.#engage(event),
    });
    this.#obey();
  }

  get held(): boolean {
    return this.#hold.active;
  }

  get probability(): number {
    return this.#hold.probability;
  }

  update(options: Partial<HeldOpenOptions>): void {
    const given = { ...this.#given, ...options };
    this.#settings = readHeldOpen(given);
    this.#given = given;
    if (this.#listening) this.#obey();
  }

  stop(): void {
    this.#disengage();
    this.#listening?.();
    this.#signalled?.();
    this.#listening = this.#signalled = null;
  }

  [dispose](): void {
    this.stop();
  }

  /** Stops with the signal. */
  #obey(): void {
    const { signal } = this.#settings;
    this.#signalled?.();
    this.#signalled = signal ? this.#platform.listen(signal, { abort: () => this.stop() }) : null;
    if (signal?.aborted) this.stop();
  }

  #panels(): readonly Element[] {
    const panel = typeof this.#panel === "function" ? this.#panel() : this.#panel;
    if (!panel) return [];
    return Symbol.iterator in panel ? [...panel] : [panel];
  }

  #engage(event: PointerEvent): void {
    if (this.#follower || !hovers(event)) return;
    const lost = () => {
      this.#at(NOWHERE);
      this.#hold.lose();
    };
    this.#follower = new Follower(this.#platform, event.pointerId, (place) => this.#at(place), lost);
    this.#at(placeOf(event));
  }

  #disengage(): void {
    this.#follower?.stop();
    this.#opening?.();
    this.#follower = this.#opening = null;
    this.#zone = "outside";
    this.#hold.end();
  }

  #at({ path, x, y }: Place): void {
    const panels = this.#panels();
    const before = this.#zone;
    this.#over = path[0] ?? null;
    // a panel may be in its trigger
    this.#zone = panels.some((panel) => path.includes(panel)) ? "panel" : path.includes(this.#trigger) ? "trigger" : "outside";
    if (this.#zone !== before) {
      this.#opening?.();
      this.#opening = null;
      if (this.#zone !== "outside") this.#hold.enter();
      if (this.#zone === "trigger") this.#open();
    }
    if (this.#zone === "outside" && !this.#hold.leave(x, y)) this.#disengage();
  }

  #open(): void {
    const { onOpen, delay } = this.#settings;
    const open = () => {
      if (onOpen && !this.#panels().some(isShown)) this.#call(onOpen);
    };
    if (delay > 0) this.#opening = this.#platform.wait(delay, open);
    else open();
  }

  #lost(why: Why, probability: number): void {
    const { keep = () => this.#panels().some((panel) => this.#follower?.isUsing(panel)), onClose } = this.#settings;
    // it may have been closed by the page
    if (this.#panels().some(isShown)) {
      if (this.#call(keep)) return;
      const over = this.#over as Element | null;
      this.#call(() => onClose({ why, probability, over: over?.nodeType === 1 ? over : null }));
    }
    if (!this.#hold.active) this.#disengage();
  }

  #call<T>(run: () => T): T | undefined {
    try {
      return run();
    } catch (error) {
      (this.#settings.onError ?? this.#platform.report)(error);
      return undefined;
    }
  }
}

/** On a server: does nothing. */
function nowhere(): HeldOpen {
  return { held: false, probability: 0, update() {}, stop() {}, [dispose]() {} };
}
