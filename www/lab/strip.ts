/** When along a movement a method was right, as a strip from its start to the entry. */
import type { Movement } from "./movement.ts";
import { svg } from "./svg.ts";

/** The strip's own units. */
const LENGTH = 100;
const HEIGHT = 8;

/** A stretch of time with the right target on top, as shares of the approach. */
export interface Stretch {
  readonly from: number;
  readonly to: number;
}

/** Each sample counts from half of the interval before it to half of the one after it, as in the share of the time. */
export function stretches({ samples, target }: Movement, tops: readonly (number | null)[]): Stretch[] {
  const time = (k: number) => samples[Math.min(Math.max(k, 0), tops.length - 1)]?.[0] ?? 0;
  const [start, total] = [time(0), Math.max(time(tops.length - 1) - time(0), 1e-12)];
  const found: { from: number; to: number }[] = [];
  tops.forEach((top, k) => {
    if (top !== target) return;
    const [from, to] = [(time(k - 1) + time(k)) / 2, (time(k) + time(k + 1)) / 2].map((each) => (each - start) / total);
    const last = found.at(-1);
    if (last && tops[k - 1] === target) last.to = to ?? 1;
    else found.push({ from: from ?? 0, to: to ?? 1 });
  });
  return found;
}

export function strip(movement: Movement, tops: readonly (number | null)[]): SVGElement {
  const lit = stretches(movement, tops);
  const share = lit.reduce((sum, { from, to }) => sum + to - from, 0);
  return svg(
    "svg",
    {
      class: "strip",
      viewBox: `0 0 ${LENGTH} ${HEIGHT}`,
      preserveAspectRatio: "none",
      role: "img",
      "aria-label": `right for ${Math.round(100 * share)}% of it`,
    },
    svg("rect", { class: "strip-rail", x: 0, y: 0, width: LENGTH, height: HEIGHT }),
    ...lit.map(({ from, to }) =>
      svg("rect", { class: "strip-lit", x: LENGTH * from, y: 0, width: LENGTH * (to - from), height: HEIGHT }),
    ),
  );
}
