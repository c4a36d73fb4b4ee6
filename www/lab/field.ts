/** The field: targets, one of which is asked for, a pointer that goes there and presses, and where it has been. */
import { LAYOUTS, nextTarget, targetsOf, type Layout } from "./layouts.ts";
import { contains, places, type Box, type Movement, type Place, type Sample } from "./movement.ts";
import { coloured, mappingOf } from "./path.ts";
import { Recorder, type Recording } from "./recorder.ts";
import { points, svg, targetShape } from "./svg.ts";
import type { Trace } from "./tally.ts";

export { LAYOUTS, type Layout };

export interface FieldParts {
  readonly field: HTMLElement;
  readonly drawing: SVGSVGElement;
  /** What a finger drags. */
  readonly handle: HTMLElement;
}

/** What the field reports. */
export interface FieldEvents {
  /** The asked target was pressed, after this movement; null where there was none. */
  pressed(press: { readonly targets: readonly Box[]; readonly target: number; readonly recording: Recording | null }): void;
  /** Something else was pressed, or a finger was lifted beside it. */
  missed(by: "press" | "lift" | "tap"): void;
  /** At most once a frame: the samples of the movement so far; none where it is over. */
  moved(samples: readonly Sample[]): void;
}

/** Movements that stay drawn. */
const DRAWN = 60;

