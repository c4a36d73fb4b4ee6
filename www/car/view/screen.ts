/** The car's screen: 21 icons that shine as bright as they are probable. */
import { createElement } from "lucide";
import type { Box, Point } from "../geometry.ts";
import type { Place } from "../../shared/places.ts";
import { destinationOf } from "./walk.ts";

const SVG = "http://www.w3.org/2000/svg";

/** Steps of brightness: finer ones would restyle every icon at every frame without a visible difference. */
const LIGHTS = 200;

export class Screen {
  readonly #root: HTMLElement;
  readonly icons: readonly HTMLButtonElement[];
  readonly #lights: number[] = [];
  #held: Element | null = null;

  constructor(root: HTMLElement, grid: HTMLElement, places: readonly Place[]) {
    this.#root = root;
    this.icons = places.map(button);
    grid.append(...this.icons);
    // what is fetched after it does not delay the first frame
    performance.mark("icons");
    grid.addEventListener("keydown", (event) => this.#walk(event));
  }

  /** Calls back when an icon is pressed: with a pointer, or without one by Enter, the space bar, an assistive tool. */
  onPress(callback: (index: number, pointed: boolean) => void): void {
    this.icons.forEach((each, index) =>
      each.addEventListener("click", (event) => {
        callback(index, event instanceof PointerEvent && ["mouse", "pen", "touch"].includes(event.pointerType));
      }),
    );
  }

  /** Its corner, in px of the viewport. */
  corner(): Point {
    const { left, top } = this.#root.getBoundingClientRect();
    return { x: left, y: top };
  }

  /** Where the icons are, in px of the viewport. */
  measure(): Box[] {
    return this.icons.map((each) => {
      const { left, top, width, height } = each.getBoundingClientRect();
      return { x: left + width / 2, y: top + height / 2, width, height };
    });
  }

  paint(probabilities: ArrayLike<number>): void {
    this.icons.forEach((each, index) => {
      const light = Math.round((probabilities[index] ?? 0) * LIGHTS) / LIGHTS;
      if (light === this.#lights[index]) return;
      this.#lights[index] = light;
      each.style.setProperty("--light-share", String(light));
    });
  }

  /** Keeps the ring of an icon that is not predicted any more, and no other one's. */
  hold(icon: Element | null): void {
    this.#held?.removeAttribute("data-held");
    icon?.setAttribute("data-held", "");
    this.#held = icon;
  }

  /** Marks the icon to go to, and no other one. */
  want(index: number | null): void {
    this.icons.forEach((icon, at) => icon.toggleAttribute("data-wanted", at === index));
  }

  /** While what was lit fades. */
  fade(fading: boolean): void {
    this.#root.toggleAttribute("data-fading", fading);
  }

  /** Whether some of it is in the viewport. */
  isVisible(): boolean {
    const { top, bottom } = this.#root.getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  }

  /** Shows that a press was received. */
  acknowledge(index: number): void {
    const pressed = this.icons[index];
    if (!pressed) return;
    pressed.removeAttribute("data-pressed");
    void pressed.offsetWidth;
    pressed.setAttribute("data-pressed", "");
  }

  #walk(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const here = this.icons.indexOf(event.target as HTMLButtonElement);
    if (here < 0) return;
    const next = destinationOf(event.key, here, this.#columns(), this.icons.length);
    if (next === null) return;
    event.preventDefault();
    this.icons[next]?.focus();
  }

  #columns(): number {
    const top = this.icons[0]?.offsetTop;
    return this.icons.filter((each) => each.offsetTop === top).length;
  }
}

function button(place: Place): HTMLButtonElement {
  const element = document.createElement("button");
  element.type = "button";
  element.className = "icon";
  element.dataset["destination"] = place.id;
  const lamp = document.createElement("span");
  lamp.className = "lamp";
  lamp.append(createElement(place.icon, { class: "glyph", "aria-hidden": "true" }), ring());
  const label = document.createElement("span");
  label.className = "label";
  label.textContent = place.label;
  element.append(lamp, label);
  return element;
}

function ring(): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("class", "ring");
  svg.setAttribute("viewBox", "0 0 100 100");
  svg.setAttribute("aria-hidden", "true");
  const circle = document.createElementNS(SVG, "circle");
  for (const [name, value] of Object.entries({ cx: "50", cy: "50", r: "48", pathLength: "1" })) circle.setAttribute(name, value);
  svg.append(circle);
  return svg;
}
