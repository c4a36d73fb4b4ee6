/** The visitor at the helm: the vessel follows a mouse, a finger or the arrow keys, no faster than a vessel, while the bay's clock runs. */
import type { Place } from "./coast.ts";
import { depth } from "./depth.ts";

/** The most that it does, and what it does by the arrow keys, in m/s: 23 and 16 knots. */
const FASTEST = 12;
const CRUISING = 8;
/** Seconds of the bay in which it would be where it is drawn to, were it as fast as it liked. */
const EASE = 120;
/** What one touch of an arrow key sails at once, in seconds of the bay. */
const TOUCH = 60;
/** Seconds of ours that one frame may bridge, and of the bay that one step of the vessel may take. */
const LONGEST = 0.1;
const STEP = 15;
const KEYS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export interface HelmOptions {
  /** Where the vessel is when it is taken over. */
  place(): Place;
  /** What place a point of the window is at. */
  under(point: Place): Place;
  /** Seconds of the bay in one of ours. */
  rate(): number;
  /** It has been taken over. */
  taken(): void;
  /** It has sailed for so many seconds of the bay. */
  sailed(place: Place, seconds: number): void;
  /** It was let go. */
  released(): void;
}

export class Helm {
  readonly #options: HelmOptions;
  readonly #keys = new Set<string>();
  /** Where it is drawn to. */
  #towards: Place | null = null;
  #frame = 0;
  #last = 0;

  constructor(vessel: HTMLElement, options: HelmOptions) {
    this.#options = options;
    vessel.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      vessel.setPointerCapture(event.pointerId);
      this.#towards = options.under({ x: event.clientX, y: event.clientY });
      this.#take();
    });
    vessel.addEventListener("pointermove", (event) => {
      if (this.#towards && vessel.hasPointerCapture(event.pointerId))
        this.#towards = options.under({ x: event.clientX, y: event.clientY });
    });
    vessel.addEventListener("lostpointercapture", () => {
      this.#towards = null;
      this.#release();
    });
    vessel.addEventListener("keydown", (event) => {
      if (!KEYS[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      this.#keys.add(event.key);
      if (event.repeat) return;
      this.#take();
      this.#sail(TOUCH);
    });
    vessel.addEventListener("keyup", ({ key }) => {
      if (this.#keys.delete(key)) this.#release();
    });
    vessel.addEventListener("blur", () => {
      this.#keys.clear();
      this.#release();
    });
  }

  #take(): void {
    this.#options.taken();
    if (this.#frame) return;
    this.#last = performance.now();
    this.#frame = requestAnimationFrame(this.#step);
  }

  #release(): void {
    if (!this.#frame || this.#towards || this.#keys.size > 0) return;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#options.released();
  }

  readonly #step = (now: number) => {
    const seconds = Math.min(LONGEST, Math.max(0, now - this.#last) / 1000);
    this.#last = now;
    this.#frame = requestAnimationFrame(this.#step);
    this.#sail(seconds * this.#options.rate());
  };

  #sail(seconds: number): void {
    for (let left = seconds; left > 0; left -= STEP) {
      const step = Math.min(STEP, left);
      const place = this.#options.place();
      this.#options.sailed(afloat(place, this.#velocity(place), step), step);
    }
  }

  #velocity(place: Place): Place {
    if (this.#towards) {
      const [x, y] = [(this.#towards.x - place.x) / EASE, (this.#towards.y - place.y) / EASE];
      const share = Math.min(1, FASTEST / Math.hypot(x, y));
      return { x: share * x, y: share * y };
    }
    const along = (axis: 0 | 1) => [...this.#keys].reduce((sum, key) => sum + (KEYS[key]?.[axis] ?? 0), 0);
    const [x, y] = [along(0), along(1)];
    const length = Math.hypot(x, y) || 1;
    return { x: (CRUISING * x) / length, y: (CRUISING * y) / length };
  }
}

/** Where it is after a step: in the water, along the coast where the way leads ashore. */
function afloat({ x, y }: Place, velocity: Place, seconds: number): Place {
  const [dx, dy] = [velocity.x * seconds, velocity.y * seconds];
  const ways = [
    { x: x + dx, y: y + dy },
    { x: x + dx, y },
    { x, y: y + dy },
  ];
  return ways.find((place) => depth(place) > 0) ?? { x, y };
}
