/** What moves on the chart: harbours as lights, tracks, expected paths, vessels. Drawn once a frame. */
import type { Gaussian } from "whither";
import { ellipse, isInformative } from "../shared/ellipse.ts";
import { HARBOURS, type Place } from "./coast.ts";
import type { Path } from "./lookout.ts";
import type { Paper } from "./paper.ts";
import type { Projection } from "./projection.ts";

/** A harbour's light, from 0 to 1, and the number beside its name. */
export interface Light {
  readonly share: number;
  readonly figure: string;
  /** A ring around it: it leads. */
  readonly ringed: boolean;
}

const DARK: Light = { share: 0, figure: "", ringed: false };

/** One vessel of a fleet. */
export interface Mark {
  readonly place: Place;
  readonly velocity: Place;
  /** How probable the most probable harbour is. */
  readonly probability: number;
  readonly marked: boolean;
  readonly followed: boolean;
}

/** Where something was found on a track. */
export interface Spot {
  readonly place: Place;
  readonly number: number;
}

export class Traffic {
  readonly #paper: Paper;
  readonly #projection: Projection;
  readonly #strength: number;

  /** `strength` is the theme's, of a glow. */
  constructor(paper: Paper, projection: Projection, strength: number) {
    this.#paper = paper;
    this.#projection = projection;
    this.#strength = strength;
  }

  clear(): void {
    this.#paper.context.clearRect(0, 0, this.#paper.width, this.#paper.height);
  }

  lights(lights: readonly Light[]): void {
    for (const [index, harbour] of HARBOURS.entries()) {
      const { x, y } = this.#projection.toScreen(harbour);
      const { share = 0 } = lights[index] ?? {};
      this.#glow(x, y, share);
    }
    for (const [index, harbour] of HARBOURS.entries()) this.#harbour(harbour, lights[index] ?? DARK);
  }

