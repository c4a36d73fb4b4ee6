/**
 * A list of items, some of which have submenus, and theirs.
 *
 * @module
 */
import { dispose as disposeName } from "../core/lifetime.js";
import { isShown } from "./boxes.js";
import { Follower, hovers, NOWHERE, type Place, placeOf } from "./follow.js";
import { Hold } from "./hold.js";
import { type MenuSettings, readElement, readMenu } from "./options.js";
import { browser, type Platform, type Stop } from "./platform.js";
import { hide, show, submenuOf } from "./submenus.js";
import type { Menu, MenuOptions, Submenu, Why } from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/** An open submenu. */
interface Open extends Submenu {
  readonly hold: Hold;
  /** Whether the pointer is on its item, or in it, or in one that opened out of it. */
  inside: boolean;
  /** Whether it has been shown: a page may do so later. */
  shown: boolean;
  /** Whether it was opened here: what the page opened is its own to leave open. */
  readonly own: boolean;
}

/** Where the pointer is: in which list (0: the root's, 1: the first open submenu's), and on which item of it. */
interface Spot {
  readonly list: number;
  readonly item: Element | null;
}

/**
 * Opens the submenus of a list for mice and pens: one at a time, and the one that is open stays open while the pointer is on its way to it,
 * across the other items too. As soon as it is not, the item that the pointer is on has its turn.
 *
 * Submenus have submenus to any depth, on any side, wherever in the document they are. What is opened and closed by clicks, touches and keys is
 * the page's own, as are roles and the focus; the pointer alone is followed here.
 *
 * @param root - The list.
 * @param options - Which its items are, what their submenus are, and how these are shown.
 * @throws {@link WhitherError} for an unknown option, a value that is not legal, a root that is no element.
 *
 * @example
 * ```ts
 * const { stop } = menu(document.querySelector("[role=menu]") as Element);
 * stop();
 * ```
 */
export function menu(root: Element, options?: MenuOptions): Menu {
  return menuOn(browser(), root, options);
}

/** As {@link menu}, on any platform; null for none. */
export function menuOn(platform: Platform | null, root: Element, options?: MenuOptions): Menu {
  return platform ? new PageMenu(platform, root, options) : nowhere();
}

class PageMenu implements Menu {
  readonly #platform: Platform;
  readonly #root: Element;
  #given: MenuOptions;
  #settings: MenuSettings;
  readonly #chain: Open[] = [];
  /** What was closed and may still be fading. */
  readonly #closing = new WeakSet<Element>();
  /** While a pointer is followed. */
  #follower: Follower | null = null;
  #place: Place = NOWHERE;
  /** The item that it is on. */
  #item: Element | null = null;
  /** The item whose submenu is about to open. */
  #next: { readonly item: Element; readonly stop: Stop } | null = null;
  #listening: Stop | null = null;
  #signalled: Stop | null = null;

