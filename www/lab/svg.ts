/** Drawing in SVG, whose colours the stylesheet gives by class. */
import type { Box, Place } from "./movement.ts";

const NAMESPACE = "http://www.w3.org/2000/svg";

/** An element with attributes. */
export function svg(tag: string, attributes: Readonly<Record<string, string | number>>, ...children: Element[]): SVGElement {
  const element = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export function text(words: string, attributes: Readonly<Record<string, string | number>>): SVGElement {
  const element = svg("text", attributes);
  element.textContent = words;
  return element;
}

/** As `points` of a polyline. */
export function points(path: readonly Place[]): string {
  return path.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ");
}

/** A target; one that is as wide as high and on a ring is a disc. */
export function targetShape([x, y, width, height]: Box, round: boolean, name: string): SVGElement {
  return svg("rect", {
    class: name,
    x: x - width / 2,
    y: y - height / 2,
    width,
    height,
    rx: (round ? 0.5 : 0.22) * Math.min(width, height),
  });
}
