/** After four idle seconds a ghost shows what the page is for, until somebody touches it. */
import { reach, seeded, type Hand, type Point } from "./movement/hand.ts";
import type { Sample } from "./movement/segmenter.ts";

/** Seconds: before the ghost appears, between arrival and press, between press and the next movement. */
const IDLE = 4;
const DWELL = 0.18;
const PAUSE = 1.4;

/** The ghost is sampled like a common mouse, however seldom the page is drawn (seconds). */
const SAMPLING = 0.01;

export interface Stage {
  /** The middles of the icons and their size, in px from the screen's corner. */
  targets(): readonly { readonly x: number; readonly y: number; readonly width: number; readonly height: number }[];
  move(sample: Sample): void;
  press(index: number, sample: Sample): void;
  gone(): void;
}

/** Waits, plays, and stops for good at the first input or when the returned function is called. */
export function haunt(element: HTMLElement, stage: Stage): () => void {
  const controller = new AbortController();
  const random = seeded(21);
  let frame = 0;
  let last: Point | null = null;

  const stop = () => {
    if (controller.signal.aborted) return;
    controller.abort();
    clearTimeout(timer);
    cancelAnimationFrame(frame);
    if (!element.hidden) stage.gone();
    element.hidden = true;
  };

  const at = (point: Point, time: number): Sample => {
    last = point;
    element.style.transform = `translate(${point.x}px, ${point.y}px)`;
    return { time, x: point.x, y: point.y };
  };

  const play = (set: number) => {
    const targets = stage.targets();
    const from = last ?? { x: (targets[0]?.x ?? 0) - 30, y: targets.at(-1)?.y ?? 0 };
    const far = targets.map((_, index) => index).filter((index) => away(from, targets[index]) > 2.5 * (targets[index]?.width ?? 0));
    const index = far[Math.floor(random() * far.length)] ?? 0;
    const target = targets[index];
    if (!target) return;
    const aim = { x: target.x + (random() - 0.5) * target.width * 0.3, y: target.y + (random() - 0.5) * target.height * 0.3 };
    const hand = reach(from, aim, Math.min(target.width, target.height), random);
    follow(hand, index, set);
  };

  const follow = (hand: Hand, index: number, set: number) => {
    let sampled = 0;
    let pressed = false;
    const step = (now: number) => {
      const elapsed = (now - set) / 1000;
      for (; sampled <= Math.min(elapsed, hand.duration); sampled += SAMPLING) stage.move(at(hand.at(sampled), set / 1000 + sampled));
      if (!pressed && elapsed > hand.duration + DWELL) {
        pressed = true;
        stage.press(index, at(hand.at(hand.duration), now / 1000));
      } else if (elapsed > hand.duration + DWELL + PAUSE) {
        play(now);
        return;
      }
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  };

  const timer = setTimeout(() => {
    element.hidden = false;
    play(performance.now());
  }, IDLE * 1000);
  for (const type of ["pointermove", "pointerdown", "keydown", "wheel", "touchstart"]) {
    addEventListener(type, stop, { signal: controller.signal, passive: true, capture: true });
  }
  return stop;
}

function away(from: Point, target: Point | undefined): number {
  return target ? Math.hypot(target.x - from.x, target.y - from.y) : 0;
}
