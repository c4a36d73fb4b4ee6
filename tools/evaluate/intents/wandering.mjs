// Pages are wandered over more than they are pressed: a user's movements in one stream, of which only some lead to a target.
import { judge } from "./figures.mjs";
import { randomOf } from "./random.mjs";
import { append, approachOf, boundsOf, move, press, waitUntil, watchEach, withRight } from "./replay.mjs";
import { isInside } from "./tracks.mjs";

/** Shares of the movements that lead to nothing on the page. */
export const SHARES = [0.5, 0.8];

/** Seconds between movements, from and to: every ratio is as likely. Some are shorter than the rest that ends a movement. */
const PAUSES = [0.1, 2];

/** So many seconds before a movement what it can lead to appears, or when the last one has ended. */
const APPEARING = 0.1;

/**
 * Chains a user's tracks: each begins where the last one came to, after a pause, and its targets move with it.
 *
 * @returns the movements `{ targets, target, samples, entry, press, begin, end, draw }`: seconds of the stream, `end` is the next one's
 *   begin, `draw` a number from 0 to 1 by which movements are chosen; tracks without an approach are left out.
 */
export function chain(tracks, user) {
  const random = randomOf(String(user));
  const movements = [];
  let [time, x, y] = [0, 0, 0];
  for (const track of tracks) {
    const approach = approachOf(track);
    const draw = random();
    const pause = PAUSES[0] * (PAUSES[1] / PAUSES[0]) ** random();
    if (!approach) continue;
    const [[t0, x0, y0]] = track.samples;
    const [begin, right, down] = [time, x - x0, y - y0];
    const samples = track.samples.slice(0, approach.press + 1).map(([t, sx, sy]) => [begin + t - t0, sx + right, sy + down]);
    const targets = track.targets.map(([tx, ty, ...size]) => [tx + right, ty + down, ...size]);
    const entry = samples[approach.entry][0];
    const last = samples.at(-1);
    const end = last[0] + pause;
    movements.push({ targets, target: track.target, samples, entry, press: last[0], begin, end, draw });
    [time, x, y] = [end, last[1], last[2]];
  }
  return movements;
}

/**
 * What a movement can lead to, in place of what was `before`. Where it begins there is what was pressed there last, or nothing: who has
 * wandered has come to rest between the links. Returns an element for each of the targets, or null.
 */
function layOut(page, { targets, target, samples }, { wanders, pressed, before }) {
  const under = targets.findIndex((box) => isInside(samples[0], box));
  const kept = under >= 0 && !(wanders && under === target) ? pressed : null;
  for (const element of before) if (element && element !== kept) page.remove(element);
  return targets.map((box, i) => {
    if (wanders && i === target) return null;
    if (i === under && kept) return Object.assign(kept, { box: boundsOf(box) });
    return i === target || !isInside(samples[0], box) ? append(page, box) : null;
  });
}

/**
 * Replays a stream of which such a share wanders, the movements with the least draws: what one of these leads to is not on the page, and
 * it ends without a press.
 *
 * @returns for each movement `{ wanders, seconds, scores }`: its seconds with the pause after it, and for each of the options what `judge`
 *   returns for its intents, with those after the press among the wrong ones; where it wanders `{ wrong }`, how many there were.
 */
export async function replayStream(movements, share, options, { Page, core }) {
  const page = new Page({ core });
  const watching = await watchEach(page, options);
  const played = [];
  let elements = [];
  let pressed = null;
  let from = 0;
  for (const movement of movements) {
    const { target, samples } = movement;
    const wanders = movement.draw < share;
    const to = Math.max(movement.press, movement.end - APPEARING);
    elements = layOut(page, movement, { wanders, pressed, before: elements });
    move(page, samples);
    if (!wanders) press(page, samples.at(-1));
    waitUntil(page, to);
    pressed = elements[target];
    played.push({ movement, wanders, element: pressed, from, to });
    from = to;
  }
  watching.stop();
  return played.map(({ movement, wanders, element, from, to }) => ({
    wanders,
    seconds: movement.end - movement.begin,
    scores: watching.intents.map((all) => {
      const own = all.filter(({ begin }) => begin >= from && begin < to);
      if (wanders) return { wrong: own.length };
      const intents = own.map((intent) => withRight(intent, element));
      const after = intents.filter(({ right, begin }) => begin >= movement.press && !right).length;
      const judged = judge(movement, intents);
      return { ...judged, wrong: judged.wrong + after };
    }),
  }));
}
