/** From metres of the bay to pixels of the chart, at one scale for both axes. */
import { EXTENT, type Place } from "./coast.ts";

const MIDDLE: Place = { x: (EXTENT.west + EXTENT.east) / 2, y: (EXTENT.south + EXTENT.north) / 2 };

export class Projection {
  readonly width: number;
  readonly height: number;
  /** Pixels in a metre. */
  readonly scale: number;

  /** For a chart of so many pixels: all of the extent is on it, and more of the bay where there is room. */
  constructor(width: number, height: number) {
    this.width = width;
    this.height = height;
    this.scale = Math.min(width / (EXTENT.east - EXTENT.west), height / (EXTENT.north - EXTENT.south));
  }

  toScreen({ x, y }: Place): Place {
    return { x: this.width / 2 + (x - MIDDLE.x) * this.scale, y: this.height / 2 - (y - MIDDLE.y) * this.scale };
  }

  toPlace({ x, y }: Place): Place {
    return { x: MIDDLE.x + (x - this.width / 2) / this.scale, y: MIDDLE.y - (y - this.height / 2) / this.scale };
  }
}
