// A recorded movement on a page without a browser, watched by whither/dom itself, until the press that it ended in.

/** Milliseconds on the page's clock before the first sample: what is watched has been read by then. */
const BEFORE = 100;

/**
 * What a movement led to: the samples until the last one in its target, where it is pressed, and the sample with which the pointer
 * came there. Null where it never did, or began there.
 */
export function approachOf({ targets, target, samples }) {
  const within = samples.map((sample) => isInside(sample, targets[target]));
  const press = within.lastIndexOf(true);
  const entry = within.lastIndexOf(false, press) + 1;
  return press < 0 || entry === 0 ? null : { press, entry };
}

/**
 * Replays one movement with each of the options at a time, on the same page: the watchers know nothing of one another.
 *
 * @param Page - `TestPage` of js/dom/testing.
 * @param core - Makes predictors.
 * @param withheld - Leaves the target that is pressed out of the page: whatever is intended then is false.
 * @returns the movement's `{ seconds, entry, press }` from its first sample on, and for each of the options what was intended,
 *   `[{ right, reason, begin, end }]`: seconds from the first sample, `end` null where the press ended it; null for no approach.
 */
export async function replay(track, options, { Page, core, withheld }) {
  const approach = approachOf(track);
  if (!approach) return null;
  const page = new Page({ core });
  const elements = track.targets.map((box, i) => (withheld && i === track.target ? null : page.append("a", boundsOf(box))));
  const origin = track.samples[0][0];
  const onPage = (time) => BEFORE + 1000 * (time - origin);
  const watchers = options.map((own) => {
    const intents = [];
    const open = new Map();
    const now = () => (page.now() - BEFORE) / 1000;
    const watcher = page.watch("a", {
      ...own,
      load: "eager",
      decorate: false,
      onIntent({ target, reason }) {
        const intent = { right: target === elements[track.target], reason, begin: now(), end: null };
        intents.push(intent);
        open.set(target, intent);
      },
      onRelease({ target, pressed }) {
        if (!pressed) open.get(target).end = now();
      },
      onError(error) {
        throw error;
      },
    });
    return { watcher, intents };
  });
  await Promise.all(watchers.map(({ watcher }) => watcher.ready));
  for (const [time, x, y] of track.samples.slice(0, approach.press + 1)) {
    page.clock.advanceTo(onPage(time));
    page.point("pointermove", x, y);
  }
  const [, x, y] = track.samples[approach.press];
  page.point("pointerdown", x, y);
  for (const { watcher } of watchers) watcher.stop();
  if (page.errors.length > 0) throw page.errors[0];
  const since = (place) => track.samples[place][0] - origin;
  return { entry: since(approach.entry), press: since(approach.press), intents: watchers.map(({ intents }) => intents) };
}

function isInside([, x, y], [centerX, centerY, width, height]) {
  return Math.abs(x - centerX) <= width / 2 && Math.abs(y - centerY) <= height / 2;
}

function boundsOf([x, y, width, height]) {
  return { x: x - width / 2, y: y - height / 2, width, height };
}
