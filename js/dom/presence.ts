/**
 * What the browser reports of the targets: that they appear on the screen or disappear from it, that something in their trees has
 * changed; and in which windows they are. Nothing is read here.
 *
 * @module
 */
import type { Mutations, Platform, Stop, Visibility } from "./platform.js";
import type { Target, Targets } from "./targets.js";

const EVERYTHING = { subtree: true, childList: true, attributes: true, attributeOldValue: true };

export interface PresenceSinks {
  /** Something has changed in the trees in which targets are. */
  changed(records: readonly MutationRecord[]): void;
  /** A target appeared on the screen, or disappeared from it. */
  visible(target: Target): void;
  /** Listens to what matters in a window that has targets. */
  listen(view: Window): Stop;
}

export class Presence {
  readonly #platform: Platform;
  readonly #targets: Targets;
  readonly #sinks: PresenceSinks;
  readonly #visibility: Visibility | null;
  readonly #mutations: Mutations | null;
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
    });
    this.#mutations = platform.mutations((records) => sinks.changed(records));
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
  }

  /** Listens again: with other options. */
  listen(): void {
    this.deafen();
    for (const root of this.#roots) {
      const view = (root.ownerDocument ?? (root as Document)).defaultView;
      if (view && !this.#windows.has(view)) this.#windows.set(view, this.#sinks.listen(view));
    }
  }

  deafen(): void {
    for (const stop of this.#windows.values()) stop();
    this.#windows.clear();
  }

  stop(): void {
    this.deafen();
    this.#visibility?.disconnect();
    this.#mutations?.disconnect();
  }

  #observe(roots: Set<Node>): void {
    const listening = this.#windows.size > 0;
    this.#roots = roots;
    this.#mutations?.disconnect();
    for (const root of roots) this.#mutations?.observe(root, EVERYTHING);
    if (listening) this.listen();
  }
}
