/**
 * What is drawn over the page: the targets' boxes, the ways to the most probable ones, where the pointer will be.
 *
 * @module
 */
import type { Bounds, Inspection, Probable, Snapshot, Watcher, WatchTarget } from "#dom";
import { duration, percent } from "./elements.js";

/** What a canvas paints with. */
export interface Colours {
  /** What is probable, and what is written on it. */
  readonly light: string;
  readonly ink: string;
  /** Around lines and behind words, so that they show on any page. */
  readonly ground: string;
}

/** How many ways are drawn, to targets at least this probable, and the times on them (s). */
const WAYS = 4;
const LEAST = 0.03;
const TIMES = Array.from({ length: 21 }, (_, i) => i / 20);

/** When the forecast is drawn (s), and its contour in deviations, the root of -2 ln .2: the pointer is within it four times in five. */
const HORIZONS = [0.1, 0.2];
const CONTOUR = 1.7941;

/** Of the pointer's trail so many places are kept. */
const TRAIL = 40;

/** The outlines of what is not probable. */
const QUIET = "rgb(128 132 140 / 0.8)";

const FONT = "600 11px system-ui, sans-serif";
const CHIP = 18;

export class Drawing {
  readonly canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D | null;
  #trail: (readonly [number, number])[] = [];
  #width = 0;
  #height = 0;
  /** Whether anything is painted. */
  #painted = false;

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    this.#context = canvas.getContext("2d");
  }

  /** As many pixels as the screen has. */
  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = window.devicePixelRatio;
    this.#width = clientWidth;
    this.#height = clientHeight;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.#context?.scale(ratio, ratio);
  }

  clear(): void {
    if (this.#painted) this.#context?.clearRect(0, 0, this.#width, this.#height);
    this.#painted = false;
  }

  /** A frame, with or without the trail behind the pointer. */
  paint(
    watcher: Watcher,
    inspection: Inspection | null,
    places: Map<WatchTarget, Bounds>,
    colours: Colours,
    trail: boolean,
  ): void {
    const context = this.#context;
    this.clear();
    if (!context) return;
    this.#painted = true;
    const snapshot = watcher.getSnapshot();
    context.lineJoin = context.lineCap = "round";
    context.font = FONT;
    context.textBaseline = "middle";
    this.#boxes(context, snapshot, places, colours);
    if (snapshot.moving) this.#movement(context, watcher, snapshot, colours, trail);
    else this.#trail = [];
    this.#chips(context, watcher, inspection, snapshot, places, colours);
  }

  #boxes(
    context: CanvasRenderingContext2D,
    { targets, intended }: Snapshot,
    places: Map<WatchTarget, Bounds>,
    colours: Colours,
  ): void {
    const probabilities = new Map(targets.map(({ target, probability }) => [target, probability]));
    // the most probable ones last, on top
    const each = [...places].map(([target, box]) => ({ target, box, probability: probabilities.get(target) ?? 0 }));
    each.sort((a, b) => a.probability - b.probability);
    for (const { target, box, probability } of each) {
      const strength = intended.includes(target) ? 1 : probability;
      context.beginPath();
      context.roundRect?.(box.x, box.y, box.width, box.height, 3);
      if (!context.roundRect) context.rect(box.x, box.y, box.width, box.height);
      if (strength === 0) {
        // a middling grey, which shows on dark and on light
        context.setLineDash([3, 3]);
        context.lineWidth = 1;
        context.strokeStyle = QUIET;
        context.stroke();
        continue;
      }
      context.setLineDash([]);
      context.fillStyle = colours.light;
      context.globalAlpha = 0.22 * strength;
      context.fill();
      context.globalAlpha = 0.8;
      this.#line(context, colours.light, 1 + 1.5 * strength, colours.ground);
      context.globalAlpha = 1;
    }
    context.setLineDash([]);
  }

  /** Strokes the path, with something around it. */
  #line(context: CanvasRenderingContext2D, colour: string, width: number, ground: string): void {
    context.strokeStyle = ground;
    context.lineWidth = width + 1.5;
    context.stroke();
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }

  #movement(context: CanvasRenderingContext2D, watcher: Watcher, snapshot: Snapshot, colours: Colours, trail: boolean): void {
    const now = watcher.forecast(0)?.mean;
    if (!now) return;
    const [x, y] = now as unknown as [number, number];
    const last = this.#trail.at(-1);
    if (last?.[0] !== x || last[1] !== y) this.#trail = [...this.#trail, [x, y] as const].slice(-TRAIL);
    if (trail) {
      this.#trail.forEach(([x, y], i) => {
        context.globalAlpha = (0.6 * i) / this.#trail.length;
        disc(context, x, y, 1.5, colours.light);
      });
    }
    for (const { target, probability } of snapshot.targets.slice(0, WAYS)) {
      if (probability < LEAST) break;
      const way = watcher.path(target, TIMES);
      context.beginPath();
      for (let i = 0; i < way.length; i += 2) context.lineTo(way[i] as number, way[i + 1] as number);
      context.globalAlpha = 0.2 + 0.7 * probability;
      this.#line(context, colours.light, 1 + 2 * probability, colours.ground);
    }
    for (const seconds of HORIZONS) {
      const forecast = watcher.forecast(seconds);
      if (!forecast) continue;
      const { x, y, long, short, angle } = ellipseOf(forecast.mean, forecast.covariance);
      context.beginPath();
      context.ellipse(x, y, CONTOUR * long, CONTOUR * short, angle, 0, 2 * Math.PI);
      context.globalAlpha = 0.1;
      context.fillStyle = colours.light;
      context.fill();
      context.globalAlpha = 0.8;
      context.setLineDash([4, 3]);
      this.#line(context, colours.light, 1, colours.ground);
      context.setLineDash([]);
      disc(context, x, y, 2, colours.light);
    }
    context.globalAlpha = 1;
  }

  #chips(
    context: CanvasRenderingContext2D,
    watcher: Watcher,
    inspection: Inspection | null,
    { best, targets, intended }: Snapshot,
    places: Map<WatchTarget, Bounds>,
    colours: Colours,
  ): void {
    const listed = new Set(targets.map(({ target }) => target));
    const meant = intended.filter((target) => !listed.has(target));
    const each: Pick<Probable, "target" | "probability">[] = [...meant.map((target) => ({ target, probability: 0 })), ...targets];
    // the most probable ones last, on top
    for (const { target, probability } of each.reverse()) {
      const box = places.get(target);
      if (!box) continue;
      const isIntended = intended.includes(target);
      const words = probability > 0 ? [percent(probability)] : [];
      if (isIntended) words.push(inspection?.reasonOf(target) ?? "intended");
      const { remaining } = watcher;
      if (target === best?.target && remaining) words.push(`in ${duration(remaining.mean)}`);
      const text = words.join(" · ");
      const width = context.measureText(text).width + 10;
      const x = Math.max(0, Math.min(box.x, this.#width - width));
      // over the box, or in it where there is no room
      const y = box.y - CHIP - 2 < 0 ? Math.max(0, box.y) : box.y - CHIP - 2;
      context.globalAlpha = isIntended ? 1 : 0.92;
      context.fillStyle = isIntended ? colours.light : colours.ground;
      context.beginPath();
      context.roundRect?.(x, y, width, CHIP, 4);
      if (!context.roundRect) context.rect(x, y, width, CHIP);
      context.fill();
      context.globalAlpha = 1;
      context.fillStyle = isIntended ? colours.ink : colours.light;
      context.fillText(text, x + 5, y + CHIP / 2 + 0.5);
    }
  }
}

function disc(context: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
  context.fillStyle = colour;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}

/** The principal axes of the position's covariance, one deviation long. */
function ellipseOf(mean: Float64Array, covariance: Float64Array) {
  const [x = 0, y = 0] = mean;
  const [xx = 0, xy = 0] = covariance;
  const yy = covariance[mean.length + 1] ?? 0;
  const middle = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {
    x,
    y,
    long: Math.sqrt(Math.max(0, middle + spread)),
    short: Math.sqrt(Math.max(0, middle - spread)),
    angle: Math.atan2(2 * xy, xx - yy) / 2,
  };
}
