/** The car's screen: 21 icons that shine as bright as they are probable. */
import { createElement } from "lucide";
import type { PointerTarget } from "whither";
import type { Place } from "../destinations.ts";
import { destinationOf } from "./walk.ts";

const SVG = "http://www.w3.org/2000/svg";

/** Steps of brightness: finer ones would restyle every icon at every frame without a visible difference. */
const LIGHTS = 200;

export class Screen {
  readonly #root: HTMLElement;
  readonly #buttons: readonly HTMLButtonElement[];
  readonly #places: readonly Place[];
  readonly #lights: number[] = [];
  #predicted: number | null = null;

  constructor(root: HTMLElement, grid: HTMLElement, places: readonly Place[]) {
    this.#root = root;
    this.#places = places;
    this.#buttons = places.map(button);
    grid.append(...this.#buttons);
    grid.addEventListener("keydown", (event) => this.#walk(event));
  }

  /** Calls back when an icon is pressed without a pointer: Enter, the space bar, an assistive tool. */
  onKeyPress(callback: (index: number) => void): void {
    this.#buttons.forEach((each, index) =>
      each.addEventListener("click", (event) => {
        const pointed = event instanceof PointerEvent && ["mouse", "pen", "touch"].includes(event.pointerType);
        if (!pointed) callback(index);
      }),
    );
  }

  corner(): { x: number; y: number } {
    const { left, top } = this.#root.getBoundingClientRect();
    return { x: left, y: top };
  }

  /** Where the icons are, in px from the screen's corner. */
  measure(): PointerTarget[] {
    const corner = this.corner();
    return this.#buttons.map((each, index) => {
      const { left, top, width, height } = each.getBoundingClientRect();
      return { id: this.#places[index]?.id ?? "", x: left - corner.x + width / 2, y: top - corner.y + height / 2, width, height };
    });
  }

  /** The icon that an element belongs to, or null. */
  iconOf(element: Element | null): number | null {
    const found = element?.closest<HTMLButtonElement>("button[data-destination]");
    const index = found ? this.#buttons.indexOf(found) : -1;
    return index < 0 ? null : index;
  }

  paint(probabilities: ArrayLike<number>, predicted: number | null): void {
    this.#buttons.forEach((each, index) => {
      const probability = probabilities[index] ?? 0;
      each.style.setProperty("--probability", probability.toFixed(6));
      const light = Math.round(probability * LIGHTS) / LIGHTS;
      if (light === this.#lights[index]) return;
      this.#lights[index] = light;
      each.style.setProperty("--light-share", String(light));
    });
    if (predicted === this.#predicted) return;
    if (this.#predicted !== null) this.#buttons[this.#predicted]?.removeAttribute("data-predicted");
    if (predicted !== null) this.#buttons[predicted]?.setAttribute("data-predicted", "true");
    this.#predicted = predicted;
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
    const pressed = this.#buttons[index];
    if (!pressed) return;
    pressed.removeAttribute("data-pressed");
    void pressed.offsetWidth;
    pressed.setAttribute("data-pressed", "");
  }

  #walk(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const here = this.iconOf(event.target instanceof Element ? event.target : null);
    if (here === null) return;
    const next = destinationOf(event.key, here, this.#columns(), this.#buttons.length);
    if (next === null) return;
    event.preventDefault();
    this.#buttons[next]?.focus();
  }

  #columns(): number {
    const top = this.#buttons[0]?.offsetTop;
    return this.#buttons.filter((each) => each.offsetTop === top).length;
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
