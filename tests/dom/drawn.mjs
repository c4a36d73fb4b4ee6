// Pages that whither/overlay draws over.
import { open, scripted } from "./page.mjs";

/** Runs in the page: what there is of the overlay, and what it shows. */
function prepare() {
  window.shadow = () => document.querySelector("whither-overlay")?.shadowRoot;
  window.part = (selector) => shadow()?.querySelector(selector);
  window.parts = (selector) => [...(shadow()?.querySelectorAll(selector) ?? [])];
  /** The lines of the posterior: a name and a figure each. */
  window.lines = () => parts(".row").map((row) => [row.firstChild.textContent, row.lastChild.textContent]);
  window.logLines = () =>
    parts("li").map(({ children: [name, end, why] }) => [`${name.textContent} ${why.textContent}`, end.textContent]);
  window.figures = () => parts("dd").map(({ textContent }) => textContent);
  /** The share of a box's outline that is painted. */
  window.outlined = ({ x, y, width, height }) => {
    const canvas = part("canvas");
    const ratio = canvas.width / canvas.clientWidth;
    // a copy, from which reading is cheap
    const { width: across, height: down } = canvas;
    const context = Object.assign(document.createElement("canvas"), { width: across, height: down }).getContext("2d", {
      willReadFrequently: true,
    });
    context.drawImage(canvas, 0, 0);
    const painted = (x, y) => {
      const { data } = context.getImageData(Math.round(ratio * x) - 1, Math.round(ratio * y) - 1, 3, 3);
      return data.some((value, i) => i % 4 === 3 && value > 60);
    };
    const at = Array.from({ length: 20 }, (_, i) => (i + 0.5) / 20);
    const places = at.flatMap((share) => [
      [x + share * width, y],
      [x + share * width, y + height],
      [x, y + share * height],
      [x + width, y + share * height],
    ]);
    return places.filter(([x, y]) => painted(x, y)).length / places.length;
  };
}

const head = `<script>(${prepare})()</script>`;
const start = (overlaid) => `
  const { overlay } = await import("./overlay.js");
  Object.assign(window, { overlay });
  window.drawn = overlay(${overlaid});
  await frames(3);`;

/** A page whose watcher the overlay draws; `overlaid` are its arguments (text). */
export function openDrawn(
  site,
  body,
  { overlaid = "watcher", script = "", head: more = "", options = "{}", watched = '"button"', ...others } = {},
) {
  return open(site, body, {
    head: head + more,
    script: `window.watcher = record(${watched}, ${options}); await watcher.ready; ${start(overlaid)} ${script}`,
    ...others,
  });
}

/** The same with a scripted posterior. */
export async function scriptedDrawn(site, options, { overlaid = "watcher", body } = {}) {
  const opened = await scripted(site, options, body);
  await opened.page.evaluate(prepare);
  await opened.page.evaluate(`(async () => { ${start(overlaid)} })()`);
  return opened;
}
