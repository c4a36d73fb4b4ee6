/** The icons of lucide as lines on the screen's plane. */
import type { IconNode } from "lucide";

const SVG = "http://www.w3.org/2000/svg";
/** The side of the square in which lucide draws. */
export const BOX = 24;
/** From one point of a line to the next, in the square's units. */
const STEP = 0.7;

/** Points of the square, one list for each line. */
export type Glyph = readonly (readonly (readonly [x: number, y: number])[])[];

/** Traces icons; the shapes have to be in the document for that. */
export function trace(icons: readonly IconNode[]): Glyph[] {
  const canvas = document.createElementNS(SVG, "svg");
  canvas.setAttribute("class", "hidden");
  canvas.setAttribute("aria-hidden", "true");
  document.body.append(canvas);
  const glyphs = icons.map((icon) =>
    icon.flatMap(([tag, attributes]) => {
      const shape = document.createElementNS(SVG, tag) as SVGGeometryElement;
      for (const [name, value] of Object.entries(attributes)) shape.setAttribute(name, String(value));
      canvas.append(shape);
      return lines(shape);
    }),
  );
  canvas.remove();
  return glyphs;
}

/** A path may jump from one line to the next. */
function lines(shape: SVGGeometryElement): [number, number][][] {
  const length = shape.getTotalLength();
  const count = Math.max(1, Math.ceil(length / STEP));
  const found: [number, number][][] = [[]];
  for (let k = 0; k <= count; k += 1) {
    const { x, y } = shape.getPointAtLength((k * length) / count);
    const line = found.at(-1) as [number, number][];
    const [lastX, lastY] = line.at(-1) ?? [x, y];
    if (Math.hypot(x - lastX, y - lastY) > 1.2 * STEP) found.push([[x, y]]);
    else line.push([x, y]);
  }
  // a dot is a line without length
  return found.map((line) => (line.length === 1 ? [...line, ...line] : line));
}
