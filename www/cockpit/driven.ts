/** The hand as a visitor drives it, over the road. */
import type { Position } from "./cabin.ts";
import { Drive, type DriveParts } from "./drive.ts";
import { leader } from "./forecast.ts";
import { Movements } from "./movements.ts";
import { type Road, shaking } from "./road.ts";
import type { Scene } from "./scene.ts";
import { outcome, prediction } from "./sentences.ts";
import { plus } from "./vector.ts";
import type { Camera } from "./view/camera.ts";

/** Where it begins, in front of the screen. */
const START: Position = [60, 150, 300];
/** How much of its way is drawn, in seconds. */
const TRAIL = 0.9;

export interface DrivenParts extends DriveParts {
  /** The distance, in words. */
  readonly shown: HTMLElement;
  /** What is there for it under the scene. */
  readonly root: HTMLElement;
}

export class Driven {
  readonly #parts: DrivenParts;
  readonly #camera: Camera;
  #under: { drive: Drive; movements: Movements; shake: (seconds: number) => Position } | null = null;
  #way: { seconds: number; place: Position }[] = [];
  #hand: Position = START;

  constructor(parts: DrivenParts, camera: Camera) {
    this.#parts = parts;
    this.#camera = camera;
    parts.root.dataset["away"] = "";
  }

  enter(road: Road): void {
    const { root, handle, stage } = this.#parts;
    root.removeAttribute("data-away");
    handle.hidden = false;
    stage.dataset["driven"] = "";
    this.#under = { drive: new Drive(this.#parts, this.#camera, START), movements: new Movements(), shake: shaking(road, 1) };
    this.#way = [];
  }

  leave(): void {
    const { root, handle, stage } = this.#parts;
    root.dataset["away"] = "";
    handle.hidden = true;
    delete stage.dataset["driven"];
    this.#under?.drive.end();
    this.#under?.movements.free();
    this.#under = null;
  }

  /** Another road. */
  drive(road: Road): void {
    if (this.#under) this.#under.shake = shaking(road, 1);
  }

  /** The hand stays where it is when the view turns. */
  turned(): void {
    this.#under?.drive.stay(this.#hand);
  }

  /** At a time in seconds, which is that of the frame. */
  scene(seconds: number): Scene {
    if (!this.#under) throw new Error("nobody drives");
    const { drive, movements, shake } = this.#under;
    this.#hand = drive.step(seconds);
    const tip = plus(this.#hand, shake(seconds));
    movements.add(seconds, this.#hand, tip);
    const place: Position = [tip[0], tip[1], Math.max(0, tip[2])];
    this.#way = [...this.#way.filter((each) => each.seconds > seconds - TRAIL), { seconds, place }];
    this.#showHandle(place);
    const { moments, touched, icon } = movements.current;
    const last = moments.shake.at(-1);
    return {
      trail: this.#way.map((each) => each.place),
      moments,
      at: moments.shake.length - 1,
      touched,
      hit: icon,
      icon: icon ?? (last ? leader(last).icon : 0),
      playing: !touched,
      words: (moments) => {
        const moment = moments.at(-1);
        if (!moment) return "Point at the scene, and turn the wheel forward to reach for the screen.";
        return touched ? outcome(moments, icon) : prediction(moment);
      },
    };
  }

  #showHandle(place: Position): void {
    const { handle, shown } = this.#parts;
    const { x, y } = this.#camera.project(place);
    handle.style.setProperty("--x", `${x}px`);
    handle.style.setProperty("--y", `${y}px`);
    const text = `${Math.round(this.#hand[2])} mm`;
    if (shown.textContent !== text) shown.textContent = text;
  }
}
