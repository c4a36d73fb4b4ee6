/**
 * What is read of a page's layout and styles: injected, as the platform is.
 *
 * @module
 */
import { attempt, hostOf } from "../platform.js";
import { isDisabled } from "../targets.js";
import type { Bounds } from "../types.js";

/** Where a window's viewport is in the main window: scales and px. */
export interface Frame {
  readonly x: number;
  readonly y: number;
  readonly across: number;
  readonly down: number;
}

/** The only part that reads where things are. */
export interface Surface {
  /** An element's box in the viewport of its own window. */
  box(element: Element): Bounds;
  /** Where the viewport of a window is in the main window. */
  frameOf(view: Window): Frame;
  /** Whether an element is rendered, visible, enabled and can be pointed at, as far as styles and attributes decide. */
  isUsable(element: Element): boolean;
  /** The elements outside of which nothing can be pointed at: open modal dialogs, what fills the screen. */
  modals(document: Document): Element[];
  /** The innermost element at a place of a document's viewport, in shadow trees too. */
  topmost(document: Document, x: number, y: number): Element | null;
}

/** The nearest of an element and those around it, out of shadow trees too, that matches. */
export function closest(element: Element, selector: string): Element | null {
  for (let at: Element | undefined = element; at; ) {
    const found: Element | null = at.closest(selector);
    if (found) return found;
    at = (at.getRootNode() as ShadowRoot).host;
  }
  return null;
}

/** Whether a node is in the tree of another one, in a shadow tree or an iframe there too. */
export function contains(ancestor: Node, node: Node): boolean {
  for (let at: Node | null = node; at; at = at.parentNode ?? hostOf(at)) if (at === ancestor) return true;
  return false;
}

/** The browser's. */
export function surface(): Surface {
  return {
    box: (element) => element.getBoundingClientRect(),
    frameOf,
    isUsable,
    modals: (document) => attempt(() => Array.from(document.querySelectorAll(":modal, :fullscreen:not(:root)"))) ?? [],
    topmost,
  };
}

/** Through the elements in which the window and those around it are framed. */
function frameOf(view: Window): Frame {
  let frame = { x: 0, y: 0, across: 1, down: 1 };
  for (let at = view; at !== window; ) {
    const element = hostOf(at.document) as HTMLElement | null;
    const around = element?.ownerDocument.defaultView;
    if (!element || !around) break;
    const { x, y, width, height } = element.getBoundingClientRect();
    const across = width / element.offsetWidth || 1;
    const down = height / element.offsetHeight || 1;
    const { paddingLeft, paddingTop } = around.getComputedStyle(element);
    frame = {
      x: x + across * (element.clientLeft + Number.parseFloat(paddingLeft) + frame.x),
      y: y + down * (element.clientTop + Number.parseFloat(paddingTop) + frame.y),
      across: across * frame.across,
      down: down * frame.down,
    };
    at = around;
  }
  return frame;
}

function isUsable(element: Element): boolean {
  if (element.checkVisibility?.({ visibilityProperty: true }) === false) return false;
  if (isDisabled(element) || closest(element, "[inert]")) return false;
  return getComputedStyle(element).pointerEvents !== "none";
}

function topmost(document: Document, x: number, y: number): Element | null {
  let found = document.elementFromPoint?.(x, y) ?? null;
  for (let inner = found; inner; ) {
    inner = found?.shadowRoot?.elementFromPoint(x, y) ?? null;
    if (!inner || inner === found) break;
    found = inner;
  }
  return found;
}
