/**
 * Movements as events, in a page or in jsdom.
 *
 * @module
 */
import { isAbsent, number, positive, refuse, text } from "../core/read.js";
import { eventsOf, type Init } from "./events.js";
import type { Sample } from "./hand.js";
import { type Beat, type PlayOptions, play, readPlay, readSamples } from "./play.js";

/** How events are dispatched; all have defaults. */
export interface DispatchOptions extends PlayOptions {
  /** Events a second at most, each with the samples since the last one as its coalesced events. @defaultValue 60 */
  readonly frames?: number | undefined;
  /** The `pointerType` of a pointer that hovers. @defaultValue "mouse" */
  readonly pointerType?: string | undefined;
  /** Its `pointerId`. @defaultValue 1 */
  readonly pointerId?: number | undefined;
  /** When the movement begins on the clock of the page's events, milliseconds. @defaultValue `performance.now()` */
  readonly start?: number | undefined;
  /**
   * What is under the pointer at a place; null: nothing of this page. @defaultValue an element that is given as target; of a document or a
   * shadow root what its `elementFromPoint` returns, in open shadow roots too, and in jsdom, which has no such method, the last element
   * whose `getBoundingClientRect()` has the place in it
   */
  readonly hit?: ((x: number, y: number) => Element | null) | undefined;
}

/** The element under each pointer, so that a movement begins where the one before has ended. */
let hovered: WeakMap<Document, Map<number, Element>> | undefined;

/**
 * Dispatches a movement as a mouse's events, each at its time, and is fulfilled when the last was dispatched: `pointermove` with coalesced
 * events, and `pointerover`, `pointerenter`, `pointerout`, `pointerleave` where what is under the pointer changes, all with the time stamps
 * of their samples, and the mouse events that belong to them; with `press` then `pointerdown`, `pointerup` and `click`. They are not trusted
 * events: `:hover` and the focus stay as they are.
 *
 * @param target - A document or a shadow root, of which the element under the pointer is given the events, or an element that is given all.
 * @param samples - What {@link hand} returns, or recorded ones: `[seconds, x, y]`, px in the viewport.
 * @param options - Whether it presses, how time passes, what pointer it is.
 * @throws {@link WhitherError} (as a rejection) `missing-key`, `unknown-key`, `wrong-type`, `wrong-length`, `not-finite`, `out-of-range`,
 * `time-not-increasing`, with the path of what is wrong, before any event.
 *
 * @example
 * ```ts
 * import { dispatch, hand } from "whither/testing";
 *
 * const link = document.querySelector("nav a")!;
 * await dispatch(document, hand({ x: 400, y: 500 }, link.getBoundingClientRect(), { seed: 1 }), { press: true });
 * ```
 */
export async function dispatch(
  target: Element | Document | ShadowRoot,
  samples: readonly Sample[],
  options: DispatchOptions = {},
): Promise<void> {
  const page = documentOf(target);
  const [settings, more] = readPlay(options, ["frames", "pointerType", "pointerId", "start", "hit"]);
  const frames = isAbsent(more["frames"]) ? 60 : positive(more["frames"], "frames");
  const pointerType = isAbsent(more["pointerType"]) ? "mouse" : text(more["pointerType"], "pointerType");
  const pointerId = isAbsent(more["pointerId"]) ? 1 : number(more["pointerId"], "pointerId");
  const { hit = hits(target) } = more as DispatchOptions;
  if (typeof hit !== "function") refuse("wrong-type", "hit", "must be a function", hit);
  const all = readSamples(samples);
  const [begin] = all[0] as Sample;
  const start = isAbsent(more["start"]) ? performance.now() : number(more["start"], "start");

  const stamp = ([time, x, y]: Sample) => ({ time: start + 1000 * (time - begin), x, y });
  const emit = eventsOf(page, pointerType, pointerId);
  hovered ??= new WeakMap();
  const under = hovered.get(page) ?? new Map<number, Element>();
  hovered.set(page, under);
  let place: Sample | undefined;

  const wait = await play(byFrame(all, frames), settings, (due) => {
    const moved = due.filter((sample, index) => differs(sample, due[index - 1] ?? place));
    const last = moved.at(-1);
    if (!last) return;
    place = last;
    const element = hit(last[1], last[2]);
    const init: Init = { ...stamp(last), coalesced: moved.map(stamp) };
    emit.move(under.get(pointerId) ?? null, element, init);
    if (element) under.set(pointerId, element);
    else under.delete(pointerId);
  });
  if (!settings.press) return;
  const [end, x, y] = all.at(-1) as Sample;
  const down = hit(x, y);
  const compatible = !down || emit.down(down, stamp([end, x, y]));
  const release = end - begin + settings.hold;
  await wait(release);
  emit.up(down, hit(x, y), stamp([begin + release, x, y]), compatible);
}

function differs([, x, y]: Sample, before: Sample | undefined): boolean {
  return !before || x !== before[1] || y !== before[2];
}

/** The samples of each frame, at the time of the last of them. */
function byFrame(samples: readonly Sample[], frames: number): Beat[] {
  const [begin] = samples[0] as Sample;
  const beats: { frame: number; time: number; samples: Sample[] }[] = [];
  for (const sample of samples) {
    const time = sample[0] - begin;
    const frame = Math.ceil(time * frames - 1e-9);
    const last = beats.at(-1);
    if (last?.frame === frame) {
      last.time = time;
      last.samples.push(sample);
    } else beats.push({ frame, time, samples: [sample] });
  }
  return beats;
}

function documentOf(target: Element | Document | ShadowRoot): Document {
  const node = target as Partial<Node> | null | undefined;
  if (typeof node?.dispatchEvent !== "function" || node.nodeType === undefined)
    refuse("wrong-type", "target", "must be an element, a document or a shadow root", target);
  return node.ownerDocument ?? (target as Document);
}

/** What is under a place of a target. */
function hits(target: Element | Document | ShadowRoot): (x: number, y: number) => Element | null {
  if ("matches" in target) return () => target;
  return (x, y) => {
    if (typeof target.elementFromPoint !== "function") return boxAt(target, x, y);
    let found = target.elementFromPoint(x, y);
    for (;;) {
      const inner = found?.shadowRoot?.elementFromPoint(x, y);
      if (!inner || inner === found) return found;
      found = inner;
    }
  };
}

/** The last element in the order of the document that has the place in its box; where none has, the document's own. */
function boxAt(target: Document | ShadowRoot, x: number, y: number): Element | null {
  const all = Array.from(target.querySelectorAll("*")).reverse();
  const found = all.find((element) => {
    const { left, top, right, bottom } = element.getBoundingClientRect();
    return x >= left && x < right && y >= top && y < bottom;
  });
  return found ?? ("host" in target ? target.host : target.documentElement);
}
