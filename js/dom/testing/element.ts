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
  /** The shadow root that it is in. @defaultValue none */
  readonly shadow?: { readonly host: Element; readonly mode: "open" | "closed" };
}

let count = 0;

export class TestElement extends EventTarget {
  /** So that no two of them are equal. */
  readonly number = count++;
  readonly nodeType = 1;
  readonly style = new TestStyle((oldValue) => this.#report("style", oldValue));
  readonly ownerDocument: Document;
  readonly parentElement: TestElement | null;
  /** Where it is, in the viewport's px. */
  box: Bounds;
  /** Whether styles let it be pointed at. */
  usable = true;
  readonly #page: TestPage;
  readonly #tag: string;
  readonly #attributes: Map<string, string>;
  readonly #root: Node;

  constructor(page: TestPage, tag: string, box: Bounds, { parent, attributes = {}, shadow }: ElementOptions) {
    super();
    this.#page = page;
    this.#tag = tag;
    this.#attributes = new Map(Object.entries(attributes));
    this.ownerDocument = page.document;
    this.parentElement = parent ?? null;
    this.box = box;
    this.#root = (shadow ?? page.document) as Node;
  }

  get id(): string {
    return this.getAttribute("id") ?? "";
  }

  get isConnected(): boolean {
    return this.#page.elements.includes(this);
  }

  get parentNode(): Node {
    return (this.parentElement ?? this.#root) as unknown as Node;
  }

  getRootNode(): Node {
    return this.#root;
  }

  querySelectorAll(selector: string): TestElement[] {
    return this.#page.elements.filter((element) => element !== this && this.contains(element) && element.matches(selector));
  }

  getAttribute(name: string): string | null {
    return name === "style" ? this.style.cssText || null : (this.#attributes.get(name) ?? null);
  }

  setAttribute(name: string, value: string): void {
    if (name === "style") this.style.cssText = value;
    else this.#change(name, () => this.#attributes.set(name, value));
  }

  removeAttribute(name: string): void {
    if (this.getAttribute(name) === null) return;
    if (name === "style") this.style.cssText = "";
    else this.#change(name, () => this.#attributes.delete(name));
  }

  contains(other: TestElement | null): boolean {
    for (let at = other; at; at = at.parentElement) if (at === this) return true;
    return false;
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
    this.#report(attributeName, oldValue);
  }

  #report(attributeName: string, oldValue: string | null): void {
    this.#page.changed([{ type: "attributes", target: this, attributeName, oldValue }]);
  }
}

export class TestStyle {
  readonly #properties = new Map<string, string>();
  readonly #changed: (before: string | null) => void;

  /** `changed` is called after every change, with the text before it. */
  constructor(changed: (before: string | null) => void) {
    this.#changed = changed;
  }

  get cssText(): string {
    return Array.from(this.#properties, ([name, value]) => `${name}: ${value};`).join(" ");
  }

  set cssText(text: string) {
    this.#change(() => {
      this.#properties.clear();
      for (const [, name, value] of text.matchAll(/([\w-]+)\s*:\s*([^;]+)/g))
        this.#properties.set(name as string, value as string);
    });
  }

  get length(): number {
    return this.#properties.size;
  }

  getPropertyValue(name: string): string {
    return this.#properties.get(name) ?? "";
  }

  setProperty(name: string, value: string): void {
    this.#change(() => this.#properties.set(name, value));
  }

  removeProperty(name: string): void {
    if (this.#properties.has(name)) this.#change(() => this.#properties.delete(name));
  }

  #change(run: () => void): void {
    const before = this.cssText || null;
    run();
    this.#changed(before);
  }
}
