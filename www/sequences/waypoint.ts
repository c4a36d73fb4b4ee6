/** The ring that a finger, a mouse or the arrow keys move over the map. */
import { PAPER, type Place } from "./airliner.ts";
import type { FlightMap } from "./map.ts";

/** Where it waits until it is moved. */
const REST: Place = { x: 66_000, y: 17_000 };
/** How far an arrow key moves it, in metres. */
const KEY_STEP = 500;
const KEYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export class Waypoint {
  readonly #button: HTMLButtonElement;
  readonly #map: FlightMap;
  #place: Place | null = PAPER.waypoint;

  /** `moved` is called with every new place. */
  constructor(button: HTMLButtonElement, map: FlightMap, moved: (place: Place) => void) {
    this.#button = button;
    this.#map = map;
    const move = (place: Place) => {
      this.set(place);
      moved(place);
    };
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
    });
    button.addEventListener("pointermove", (event) => {
      if (!button.hasPointerCapture(event.pointerId)) return;
      const { left, top } = (button.parentElement ?? button).getBoundingClientRect();
      move(map.toPlace({ x: event.clientX - left, y: event.clientY - top }));
    });
    button.addEventListener("keydown", (event) => {
      const direction = KEYS[event.key];
      if (!direction) return;
      event.preventDefault();
      const { x, y } = this.#place ?? REST;
      const next = { x: x + 4 * KEY_STEP * direction[0], y: y + KEY_STEP * direction[1] };
      move(map.toPlace(map.toScreen(next)));
    });
    this.set(null);
  }

  /** Shows it at a place, or waiting. */
  set(place: Place | null): void {
    this.#place = place;
    const { x, y } = this.#map.toScreen(place ?? REST);
    this.#button.style.setProperty("--x", `${x}px`);
    this.#button.style.setProperty("--y", `${y}px`);
    this.#button.dataset["pinned"] = String(place !== null);
    const kilometres = (metres: number) => Math.round(metres / 1000);
    const where = place ? `at ${kilometres(place.x)} km east, ${kilometres(place.y)} km north` : "not set";
    this.#button.setAttribute("aria-label", `Waypoint ${where}`);
  }

  /** After a change of size. */
  fit(): void {
    this.set(this.#place);
  }
}
