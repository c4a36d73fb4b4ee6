/** The hand as it is replayed: a gesture, slowly, with a button and a slider; before anybody touches them one after the other. */
import { Playback } from "../shared/playback.ts";
import { Replay } from "./replay.ts";
import type { Road } from "./road.ts";
import type { Scene } from "./scene.ts";
import { outcome, prediction } from "./sentences.ts";

/** Places of the slider. */
const PLACES = 200;
/** How many times as slow as it is; and milliseconds from the end of one gesture to the next. */
const SLOWNESS = 4;
const PAUSE = 1600;
/** What is shown first, where nothing plays: from the wheel, at three fifths of the time. */
const FIRST = 242;
const STILL = Math.round(0.6 * PLACES);

export interface ReplayedParts {
  readonly play: HTMLButtonElement;
  readonly time: HTMLInputElement;
  readonly another: HTMLButtonElement;
  /** What all of them are in. */
  readonly root: HTMLElement;
}

export class Replayed {
  readonly #root: HTMLElement;
  readonly #playback: Playback;
  readonly #changed: () => void;
  #road: Road;
  #seed = FIRST;
  #replay: Replay;
  /** One gesture follows the other. */
  #touring = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor({ play, time, another, root }: ReplayedParts, road: Road, changed: () => void) {
    this.#root = root;
    this.#changed = changed;
    this.#road = road;
    this.#replay = new Replay(this.#seed, road);
    const pace = () => (1000 * SLOWNESS * this.#replay.duration) / PLACES;
    this.#playback = new Playback(
      { play, slider: time },
      {
        last: PLACES,
        get pace() {
          return pace();
        },
        text: (place) => this.#clock(place),
        moved: () => this.#moved(),
      },
      STILL,
    );
    another.addEventListener("click", () => this.#next());
    for (const type of ["pointerdown", "keydown"]) root.addEventListener(type, () => this.#rest(), { capture: true });
  }

  /** Plays, and goes on with other gestures until somebody takes over. */
  begin(): void {
    this.#touring = true;
    this.#playback.set(0);
    this.#playback.play();
  }

  enter(road: Road): void {
    this.#root.removeAttribute("data-away");
    this.drive(road);
  }

  leave(): void {
    this.#rest();
    this.#playback.pause();
    this.#root.dataset["away"] = "";
  }

  /** The same gesture on another road. */
  drive(road: Road): void {
    const { deviation, frequency } = this.#road;
    if (road.deviation === deviation && road.frequency === frequency) return;
    this.#road = road;
    this.#replay = new Replay(this.#seed, road);
  }

  scene(): Scene {
    const { moments, gesture } = this.#replay;
    const { trail, at } = this.#replay.instant(this.#playback.place / PLACES);
    return {
      trail,
      moments,
      at,
      touched: true,
      hit: gesture.target,
      icon: gesture.target,
      playing: this.#playback.playing || this.#touring,
      words: (moments) => {
        const moment = moments[at];
        if (!moment) return "";
        return at < moments.length - 1
          ? `After ${moment.sample[0].toFixed(2)} s: ${prediction(moment)}`
          : outcome(moments, gesture.target);
      },
    };
  }

  #next(): void {
    this.#seed += 1;
    this.#replay = new Replay(this.#seed, this.#road);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.#playback.set(STILL);
    else {
      this.#playback.set(0);
      this.#playback.play();
    }
  }

  #moved(): void {
    const isOver = !this.#playback.playing && this.#playback.place >= PLACES;
    if (isOver && this.#touring) this.#timer = setTimeout(() => this.#next(), PAUSE);
    this.#changed();
  }

  #rest(): void {
    this.#touring = false;
    clearTimeout(this.#timer);
  }

  #clock(place: number): string {
    const { duration } = this.#replay;
    return `${((place / PLACES) * duration).toFixed(2)} of ${duration.toFixed(2)} s`;
  }
}
