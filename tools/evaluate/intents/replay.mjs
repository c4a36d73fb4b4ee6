// A recorded movement on a page without a browser, watched by whither/dom itself, until the press that it ended in; beside it
// ForesightJS is given the same events and frames.
import { register } from "./foresight.mjs";
import { isInside } from "./tracks.mjs";

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
 * Replays one movement with each of the options at a time, on the same page.
 *
 * @param Page - `TestPage` of js/dom/testing.
 * @param core - Makes predictors.
 * @param withheld - Leaves the target that is pressed out of the page: whatever is intended then is false.
 * @param peers - Settings of ForesightJS.
 * @returns the movement's `{ entry, press }` from its first sample on, and for each of the options, then of the peers, what was intended,
 *   `[{ right, begin, end }]`: seconds from the first sample, `end` null where the press ended it; null for no approach.
 */
export async function replay(track, options, { Page, core, withheld, peers = [] }) {
  const approach = approachOf(track);
  if (!approach) return null;
  const page = new Page({ core });
  const elements = track.targets.map((box, i) => (withheld && i === track.target ? null : append(page, box)));
  const origin = track.samples[0][0];
  const watching = await watchEach(page, options);
  const called = register(page, track, elements, peers, () => secondsOf(page));
  const samples = track.samples.slice(0, approach.press + 1).map(([time, ...place]) => [time - origin, ...place]);
  move(page, samples);
  press(page, samples.at(-1));
  watching.stop();
  return {
    entry: samples[approach.entry][0],
    press: samples[approach.press][0],
    intents: [...watching.intents, ...called].map((each) => each.map((intent) => withRight(intent, elements[track.target]))),
  };
}

/** An intent, and whether it was of that element. */
export function withRight({ target, ...intent }, element) {
  return { right: target === element, ...intent };
}

/**
 * Watches the links of a page with each of the options; the watchers know nothing of one another.
 *
 * @returns for each of the options its `intents`, `[{ target, reason, begin, end }]` in seconds since everything was ready, to which those to
 *   come are appended, and what ends it.
 */
export async function watchEach(page, options) {
  const now = () => secondsOf(page);
  const watchers = options.map((own) => {
    const intents = [];
    const open = new Map();
    const watcher = page.watch("a", {
      ...own,
      load: "eager",
      decorate: false,
      onIntent({ target, reason }) {
        const intent = { target, reason, begin: now(), end: null };
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
  return {
    intents: watchers.map(({ intents }) => intents),
    stop() {
      for (const { watcher } of watchers) watcher.stop();
      if (page.errors.length > 0) throw page.errors[0];
    },
  };
}

/** Seconds since everything was ready. */
function secondsOf(page) {
  return (page.now() - BEFORE) / 1000;
}

/** Lets time pass until so many seconds after everything was ready. */
export function waitUntil(page, time) {
  page.clock.advanceTo(BEFORE + 1000 * time);
}

/** Moves the pointer through samples, whose times are seconds since everything was ready. */
export function move(page, samples) {
  for (const [time, x, y] of samples) {
    waitUntil(page, time);
    page.point("pointermove", x, y);
  }
}

/** Presses where a sample is, now. */
export function press(page, [, x, y]) {
  page.point("pointerdown", x, y);
}

/** Appends a link with a box of a recording. */
export function append(page, box) {
  return page.append("a", boundsOf(box));
}

/** A box of a recording, `[x, y, width, height]` about its centre, as a page has it. */
export function boundsOf([x, y, width, height]) {
  return { x: x - width / 2, y: y - height / 2, width, height };
}
