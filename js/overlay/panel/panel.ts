/**
 * The panel: what there is to read and to set, in a place that can be moved, by hand and by the keyboard.
 *
 * @module
 */
import { icon, make, percent, write } from "../elements.js";
import type { Subject } from "../subject.js";
import { controls } from "./controls.js";
import { intents } from "./intents.js";
import { ledger } from "./ledger.js";
import { now } from "./now.js";

/** Px by which an arrow key moves it. */
const STEP = 24;

/** What the panel asks for. */
export interface Asks {
  hide(): void;
  close(): void;
  choose(index: number): void;
}

const GRIP = "M5.5 3.5h.01M10.5 3.5h.01M5.5 8h.01M10.5 8h.01M5.5 12.5h.01M10.5 12.5h.01";
const FOLD = "M3 10l5-5 5 5";
const UNFOLD = "M3 6l5 5 5-5";
const CLOSE = "M3.5 3.5l9 9M12.5 3.5l-9 9";

export class Panel {
  readonly element: HTMLElement;
  readonly #body: HTMLElement;
  readonly #grip: HTMLButtonElement;
  readonly #fold: HTMLButtonElement;
  readonly #state: HTMLElement;
  readonly #watchers: HTMLSelectElement;
  readonly #waiting: HTMLElement;
  readonly #filled: HTMLElement;
  readonly #parts = [now(), intents(performance.now()), ledger(), controls()];
  #titles = "";

  /** `shortcut` is what hides it, as it is written. */
  constructor(collapsed: boolean, shortcut: string | null, asks: Asks) {
    const button = (name: string, path: string, click: () => void, more = {}) =>
      make("button", { type: "button", "aria-label": name, title: name, on: { click }, ...more }, icon(path));
    this.#state = make("span", { className: "state" });
    this.#grip = button("Move: arrow keys", GRIP, () => {}, {
      className: "grip",
      on: { keydown: (event: KeyboardEvent) => this.#step(event) },
    });
    this.#fold = button("Fold", UNFOLD, () => this.#collapse(!this.#body.hidden));
    const header = make(
      "header",
      { on: { pointerdown: (event: PointerEvent) => this.#drag(event) } },
      this.#grip,
      make("h2", { id: "name" }, "Whither"),
      this.#state,
      this.#fold,
      button(shortcut ? `Close (${shortcut} hides)` : "Close", CLOSE, () => asks.close()),
    );
    this.#watchers = make("select", { "aria-label": "Watcher", on: { change: () => asks.choose(this.#watchers.selectedIndex) } });
    const choice = make("div", { className: "watchers" }, this.#watchers);
    this.#waiting = make(
      "p",
      { className: "inside" },
      "No watcher has answered yet. One does once its core is loaded: move the pointer over the page.",
    );
    this.#filled = make("div", {}, choice, ...this.#parts.map(({ element }) => element));
    this.#body = make("div", { className: "body" }, this.#waiting, this.#filled);
    const keydown = (event: KeyboardEvent) => {
      if (event.key !== "Escape" || event.defaultPrevented) return;
      event.stopPropagation();
      if (this.#body.hidden) {
        asks.hide();
        return;
      }
      this.#collapse(true);
      // what had the focus may be folded away
      this.#fold.focus();
    };
    this.element = make("section", { className: "panel", "aria-labelledby": "name", on: { keydown } }, header, this.#body);
    this.#collapse(collapsed);
  }

  focus(): void {
    this.#fold.focus();
  }

  /** Shows what there is of one of the watchers; null where there is none. */
  update(subject: Subject | null, all: readonly Subject[]): void {
    this.#waiting.hidden = subject !== null;
    this.#filled.hidden = subject === null;
    if (!subject) {
      write(this.#state, "waiting");
      return;
    }
    const { best, moving } = subject.watcher.getSnapshot();
    const leading = best && moving ? `${subject.nameOf(best.target)} ${percent(best.probability)}` : "at rest";
    write(this.#state, this.#body.hidden ? leading : moving ? "moving" : "at rest");
    if (this.#body.hidden) return;
    this.#list(subject, all);
    for (const part of this.#parts) part.update(subject);
  }

  /** Keeps it in the window after that has another size. */
  keepInside(): void {
    if (this.element.style.left) this.#moveTo(this.element.offsetLeft, this.element.offsetTop);
  }

  /** Several watchers, to choose from. */
  #list(subject: Subject, all: readonly Subject[]): void {
    const titles = all.map(({ title }) => title);
    const text = titles.join("\n");
    (this.#watchers.parentElement as HTMLElement).hidden = all.length < 2;
    if (text !== this.#titles) {
      this.#titles = text;
      this.#watchers.replaceChildren(...titles.map((title, i) => make("option", {}, `${i + 1}: ${title}`)));
    }
    this.#watchers.selectedIndex = all.indexOf(subject);
  }

  #collapse(collapsed: boolean): void {
    this.#body.hidden = collapsed;
    const name = collapsed ? "Unfold" : "Fold";
    this.#fold.setAttribute("aria-label", name);
    this.#fold.setAttribute("aria-expanded", String(!collapsed));
    this.#fold.title = name;
    this.#fold.replaceChildren(icon(collapsed ? FOLD : UNFOLD));
  }

  #step(event: KeyboardEvent): void {
    const steps: Record<string, readonly [number, number]> = {
      ArrowLeft: [-STEP, 0],
      ArrowRight: [STEP, 0],
      ArrowUp: [0, -STEP],
      ArrowDown: [0, STEP],
    };
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const { offsetLeft, offsetTop } = this.element;
    this.#moveTo(offsetLeft + step[0], offsetTop + step[1]);
  }

  #drag(event: PointerEvent): void {
    const header = event.currentTarget as HTMLElement;
    const button = (event.target as Element).closest("button");
    if (event.button !== 0 || (button && button !== this.#grip)) return;
    const { offsetLeft, offsetTop } = this.element;
    const move = ({ clientX, clientY, pointerId }: PointerEvent) => {
      if (pointerId === event.pointerId) this.#moveTo(offsetLeft + clientX - event.clientX, offsetTop + clientY - event.clientY);
    };
    const stop = () => {
      header.removeEventListener("pointermove", move);
      header.removeEventListener("lostpointercapture", stop);
    };
    header.addEventListener("pointermove", move);
    header.addEventListener("lostpointercapture", stop);
    header.setPointerCapture(event.pointerId);
  }

  #moveTo(x: number, y: number): void {
    const { style, offsetWidth, offsetHeight, offsetParent } = this.element;
    const { clientWidth, clientHeight } = (offsetParent ?? document.documentElement) as HTMLElement;
    style.right = style.bottom = "auto";
    style.left = `${Math.max(0, Math.min(x, clientWidth - offsetWidth))}px`;
    style.top = `${Math.max(0, Math.min(y, clientHeight - offsetHeight))}px`;
  }
}
