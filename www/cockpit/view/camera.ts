/** The driver's eye: it looks at the middle of the cockpit, and can be turned about it. */
import { type Position, SCREEN } from "../cabin.ts";
import { cross, dot, minus, plus, times, unit } from "../vector.ts";

/** A place on the canvas, in px, and how far it is from the eye, in mm. */
export interface Projected {
  readonly x: number;
  readonly y: number;
  readonly depth: number;
}

/** Degrees: to the right of the screen's middle, and above. */
export interface Turn {
  readonly azimuth: number;
  readonly elevation: number;
}

/** About where a driver's eyes are. */
export const FROM_THE_SEAT: Turn = { azimuth: -20, elevation: 24 };
const LIMITS = { azimuth: [-50, 46], elevation: [6, 44] } as const;

const MIDDLE: Position = [SCREEN.width / 2 - 58, SCREEN.height / 2 + 52, 100];
const DISTANCE = 1000;
/** Half of what is visible at the middle, in mm: at least so much to the sides, and up and down. */
const HALF_WIDTH = 290;
const HALF_HEIGHT = 204;
/** Nothing nearer than this to the eye is drawn, and nothing farther. */
export const NEAR = 120;
export const FAR = 2600;

const within = (value: number, [low, high]: readonly [number, number]) => Math.min(high, Math.max(low, value));

export class Camera {
  #turn: Turn = FROM_THE_SEAT;
  #width = 1;
  #height = 1;
  #eye: Position = MIDDLE;
  #axes: readonly [right: Position, up: Position, ahead: Position] = [
    [1, 0, 0],
    [0, -1, 0],
    [0, 0, -1],
  ];

  constructor() {
    this.turnTo(FROM_THE_SEAT);
  }

  get turn(): Turn {
    return this.#turn;
  }

  /** Within its limits. */
  turnTo({ azimuth, elevation }: Turn): void {
    this.#turn = { azimuth: within(azimuth, LIMITS.azimuth), elevation: within(elevation, LIMITS.elevation) };
    const [across, up] = [this.#turn.azimuth, this.#turn.elevation].map((degrees) => (degrees * Math.PI) / 180) as [
      number,
      number,
    ];
    const back: Position = [Math.sin(across) * Math.cos(up), -Math.sin(up), Math.cos(across) * Math.cos(up)];
    const ahead = times(-1, back);
    const right = unit(cross([0, -1, 0], ahead));
    this.#eye = plus(MIDDLE, times(DISTANCE, back));
    this.#axes = [right, unit(cross(ahead, right)), ahead];
  }

  /** The size of the canvas, in px. */
  resize(width: number, height: number): void {
    this.#width = Math.max(1, width);
    this.#height = Math.max(1, height);
  }

  /** Px for a mm at so many mm from the eye. */
  scale(depth: number): number {
    return (DISTANCE / depth) * Math.min(this.#width / (2 * HALF_WIDTH), this.#height / (2 * HALF_HEIGHT));
  }

  project(place: Position): Projected {
    const [right, up, ahead] = this.#axes;
    const from = minus(place, this.#eye);
    const depth = Math.max(NEAR, dot(from, ahead));
    const scale = this.scale(depth);
    return { x: this.#width / 2 + scale * dot(from, right), y: this.#height / 2 - scale * dot(from, up), depth };
  }

  /** The place under a point of the canvas so many mm in front of the screen. */
  placeAt(x: number, y: number, z: number): Position {
    const [right, up, ahead] = this.#axes;
    const scale = this.scale(1);
    const ray = plus(ahead, plus(times((x - this.#width / 2) / scale, right), times((this.#height / 2 - y) / scale, up)));
    return plus(this.#eye, times((z - this.#eye[2]) / ray[2], ray));
  }

  /** The same as `project`, as a matrix for WebGL, column by column: its `w` is the depth. */
  matrix(): Float32Array {
    const [right, up, ahead] = this.#axes;
    const row = (axis: Position, by: number): [number, number, number, number] => [
      by * axis[0],
      by * axis[1],
      by * axis[2],
      -by * dot(axis, this.#eye),
    ];
    const scale = this.scale(1);
    const rows = [row(right, (2 * scale) / this.#width), row(up, (2 * scale) / this.#height), row(ahead, 1)] as const;
    const depth = (FAR + NEAR) / (FAR - NEAR);
    const z = rows[2].map((each) => depth * each);
    z[3] = (z[3] ?? 0) - (2 * FAR * NEAR) / (FAR - NEAR);
    return Float32Array.from([0, 1, 2, 3].flatMap((column) => [rows[0], rows[1], z, rows[2]].map((each) => each[column] ?? 0)));
  }
}
