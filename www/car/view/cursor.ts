/** What is drawn of a hand that is not the browser's own pointer: an arrow, a fingertip or a hand, with a trail. */
import type { DeviceName, Sample } from "../devices.ts";
import type { Point } from "../geometry.ts";
import { trail } from "./trail.ts";

/** Seconds and px that the trail is long and wide. */
const LENGTH = 0.45;
const WIDTH = 7;

export class Cursor {
  readonly #root: HTMLElement;
  readonly #shape: SVGElement;
  readonly #trail: SVGElement;
  #places: Sample[] = [];

  constructor(root: HTMLElement) {
    this.#root = root;
    this.#shape = root.querySelector(".cursor") as SVGElement;
    this.#trail = root.querySelector(".trail") as SVGElement;
  }

  get visible(): boolean {
    return !this.#root.hidden;
  }

  show(device: DeviceName): void {
    this.#root.hidden = false;
    this.#root.dataset["device"] = device;
  }

  hide(): void {
    this.#root.hidden = true;
    this.#places = [];
  }

  add(samples: readonly Sample[]): void {
    this.#places.push(...samples);
  }

  /** `now` in seconds; `corner` is that of what it is drawn in, in px of the viewport. */
  draw(now: number, corner: Point): void {
    const head = this.#places.at(-1);
    if (!head) return;
    const inside = ({ x, y }: Point) => ({ x: x - corner.x, y: y - corner.y });
    const { x, y } = inside(head);
    this.#places = this.#places.filter((place) => now - place.time <= LENGTH);
    if (this.#places.length === 0) this.#places = [head];
    this.#shape.style.transform = `translate(${x}px, ${y}px)`;
    this.#trail.setAttribute("d", trail(this.#places.map(inside), WIDTH));
  }
}
