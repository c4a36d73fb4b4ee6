/** The map: flights, the one that is followed, and its prediction, on a canvas. */
import { colours } from "../shared/colours.ts";
import { ellipse } from "../shared/ellipse.ts";
import type { Airliner, Flight, Place, Prediction } from "./airliner.ts";

/** What is shown, in metres. */
const WEST = -7000;
const EAST = 139_000;
const SOUTH = -14_000;
const NORTH = 26_000;
const KILOMETRE = 1000;

export class FlightMap {
  readonly #canvas: HTMLCanvasElement;
  #width = 0;
  #height = 0;
  #colours = { line: "", muted: "", rest: "", light: "", text: "", font: "" };

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.fit();
  }

  /** After a change of size or theme. */
  fit(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    [this.#width, this.#height] = [clientWidth, clientHeight];
    this.#canvas.width = Math.round(clientWidth * devicePixelRatio);
    this.#canvas.height = Math.round(clientHeight * devicePixelRatio);
    const style = getComputedStyle(this.#canvas);
    const rem = Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
    this.#colours = {
      ...colours(this.#canvas.parentElement ?? this.#canvas, ["line", "muted", "rest", "light", "text"]),
      font: `${0.75 * rem}px ${style.fontFamily}`,
    };
  }

  /** A place in CSS pixels from the canvas's corner. */
  toScreen({ x, y }: Place): Place {
    return { x: ((x - WEST) / (EAST - WEST)) * this.#width, y: ((NORTH - y) / (NORTH - SOUTH)) * this.#height };
  }

  /** The place under a point of the canvas, within the map. */
  toPlace({ x, y }: Place): Place {
    const within = (share: number) => Math.min(1, Math.max(0, share));
    return {
      x: WEST + within(x / this.#width) * (EAST - WEST),
      y: NORTH - within(y / this.#height) * (NORTH - SOUTH),
    };
  }

  draw(airliner: Airliner, measured: number, prediction: Prediction): void {
    const context = this.#canvas.getContext("2d");
    if (!context) return;
    const { rest, light, text } = this.#colours;
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, this.#width, this.#height);
    context.lineJoin = "round";
    this.#axes(context);

    context.lineWidth = 1;
    context.strokeStyle = rest;
    context.globalAlpha = 0.5;
    context.setLineDash([5, 4]);
    for (const flight of airliner.markov) this.#line(context, flight);
    context.setLineDash([]);
    context.strokeStyle = light;
    context.globalAlpha = 0.3;
    for (const flight of airliner.directed) this.#line(context, flight);

    context.globalAlpha = 1;
    for (const density of prediction.densities) this.#density(context, density);
    context.strokeStyle = light;
    context.lineWidth = 2.5;
    this.#line(context, prediction.path);

    context.strokeStyle = text;
    context.lineWidth = 2;
    this.#line(context, airliner.followed.slice(0, measured + 1));
    const now = airliner.followed[measured];
    if (now) {
      const { x, y } = this.toScreen(now);
      context.fillStyle = text;
      context.beginPath();
      context.arc(x, y, 4.5, 0, 2 * Math.PI);
      context.fill();
    }
  }

  #line(context: CanvasRenderingContext2D, flight: Flight): void {
    context.beginPath();
    for (const place of flight) {
      const { x, y } = this.toScreen(place);
      context.lineTo(x, y);
    }
    context.stroke();
  }

  /** Two deviations of a position. */
  #density(context: CanvasRenderingContext2D, { mean, covariance }: Prediction["end"]): void {
    // in pixels first: the map's axes have scales of their own
    const [a, b] = [this.#width / (EAST - WEST), -this.#height / (NORTH - SOUTH)];
    const [xx = 0, xy = 0] = covariance;
    const yy = covariance[mean.length + 1] ?? 0;
    const shape = ellipse([xx * a * a, xy * a * b, xy * a * b, yy * b * b], 2);
    const { x, y } = this.toScreen({ x: mean[0] ?? 0, y: mean[1] ?? 0 });
    context.beginPath();
    context.ellipse(x, y, 2 * shape.long, 2 * shape.short, shape.angle, 0, 2 * Math.PI);
    context.fillStyle = this.#colours.light;
    context.strokeStyle = this.#colours.text;
    context.globalAlpha = 0.16;
    context.fill();
    context.globalAlpha = 0.75;
    context.lineWidth = 1;
    context.stroke();
    context.globalAlpha = 1;
  }

  #axes(context: CanvasRenderingContext2D): void {
    const { line, muted, font } = this.#colours;
    context.globalAlpha = 1;
    context.strokeStyle = line;
    context.fillStyle = muted;
    context.font = font;
    context.lineWidth = 1;
    context.textBaseline = "alphabetic";
    for (let x = 20; x * KILOMETRE < EAST; x += 20) {
      const place = this.toScreen({ x: x * KILOMETRE, y: SOUTH });
      this.#rule(context, place.x, 0, place.x, this.#height);
      context.textAlign = "center";
      context.fillText(x === 20 ? "20 km east" : String(x), place.x, this.#height - 8);
    }
    for (let y = -10; y * KILOMETRE < NORTH; y += 10) {
      const place = this.toScreen({ x: WEST, y: y * KILOMETRE });
      this.#rule(context, 0, place.y, this.#width, place.y);
      context.textAlign = "left";
      context.fillText(y === 20 ? "20 km north" : String(y), 8, place.y - 6);
    }
  }

  #rule(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
    context.beginPath();
    context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
    context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
    context.stroke();
  }
}
