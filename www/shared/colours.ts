/** Colours for a canvas, which knows neither variables nor every way to write a colour. */

/** Resolves custom properties that hold colours, as they are for `element` now. */
export function colours<Name extends string>(element: HTMLElement, names: readonly Name[]): Record<Name, string> {
  const probe = document.createElement("span");
  probe.hidden = true;
  probe.style.setProperty("forced-color-adjust", "none");
  element.append(probe);
  const style = getComputedStyle(probe);
  const found = names.map((name) => {
    probe.style.color = `var(--${name})`;
    return [name, style.color] as const;
  });
  probe.remove();
  return Object.fromEntries(found) as Record<Name, string>;
}
