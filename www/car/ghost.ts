/**
 * While nobody moves, a ghost shows what the page is for: an arrow with a trail that moves slowly enough to be followed. Its
 * movements are pointer events of a type of their own, so that what follows them need not be what follows the visitor.
 */
import { hand, random, type Sample as HandSample } from "whither/testing";
import type { Box, Point } from "./geometry.ts";
import { trail } from "./view/trail.ts";

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

/** Seconds and px that the trail is long and wide. */
const TRAIL = 0.45;
const TRAIL_WIDTH = 7;

/** The arrow points to the right of the icon's drawing, so that it does not hide it (shares of a box). */
const ASIDE = { from: 0.23, to: 0.26 };

/** Seconds on the page's clock, and px of the viewport. */
interface Sample extends Point {
  readonly time: number;
}

export interface Stage {
  /** The icons' boxes, in px of the viewport. */
  targets(): readonly Box[];
  /** The corner of what the ghost is drawn in, in px of the viewport. */
  corner(): Point;
  /** Whether the screen is visible. */
  visible(): boolean;
  enter(): void;
  gone(): void;
}

export interface GhostParts {
  readonly root: HTMLElement;
  readonly arrow: SVGElement;
  readonly trail: SVGElement;
}

/** An event of the ghost, at the moment that its sample is of. */
class GhostEvent extends PointerEvent {
  override readonly timeStamp: number;

  constructor(type: "pointermove" | "pointerdown", { time, x, y }: Sample) {
    const button = type === "pointerdown" ? 0 : -1;
    super(type, { pointerType: GHOST, pointerId: -1, clientX: x, clientY: y, button, bubbles: true, composed: true });
    this.timeStamp = time * 1000;
  }
}

/** Plays whenever nothing was heard of a visitor for a while, until the returned function is called. */
export function haunt(parts: GhostParts, stage: Stage): () => void {
  const controller = new AbortController();
  // the same movements for everybody
  const next = random(21);
  let seed = 0;
  let frame = 0;
  let timer = 0;
  let due = performance.now() + FIRST * 1000;
  let places: Sample[] = [];

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
    parts.root.hidden = false;
    stage.enter();
    play(performance.now());
  };

  const vanish = () => {
    cancelAnimationFrame(frame);
    if (parts.root.hidden) return;
    parts.root.hidden = true;
    places = [];
    stage.gone();
    wait();
  };

  const show = (now: number) => {
    const head = places.at(-1);
    if (!head) return;
    const corner = stage.corner();
    const inside = ({ x, y }: Point) => ({ x: x - corner.x, y: y - corner.y });
    const { x, y } = inside(head);
    places = places.filter((place) => now - place.time <= TRAIL);
    if (places.length === 0) places = [head];
    parts.arrow.style.transform = `translate(${x}px, ${y}px)`;
    parts.trail.setAttribute("d", trail(places.map(inside), TRAIL_WIDTH));
  };

  const play = (set: number) => {
    const targets = stage.targets();
    const from = places.at(-1) ?? { x: stage.corner().x - 30, y: targets.at(-1)?.y ?? 0 };
    const far = targets
      .map((_, index) => index)
      .filter((index) => away(from, targets[index]) > 2.5 * (targets[index]?.width ?? 0));
    const target = targets[far[Math.floor(next() * far.length)] ?? 0];
    if (!target || !stage.visible()) {
      vanish();
      return;
    }
    const aside = ASIDE.from + (ASIDE.to - ASIDE.from) * next();
    const aim = { x: target.x + aside * target.width, y: target.y + 0.1 * (next() - 0.5) * target.height };
    seed += 1;
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
      dispatch("pointermove", passed);
      places.push(...passed);
      show(now / 1000);
      if (!pressed && elapsed > end) {
        pressed = true;
        dispatch("pointerdown", [{ time: now / 1000, x, y }]);
      } else if (elapsed > end + PAUSE) {
        play(now);
        return;
      }
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  };

  const input = (event: Event) => {
    if (event instanceof GhostEvent) return;
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

/** Dispatches events where the last sample is. */
function dispatch(type: "pointermove" | "pointerdown", samples: readonly Sample[]): void {
  const last = samples.at(-1);
  if (!last) return;
  const target = document.elementFromPoint(last.x, last.y) ?? document.documentElement;
  for (const sample of samples) target.dispatchEvent(new GhostEvent(type, sample));
}

function away(from: Point, target: Point | undefined): number {
  return target ? Math.hypot(target.x - from.x, target.y - from.y) : 0;
}
