/** A canvas to draw on: as sharp as the device is, in the theme's colours and the page's size of text. */
import { colours } from "../shared/colours.ts";

const NAMES = [
  "screen",
  "line",
  "text",
  "muted",
  "rest",
  "light",
  "glow",
  "on-light",
  "on-band",
  "band-1",
  "band-2",
  "band-3",
  "band-4",
  "band-5",
  "land",
] as const;

export interface Paper {
  readonly context: CanvasRenderingContext2D;
  readonly width: number;
  readonly height: number;
  readonly colours: Readonly<Record<(typeof NAMES)[number], string>>;
  /** Pixels in a rem, and the family of fonts. */
  readonly rem: number;
  readonly family: string;
}

/** Fits a canvas to its element; null where it cannot be drawn on. After each change of size, resolution or theme. */
export function paper(canvas: HTMLCanvasElement): Paper | null {
  const context = canvas.getContext("2d");
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!context || width === 0) return null;
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  return {
    context,
    width,
    height,
    colours: colours(canvas.parentElement ?? canvas, NAMES),
    rem: Number.parseFloat(getComputedStyle(document.documentElement).fontSize),
    family: getComputedStyle(canvas).fontFamily,
  };
}
