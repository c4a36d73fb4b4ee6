/**
 * What is watched: the elements of a live selector, elements and virtual targets that were given, and what holds for each.
 *
 * @module
 */
import { isAbsent, missing, number, refuse, text } from "../core/read.js";
import { readTarget, type Settings, type TargetSettings } from "./options.js";
import { hostOf } from "./platform.js";
import type { Bounds, WatchTarget, WatchTargets } from "./types.js";

/** One target, with what the other files of this folder know of it. */
export interface Target {
  node: WatchTarget;
  /** Null for a virtual one. */
  element: Element | null;
  /** What a predictor calls it: unlike ids of users, never the same as another one's. */
  readonly key: string;
  settings: TargetSettings;
  /** Presence: whether it is on the screen. */
  visible: boolean;
  /** Layout: whether its styles were read; whether it can be pointed at by these and its attributes; where; whether covered, found out when. */
  styled: boolean;
  usable: boolean;
  box: Bounds | null;
  covered: boolean;
  checked: number;
  /** Intent: when it was last taken to be meant (milliseconds). */
  meant: number;
}

/** What came and what went. */
export interface Exchange {
  readonly added: readonly Target[];
  readonly removed: readonly Target[];
}

/** What may be changed at once. */
interface Change {
  readonly settings?: Settings;
  readonly given?: ReadonlySet<WatchTarget>;
  readonly own?: readonly [WatchTarget, TargetSettings | null];
  /** What was removed before, and is not any more. */
  readonly readmitted?: readonly WatchTarget[];
  /** With it an error is one target's alone. */
  readonly report?: (error: unknown) => void;
}

export class Targets {
  readonly #selector: string | null;
  /** What was removed of a selector's elements. */
  readonly #removed = new WeakSet<WatchTarget>();
  #settings: Settings;
  #given: ReadonlySet<WatchTarget>;
  readonly #own = new WeakMap<WatchTarget, TargetSettings>();
  #byNode = new Map<unknown, Target>();
  #count = 0;
  /** Whether the document may have other elements by now. */
  stale = false;

  /**
   * @throws {@link WhitherError} at `targets`, or where the options of one of them are wrong.
   */
  constructor(targets: WatchTargets, settings: Settings) {
    this.#settings = settings;
    this.#selector = typeof targets === "string" ? targets : null;
    this.#given = new Set(typeof targets === "string" ? [] : readNodes(targets));
    this.change({});
  }

  get all(): IterableIterator<Target> {
    return this.#byNode.values();
  }

  /** The target that is this node, or undefined. */
  find(node: unknown): Target | undefined {
    return this.#byNode.get(node);
  }

