// Menus laid around recorded movements: where the trigger, its siblings and the panel would have been. What is not stated by the
// movement is drawn by the track's id, the same in every run.
import { randomOf } from "../intents/random.mjs";
import { approachOf } from "../intents/replay.mjs";
import { isInside } from "../intents/tracks.mjs";

/** Kinds of scenes: the movement goes into the panel, to a sibling of the trigger, or elsewhere. */
export const KINDS = ["panel", "sibling", "away"];

/** The height of an item, and the least width of a column of them; the width of an item of a bar; the least size of a panel (px). */
const ITEM = { height: 32, width: 180 };
const BAR = { width: 110, height: 40 };
const PANEL = { width: 200, height: 6 * ITEM.height };

/** From the trigger's edge to the panel (px); and how far panels are that are far. */
const GAP = 2;
const FAR = [40, 120];

/** How much farther a panel goes on than the place that is pressed in it, at least (px). */
const BEYOND = 24;

/** A tall panel reaches so far above and below its trigger (px). */
const TALL = 280;

/** Siblings at most on either side of the trigger where the movement does not ask for more. */
const SIBLINGS = 5;

/**
 * Lays a scene of a kind around a track; null where it has no approach, or cannot be of that kind.
 *
 * The movement begins in the trigger, at a drawn place of it, with the panel open. Menus are columns where it goes mostly sideways for
 * `panel` and mostly up or down for `sibling`, else bars. A panel is on the side of its trigger that the movement goes to for `panel`, and
 * holds the place that is pressed; a third each are beside the trigger and aligned with it, far from it, and tall. For `sibling` the menu
 * goes on to an item that holds the place that is pressed, with the panel at either side. For `away` there are no siblings, and the panel is
 * on another side than the one that the movement goes to.
 *
 * @returns `{ kind, shape, side, trigger, panel, siblings, samples, arrival }`: boxes `[x, y, width, height]` about their centres as those of
 *   tracks, seconds from the first sample, `arrival` when the pointer comes to where it is pressed: in the panel, the sibling, or the
 *   recorded target.
 */
export function sceneOf(track, kind) {
  const approach = approachOf(track);
  if (!approach) return null;
  const [origin] = track.samples[0];
  const samples = track.samples.slice(0, approach.press + 1).map(([time, ...place]) => [time - origin, ...place]);
  const random = randomOf(`${track.id} ${kind}`);
  const scene = LAY[kind](samples, random);
  if (!scene || !isInside(samples[0], scene.trigger)) return null;
  const at = (box) => samples.findIndex((sample) => isInside(sample, box));
  const into = at(scene.panel);
  // what crosses the panel on its way elsewhere may keep it
  if ((kind === "panel") !== into >= 0) return null;
  const goal = scene.siblings.find((box) => isInside(samples.at(-1), box));
  const arrival = { panel: into, sibling: goal ? lastEntry(samples, goal) : -1, away: approach.entry }[kind];
  const left = samples.findIndex((sample) => !isInside(sample, scene.trigger));
  // where it is there as soon as it is off the trigger there is nothing to decide
  return left > 0 && arrival > left ? { kind, samples, ...scene, arrival: samples[arrival][0] } : null;
}

const LAY = { panel: layPanel, sibling: laySibling, away: layAway };

function layPanel(samples, random) {
  const { across, along, place } = axes(samples, (x, y) => Math.abs(x) >= Math.abs(y));
  const shape = ["aligned", "far", "tall"][Math.floor(3 * random())];
  const reach = Math.abs(across.by);
  const item = across.x ? [ITEM.width, ITEM.height] : [BAR.height, BAR.width];
  const gap = shape === "far" ? between(FAR, random()) : GAP;
  // how far the pointer goes on inside the trigger
  const inside = between([6, Math.min(item[0] - 6, 0.6 * reach)], random());
  const depth = reach - inside - gap;
  if (depth < BEYOND) return null;
  const offset = between([0.15, 0.85], random()) * item[1];
  const edge = { trigger: inside, panel: inside + gap };
  const width = Math.max(across.x ? PANEL.width : PANEL.height, depth + BEYOND);
  const [low, high] = [-offset, item[1] - offset];
  const least = across.x ? PANEL.height : PANEL.width;
  let panel = [low, low + Math.max(least, along.by - low + BEYOND)];
  if (shape === "tall") panel = [Math.min(low - TALL, along.by - BEYOND), Math.max(high + TALL, along.by + BEYOND)];
  // aligned with the other edge, as where there is no room
  else if (along.by < low) panel = [Math.min(high - least, along.by - BEYOND), high];
  const siblings = neighbours(SIBLINGS, SIBLINGS, item, [edge.trigger - item[0], low]);
  return {
    shape,
    side: across.side,
    trigger: place([edge.trigger - item[0], edge.trigger], [low, high]),
    panel: place([edge.panel, edge.panel + width], panel),
    siblings: siblings.map(([a, b]) => place(a, b)),
  };
}

