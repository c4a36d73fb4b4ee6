/** The plain projection: the same shapes on a canvas without WebGL, the farthest first. */
import type { Position } from "../cabin.ts";
import type { Camera, Projected } from "./camera.ts";
import {
  type Colour,
  dashes,
  faded,
  type Glow,
  type Line,
  mixed,
  type Patch,
  type Shapes,
  type Tube,
  type View,
} from "./view.ts";

/** Tubes are shaded from their rim to the middle as a cylinder is: share of the width, and of the way to black. */
const SHADES = [1, 0.92, 0.8, 0.64, 0.44, 0.2].map((width) => ({ width, dark: 0.5 - 0.5 * Math.sqrt(1 - width ** 2) }));
const DARK: Colour = [0, 0, 0, 1];

export class PlainView implements View {
  readonly kind = "plain";
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D;
  #ratio = 1;

  constructor(canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("a canvas cannot be drawn on here");
    this.#canvas = canvas;
    this.#context = context;
    context.lineCap = "round";
  }

  resize(width: number, height: number, ratio: number): void {
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    this.#ratio = ratio;
  }

  draw({ patches, glows, marks, tubes, lines }: Shapes, camera: Camera): void {
    const context = this.#context;
    context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    context.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.lineCap = "round";
    context.lineJoin = "round";
    for (const patch of patches) this.#patch(patch, camera);
    for (const glow of glows) this.#glow(glow, camera);
    for (const mark of marks) this.#line(mark, camera);
    const solid = [
      ...tubes.map((tube) => ({ depth: depthOf(tube.points, camera), paint: () => this.#tube(tube, camera) })),
      ...lines.map((line) => ({ depth: depthOf(line.points, camera), paint: () => this.#line(line, camera) })),
    ];
    for (const { paint } of solid.sort((a, b) => b.depth - a.depth)) paint();
  }

  free(): void {
    this.#canvas.width = this.#canvas.height = 0;
  }

  #patch({ corners, colour }: Patch, camera: Camera): void {
    this.#path(corners.map((corner) => camera.project(corner)));
    this.#context.closePath();
    this.#context.fillStyle = css(colour);
    this.#context.fill();
  }

  /** A circle on the screen's plane is nearly an ellipse: the one through its ends. */
  #glow({ centre: [x, y, z], radius, colour }: Glow, camera: Camera): void {
    const context = this.#context;
    const middle = camera.project([x, y, z]);
    const right = camera.project([x + radius, y, z]);
    const down = camera.project([x, y + radius, z]);
    context.save();
    context.transform(right.x - middle.x, right.y - middle.y, down.x - middle.x, down.y - middle.y, middle.x, middle.y);
    const light = context.createRadialGradient(0, 0, 0, 0, 0, 1);
    for (const [at, share] of FALL) light.addColorStop(at, css(faded(colour, share)));
    context.fillStyle = light;
    context.beginPath();
    context.arc(0, 0, 1, 0, 2 * Math.PI);
    context.fill();
    context.restore();
  }

  #tube({ points, radius, colour }: Tube, camera: Camera): void {
    const places = points.map((point) => camera.project(point));
    const width = 2 * radius * camera.scale(depthOf(points, camera));
    this.#context.lineCap = "round";
    for (const shade of SHADES) {
      this.#path(places);
      this.#context.lineWidth = shade.width * width;
      this.#context.strokeStyle = css(mixed(colour, DARK, shade.dark));
      this.#context.stroke();
    }
  }

  #line(line: Line, camera: Camera): void {
    const context = this.#context;
    context.lineWidth = line.width;
    context.lineCap = "round";
    for (const points of dashes(line)) {
      const places = points.map((point) => camera.project(point));
      if (line.from === undefined) {
        this.#path(places);
        context.strokeStyle = css(line.colour);
        context.stroke();
        continue;
      }
      const from = line.from;
      context.lineCap = "butt";
      places.slice(1).forEach((place, k) => {
        this.#path([places[k] as Projected, place]);
        context.strokeStyle = css(faded(line.colour, from + ((1 - from) * (k + 1)) / (places.length - 1)));
        context.stroke();
      });
    }
  }

  #path(places: readonly Projected[]): void {
    this.#context.beginPath();
    for (const { x, y } of places) this.#context.lineTo(x, y);
  }
}

/** How light falls off from the middle. */
const FALL = [
  [0, 1],
  [0.2, 0.78],
  [0.48, 0.32],
  [0.75, 0.08],
  [1, 0],
] as const;

function depthOf(points: readonly Position[], camera: Camera): number {
  return points.reduce((sum, point) => sum + camera.project(point).depth, 0) / points.length;
}

function css([red, green, blue, alpha]: Colour): string {
  return `rgb(${red} ${green} ${blue} / ${alpha})`;
}