  /** The nodes whose trees have to be observed for changes: every root that a target or the selector is in. */
  roots(): Set<Node> {
    const roots = new Set<Node>();
    const elements = [...this.#given].filter(isElement);
    for (const node of this.#selector === null ? elements : [this.#settings.root, ...elements]) {
      for (let at: Node | null = node; at; ) {
        const root: Node = at.getRootNode();
        if (roots.has(root)) break;
        roots.add(root);
        at = hostOf(root);
      }
    }
    return roots;
  }

  /** The targets among the nodes of a path, in its order. */
  on(path: readonly EventTarget[]): Target[] {
    return path.flatMap((node) => this.find(node) ?? []);
  }

  /** Watches more. */
  add(nodes: readonly WatchTarget[]): Exchange {
    const added = readNodes(nodes);
    return this.change({ given: new Set([...this.#given, ...added]), readmitted: added });
  }

  /** Watches these no longer; what is wrong with others by now is reported. */
  remove(nodes: readonly WatchTarget[], report: (error: unknown) => void): Exchange {
    const given = new Set(this.#given);
    for (const node of nodes) {
      if (this.find(node)) this.#removed.add(node);
      given.delete(node);
    }
    return this.change({ given, report });
  }

  /** Sets what holds for one target; null for what the options have. */
  set(node: WatchTarget, options: unknown): void {
    if (!this.find(node)) refuse("unknown-id", "target", "must be watched", node);
    this.change({ own: [node, options === null ? null : readTarget(options, "options")] });
  }

  /**
   * Finds a live selector's elements again, in the order of the document, and takes in what is to be changed: nothing is where one of
   * the new values is wrong.
   */
  change({ settings = this.#settings, given = this.#given, own, readmitted = [], report }: Change): Exchange {
    const found = this.#selector === null ? [] : query(settings.root, this.#selector);
    const next = new Map<unknown, Target>();
    const resolved = new Map<Target, TargetSettings>();
    const ids = new Set<string>();
    const added: Target[] = [];
    for (const node of new Set([...found, ...given])) {
      if (this.#removed.has(node) && !readmitted.includes(node)) continue;
      if (isElement(node) && isIgnored(node)) continue;
      const existing = this.find(node);
      const target = existing ?? this.#make(node);
      if (!existing) added.push(target);
      next.set(node, target);
      try {
        const known = existing && settings === this.#settings && own?.[0] !== node;
        const one = known ? target.settings : settingsOf(node, settings, own?.[0] === node ? own[1] : this.#own.get(node));
        resolved.set(target, one);
        if (one.id === undefined) continue;
        if (ids.has(one.id)) {
          // the first one has it
          resolved.set(target, { ...one, id: undefined });
          refuse("duplicate-id", "target.id", "must be no other target's", one.id);
        }
        ids.add(one.id);
      } catch (error) {
        if (!report) throw error;
        report(error);
      }
    }
    const removed = [...this.all].filter(({ node }) => !next.has(node));
    for (const [target, one] of resolved) target.settings = one;
    for (const node of readmitted) this.#removed.delete(node);
    [this.#byNode, this.#settings, this.#given] = [next, settings, given];
    if (own?.[1]) this.#own.set(own[0], own[1]);
    else if (own) this.#own.delete(own[0]);
    this.stale = false;
    return { added, removed };
  }

  #make(node: WatchTarget): Target {
    return {
      node,
      element: isElement(node) ? node : null,
      key: String(this.#count++),
      settings: {},
      visible: false,
      styled: false,
      usable: true,
      box: null,
      covered: false,
      checked: -Infinity,
      meant: -Infinity,
    };
  }
}

/** What a target is that is no longer watched. */
const GONE: WatchTarget = { id: "", bounds: () => ({ x: 0, y: 0, width: 0, height: 0 }) };

/** Lets go of the element of a target that is no longer watched: a movement may remember the target. */
export function release(target: Target): void {
  target.node = GONE;
  target.element = null;
}

export function isGone({ node }: Target): boolean {
  return node === GONE;
}

/** What its own options call it, else its `id`. */
export function idOf({ settings, node }: Target): string | undefined {
  return settings.id ?? (node.id || undefined);
}

export function isDisabled(element: Element): boolean {
  return element.matches(":disabled, [aria-disabled=true]");
}

/** Where a virtual target is. */
export function readBounds(bounds: Bounds, path: string): Bounds {
  for (const side of ["x", "y", "width", "height"] as const) number(bounds?.[side], `${path}.${side}`);
  return bounds;
}

function settingsOf(node: WatchTarget, { target }: Settings, own: TargetSettings | null | undefined): TargetSettings {
  const given = typeof target === "function" ? readTarget(target(node), "target") : target;
  return { ...(isElement(node) ? null : { id: node.id }), ...given, ...own };
}

function isElement(node: WatchTarget): node is Element {
  return (node as Element).nodeType === 1;
}

/** Takes out an element and all that is in it. */
export const IGNORE = "data-whither-ignore";

/** Whether it is in a subtree that the page takes out. */
function isIgnored(element: Element): boolean {
  const host = hostOf(element.getRootNode());
  return element.closest(`[${IGNORE}]`) !== null || (host !== null && isIgnored(host));
}

function query(root: ParentNode, selector: string): Element[] {
  try {
    return Array.from(root.querySelectorAll(selector));
  } catch {
    return refuse("out-of-range", "targets", "must be a selector", selector);
  }
}

/** The elements and virtual targets that a user gave. */
function readNodes(given: Exclude<WatchTargets, string>): WatchTarget[] {
  const many = typeof given === "object" && given !== null && Symbol.iterator in given;
  return many ? Array.from(given, (node, i) => readNode(node, `targets[${i}]`)) : [readNode(given, "targets")];
}

function readNode(node: WatchTarget, path: string): WatchTarget {
  if (typeof node !== "object" || node === null) refuse("wrong-type", path, "must be an element or virtual target", node);
  if (isElement(node)) return node;
  text(node.id, `${path}.id`);
  if (isAbsent(node.bounds)) missing(`${path}.bounds`);
  if (typeof node.bounds !== "function") refuse("wrong-type", `${path}.bounds`, "must be a function", node.bounds);
  readBounds(node.bounds(), `${path}.bounds()`);
  return node;
}