function laySibling(samples, random) {
  const { across, along, place } = axes(samples, (x, y) => Math.abs(x) < Math.abs(y), random);
  const reach = Math.abs(across.by);
  const [least, size] = across.x ? [ITEM.width, ITEM.height] : [BAR.height, BAR.width];
  const breadth = Math.max(least, reach + 40);
  const left = Math.min(0, across.by) - between([20, breadth - reach - 20], random());
  const offset = between([0.15, 0.85], random()) * size;
  const count = Math.ceil(Math.abs(along.by) / size) + 1;
  const [before, after] = along.by < 0 ? [count, SIBLINGS] : [SIBLINGS, count];
  const far = random() < 0.25 ? between(FAR, random()) : GAP;
  const edge = left + breadth + far;
  const panel = across.x ? [PANEL.width, PANEL.height] : [PANEL.height, PANEL.width];
  const top = random() < 0.5 ? -offset : size - offset - panel[1];
  return {
    shape: far === GAP ? "aligned" : "far",
    side: across.side,
    trigger: place([left, left + breadth], [-offset, size - offset]),
    panel: place([edge, edge + panel[0]], [top, top + panel[1]]),
    siblings: neighbours(before, after, [breadth, size], [left, -offset]).map(([a, b]) => place(a, b)),
  };
}

function layAway(samples, random) {
  // behind, or to one side of where the movement goes
  const behind = random() < 0.5;
  const { across, place } = axes(samples, (x, y) => Math.abs(x) >= Math.abs(y) === behind, behind ? () => -1 : random);
  const item = across.x ? [ITEM.width, ITEM.height] : [BAR.height, BAR.width];
  const offset = between([0.15, 0.85], random()) * item[1];
  const inside = between([6, item[0] - 6], random());
  const panel = across.x ? [PANEL.width, PANEL.height] : [PANEL.height, PANEL.width];
  return {
    shape: behind ? "behind" : "aside",
    side: across.side,
    trigger: place([inside - item[0], inside], [-offset, item[1] - offset]),
    panel: place([inside + GAP, inside + GAP + panel[0]], [-offset, -offset + panel[1]]),
    siblings: [],
  };
}

/**
 * Coordinates from the start of a movement: `across` from the trigger to its panel, `along` the menu.
 *
 * @param sideways - Whether the panel is left or right of the trigger, of the displacement in x and y.
 * @param random - On which of two sides it is; a negative number: not the movement's. Left out: the movement's.
 */
function axes(samples, sideways, random) {
  const [, startX, startY] = samples[0];
  const [, endX, endY] = samples.at(-1);
  const [x, y] = [endX - startX, endY - startY];
  const horizontal = sideways(x, y);
  const drawn = random?.();
  const ahead = Math.sign(horizontal ? x : y) || 1;
  const sign = drawn === undefined ? ahead : drawn < 0 ? -ahead : drawn < 0.5 ? 1 : -1;
  const place = (across, along) => {
    const a = across.map((value) => sign * value);
    const [across0, along0] = [(a[0] + a[1]) / 2, (along[0] + along[1]) / 2];
    const [width, height] = [Math.abs(a[1] - a[0]), along[1] - along[0]];
    return horizontal ? [startX + across0, startY + along0, width, height] : [startX + along0, startY + across0, height, width];
  };
  return {
    across: { x: horizontal, by: sign * (horizontal ? x : y), side: SIDES[horizontal][sign] },
    along: { by: horizontal ? y : x },
    place,
  };
}

const SIDES = { true: { 1: "right", "-1": "left" }, false: { 1: "bottom", "-1": "top" } };

/** The items before and after one, each of its size: `[[left, right], [top, bottom]]`. */
function neighbours(before, after, [width, height], [left, top]) {
  const all = [];
  for (let i = -before; i <= after; i++) {
    if (i !== 0)
      all.push([
        [left, left + width],
        [top + i * height, top + (i + 1) * height],
      ]);
  }
  return all;
}

/** When the pointer came to where it stayed. */
function lastEntry(samples, box) {
  return samples.findLastIndex((sample) => !isInside(sample, box)) + 1;
}

function between([from, to], share) {
  return from + share * (to - from);
}
