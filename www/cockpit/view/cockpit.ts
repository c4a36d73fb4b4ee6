/** The cockpit as shapes: the screen with its icons lit by their probability, what stands around it, the hand and where it may go. */
import { LEVER, type Position, SCREEN, TARGETS, WHEEL } from "../cabin.ts";
import type { Moment } from "../forecast.ts";
import { plus } from "../vector.ts";
import { BOX, type Glyph } from "./glyphs.ts";
import { handAt } from "./hand.ts";
import { type Colour, faded, type Line, mixed, type Patch, type Shapes, type Tube } from "./view.ts";

/** The theme's, resolved. */
export type Palette = Readonly<Record<"ground" | "screen" | "line" | "rest" | "muted" | "text" | "light" | "glow", Colour>> & {
  /** How strong the glow is, from 0 to 1. */
  readonly strength: number;
};

/** What is drawn at one moment. */
export interface Picture {
  /** Where the hand is, and where it was before; in mm. */
  readonly trail: readonly Position[];
  readonly moment: Moment | null;
  /** The index of the icon that is touched. */
  readonly touched: number | null;
}

/** An icon as probable as this has a ring around it. */
const RINGED = 0.8;
/** The side of a glyph, in mm. */
const GLYPH = 14;
const CIRCLE = 40;

export class Cockpit {
  readonly #glyphs: readonly Glyph[];
  #palette: Palette;
  #unit: number;
  #still: { patches: Patch[]; tubes: Tube[]; lines: Line[] };

  /** `unit` is the width of a hairline, in px. */
  constructor(glyphs: readonly Glyph[], palette: Palette, unit: number) {
    this.#glyphs = glyphs;
    this.#palette = palette;
    this.#unit = unit;
    this.#still = around(palette, unit);
  }

  /** After a change of theme, or of the text's size. */
  restyle(palette: Palette, unit: number): void {
    this.#palette = palette;
    this.#unit = unit;
    this.#still = around(palette, unit);
  }

  shapes({ trail, moment, touched }: Picture): Shapes {
    const { ground, line, light, glow, rest, text, strength } = this.#palette;
    const { patches, tubes, lines } = this.#still;
    const share = (icon: number) => moment?.probabilities[icon] ?? 0;
    const tip = trail.at(-1);
    const unit = this.#unit;
    return {
      patches,
      glows: TARGETS.map(({ x, y }, icon) => ({
        centre: [x, y, 0.4] as const,
        radius: 27,
        colour: faded(glow, Math.max(0, share(icon) - 0.04) * strength * 1.25),
      })),
      marks: [
        ...this.#glyphs.flatMap((glyph, icon) => {
          const { x = 0, y = 0 } = TARGETS[icon] ?? {};
          const colour = mixed(rest, light, share(icon));
          return glyph.map((points) => ({
            points: points.map(([u, v]): Position => [x + (u / BOX - 0.5) * GLYPH, y + (v / BOX - 0.5) * GLYPH, 0.8]),
            width: 1.5 * unit,
            colour,
          }));
        }),
        ...TARGETS.flatMap((_, icon) => (icon === touched || share(icon) >= RINGED ? [ring(icon, light, 2.5 * unit)] : [])),
        ...(tip ? [shadow(tip, text, 1.5 * unit)] : []),
      ],
      tubes: tip ? [...tubes, ...handAt(tip, mixed(rest, lighter(text, ground), 0.35), mixed(rest, line, 0.65))] : tubes,
      lines: [
        ...lines,
        ...(moment?.paths ?? []).map(({ icon, points }) => ({
          points: (tip ? [tip, ...points.slice(1)] : points).map(before),
          width: 2.25 * unit,
          colour: faded(light, Math.min(1, 0.12 + share(icon))),
        })),
        { points: trail.map(before), width: 2.5 * unit, colour: text, from: 0 },
        ...(tip
          ? [{ points: [tip, [tip[0], tip[1], 0] as const], width: unit, colour: faded(text, 0.5), dash: [5, 6] as const }]
          : []),
      ],
    };
  }
}

/** Not behind the screen, where the noise of a tracker has it. */
function before([x, y, z]: Position): Position {
  return [x, y, Math.max(1.5, z)];
}

function lighter(a: Colour, b: Colour): Colour {
  return a[0] + a[1] + a[2] > b[0] + b[1] + b[2] ? a : b;
}

function ring(icon: number, colour: Colour, width: number): Line {
  const { x = 0, y = 0 } = TARGETS[icon] ?? {};
  return { points: circle(15.5).map(([u, v]): Position => [x + u, y + v, 1]), width, colour };
}

/** The foot of the fingertip's height above the screen. */
function shadow([x, y]: Position, colour: Colour, width: number): Line {
  return { points: circle(4).map(([u, v]): Position => [x + u, y + v, 1]), width, colour: faded(colour, 0.6) };
}

/** What does not change: the screen, the dashboard's edge, the wheel, the lever. */
function around({ screen, line, rest }: Palette, unit: number): { patches: Patch[]; tubes: Tube[]; lines: Line[] } {
  const box = (by: number, z: number): Position[] => [
    [-by, -by, z],
    [SCREEN.width + by, -by, z],
    [SCREEN.width + by, SCREEN.height + by, z],
    [-by, SCREEN.height + by, z],
  ];
  const solid = mixed(line, rest, 0.16);
  return {
    patches: [
      { corners: box(9, -1), colour: line },
      { corners: box(4, 0), colour: screen },
    ],
    tubes: [
      ...wheel(solid),
      { points: LEVER, radius: 7, colour: solid },
      { points: [LEVER[1], plus(LEVER[1], [0, -1, 0])], radius: 21, colour: solid },
    ],
    lines: [
      { points: dashboard(-34, 0), width: 1.5 * unit, colour: line },
      { points: dashboard(SCREEN.height + 34, 22), width: 1.5 * unit, colour: line },
    ],
  };
}

/** An edge that runs through the cockpit, above the screen or below it. */
function dashboard(y: number, z: number): Position[] {
  return Array.from({ length: 25 }, (_, k) => {
    const x = -560 + k * 55;
    return [x, y + ((x - SCREEN.width / 2) / 300) ** 2 * 10, z + ((x - SCREEN.width / 2) / 300) ** 2 * 26];
  });
}

function wheel(colour: Colour): Tube[] {
  const { centre, radius, lean } = WHEEL;
  const at = (angle: number, share: number): Position => {
    const [u, v] = [radius * share * Math.cos(angle), radius * share * Math.sin(angle)];
    return plus(centre, [u, v * Math.cos(lean), v * Math.sin(lean)]);
  };
  // by its quarters, so that what is near hides what is far
  const arc = (quarter: number): Tube => {
    const points = Array.from({ length: 19 }, (_, k) => at(((quarter + k / 18) * Math.PI) / 2, 1));
    return { points, radius: 12, colour };
  };
  const spoke = (angle: number): Tube => ({ points: [at(angle, 0.2), at(angle, 0.96)], radius: 9, colour });
  return [
    ...[0, 1, 2, 3].map(arc),
    ...[0, Math.PI / 2, Math.PI].map(spoke),
    { points: [centre, at(Math.PI / 2, 0.2)], radius: 34, colour },
  ];
}

function circle(radius: number): [number, number][] {
  return Array.from({ length: CIRCLE + 1 }, (_, k) => {
    const angle = (k / CIRCLE) * 2 * Math.PI;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}
