/**
 * How submenus are found, shown and hidden where the page has no way of its own.
 *
 * @module
 */
import type { Submenu } from "./types.js";

const LISTS = "ul, ol, menu, [role=menu], [popover]";

/** The submenu of an item by its attributes or its place in the document. */
export function submenuOf(item: Element): Element | null {
  const id = item.getAttribute("aria-controls");
  const controlled = id ? (item.getRootNode() as Document).getElementById(id) : null;
  if (controlled) return controlled;
  const next = item.nextElementSibling;
  return [...item.children].find((child) => child.matches(LISTS)) ?? (next?.matches(LISTS) ? next : null);
}

/** The `aria-expanded` of items whose submenu is open, as it was before. */
let before: WeakMap<Element, string | null> | undefined;

export function show({ item, panel }: Submenu): void {
  if (!isPopover(panel)) panel.removeAttribute("hidden");
  // the page may have, by now
  else if (!panel.matches(":popover-open")) panel.showPopover();
  before ??= new WeakMap();
  before.set(item, item.getAttribute("aria-expanded"));
  item.setAttribute("aria-expanded", "true");
}

export function hide({ item, panel }: Submenu): void {
  if (isPopover(panel)) panel.hidePopover();
  else panel.setAttribute("hidden", "");
  if (before?.get(item) === null) item.removeAttribute("aria-expanded");
  else item.setAttribute("aria-expanded", "false");
}

function isPopover(panel: Element): panel is HTMLElement {
  return panel.hasAttribute("popover") && "showPopover" in panel;
}
