/**
 * When a target is taken to be meant, and when no longer. A target becomes meant by one of the reasons; it stays so as long as
 * one sign of it holds, whichever it began with; a press on it ends it for good.
 *
 * @module
 */
import type { Calls } from "./calls.js";
import type { Hand, Scope } from "./hand.js";
import type { Settings } from "./options.js";
import type { Platform, Stop } from "./platform.js";
import { idOf, isDisabled, isGone, type Target } from "./targets.js";
import type { Intent, Reason } from "./types.js";

/** Milliseconds for which a finger has to be on a target: it may be about to scroll the page. */
export const TOUCH = 80;

const MINUTE = 60_000;

/** Marks the elements that are meant, for a page's styles. */
const PREDICTED = "data-predicted";

/** What a target is meant by: a pointer, the focus, that it is visible. */
type Sign = Pick<Hand, "scope"> & Partial<Hand>;

interface Open {
  readonly intent: Intent;
  readonly controller: AbortController;
  readonly scope: Scope;
}

export class Intents {
  readonly #platform: Platform;
  readonly #settings: () => Settings;
  readonly #calls: Calls;
  readonly #changed: () => void;
  readonly #hands: () => Iterable<Hand>;
  readonly #open = new Map<Target, Open>();
  readonly #begun: number[] = [];
  readonly #running = new Set<Intent>();
  readonly #waiting = new Map<Hand | Target, Stop>();
  /** The focus, and what is at most so many tab stops away from it. */
  #focus: Sign = { scope: { spent: new Set() } };
  #focused = new Set<Target>();
  readonly #viewport: Sign = { scope: { spent: new Set() } };

  /** `changed` is called when another target is meant, or one no longer. */
  constructor(platform: Platform, settings: () => Settings, hands: () => Iterable<Hand>, calls: Calls, changed: () => void) {
    this.#platform = platform;
    this.#settings = settings;
    this.#hands = hands;
    this.#calls = calls;
    this.#changed = changed;
  }

