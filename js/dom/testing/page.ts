/**
 * A platform without a browser, for unit tests and for the replay of recorded movements: a page of boxes on a virtual clock, on
 * which pointers move as a test, or a recording, has it.
 *
 * @example
 * ```ts
 * const page = new TestPage({ core: (targets, options) => new PointerPredictor(targets, options) });
 * const button = page.append("button", { x: 300, y: 100, width: 40, height: 40 });
 * const watcher = page.watch("button", { load: "eager", onIntent: ({ target }) => console.log(target) });
 * await watcher.ready;
 * page.advance(100);
 * for (let x = 0; x < 320; x += 8) {
 *   page.point("pointermove", x, 120);
 *   page.advance(8);
 * }
 * page.point("pointerdown", 320, 120);
 * ```
 *
 * What a browser reports later, such as what can be seen, it reports in the next frame; nothing but `ready` needs an `await`.
 *
 * @module
 */
import type { FindStopsAhead } from "../keyboard.js";
import type { Listeners, Loaded, Mutations, Platform, Stop, Visibility } from "../platform.js";
import { Prediction } from "../prediction/prediction.js";
import type { Surface } from "../prediction/surface.js";
import type { MakePredictor, Watcher, WatchOptions, WatchTargets } from "../types.js";
import { watchOn } from "../watch.js";
import { Clock } from "./clock.js";
import { type ElementOptions, TestElement, TestStyle } from "./element.js";

/** Fields of an event besides its time, place and path. */
export type EventFields = Readonly<Record<string, unknown>>;

/** A change in the tree, as far as a `MutationRecord` has it. */
export type Change = Partial<Record<keyof MutationRecord, unknown>>;

export class TestPage implements Platform {
  readonly clock = new Clock();
  readonly window: Window;
  readonly document: Document;
  /** From the lowest to the topmost. */
  readonly elements: TestElement[] = [];
  /** The elements outside of which nothing can be pointed at. */
  readonly modals: TestElement[] = [];
  /** What was reported as uncaught. */
  readonly errors: unknown[] = [];
  readonly surface: Surface;
  /** How often the layout was read: boxes of elements, their styles, what is at a place. */
  readonly reads = { boxes: 0, styles: 0, places: 0 };
  readonly #core: MakePredictor;
  readonly #tabStops: FindStopsAhead;
  readonly #visible = new Map<TestElement, boolean>();
  readonly #listeners = new Map<string, Set<(event: never) => void>>();
  readonly #visibilities = new Set<(element: TestElement) => void>();
  readonly #mutations = new Set<(records: readonly MutationRecord[]) => void>();

  /**
   * @param core - Makes predictors.
   * @param tabStops - Finds tab stops: by default none.
   */
  constructor({ core, tabStops }: { core: MakePredictor; tabStops?: FindStopsAhead }) {
    this.#core = core;
    this.#tabStops = tabStops ?? (() => []);
    this.document = {
      nodeType: 9,
      ownerDocument: null,
      parentNode: null,
      defaultView: {},
      hidden: false,
      getRootNode: () => this.document,
      createElement: () => ({ style: new TestStyle(() => {}) }),
      querySelectorAll: (selector: string) => this.elements.filter((element) => element.matches(selector)),
    } as never;
    this.window = this.document.defaultView as Window;
    Object.assign(this.window, { document: this.document });
    this.surface = {
      box: (element) => {
        this.reads.boxes++;
        return (element as never as TestElement).box;
      },
      frameOf: () => ({ x: 0, y: 0, across: 1, down: 1 }),
      isUsable: (element) => {
        this.reads.styles++;
        return (element as never as TestElement).usable && !element.matches(":disabled, [aria-disabled=true]");
      },
      modals: () => this.modals as never,
      topmost: (_, x, y) => {
        this.reads.places++;
        return this.at(x, y) as never;
      },
    };
  }

