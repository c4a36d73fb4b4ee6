/** The trail of the ghost: as wide as the pointer was near in time. */
import type { Point } from "../geometry.ts";

/** The outline of a tail that narrows to a point, as the `d` of an SVG path: from the oldest place to the newest, `width` px wide there. */
export function trail(places: readonly Point[], width: number): string {
  if (places.length < 2) return "";
  const sides = places.map((place, index) => {
    const before = places[Math.max(0, index - 1)] ?? place;
    const after = places[Math.min(places.length - 1, index + 1)] ?? place;
    const length = Math.hypot(after.x - before.x, after.y - before.y) || 1;
    const half = (width / 2) * (index / (places.length - 1));
    const [across, down] = [(-half * (after.y - before.y)) / length, (half * (after.x - before.x)) / length];
    return {
      left: `${round(place.x + across)} ${round(place.y + down)}`,
      right: `${round(place.x - across)} ${round(place.y - down)}`,
    };
  });
  return `M${[...sides.map((side) => side.left), ...sides.map((side) => side.right).reverse()].join("L")}Z`;
}

function round(length: number): number {
  return Math.round(length * 10) / 10;
}