  /** Half the light looks half as likely. */
  #glow(x: number, y: number, share: number): void {
    const { context, colours, rem } = this.#paper;
    if (share < 0.01) return;
    const radius = 4.5 * rem;
    const glow = context.createRadialGradient(x, y, 0, x, y, radius);
    for (const [stop, alpha] of [
      [0, 1],
      [0.2, 0.78],
      [0.48, 0.32],
      [0.75, 0.08],
      [1, 0],
    ] as const)
      glow.addColorStop(stop, withAlpha(colours.glow, alpha));
    context.globalAlpha = share * this.#strength;
    context.fillStyle = glow;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
    context.globalAlpha = 1;
  }

  #harbour({ name, label, ...place }: (typeof HARBOURS)[number], { share, figure, ringed }: Light): void {
    const { context, colours, rem, family } = this.#paper;
    const { x, y } = this.#projection.toScreen(place);
    context.beginPath();
    context.arc(x, y, 0.36 * rem, 0, 2 * Math.PI);
    context.fillStyle = colours.screen;
    context.fill();
    context.globalAlpha = Math.sqrt(share);
    context.fillStyle = colours.light;
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1.75;
    context.strokeStyle = ringed ? colours.light : colours.text;
    context.stroke();
    if (ringed) {
      context.beginPath();
      context.arc(x, y, 0.7 * rem, 0, 2 * Math.PI);
      context.stroke();
    }
    context.textBaseline = "middle";
    context.textAlign = label === "above" ? "center" : label === "left" ? "right" : "left";
    const side = label === "above" ? 0 : label === "left" ? -1 : 1;
    const [left, middle] = [x + side * 1.05 * rem, label === "above" ? y - 1.95 * rem : y - 0.5 * rem];
    this.#text(name, left, middle, `${ringed ? 600 : 500} ${0.8125 * rem}px ${family}`, ringed ? colours.text : colours.muted);
    this.#text(figure, left, middle + 1 * rem, `500 ${0.8125 * rem}px ${family}`, share >= 0.05 ? colours.text : colours.muted);
  }

  /** Over whatever is under it. */
  #text(text: string, x: number, y: number, font: string, colour: string): void {
    const { context, colours } = this.#paper;
    context.font = font;
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.strokeStyle = colours.land;
    context.globalAlpha = 0.75;
    context.strokeText(text, x, y);
    context.globalAlpha = 1;
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  /** Where a vessel has been. */
  track(places: readonly Place[], share = 1): void {
    const { context, colours } = this.#paper;
    context.strokeStyle = colours.text;
    context.globalAlpha = 0.8 * share;
    context.lineWidth = 1.75;
    context.lineJoin = "round";
    this.#line(places);
    context.stroke();
    context.globalAlpha = 1;
  }

  /** Where it is expected to go, as opaque as that is probable, and the forecast's deviation. */
  paths(paths: readonly Path[], forecasts: readonly Gaussian[], from: Place): void {
    const { context, colours, width, height } = this.#paper;
    const { scale } = this.#projection;
    context.strokeStyle = colours.light;
    for (const { places, probability } of paths) {
      context.globalAlpha = 0.15 + 0.85 * probability;
      context.lineWidth = 1 + 1.5 * probability;
      this.#curve([from, ...places]);
      context.stroke();
    }
    context.lineWidth = 1;
    for (const { mean, covariance } of forecasts) {
      const shape = ellipse(
        covariance.map((entry, index) => (index % 5 === 0 ? entry : -entry) * scale * scale),
        mean.length,
      );
      if (!isInformative(shape, width, height)) continue;
      const { x, y } = this.#projection.toScreen({ x: mean[0] ?? 0, y: mean[1] ?? 0 });
      context.beginPath();
      context.ellipse(x, y, shape.long, shape.short, shape.angle, 0, 2 * Math.PI);
      context.fillStyle = colours.light;
      context.globalAlpha = 0.12;
      context.fill();
      context.globalAlpha = 0.6;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** Numbered diamonds. */
  spots(spots: readonly Spot[]): void {
    const { context, colours, rem, family } = this.#paper;
    for (const { place, number } of spots) {
      const { x, y } = this.#projection.toScreen(place);
      const half = 0.62 * rem;
      context.beginPath();
      context.moveTo(x, y - half);
      context.lineTo(x + half, y);
      context.lineTo(x, y + half);
      context.lineTo(x - half, y);
      context.closePath();
      context.fillStyle = colours.screen;
      context.fill();
      context.strokeStyle = colours.text;
      context.lineWidth = 1.75;
      context.stroke();
      context.fillStyle = colours.text;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.font = `600 ${0.6875 * rem}px ${family}`;
      context.fillText(String(number), x, y + 0.5);
    }
  }

  fleet(marks: readonly Mark[]): void {
    const { context, colours, rem } = this.#paper;
    for (const { place, velocity, probability, marked, followed } of marks) {
      const { x, y } = this.#projection.toScreen(place);
      const size = (followed ? 0.6 : 0.42) * rem;
      context.save();
      context.translate(x, y);
      if (marked || followed) {
        context.beginPath();
        if (marked) diamond(context, 1.5 * size);
        else context.arc(0, 0, 1.5 * size, 0, 2 * Math.PI);
        context.strokeStyle = colours.text;
        context.lineWidth = 1.25;
        context.stroke();
      }
      context.rotate(Math.atan2(velocity.x, velocity.y));
      hull(context, size);
      context.fillStyle = colours.screen;
      context.fill();
      context.globalAlpha = Math.max(0.08, probability);
      context.fillStyle = colours.light;
      context.fill();
      context.globalAlpha = 1;
      context.strokeStyle = followed ? colours.text : colours.rest;
      context.lineWidth = 1;
      context.stroke();
      context.restore();
    }
  }

  #line(places: readonly Place[]): void {
    const { context } = this.#paper;
    context.beginPath();
    for (const place of places) {
      const { x, y } = this.#projection.toScreen(place);
      context.lineTo(x, y);
    }
  }

  /** Smooth through few places. */
  #curve(places: readonly Place[]): void {
    const { context } = this.#paper;
    const points = places.map((place) => this.#projection.toScreen(place));
    context.beginPath();
    for (const [index, point] of points.entries()) {
      const next = points[index + 1];
      if (index === 0) context.moveTo(point.x, point.y);
      else if (next) context.quadraticCurveTo(point.x, point.y, (point.x + next.x) / 2, (point.y + next.y) / 2);
      else context.lineTo(point.x, point.y);
    }
  }
}

function hull(context: CanvasRenderingContext2D, size: number): void {
  context.beginPath();
  context.moveTo(0, -1.1 * size);
  context.lineTo(0.6 * size, 0.8 * size);
  context.lineTo(0, 0.45 * size);
  context.lineTo(-0.6 * size, 0.8 * size);
  context.closePath();
}

function diamond(context: CanvasRenderingContext2D, size: number): void {
  context.moveTo(0, -size);
  context.lineTo(size, 0);
  context.lineTo(0, size);
  context.lineTo(-size, 0);
  context.closePath();
}

/** A colour as the browser computes it, more transparent. */
function withAlpha(colour: string, alpha: number): string {
  const [red, green, blue] = colour.match(/[\d.]+/g) ?? [];
  return `rgb(${red} ${green} ${blue} / ${alpha})`;
}
