/** The nautical chart: land, depths, soundings, names, north and a scale. Drawn once for a size and a theme. */
import { distance, EXTENT, HARBOURS, NAMES, PILOT_STATION } from "./coast.ts";
import { below, sample, type Ring } from "./contours.ts";
import { depth } from "./depth.ts";
import type { Paper } from "./paper.ts";
import type { Projection } from "./projection.ts";

/** The bay far beyond every chart's edge, in steps of so many metres. */
const REACH = {
  west: EXTENT.west - 24_000,
  east: EXTENT.east + 24_000,
  south: EXTENT.south - 40_000,
  north: EXTENT.north + 40_000,
};
const STEP = 500;
/** Depth contours in metres; the first is the coast. */
const LEVELS = [0, 5, 10, 20, 50] as const;
/** Soundings about so many pixels apart. */
const SOUNDINGS = 74;
const KILOMETRE = 1000;

export class Chart {
  readonly #regions: readonly Ring[][];

  constructor() {
    const field = sample(depth, REACH, STEP);
    this.#regions = LEVELS.map((level) => below(field, level));
  }

  draw(paper: Paper, projection: Projection): void {
    const { context, colours, rem } = paper;
    const { width, height } = projection;
    context.fillStyle = colours.screen;
    context.fillRect(0, 0, width, height);
    const [land, ...depths] = this.#regions.map((rings) => outline(rings, projection));
    if (!land) return;
    // the shallower, the nearer to the colour of land
    context.fillStyle = colours.land;
    context.globalAlpha = 0.3;
    for (const path of depths.slice(0, 3)) context.fill(path, "evenodd");
    context.globalAlpha = 1;
    context.strokeStyle = colours.line;
    context.lineWidth = 1;
    for (const path of depths) context.stroke(path);
    this.#graticule(paper, projection);
    context.fillStyle = colours.land;
    context.fill(land, "evenodd");
    context.strokeStyle = colours.rest;
    context.lineWidth = 1.25;
    context.stroke(land);
    if (width > 34 * rem) this.#soundings(paper, projection);
    this.#names(paper, projection);
    this.#scale(paper, projection);
  }

  /** A grid of ten kilometres. */
  #graticule({ context, colours }: Paper, projection: Projection): void {
    const { width, height } = projection;
    context.strokeStyle = colours.line;
    context.globalAlpha = 0.55;
    context.lineWidth = 1;
    context.beginPath();
    for (let k = -60; k <= 80; k += 10) {
      const { x, y } = projection.toScreen({ x: k * KILOMETRE, y: k * KILOMETRE });
      context.moveTo(Math.round(x) + 0.5, 0);
      context.lineTo(Math.round(x) + 0.5, height);
      context.moveTo(0, Math.round(y) + 0.5);
      context.lineTo(width, Math.round(y) + 0.5);
    }
    context.stroke();
    context.globalAlpha = 1;
  }

  /** Depths in metres, where the water is, on a grid that is shifted in every second row. */
  #soundings({ context, colours, rem, family }: Paper, projection: Projection): void {
    const { width, height } = projection;
    const apart = SOUNDINGS * (rem / 16);
    context.font = `${0.625 * rem}px ${family}`;
    context.fillStyle = colours.muted;
    context.globalAlpha = 0.5;
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (let row = 0; row * apart < height; row += 1) {
      for (let x = (row % 2 ? 0.25 : 0.75) * apart; x < width; x += apart) {
        const y = (row + 0.5) * apart;
        const place = projection.toPlace({ x, y });
        const metres = depth(place);
        const free = [...HARBOURS, ...NAMES, PILOT_STATION].every(
          (other) => distance(place, other) * projection.scale > 2.75 * rem,
        );
        if (metres > 1 && free && (y < height - 3 * rem || x < width - 12 * rem))
          context.fillText(metres < 10 ? metres.toFixed(1) : metres.toFixed(0), x, y);
      }
    }
    context.globalAlpha = 1;
  }

  #names({ context, colours, rem, family }: Paper, projection: Projection): void {
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillStyle = colours.muted;
    context.strokeStyle = colours.screen;
    context.lineWidth = 4;
    context.lineJoin = "round";
    for (const { text, bay, ...place } of NAMES) {
      if (!bay && projection.width < 34 * rem) continue;
      const { x, y } = projection.toScreen(place);
      context.font = `italic ${(bay ? 1.0625 : 0.75) * rem}px ${family}`;
      context.globalAlpha = bay ? 0.8 : 1;
      context.strokeText(text, x, y);
      context.fillText(text, x, y);
    }
    context.globalAlpha = 1;
    const { x, y } = projection.toScreen(PILOT_STATION);
    context.strokeStyle = colours.rest;
    context.lineWidth = 1;
    context.setLineDash([3, 3]);
    context.beginPath();
    context.arc(x, y, 0.75 * rem, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
    context.font = `${0.6875 * rem}px ${family}`;
    context.fillText("pilot station", x, y + 1.4 * rem);
  }

  /** North, and ten kilometres beside it. */
  #scale({ context, colours, rem, family }: Paper, projection: Projection): void {
    const length = 10 * KILOMETRE * projection.scale;
    const [x, y] = [projection.width - 1.6 * rem, projection.height - 1.1 * rem];
    const left = x - 1.2 * rem - length;
    context.strokeStyle = colours.muted;
    context.fillStyle = colours.muted;
    context.lineWidth = 1;
    context.strokeRect(left, y - 4, length, 4);
    context.fillRect(left, y - 4, length / 2, 4);
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x, y - 2 * rem);
    context.moveTo(x - 0.3 * rem, y - 1.4 * rem);
    context.lineTo(x, y - 2 * rem);
    context.lineTo(x + 0.3 * rem, y - 1.4 * rem);
    context.stroke();
    context.font = `${0.6875 * rem}px ${family}`;
    context.textBaseline = "alphabetic";
    context.textAlign = "center";
    context.fillText("N", x, y - 2.3 * rem);
    context.fillText("10 km", left + length / 2, y - 0.6 * rem);
  }
}

function outline(rings: readonly Ring[], projection: Projection): Path2D {
  const path = new Path2D();
  for (const ring of rings) {
    for (const [i, place] of ring.entries()) {
      const { x, y } = projection.toScreen(place);
      if (i === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
    }
    path.closePath();
  }
  return path;
}
