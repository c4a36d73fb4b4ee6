/**
 * What the browser reports of the targets: that they appear on the screen or disappear from it, that something in their trees has
 * changed, that something was scrolled. Nothing is read here.
 *
 * @module
 */
import type { Observer, Platform, Stop } from "./platform.js";
import type { Target, Targets } from "./targets.js";

/** What may have changed. */
export interface Changes {
  /** Elements may have moved. */
  moved: boolean;
  /** Styles and attributes may be others, too. */
  restyled: boolean;
  /** What is under a resting pointer may be something else. */
  scrolled: boolean;
}

export interface PresenceSinks {
  /** There is something to look at in the next frame. */
  changed(): void;
  /** A target appeared on the screen, or disappeared from it. */
  visible(target: Target): void;
  /** Listens to what else matters in a window that has targets. */
  listen(view: Window): Stop;
}

export class Presence {
  /** Since these were last set to false. */
  readonly changes: Changes = { moved: true, restyled: true, scrolled: false };
  readonly #platform: Platform;
  readonly #targets: Targets;
  readonly #sinks: PresenceSinks;
  readonly #visibility: Observer | null;
  readonly #mutations: Observer | null;
  readonly #windows = new Map<Window, Stop>();
  #roots = new Set<Node>();

  constructor(platform: Platform, targets: Targets, sinks: PresenceSinks) {
    this.#platform = platform;
    this.#targets = targets;
    this.#sinks = sinks;
    this.#visibility = platform.visibility((element, isVisible) => {
      const target = targets.find(element);
      if (!target || target.visible === isVisible) return;
      target.visible = isVisible;
      target.styled = false;
      sinks.visible(target);
      this.#move();
    });
    this.#mutations = platform.mutations((records) => this.#note(records));
  }

  /** Everything may have changed. */
  outdate(): void {
    this.changes.restyled = true;
    this.#move();
  }

  /** Takes in that targets came and went. */
  watch(added: readonly Target[], removed: readonly Target[]): void {
    for (const target of added) {
      if (target.element && this.#visibility) this.#visibility.observe(target.element);
      else target.visible = true;
    }
    for (const { element } of removed) if (element) this.#visibility?.unobserve(element);
    const roots = this.#targets.roots();
    roots.add(this.#platform.window.document);
    if (roots.size !== this.#roots.size || [...roots].some((root) => !this.#roots.has(root))) this.#observe(roots);
    this.outdate();
  }

  /** Listens again: with other options. */
  listen(): void {
    this.deafen();
    for (const root of this.#roots) {
      const view = (root.ownerDocument ?? (root as Document)).defaultView;
      if (view && !this.#windows.has(view)) this.#windows.set(view, this.#listenIn(view));
    }
  }

  deafen(): void {
    for (const stop of this.#windows.values()) stop();
    this.#windows.clear();
  }

  stop(): void {
    this.deafen();
    this.#visibility?.stop();
    this.#mutations?.stop();
  }

  #observe(roots: Set<Node>): void {
    const listening = this.#windows.size > 0;
    this.#roots = roots;
    this.#mutations?.stop();
    for (const root of roots) this.#mutations?.observe(root);
    if (listening) this.listen();
  }

  #listenIn(view: Window): Stop {
    const resize = () => this.#move();
    const scroll = () => {
      this.changes.scrolled = true;
      this.#move();
    };
    const restyled = () => this.outdate();
    const { visualViewport } = view;
    const stops = [
      this.#sinks.listen(view),
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

  #note(records: readonly MutationRecord[]): void {
    if (records.every(isDecoration)) return;
    this.#targets.stale = true;
    this.outdate();
  }

  #move(): void {
    this.changes.moved = true;
    this.#sinks.changed();
  }
}

/** Whether it is what a watcher, this one or another, wrote on an element. */
function isDecoration({ attributeName, oldValue, target }: MutationRecord): boolean {
  if (attributeName !== "style") return attributeName === "data-predicted";
  const other = (style: string | null) => style?.replace(/--probability:[^;]*;?/, "").trim() || null;
  return other(oldValue) === other((target as Element).getAttribute("style"));
}
