/**
 * As much of an element as whither/dom reads and writes: attributes, a style, parents, simple selectors; and a box that a test sets.
 *
 * @module
 */
import type { Bounds } from "../types.js";
import type { TestPage } from "./page.js";

/** What an element of a test page is made with. */
export interface ElementOptions {
  /** @defaultValue the body */
  readonly parent?: TestElement;
  /** @defaultValue none */
  readonly attributes?: Readonly<Record<string, string>>;
}

export class TestElement extends EventTarget {
  readonly nodeType = 1;
  readonly style = new TestStyle();
  readonly ownerDocument: Document;
  readonly parentElement: TestElement | null;
  /** Where it is, in the viewport's px. */
  box: Bounds;
  /** Whether styles let it be pointed at. */
  usable = true;
  readonly #page: TestPage;
  readonly #tag: string;
  readonly #attributes: Map<string, string>;

  constructor(page: TestPage, tag: string, box: Bounds, { parent, attributes = {} }: ElementOptions) {
    super();
    this.#page = page;
    this.#tag = tag;
    this.#attributes = new Map(Object.entries(attributes));
    this.ownerDocument = page.document;
    this.parentElement = parent ?? null;
    this.box = box;
  }

  get id(): string {
    return this.getAttribute("id") ?? "";
  }

  get isConnected(): boolean {
    return this.#page.elements.includes(this);
  }

  get parentNode(): Node {
    return (this.parentElement ?? this.ownerDocument) as unknown as Node;
  }

  getRootNode(): Node {
    return this.ownerDocument;
  }

  getAttribute(name: string): string | null {
    return this.#attributes.get(name) ?? null;
  }

  setAttribute(name: string, value: string): void {
    this.#change(name, () => this.#attributes.set(name, value));
  }

  removeAttribute(name: string): void {
    if (this.#attributes.has(name)) this.#change(name, () => this.#attributes.delete(name));
  }

  /** Of selectors it knows lists of `*`, `tag`, `[name]`, `[name=value]` and `:disabled`. */
  matches(selector: string): boolean {
    return selector.split(",").some((one) => this.#matches(one.trim()));
  }

  closest(selector: string): TestElement | null {
    for (let at: TestElement | null = this; at; at = at.parentElement) if (at.matches(selector)) return at;
    return null;
  }

  #matches(selector: string): boolean {
    if (selector === "*" || selector === this.#tag) return true;
    if (selector === ":disabled") return this.#attributes.has("disabled");
    const [, name, value] = /^\[([\w-]+)(?:=([\w-]+))?\]$/.exec(selector) ?? [];
    if (name !== undefined) return value === undefined ? this.#attributes.has(name) : this.#attributes.get(name) === value;
    if (/^[\w-]+$/.test(selector)) return false;
    throw new SyntaxError(`not a selector that a test page knows: ${selector}`);
  }

  #change(attributeName: string, run: () => void): void {
    const oldValue = this.getAttribute(attributeName);
    run();
    this.#page.changed([{ type: "attributes", target: this, attributeName, oldValue }]);
  }
}

class TestStyle {
  readonly #properties = new Map<string, string>();

  get length(): number {
    return this.#properties.size;
  }

  getPropertyValue(name: string): string {
    return this.#properties.get(name) ?? "";
  }

  setProperty(name: string, value: string): void {
    this.#properties.set(name, value);
  }

  removeProperty(name: string): void {
    this.#properties.delete(name);
  }
}
