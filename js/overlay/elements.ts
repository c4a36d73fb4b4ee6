/**
 * Makes elements, without markup in text: pages with Trusted Types take it, too.
 *
 * @module
 */

type Child = Node | string;

/** What an element is given: properties by their names, attributes by theirs where there is a hyphen or it is `role`, listeners in `on`. */
type Given = Readonly<Record<string, unknown>> & { readonly on?: Readonly<Record<string, (event: never) => void>> };

/** An HTML element. */
export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  given: Given,
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  const { on, ...rest } = given;
  for (const [name, value] of Object.entries(rest)) {
    if (name.includes("-") || name === "role") element.setAttribute(name, String(value));
    else Object.assign(element, { [name]: value });
  }
  for (const [type, listener] of Object.entries(on ?? {})) element.addEventListener(type, listener as EventListener);
  element.append(...children);
  return element;
}

/** An SVG element. */
export function draw(tag: string, attributes: Readonly<Record<string, string | number>>, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

/** A picture of 16 by 16 lines for a button that has a name. */
export function icon(path: string): SVGElement {
  return draw("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" }, draw("path", { d: path }));
}

/** Writes a text where it is another one: nothing is laid out again for the same. */
export function write(node: Node, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

/** A share as people read it: "72%", "<1%". */
export function percent(share: number): string {
  return share > 0 && share < 0.01 ? "<1%" : `${Math.round(100 * share)}%`;
}

/** Seconds as people read them: "412 ms", "1.3 s". */
export function duration(seconds: number): string {
  return seconds < 0.9995 ? `${Math.round(1000 * seconds)} ms` : `${seconds.toFixed(1)} s`;
}