  constructor(platform: Platform, root: Element, options: MenuOptions | undefined) {
    this.#platform = platform;
    this.#root = readElement(root, "root");
    this.#settings = readMenu(options, this.#root);
    this.#given = { ...options };
    this.#listening = platform.listen(root, {
      pointerenter: (event: PointerEvent) => this.#engage(event),
      // of a pointer that was on it before this began
      pointermove: (event: PointerEvent) => this.#engage(event),
    });
    this.#obey();
  }

  get open(): readonly Submenu[] {
    return this.#chain.map(({ item, panel }) => ({ item, panel }));
  }

  get held(): boolean {
    return this.#chain.some(({ hold }) => hold.active);
  }

  close(): void {
    this.#close(0, "closed");
  }

  update(options: MenuOptions): void {
    const given = { ...this.#given, ...options };
    this.#settings = readMenu(given, this.#root);
    this.#given = given;
    if (this.#listening) this.#obey();
  }

  // it is passed around on its own
  readonly stop = (): void => {
    const level = this.#chain.findIndex(({ own }) => own);
    if (level >= 0) this.#close(level, "closed");
    this.#forget(0);
    this.#disengage();
    this.#listening?.();
    this.#signalled?.();
    this.#listening = this.#signalled = null;
  };

  [dispose](): void {
    this.stop();
  }

  /** Stops with the signal. */
  #obey(): void {
    const { signal } = this.#settings;
    this.#signalled?.();
    this.#signalled = signal ? this.#platform.listen(signal, { abort: this.stop }) : null;
    if (signal?.aborted) this.stop();
  }

  #engage(event: PointerEvent): void {
    if (this.#follower || !hovers(event)) return;
    const lost = () => {
      this.#at(NOWHERE, true);
      for (const { hold } of [...this.#chain]) hold.lose();
    };
    this.#follower = new Follower(this.#platform, event.pointerId, (place, moved) => this.#at(place, moved), lost);
    // scrolling brings it under a pointer, too
    this.#at(placeOf(event), event.type === "pointermove");
  }

  #disengage(): void {
    this.#follower?.stop();
    this.#follower = null;
    this.#place = NOWHERE;
    this.#item = null;
    this.#await(null);
  }

  #at(place: Place, moved: boolean): void {
    this.#place = place;
    if (!moved) this.#prune();
    let spot = this.#spot();
    // what the page has opened is open like what was opened here
    if (moved && spot?.item !== this.#item) {
      while (spot?.list === this.#chain.length && this.#adopt(spot.list)) spot = this.#spot();
      this.#item = spot?.item ?? null;
    }
    for (const [i, open] of this.#chain.entries()) {
      const inside = spot !== null && (spot.list > i || (spot.list === i && spot.item === open.item));
      if (inside && !open.inside) open.hold.enter();
      open.inside = inside;
    }
    for (const { inside, hold } of [...this.#chain]) if (!inside) hold.leave(place.x, place.y);
    if (moved) this.#turn(spot);
    if (spot === null && this.#chain.length === 0) this.#disengage();
  }

  /** Opens what the pointer is on, if it is the turn of it. */
  #turn(spot: Spot | null): void {
    const item = spot !== null && spot.list === this.#chain.length ? spot.item : null;
    if (item === this.#next?.item) return;
    this.#await(null);
    const panel = item && this.#submenu(item);
    if (!item || !panel || item.matches(":disabled, [aria-disabled=true]")) return;
    const { delay } = this.#settings;
    if (delay > 0) this.#await(item, delay, () => this.#open({ item, panel }));
    else this.#open({ item, panel });
  }

  #await(item: Element | null, delay = 0, run: () => void = () => {}): void {
    this.#next?.stop();
    this.#next = item && { item, stop: this.#platform.wait(delay, run) };
  }

  #open(submenu: Submenu): void {
    this.#await(null);
    this.#hold(submenu, true);
    this.#call(() => (this.#settings.onOpen ?? show)(submenu));
  }

  /** Holds a submenu that is open from now on. */
  #hold(submenu: Submenu, own: boolean): void {
    const level = this.#chain.length;
    const hold = new Hold(this.#platform, () => this.#settings, {
      trigger: submenu.item,
      panels: () => this.#chain.slice(level).map(({ panel }) => panel),
      lost: (why) => this.#lost(open, why),
    });
    const open: Open = { ...submenu, hold, inside: own, shown: !own, own };
    this.#chain.push(open);
    hold.enter();
  }

  /** Takes over a submenu of a list that the page has opened, by a click or a key; gives whether there is one. */
  #adopt(list: number): boolean {
    const items = (this.#chain[list - 1]?.panel ?? this.#root).querySelectorAll(this.#items);
    for (const item of items) {
      const panel = this.#submenu(item);
      if (!panel) continue;
      if (!isShown(panel)) this.#closing.delete(panel);
      else if (!this.#closing.has(panel)) {
        this.#hold({ item, panel }, false);
        return true;
      }
    }
    return false;
  }

  #lost(open: Open, why: Why): void {
    const { keep = ({ panel }: Submenu) => this.#follower?.isUsing(panel) ?? false } = this.#settings;
    const level = this.#chain.indexOf(open);
    if (level < 0 || this.#chain.slice(level).some((each) => this.#call(() => keep(each)))) return;
    this.#close(level, why);
    const spot = this.#spot();
    this.#turn(spot);
    if (spot === null && this.#chain.length === 0) this.#disengage();
  }

  /** Forgets what the page has closed. */
  #prune(): void {
    const level = this.#chain.findIndex((open) => {
      const before = open.shown;
      open.shown = isShown(open.panel);
      return before && !open.shown;
    });
    if (level >= 0) this.#forget(level);
  }

  /** Holds nothing from a level on any more. */
  #forget(level: number): void {
    for (const { hold } of this.#chain.splice(level)) hold.end();
  }

  /** Closes from a level on, the innermost first. */
  #close(level: number, why: Why | "closed"): void {
    while (this.#chain.length > level) {
      const { item, panel, hold } = this.#chain.pop() as Open;
      hold.end();
      this.#closing.add(panel);
      this.#call(() => (this.#settings.onClose ?? hide)({ item, panel, why }));
    }
  }

  /** Where the pointer is; null where it is in none of the lists. */
  #spot(): Spot | null {
    const { path } = this.#place;
    const lists = [this.#root, ...this.#chain.map(({ panel }) => panel)];
    const list = lists.reduce((last, each, i) => (path.includes(each) ? i : last), -1);
    if (list < 0) return null;
    const within = path.slice(0, path.indexOf(lists[list] as Element));
    const items = this.#items;
    const item = within.find((node) => (node as Node).nodeType === 1 && (node as Element).matches(items));
    return { list, item: (item as Element | undefined) ?? null };
  }

  get #items(): string {
    return this.#settings.items ?? (this.#root.querySelector("[role^=menuitem]") ? "[role^=menuitem]" : "li");
  }

  #submenu(item: Element): Element | null {
    const { submenu = submenuOf } = this.#settings;
    return this.#call(() => submenu(item)) ?? null;
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
function nowhere(): Menu {
  return { open: [], held: false, close() {}, update() {}, stop() {}, [dispose]() {} };
}
