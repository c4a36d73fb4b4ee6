/**
 * Holds one open panel: decides, once the pointer is off its trigger and off it, when it is let go.
 *
 * @module
 */
import type { Bounds } from "#dom";
import { Aim } from "./aim.js";
import { betweenOf, boundsOf, isIn, isShown } from "./boxes.js";
import type { HoldSettings } from "./options.js";
import type { Platform, Stop } from "./platform.js";
import type { Why } from "./types.js";

/** Milliseconds after which a panel is let go of which nothing is known by then, as menus without a prediction do. */
const UNKNOWN = 300;

/** A rest has lasted so many milliseconds longer before it is taken for one: events of a busy page come late. */
const LATE = 50;

/** A pointer that has come no farther than this has not set out (px): `whither/dom` takes as much for a rest. */
const STILL = 12;

interface Point {
  readonly x: number;
  readonly y: number;
}

/** What is held, and who is to know. */
export interface Held {
  readonly trigger: Element;
  /** The panel, and those that opened out of it; may be none. */
  panels(): readonly Element[];
  /** It is let go: called once, until the pointer has been on one of them again. */
  lost(why: Why, probability: number): void;
}

export class Hold {
  readonly #platform: Platform;
  readonly #settings: () => HoldSettings;
  readonly #held: Held;
  #aim: Aim | null = null;
  #timers: Stop[] = [];
  /** While it is held: where the pointer is and where it came off, and the boxes straight between trigger and panels. */
  #place: Point | null = null;
  #left: Point = { x: 0, y: 0 };
  #between: readonly Bounds[] = [];
  /** Whether there has been a posterior since the pointer has left. */
  #known = false;

  constructor(platform: Platform, settings: () => HoldSettings, held: Held) {
    this.#platform = platform;
    this.#settings = settings;
    this.#held = held;
  }

  /** Whether the pointer is on neither of them, and it is held. */
  get active(): boolean {
    return this.#place !== null;
  }

  get probability(): number {
    return this.#aim?.probability ?? 0;
  }

  /** The pointer has come to the trigger or to a panel: its way from here is another movement. */
  enter(): void {
    this.end();
    this.#aim = new Aim(
      this.#platform,
      this.#settings(),
      () => boundsOf(this.#held.trigger),
      () => this.#review(),
    );
  }

  /** The pointer is on neither of them, at a place of the viewport; gives whether there is something to hold. */
  leave(x: number, y: number): boolean {
    if (this.#place) {
      this.#place = { x, y };
      return true;
    }
    const panels = this.#held.panels().filter(isShown);
    if (panels.length === 0) return false;
    if (!this.#aim) this.enter();
    const trigger = boundsOf(this.#held.trigger);
    this.#place = this.#left = { x, y };
    this.#between = panels.map((panel) => betweenOf(trigger, boundsOf(panel)));
    this.#known = false;
    this.#aim?.at(panels.map((panel) => () => boundsOf(panel)));
    this.#timers = [
      this.#platform.wait(this.#settings().bound, () => this.#lose("bound")),
      this.#platform.wait(UNKNOWN, () => this.#giveUp()),
    ];
    return true;
  }

  /** The pointer is gone. */
  lose(): void {
    if (this.#place) this.#lose("lost");
  }

  /** Nothing is held any more, nor followed. */
  end(): void {
    for (const stop of this.#timers.splice(0)) stop();
    const aim = this.#aim;
    // a watcher that is stopped has another snapshot, which is none of the way
    this.#aim = this.#place = null;
    aim?.stop();
  }

  /** There is another posterior, or none any more. */
  #review(): void {
    if (!this.#place) return;
    const probability = this.#aim?.probability ?? null;
    const was = this.#known;
    this.#known ||= probability !== null;
    if (probability === null) {
      if (was) this.#timers.push(this.#platform.wait(LATE, () => this.#rest()));
    } else if (probability < this.#settings().release && !this.#isBetween()) this.#lose("away");
  }

  /** Nothing is known yet: the core is not there, or there was no movement, unless the page is too busy for a posterior. */
  #giveUp(): void {
    const { x, y } = this.#place ?? this.#left;
    if (this.#known || this.#isBetween()) return;
    if (!this.#aim?.loaded) this.#lose("unknown");
    else if (Math.hypot(x - this.#left.x, y - this.#left.y) <= STILL) this.#lose("rest");
  }

  #rest(): void {
    if (this.#aim?.probability === null && !this.#isBetween()) this.#lose("rest");
  }

  #isBetween(): boolean {
    const place = this.#place;
    return place !== null && this.#between.some((box) => isIn(box, place));
  }

  #lose(why: Why): void {
    const { probability } = this;
    this.end();
    this.#held.lost(why, probability);
  }
}
