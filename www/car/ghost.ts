/**
 * While nobody moves, a ghost shows what the page is for: an arrow with a trail that moves slowly enough to be followed. Its
 * movements are pointer events of a type of their own, so that what follows them need not be what follows the visitor.
 */
import { hand, random, type Sample as HandSample } from "whither/testing";
import { observer, type Ride, type Sample } from "./devices.ts";
import type { Box, Point } from "./geometry.ts";
import { dispatch, ObservedEvent } from "./shaken.ts";
import type { Cursor } from "./view/cursor.ts";

/** The `pointerType` of its events. */
export const GHOST = "ghost";

/** Seconds without input before it appears, and before it comes back. */
const FIRST = 1;
const AGAIN = 15;

/** Seconds between arrival and press, and between press and the next movement. */
const DWELL = 0.35;
const PAUSE = 1;

/**
 * A slow and steady hand that can be followed, sampled like a common mouse, however seldom the page is drawn. What it goes to is a spot
 * beside the icon's drawing (px).
 */
const MANNER = { pace: 5.5, noise: 0.02, size: 6, rate: 100, resolution: 0, dwell: DWELL };

/** What it goes to is at least so many widths of an icon away. */
const FAR = 2.5;

/** The arrow points to the right of the icon's drawing, so that it does not hide it (shares of a box). */
const ASIDE = { from: 0.23, to: 0.26 };

export interface Stage {
  /** The icons' boxes, in px of the viewport. */
  targets(): readonly Box[];
  /** The corner of what the ghost is drawn in, in px of the viewport. */
  corner(): Point;
  /** Whether the screen is visible. */
  visible(): boolean;
  /** What it points with, and over which road. */
  ride(): Ride;
  enter(): void;
  /** It sets out for an icon. */
  heads(index: number): void;
  /** Whether it presses what it arrives at. */
  presses(): boolean;
  gone(): void;
}

/** Plays whenever nothing was heard of a visitor for a while, until the returned function is called. */
export function haunt(cursor: Cursor, stage: Stage): () => void {
  const controller = new AbortController();
  const observed = observer(2);
  // the same movements for everybody
  const next = random(21);
  let seed = 0;
  let frame = 0;
  let timer = 0;
  let due = performance.now() + FIRST * 1000;
  let place: Sample | null = null;

  const wait = () => {
    timer = window.setTimeout(
      () => {
        if (performance.now() < due || !stage.visible()) wait();
        else appear();
      },
      Math.max(100, due - performance.now()),
    );
  };

  const appear = () => {
    cursor.show(stage.ride().device);
    stage.enter();
    play(performance.now());
  };

  const vanish = () => {
    cancelAnimationFrame(frame);
    if (!cursor.visible) return;
    cursor.hide();
    place = null;
    stage.gone();
    wait();
  };

  const play = (set: number) => {
    const targets = stage.targets();
    const inView = targets.flatMap((target, index) => (isInView(target) ? [{ target, index }] : []));
    const from: Point = place ?? { x: stage.corner().x - 30, y: inView.at(-1)?.target.y ?? 0 };
    inView.sort((one, other) => away(from, other.target) - away(from, one.target));
    const far = inView.filter(({ target }) => away(from, target) > FAR * target.width);
    // where none is far, as on a phone, the farthest
    const { target, index } = (far.length > 0 ? far[Math.floor(next() * far.length)] : inView[0]) ?? {};
    if (index === undefined || !target) {
      vanish();
      return;
    }
    const aside = ASIDE.from + (ASIDE.to - ASIDE.from) * next();
    const aim = { x: target.x + aside * target.width, y: target.y + 0.1 * (next() - 0.5) * target.height };
    seed += 1;
    stage.heads(index);
    follow(hand({ x: from.x, y: from.y }, aim, { ...MANNER, seed }), set);
  };

  /** The last of the samples is the press. */
  const follow = (samples: readonly HandSample[], set: number) => {
    let sent = 0;
    let pressed = false;
    const [end = 0, x = 0, y = 0] = samples.at(-1) ?? [];
    const step = (now: number) => {
      const elapsed = (now - set) / 1000;
      const until = samples.findIndex(([time], index) => time > elapsed || index === samples.length - 1);
      const passed = samples.slice(sent, until).map(([time, x, y]) => ({ time: set / 1000 + time, x, y }));
      sent = until;
      place = passed.at(-1) ?? place;
      const reported = passed.flatMap((sample) => observed(sample, stage.ride()) ?? []);
      dispatch("pointermove", GHOST, reported);
      cursor.add(reported);
      cursor.draw(now / 1000, stage.corner());
      if (!pressed && elapsed > end) {
        pressed = true;
        const at = stage.presses() && observed({ time: now / 1000, x, y }, { ...stage.ride(), device: "mouse" });
        if (at) dispatch("pointerdown", GHOST, [at]);
      } else if (elapsed > end + PAUSE) {
        play(now);
        return;
      }
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  };

  const input = (event: Event) => {
    if (event instanceof ObservedEvent) return;
    due = performance.now() + AGAIN * 1000;
    vanish();
  };
  for (const type of ["pointermove", "pointerdown", "keydown", "wheel", "touchstart"]) {
    addEventListener(type, input, { signal: controller.signal, passive: true, capture: true });
  }
  wait();
  return () => {
    controller.abort();
    vanish();
    clearTimeout(timer);
  };
}

/** Whether there is an icon where a box has its middle, and nothing over it. */
function isInView({ x, y }: Box): boolean {
  return document.elementFromPoint(x, y)?.closest("button") != null;
}

function away(from: Point, to: Point): number {
  return Math.hypot(to.x - from.x, to.y - from.y);
}