  /** How many listeners and observers there are: 0 when every watcher has stopped. */
  get listening(): number {
    const listeners = [...this.#listeners.values()].reduce((sum, { size }) => sum + size, 0);
    return listeners + this.#visibilities.size + this.#mutations.size;
  }

  /** A watcher on this page. */
  watch(targets: WatchTargets, options?: WatchOptions): Watcher {
    return watchOn(this, targets, { root: this.document, ...options });
  }

  /** Appends an element, above those that there are. */
  append(tag: string, box: TestElement["box"], options: ElementOptions = {}): Element {
    const element = new TestElement(this, tag, box, options);
    this.elements.push(element);
    this.#visible.set(element, true);
    this.changed([{ type: "childList" }]);
    return element as never;
  }

  /** Removes an element. */
  remove(element: Element): void {
    this.elements.splice(this.elements.indexOf(element as never), 1);
    this.changed([{ type: "childList" }]);
  }

  /** An element appears on the screen or disappears from it. */
  show(element: Element, visible: boolean): void {
    this.#visible.set(element as never, visible);
    for (const report of this.#visibilities) report(element as never);
  }

  /** Something changed in the tree. */
  changed(records: readonly Change[]): void {
    for (const report of this.#mutations) report(records as never);
  }

  /** Lets time pass: timers and frames run. */
  advance(milliseconds: number): void {
    this.clock.advance(milliseconds);
  }

  /** The topmost element at a place. */
  at(x: number, y: number): TestElement | null {
    const isAt = ({ box }: TestElement) => x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height;
    return this.elements.filter(isAt).at(-1) ?? null;
  }

  /** A pointer's event, now and at a place: by default of the one mouse, with its primary button, and nothing coalesced. */
  point(type: string, x: number, y: number, fields: EventFields = {}): void {
    const mouse = { pointerId: 1, pointerType: "mouse", button: 0, relatedTarget: null };
    this.dispatch(type, this.at(x, y), { ...mouse, clientX: x, clientY: y, ...fields });
  }

  /** An event, now and on an element or on the document alone. */
  dispatch(type: string, target: Element | TestElement | null, fields: EventFields = {}): void {
    const path: unknown[] = [];
    for (let at = target; at; at = at.parentElement) path.push(at);
    path.push(this.document, this.window);
    const event = { type, timeStamp: this.clock.now, composedPath: () => path, ...fields };
    for (const listener of [...(this.#listeners.get(type) ?? [])]) listener(event as never);
  }

  now(): number {
    return this.clock.now;
  }

  frame(run: () => void): Stop {
    return this.clock.frame(run);
  }

  wait(milliseconds: number, run: () => void): Stop {
    return this.clock.wait(milliseconds, run);
  }

  idle(run: () => void): Stop {
    return this.clock.wait(200, run);
  }

  listen(target: EventTarget, listeners: Listeners): Stop {
    if (target !== this.window) return listenTo(target, listeners);
    const stops = Object.entries(listeners).map(([type, listener]) => {
      const all = this.#listeners.get(type) ?? new Set();
      this.#listeners.set(type, all.add(listener));
      return () => all.delete(listener);
    });
    return () => {
      for (const stop of stops) stop();
    };
  }

  visibility(changed: (element: Element, visible: boolean) => void): Visibility {
    const observed = new Set<unknown>();
    const report = (element: TestElement) => {
      if (observed.has(element)) changed(element as never, this.#visible.get(element) ?? false);
    };
    return {
      observe: (node) => {
        this.#visibilities.add(report);
        observed.add(node);
        this.frame(() => report(node as never));
      },
      unobserve: (node) => observed.delete(node),
      disconnect: () => {
        this.#visibilities.delete(report);
        observed.clear();
      },
    };
  }

  mutations(changed: (records: readonly MutationRecord[]) => void): Mutations {
    return {
      observe: () => this.#mutations.add(changed),
      disconnect: () => this.#mutations.delete(changed),
    };
  }

  loadPrediction(): Promise<Loaded> {
    return Promise.resolve({ Prediction, surface: () => this.surface });
  }

  loadCore(): Promise<MakePredictor> {
    return Promise.resolve(this.#core);
  }

  loadKeyboard(): Promise<FindStopsAhead> {
    return Promise.resolve(this.#tabStops);
  }

  report(error: unknown): void {
    this.errors.push(error);
  }
}

/** Of an AbortSignal, say, which is as in a browser. */
function listenTo(target: EventTarget, listeners: Listeners): Stop {
  const each = Object.entries(listeners) as [string, EventListener][];
  for (const [type, listener] of each) target.addEventListener(type, listener);
  return () => {
    for (const [type, listener] of each) target.removeEventListener(type, listener);
  };
}
