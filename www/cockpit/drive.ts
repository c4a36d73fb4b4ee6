/** A visitor's hand: the pointer, or a handle that is dragged, takes it sideways and up, the wheel or a slider towards the screen. */
import { type Position, REACH } from "./cabin.ts";
import type { Camera } from "./view/camera.ts";

/** Mm towards the screen for a px of the wheel, and for a key. */
const WHEEL = 0.3;
const KEY = 20;
/** Px of a line that the wheel turns by. */
const LINE = 16;
/** Px for an arrow key. */
const STEP = 12;
/** How slowly the hand follows, in seconds: sideways, and towards the screen, where a wheel comes in jumps. */
const LAG = { aside: 0.015, ahead: 0.05 } as const;
/** How far from the screen it begins, in mm. */
const START = 300;

const KEYS: Readonly<Record<string, readonly [right: number, down: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
const AHEAD: Readonly<Record<string, number>> = { PageUp: 1, "+": 1, PageDown: -1, "-": -1 };

export interface DriveParts {
  readonly stage: HTMLElement;
  readonly handle: HTMLButtonElement;
  /** In mm from the screen. */
  readonly distance: HTMLInputElement;
}

/** Follows what it is given, without jumps of its speed. */
class Follower {
  readonly #lag: number;
  #between: number;
  value: number;

  constructor(lag: number, value: number) {
    this.#lag = lag;
    this.#between = this.value = value;
  }

  put(value: number): void {
    this.#between = this.value = value;
  }

  step(to: number, seconds: number): void {
    const share = 1 - Math.exp(-seconds / this.#lag);
    this.#between += share * (to - this.#between);
    this.value += share * (this.#between - this.value);
  }
}

export class Drive {
  readonly #parts: DriveParts;
  readonly #camera: Camera;
  readonly #controller = new AbortController();
  /** Where it is to be: px of the stage, and mm from the screen. */
  #aim: { x: number; y: number };
  #depth = START;
  readonly #x: Follower;
  readonly #y: Follower;
  readonly #z: Follower;
  #last: number | null = null;

  constructor(parts: DriveParts, camera: Camera, start: Position) {
    this.#parts = parts;
    this.#camera = camera;
    const { x, y } = camera.project([start[0], start[1], START]);
    this.#aim = { x, y };
    [this.#x, this.#y] = [new Follower(LAG.aside, x), new Follower(LAG.aside, y)];
    this.#z = new Follower(LAG.ahead, START);
    parts.distance.value = String(START);
    this.#listen();
  }

  /** Where the hand is at a time in seconds, ever later. */
  step(seconds: number): Position {
    const by = this.#last === null ? 0 : Math.min(0.1, seconds - this.#last);
    this.#last = seconds;
    this.#x.step(this.#aim.x, by);
    this.#y.step(this.#aim.y, by);
    this.#z.step(this.#depth, by);
    return reachable(this.#camera.placeAt(this.#x.value, this.#y.value, this.#z.value));
  }

  /** After a turn of the camera, or a change of size: the hand stays where it is. */
  stay(place: Position): void {
    const { x, y } = this.#camera.project(place);
    this.#aim = { x, y };
    this.#x.put(x);
    this.#y.put(y);
  }

  end(): void {
    this.#controller.abort();
  }

  #listen(): void {
    const { stage, handle, distance } = this.#parts;
    const { signal } = this.#controller;
    const point = (event: PointerEvent) => {
      const { left, top } = stage.getBoundingClientRect();
      this.#aim = { x: event.clientX - left - stage.clientLeft, y: event.clientY - top - stage.clientTop };
    };
    stage.addEventListener(
      "pointermove",
      (event) => {
        // a finger scrolls, but for the handle
        if (event.pointerType !== "touch" || handle.hasPointerCapture(event.pointerId)) point(event);
      },
      { signal },
    );
    handle.addEventListener("pointerdown", (event) => handle.setPointerCapture(event.pointerId), { signal });
    stage.addEventListener(
      "wheel",
      (event) => {
        if (event.ctrlKey) return;
        event.preventDefault();
        this.#ahead(-WHEEL * event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1));
      },
      { signal, passive: false },
    );
    handle.addEventListener(
      "keydown",
      (event) => {
        const [direction, ahead] = [KEYS[event.key], AHEAD[event.key]];
        if (!direction && ahead === undefined) return;
        event.preventDefault();
        if (direction) {
          this.#aim = {
            x: within(this.#aim.x + STEP * direction[0], 0, stage.clientWidth),
            y: within(this.#aim.y + STEP * direction[1], 0, stage.clientHeight),
          };
        }
        if (ahead !== undefined) this.#ahead(KEY * ahead);
      },
      { signal },
    );
    distance.addEventListener("input", () => (this.#depth = Number(distance.value)), { signal });
  }

  #ahead(millimetres: number): void {
    this.#depth = within(this.#depth - millimetres, REACH[0][2], REACH[1][2]);
    this.#parts.distance.value = String(this.#depth);
  }
}

function reachable(place: Position): Position {
  const at = (axis: 0 | 1 | 2) => within(place[axis], REACH[0][axis], REACH[1][axis]);
  return [at(0), at(1), at(2)];
}

function within(value: number, least: number, most: number): number {
  return Math.min(most, Math.max(least, value));
}
