/**
 * Joins the other files: watchers, the frames in which they are drawn, the panel, and the end of it all.
 *
 * @module
 */
import type { Inspection, Intent, Release, Watcher } from "#dom";
import { dispose as disposeName } from "../core/lifetime.js";
import { type Colours, Drawing } from "./drawing.js";
import { make } from "./elements.js";
import { readOptions, readWatchers, type Settings } from "./options.js";
import { Panel } from "./panel/panel.js";
import { STYLES } from "./styles.js";
import { Subject } from "./subject.js";
import type { Overlay, OverlayOptions } from "./types.js";

const dispose: typeof Symbol.dispose = disposeName;

/** By this event watchers are asked for. */
const INSPECT = "whither:inspect";

/** A newer overlay dispatches this, and the ones before it close. */
const REPLACED = "whither:overlay";

/** Milliseconds after which what nothing reports is looked up again: other targets, other watchers, other options. */
const SLOW = 500;

/** Below this width of the window the panel begins folded (px). */
const NARROW = 600;

/**
 * Draws over the page what its watchers predict: boxes with probabilities, the forecast, intents as they come, the ledger; with live
 * controls. One overlay at a time: another one closes it. On a server it does nothing.
 *
 * @param watchers - One watcher or several; left out or null: all that the page has or will have, each once its core is loaded.
 * @param options - How it begins.
 * @throws {@link WhitherError} for what is no watcher, an unknown option, a value that is not legal.
 *
 * @example
 * ```ts
 * const drawn = overlay(watch("nav a, button"));
 * drawn.close();
 * ```
 */
export function overlay(watchers?: Watcher | Iterable<Watcher> | null, options?: OverlayOptions): Overlay {
  const given = readWatchers(watchers);
  const settings = readOptions(options);
  const isThere = typeof document !== "undefined" && typeof IntersectionObserver !== "undefined";
  return isThere && !settings.signal?.aborted ? new PageOverlay(given, settings) : nowhere();
}

/** Where there is no page, or it is closed before it begins. */
function nowhere(): Overlay {
  const nothing = () => {};
  return { state: "closed", show: nothing, hide: nothing, close: nothing, [dispose]: nothing };
}

class PageOverlay implements Overlay {
  readonly #settings: Settings;
  /** Whether further watchers are taken in. */
  readonly #open: boolean;
  readonly #host = document.createElement("whither-overlay");
  readonly #root: HTMLElement;
  readonly #drawing = new Drawing(make("canvas", { "aria-hidden": "true" }));
  readonly #panel: Panel;
  readonly #calm = matchMedia("(prefers-reduced-motion: reduce)");
  readonly #subjects: Subject[] = [];
  /** Ends listeners. */
  readonly #end = new AbortController();
  #state: Overlay["state"] = "shown";
  #chosen: Subject | null = null;
  /** Whether it was chosen by hand; else it is the one that has a movement. */
  #isFixed = false;
  #frame = 0;
  #timer = 0;
  #resized = true;
  #colours: Colours | null = null;
  /** What had the focus before the panel. */
  #focused: HTMLElement | null = null;