  /** The targets that are meant now. */
  get targets(): Target[] {
    return [...this.#open.keys()];
  }

  /** What a pointer is over has changed, by its own movement or by scrolling. */
  over(hand: Hand, by: "hover" | "scroll"): void {
    const { hover, scroll } = this.#settings().reasons;
    const target = hand.over?.[0];
    this.forget(hand);
    if (!target || hand.isTouch || hover === null || (by === "scroll" && !scroll)) return;
    this.#wait(hand, hover, () => {
      if (hand.over?.[0] === target) this.begin(target, by, hand);
    });
  }

  /** A finger was put on a target. */
  touch(hand: Hand, target: Target): void {
    if (!this.#settings().reasons.touch) return;
    this.#wait(hand, TOUCH, () => {
      if (hand.isOver(target)) this.begin(target, "touch", hand);
    });
  }

  /** A pointer pressed targets, the innermost first, or nothing that is watched. */
  press(hand: Hand, targets: readonly Target[]): void {
    this.forget(hand);
    const [target] = targets;
    if (target && this.#settings().reasons.press) this.begin(target, "press", hand);
    for (const each of targets) this.#end(each, true);
  }

  /** The focus moved: `target` has it, `ahead` are at most so many tab stops away. */
  focus(target: Target | null, ahead: readonly Target[]): void {
    const focused = new Set(ahead);
    this.#focus = { scope: { spent: new Set() } };
    this.#focused = focused;
    if (target) {
      focused.add(target);
      if (this.#settings().reasons.focus) this.begin(target, "focus", this.#focus);
    }
    // the page that is called may move the focus on, or stop everything
    for (const each of ahead) if (this.#focused === focused) this.begin(each, "keyboard", this.#focus);
    this.review();
  }

  /** A target appeared on the screen or disappeared from it. */
  visible(target: Target): void {
    const { viewport } = this.#settings().reasons;
    this.forget(target);
    if (target.visible && viewport !== null) {
      this.#wait(target, viewport, () => this.begin(target, "viewport", this.#viewport));
    }
  }

  /** Ends what has no sign left. */
  review(): void {
    for (const [target, { intent }] of this.#open) if (!this.#holds(target, intent.reason)) this.#end(target, false);
  }

  /** Ends an intent of a target that is gone. */
  leave(target: Target): void {
    this.forget(target);
    this.#focused.delete(target);
    this.#viewport.scope.spent.delete(target);
    this.#end(target, false);
  }

  /** Ends what is waited for: a pointer is gone, or its movement. */
  forget(key: Hand | Target): void {
    this.#waiting.get(key)?.();
    this.#waiting.delete(key);
  }

  /** Takes the marks off elements. */
  unmark(): void {
    for (const { element } of this.targets) element?.removeAttribute(PREDICTED);
  }

  /** Ends everything. */
  clear(): void {
    for (const stop of this.#waiting.values()) stop();
    this.#waiting.clear();
    this.#focused = new Set();
    for (const target of this.targets) this.#end(target, false);
  }

  #holds(target: Target, reason: Reason): boolean {
    const { release } = this.#settings();
    if (target.settings.enabled === false) return false;
    if (reason === "viewport" && target.visible) return true;
    if (this.#focused.has(target)) return true;
    for (const hand of this.#hands()) {
      if (hand.isOver(target)) return true;
      if (hand.probability(target) >= release && !hand.predicted?.movement?.isLeaving(target)) return true;
    }
    return false;
  }

  /** Takes a target to be meant, unless it is already, may not be again, or as many are as may be. */
  begin(target: Target, reason: Reason, sign: Sign): void {
    const { reactivate, limit } = this.#settings();
    const { scope, predicted } = sign;
    const now = this.#platform.now();
    if (this.#open.has(target) || isGone(target) || target.settings.enabled === false) return;
    if (target.element && isDisabled(target.element)) return;
    if (reactivate === null ? scope.spent.has(target) : now - target.meant < reactivate) return;
    while (this.#begun[0] !== undefined && now - this.#begun[0] >= MINUTE) this.#begun.shift();
    if (this.#begun.length >= limit.perMinute || this.#running.size >= limit.running) return;
    this.#begun.push(now);
    scope.spent.add(target);
    target.meant = now;
    if (reason !== "press") predicted?.movement?.meant.push({ target, time: now, reason });
    const controller = new AbortController();
    const { node, settings } = target;
    const intent: Intent = {
      target: node,
      reason,
      probability: sign.probability?.(target) ?? 0,
      remaining: (sign.moving && predicted?.remaining) || null,
      signal: controller.signal,
      id: idOf(target),
      name: settings.name,
      data: settings.data,
    };
    // before the page is called: it may end it at once
    this.#open.set(target, { intent, controller, scope });
    this.#running.add(intent);
    if (this.#settings().decorate) target.element?.setAttribute(PREDICTED, "true");
    dispatch(this.#settings(), target, "intent", intent);
    // by a listener
    if (controller.signal.aborted) return;
    const done = () => this.#running.delete(intent);
    this.#changed();
    Promise.resolve(this.#calls.call(settings.onIntent ?? this.#settings().onIntent, intent)).then(done, (error: unknown) => {
      done();
      if ((error as Error | null)?.name !== "AbortError") this.#calls.report(error);
    });
  }

  #end(target: Target, pressed: boolean): void {
    const open = this.#open.get(target);
    if (!open) return;
    this.#open.delete(target);
    // what a rest had ended that turns out to be none may be meant once more
    if ("rested" in open.scope && open.scope.rested) open.scope.spent.delete(target);
    if (!pressed) {
      this.#running.delete(open.intent);
      open.controller.abort();
    }
    target.element?.removeAttribute(PREDICTED);
    const release = { ...open.intent, pressed };
    dispatch(this.#settings(), target, "release", release);
    this.#changed();
    this.#calls.call(this.#settings().onRelease, release);
  }

  #wait(key: Hand | Target, milliseconds: number, run: () => void): void {
    this.#waiting.set(
      key,
      this.#platform.wait(milliseconds, () => {
        this.#waiting.delete(key);
        run();
      }),
    );
  }
}

/** Dispatches `whither:intent` or `whither:release` on an element, out of shadow trees too. */
function dispatch({ decorate }: Settings, { element }: Target, type: "intent" | "release", detail: Intent): void {
  if (decorate) element?.dispatchEvent(new CustomEvent(`whither:${type}`, { bubbles: true, composed: true, detail }));
}