export class Field {
  readonly #parts: FieldParts;
  readonly #events: FieldEvents;
  readonly #recorder = new Recorder();
  readonly #layers = {
    paths: svg("g", { class: "paths" }),
    targets: svg("g", { class: "targets" }),
    last: svg("g", {}),
    trail: svg("polyline", { class: "trail" }),
    arrow: svg("path", { class: "arrow", d: "M0 0v17.5l4-3.7 2.7 6 2.7-1.2-2.6-5.8 5.6-.3z", visibility: "hidden" }),
  };
  #layout: Layout = "ring";
  #targets: readonly Box[] = [];
  /** As they are drawn. */
  #shapes: readonly SVGElement[] = [];
  #asked = 0;
  /** The target that was pressed before. */
  #before = 0;
  #corner: Place = [0, 0];
  #frame = 0;
  /** The pointer that drags the handle, and from where. */
  #dragged: { readonly id: number; readonly offset: Place } | null = null;

  constructor(parts: FieldParts, events: FieldEvents) {
    this.#parts = parts;
    this.#events = events;
    const { paths, targets, last, trail, arrow } = this.#layers;
    parts.drawing.append(paths, targets, last, trail, arrow);
    this.#begin();
    this.#listen();
  }

  get layout(): Layout {
    return this.#layout;
  }

  set layout(layout: Layout) {
    this.#layout = layout;
    this.#begin();
  }

  get targets(): readonly Box[] {
    return this.#targets;
  }

  /** The target that is to be pressed. */
  get asked(): number {
    return this.#asked;
  }

  /** The target on which the next movement begins. */
  get from(): number {
    return this.#before;
  }

  /** After a change of size; whether it was one. */
  fit(): boolean {
    const { clientWidth, clientHeight } = this.#parts.field;
    if (this.#parts.drawing.getAttribute("viewBox") === `0 0 ${clientWidth} ${clientHeight}`) return false;
    this.#begin();
    return true;
  }

  /** Where movements have gone, and the last of them lit where the right target was on top. */
  drawPaths(movements: readonly Movement[], last: { readonly movement: Movement; readonly trace: Trace } | null): void {
    const { paths, last: layer } = this.#layers;
    const drawn = movements.slice(-DRAWN).flatMap((movement) => {
      const mapping = movement.id === last?.movement.id ? null : mappingOf(movement.targets, this.#targets);
      return mapping ? [svg("polyline", { class: "path", points: points(places(movement).map(mapping)) })] : [];
    });
    paths.replaceChildren(...drawn);
    const mapping = last && mappingOf(last.movement.targets, this.#targets);
    layer.replaceChildren(
      ...(last && mapping ? [coloured(last.movement, last.trace.tops.pointing ?? [], last.trace.selected, mapping)] : []),
    );
  }

  /** Another hand's pointer, after these samples; it is nowhere without one. */
  showArrow(samples: readonly Sample[]): void {
    const { arrow, trail } = this.#layers;
    const path = places({ samples });
    const [x, y] = path.at(-1) ?? [0, 0];
    arrow.setAttribute("visibility", path.length > 0 ? "visible" : "hidden");
    arrow.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
    trail.setAttribute("points", points(path));
  }

  /** Lights each target as much as it is probable; without probabilities none. */
  light(probabilities: ArrayLike<number> | null): void {
    this.#shapes.forEach((shape, k) => shape.style.setProperty("--probability", (probabilities?.[k] ?? 0).toFixed(3)));
  }

  /** Another hand has pressed this target, and goes to the next. */
  goOn(target: number, next: number): void {
    this.#before = target;
    this.#asked = next;
    this.#showTargets();
  }

  #begin(): void {
    const { field, drawing } = this.#parts;
    const { clientWidth: width, clientHeight: height } = field;
    drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.#targets = targetsOf(this.#layout, width, height);
    this.#before = 0;
    this.#asked = nextTarget(this.#layout, 0, this.#targets.length, Math.random);
    this.#recorder.clear();
    this.#dragged = null;
    this.#showTargets();
  }

  #showTargets(): void {
    const round = this.#layout === "ring";
    this.#shapes = this.#targets.map((box, k) =>
      targetShape(box, round, k === this.#asked ? "target asked" : k === this.#before ? "target before" : "target"),
    );
    const [x, y] = this.#targets[this.#asked] ?? [0, 0];
    this.#layers.targets.replaceChildren(...this.#shapes, svg("circle", { class: "asked-mark", cx: x, cy: y, r: 5 }));
    this.#moveHandle();
    this.#layers.trail.setAttribute("points", "");
  }

  /** To a place; without one to the target that was pressed before. */
  #moveHandle(place?: Place): void {
    const [x, y] = place ?? this.#targets[this.#before] ?? [0, 0];
    const { style } = this.#parts.handle;
    style.setProperty("--x", `${x}px`);
    style.setProperty("--y", `${y}px`);
  }

  #listen(): void {
    const { field, handle } = this.#parts;
    const measure = () => {
      const { left, top } = field.getBoundingClientRect();
      this.#corner = [left, top];
    };
    field.addEventListener("pointerenter", measure);
    addEventListener("scroll", measure, { passive: true, capture: true });
    field.addEventListener("pointermove", (event) => {
      if (this.#dragged || event.pointerType === "touch" || (event.pointerType === "pen" && event.buttons)) return;
      this.#take(event);
    });
    field.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "touch" || this.#dragged) return;
      this.#recorder.clear();
      this.#follow();
    });
    field.addEventListener("pointerdown", (event) => {
      measure();
      if (event.target === handle && event.pointerType !== "mouse") this.#grasp(event);
      else if (event.pointerType === "mouse" && event.button === 0) this.#press(this.#at(event), "press");
    });
    // a pen or a finger that does not drag: a swipe that scrolls is no click
    field.addEventListener("click", (event) => {
      const { pointerType } = event as PointerEvent;
      if (event.target === handle || pointerType === "mouse") return;
      if (pointerType === "pen" && this.#recorder.current.length > 1) this.#press(this.#at(event), "press");
      else this.#events.missed("tap");
    });
    handle.addEventListener("pointermove", (event) => {
      if (event.pointerId !== this.#dragged?.id) return;
      this.#take(event);
      const [x, y] = this.#at(event);
      this.#moveHandle([x, y]);
    });
    handle.addEventListener("pointerup", (event) => {
      if (event.pointerId !== this.#dragged?.id) return;
      const place = this.#at(event);
      this.#dragged = null;
      this.#press(place, "lift");
      this.#moveHandle();
    });
    handle.addEventListener("pointercancel", () => {
      this.#dragged = null;
      this.#recorder.clear();
      this.#moveHandle();
      this.#follow();
    });
  }

  /** A movement by a finger begins where it takes the handle. */
  #grasp(event: PointerEvent): void {
    this.#parts.handle.setPointerCapture(event.pointerId);
    const [x, y] = this.#at(event);
    const [hx, hy] = this.#targets[this.#before] ?? [x, y];
    this.#dragged = { id: event.pointerId, offset: [x - hx, y - hy] };
    this.#recorder.clear();
    this.#recorder.add(event.timeStamp / 1000, ...this.#at(event));
  }

  /** In px from the field's corner. What is dragged counts from where the handle is, not from where the finger took it. */
  #at({ clientX, clientY }: MouseEvent): Place {
    const [dx, dy] = this.#dragged?.offset ?? [0, 0];
    return [clientX - this.#corner[0] - dx, clientY - this.#corner[1] - dy];
  }

  #take(event: PointerEvent): void {
    const coalesced = event.getCoalescedEvents?.() ?? [];
    for (const each of coalesced.length > 0 ? coalesced : [event]) {
      this.#recorder.add(each.timeStamp / 1000, ...this.#at(each));
    }
    const ahead = event.getPredictedEvents?.().at(-1);
    if (ahead) this.#recorder.expect(this.#at(ahead));
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#follow();
    });
  }

  #press(place: Place, by: "press" | "lift"): void {
    const target = this.#asked;
    const box = this.#targets[target];
    if (!box || !contains(box, place)) {
      if (by === "lift") this.#recorder.clear();
      this.#follow();
      this.#events.missed(by);
      return;
    }
    const targets = this.#targets;
    const recording = this.#recorder.take(box);
    this.goOn(target, nextTarget(this.#layout, target, targets.length, Math.random));
    this.#follow();
    this.#events.pressed({ targets, target, recording });
  }

  /** The pointer has moved, or its movement is over. */
  #follow(): void {
    const samples = this.#recorder.current;
    this.#layers.trail.setAttribute("points", points(places({ samples })));
    this.#events.moved(samples);
  }
}