  constructor(watchers: readonly Watcher[] | null, settings: Settings) {
    this.#settings = settings;
    this.#open = watchers === null;
    window.dispatchEvent(new CustomEvent(REPLACED));
    this.#panel = new Panel(settings.collapsed ?? innerWidth < NARROW, settings.shortcut?.text ?? null, {
      hide: () => this.hide(),
      close: () => this.close(),
      choose: (index) => {
        this.#chosen = this.#subjects[index] ?? null;
        this.#isFixed = true;
      },
    });
    this.#root = make("div", { className: "root", "data-theme": settings.theme }, this.#drawing.canvas, this.#panel.element);
    this.#mount();
    for (const watcher of watchers ?? []) this.#take(watcher);
    this.#listen();
    this.#look();
    this.#draw();
  }

  get state(): Overlay["state"] {
    return this.#state;
  }

  show(): void {
    if (this.#state !== "hidden") return;
    this.#state = "shown";
    this.#root.hidden = false;
    this.#raise();
    this.#resized = true;
    this.#draw();
  }

  hide(): void {
    if (this.#state !== "shown") return;
    this.#state = "hidden";
    this.#root.hidden = true;
    cancelAnimationFrame(this.#frame);
  }

  close(): void {
    if (this.#state === "closed") return;
    this.#state = "closed";
    this.#end.abort();
    cancelAnimationFrame(this.#frame);
    clearInterval(this.#timer);
    for (const subject of this.#subjects) subject.stop();
    this.#host.remove();
  }

  [dispose](): void {
    this.close();
  }

  /** A shadow tree over everything, in the browser's top layer where there is one. */
  #mount(): void {
    const host = this.#host;
    host.setAttribute("data-whither-ignore", "");
    const shadow = host.attachShadow({ mode: "open" });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(STYLES);
    shadow.adoptedStyleSheets = [sheet];
    shadow.append(this.#root);
    if ("popover" in host) host.popover = "manual";
    document.documentElement.append(host);
    this.#raise();
  }

  /** Over what came to the top layer since. */
  #raise(): void {
    if (!this.#host.showPopover) return;
    if (this.#host.matches(":popover-open")) this.#host.hidePopover();
    this.#host.showPopover();
  }

  #listen(): void {
    const { signal } = this.#end;
    const passive = { passive: true, capture: true, signal };
    const { shortcut } = this.#settings;
    window.addEventListener("resize", () => (this.#resized = true), passive);
    window.addEventListener(REPLACED, () => this.close(), passive);
    window.addEventListener("whither:intent", (event) => this.#dispatched(event as CustomEvent<Intent>), passive);
    window.addEventListener("whither:release", (event) => this.#released(event as CustomEvent<Release>), passive);
    // dialogs, popovers and what fills the screen come over it
    for (const type of ["toggle", "fullscreenchange"]) {
      document.addEventListener(type, ({ target }) => target !== this.#host && this.#raise(), passive);
    }
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => (this.#colours = null), { signal });
    this.#settings.signal?.addEventListener("abort", () => this.close(), { signal });
    if (shortcut) {
      const toggle = (event: KeyboardEvent) => {
        if (!shortcut.matches(event)) return;
        event.preventDefault();
        this.#toggle();
      };
      window.addEventListener("keydown", toggle, { capture: true, signal });
    }
    this.#timer = window.setInterval(() => this.#look(), SLOW);
  }

  /** Hides it, with the focus back where it was, or shows it, with the focus in the panel. */
  #toggle(): void {
    if (this.#state === "shown") {
      this.hide();
      this.#focused?.focus();
      return;
    }
    this.#focused = document.activeElement as HTMLElement | null;
    this.show();
    this.#panel.focus();
  }

  /** Looks up what nothing reports. */
  #look(): void {
    const detail = (inspection: Inspection) => {
      const known = this.#subjects.find(({ watcher }) => watcher === inspection.watcher);
      (known ?? (this.#open ? this.#take(inspection.watcher) : null))?.inspect(inspection);
    };
    window.dispatchEvent(new CustomEvent(INSPECT, { detail }));
    for (const { places } of this.#subjects) places.list();
  }

  #take(watcher: Watcher): Subject {
    const subject = new Subject(watcher);
    this.#subjects.push(subject);
    this.#chosen ??= subject;
    const unsubscribe = watcher.subscribe(() => {
      const snapshot = watcher.getSnapshot();
      subject.log.look(snapshot, subject.inspection);
      if (snapshot.moving && !this.#isFixed && !this.#chosen?.watcher.getSnapshot().moving) this.#chosen = subject;
    });
    this.#end.signal.addEventListener("abort", unsubscribe);
    return subject;
  }

  #dispatched({ detail }: CustomEvent<Intent>): void {
    for (const { log } of this.#subjects) log.begin(detail);
  }

  #released({ detail }: CustomEvent<Release>): void {
    for (const { log } of this.#subjects) log.release(detail);
  }

  /** Each frame reads where the targets are, once, and draws. */
  #draw(): void {
    this.#frame = requestAnimationFrame(() => this.#draw());
    const subject = this.#chosen;
    if (this.#resized) {
      this.#resized = false;
      this.#drawing.resize();
      this.#panel.keepInside();
    }
    const places = subject?.places.read();
    if (subject && places) {
      this.#colours ??= coloursOf(this.#root);
      this.#drawing.paint(subject.watcher, subject.inspection, places, this.#colours, !this.#calm.matches);
    }
    this.#panel.update(subject, this.#subjects);
  }
}

/** What the styles have, for a canvas. */
function coloursOf(root: HTMLElement): Colours {
  const style = getComputedStyle(root);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return { light: colour("light"), ink: colour("ink"), ground: colour("ground") };
}
