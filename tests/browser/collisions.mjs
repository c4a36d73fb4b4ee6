// Runs in a page.

/** Texts that lie over one another, or outside of what shows them, or are cut off; and what scrolls sideways. */
export function collisions() {
  const found = [];
  if (document.documentElement.scrollWidth > innerWidth)
    found.push(`the page is ${document.documentElement.scrollWidth} px wide`);
  const texts = [];
  for (const element of document.querySelectorAll("body *")) {
    if (element.closest(".hidden, .skip, svg, select, details:not([open]) > :not(summary)")) continue;
    if (!element.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    if (getComputedStyle(element).clipPath !== "none") continue; // for screen readers alone
    for (const node of element.childNodes) {
      if (node.nodeType !== Node.TEXT_NODE || !node.textContent.trim()) continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      // code scrolls sideways in its own box
      const edge = element.closest("pre")?.getBoundingClientRect().right ?? Infinity;
      for (const { left, right, top, bottom, height } of range.getClientRects()) {
        const box = { left, right: Math.min(right, edge), top, bottom, height };
        texts.push({ element, box, text: node.textContent.trim().slice(0, 30) });
      }
    }
    const own = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
    if (own && ["hidden", "clip"].includes(getComputedStyle(element).overflowX) && element.scrollWidth > element.clientWidth + 1)
      found.push(`cut: ${element.textContent.trim().slice(0, 30)}`);
  }
  const over = (a, b) =>
    Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  texts.forEach(({ element, box, text }, index) => {
    // the height of the letters, not that of the line
    const letters = (rect) => ({
      left: rect.left,
      right: rect.right,
      top: rect.top + 0.2 * rect.height,
      bottom: rect.bottom - 0.2 * rect.height,
    });
    for (const other of texts.slice(index + 1)) {
      if (other.element !== element && over(letters(box), letters(other.box))) found.push(`${text} over ${other.text}`);
    }
    const inside = element.closest("button")?.getBoundingClientRect();
    if (inside && (box.left < inside.left - 1 || box.right > inside.right + 1 || box.bottom > inside.bottom + 1))
      found.push(`${text} is outside its button`);
    if (!element.closest("pre") && (box.right > innerWidth + 1 || box.left < -1)) found.push(`${text} is outside the page`);
  });
  return found;
}
