/**
 * What is expected, drawn in light: a path to each of the leading three that the movement has not passed, and the forecast's one-deviation
 * ellipse once it is informative.
 */
import type { Gaussian } from "whither/dom";
import { ellipse, isInformative } from "../../shared/ellipse.ts";
import type { Point } from "../geometry.ts";

/** What is expected, in px of the viewport. */
export interface Outlook {
  /** Positions on the way to an icon: x, y, x, y, ... */
  readonly paths: readonly { readonly probability: number; readonly points: ArrayLike<number> }[];
  /** Where the pointer is on arrival. */
  readonly arrival: Gaussian | null;
}

/** A less probable path is not drawn. */
const FAINTEST = 0.02;

export class Fan {
  readonly #canvas: HTMLCanvasElement;
  #colour = "";
  #scale = 1;
  #drawn = false;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.fit();
  }

  /** After a change of size or theme. */
  fit(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    this.#scale = devicePixelRatio;
    this.#canvas.width = Math.round(clientWidth * this.#scale);
    this.#canvas.height = Math.round(clientHeight * this.#scale);
    this.#colour = getComputedStyle(this.#canvas).color;
    this.#drawn = false;
  }

  clear(): void {
    if (!this.#drawn) return;
    const context = this.#canvas.getContext("2d");
    context?.setTransform(1, 0, 0, 1, 0, 0);
    context?.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    this.#drawn = false;
  }

  /** `corner` is that of the canvas in the viewport. */
  draw({ paths, arrival }: Outlook, corner: Point): void {
    if (devicePixelRatio !== this.#scale) this.fit();
    this.clear();
    const context = this.#canvas.getContext("2d");
    if (!context) return;
    this.#drawn = true;
    context.setTransform(this.#scale, 0, 0, this.#scale, -corner.x * this.#scale, -corner.y * this.#scale);
    context.strokeStyle = this.#colour;
    context.fillStyle = this.#colour;
    context.lineCap = "round";
    for (const { probability, points } of paths) {
      if (probability < FAINTEST || turnsBack(points)) continue;
      // the second and the third are visible beside the first, and thinner
      context.globalAlpha = 0.25 + 0.75 * probability;
      context.lineWidth = 1 + probability;
      trace(context, points);
      context.stroke();
    }
    if (!arrival) return;
    const shape = ellipse(arrival.covariance, arrival.mean.length);
    if (!isInformative(shape, this.#canvas.clientWidth, this.#canvas.clientHeight)) return;
    context.beginPath();
    context.ellipse(arrival.mean[0] ?? 0, arrival.mean[1] ?? 0, shape.long, shape.short, shape.angle, 0, 2 * Math.PI);
    context.globalAlpha = 0.07;
    context.fill();
    context.globalAlpha = 0.35;
    context.lineWidth = 1;
    context.stroke();
  }
}

/** A path longer by this factor than its first and last places are apart turns back: its icon has been passed. */
const DETOUR = 1.5;

/** Whether a path is a hook, to an icon that the movement has passed. */
export function turnsBack(points: ArrayLike<number>): boolean {
  const at = (place: number) => ({ x: points[2 * place] ?? 0, y: points[2 * place + 1] ?? 0 });
  const apart = (one: Point, other: Point) => Math.hypot(other.x - one.x, other.y - one.y);
  const last = points.length / 2 - 1;
  const steps = Array.from({ length: Math.max(0, last) }, (_, place) => apart(at(place), at(place + 1)));
  return steps.reduce((sum, step) => sum + step, 0) > DETOUR * apart(at(0), at(last));
}

/** A smooth line through x, y, x, y, ...: quadratic pieces between the middles. */
function trace(context: CanvasRenderingContext2D, points: ArrayLike<number>): void {
  const x = (place: number) => points[2 * place] ?? 0;
  const y = (place: number) => points[2 * place + 1] ?? 0;
  const last = points.length / 2 - 1;
  context.beginPath();
  context.moveTo(x(0), y(0));
  for (let place = 1; place < last; place += 1) {
    context.quadraticCurveTo(x(place), y(place), (x(place) + x(place + 1)) / 2, (y(place) + y(place + 1)) / 2);
  }
  context.lineTo(x(last), y(last));
}
