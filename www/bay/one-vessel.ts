/** One vessel: a named voyage that is replayed, or one that the visitor steers. */
import { part } from "../shared/page.ts";
import type { Playback } from "../shared/playback.ts";
import type { Place } from "./coast.ts";
import { Helm } from "./helm.ts";
import { Pursuit } from "./pursuit.ts";
import { INTERVAL } from "./sail.ts";
import type { Settings } from "./scenario.ts";
import { TICK, type Scene } from "./scene.ts";
import type { View } from "./view.ts";
import { voyages, type Voyage } from "./voyages.ts";
import { timeOfDay } from "./clock.ts";

/** The voyage of the visitor's own. */
const OWN = "own";
/** The first voyage is shown so far along. */
const FIRST_LOOK = 0.42;

export class OneVessel implements Scene {
  readonly #view: View;
  readonly #playback: Playback;
  readonly #voyages: readonly Voyage[] = voyages();
  readonly #pursuit: Pursuit;
  readonly #select = part<HTMLSelectElement>("voyage");
  readonly #vessel = part<HTMLButtonElement>("vessel");
  /** Where the vessel has been steered to, and when that was. */
  #steered: { readonly time: number; readonly place: Place } | null = null;
  #atHelm = false;

  /** `rate` gives the seconds of the bay in one of ours. */
  constructor(view: View, playback: Playback, settings: Settings, rate: () => number) {
    this.#view = view;
    this.#playback = playback;
    const [first] = this.#voyages;
    this.#pursuit = new Pursuit(first?.reports ?? [], settings);
    for (const { id, name } of this.#voyages) this.#select.add(new Option(name, id));
    this.#select.add(new Option("Your own, from the pilot station", OWN));
    this.#select.addEventListener("change", () => this.#choose(this.#select.value));
    new Helm(this.#vessel, {
      place: () => this.#place(),
      under: (point) => this.#under(point),
      rate,
      taken: () => this.#take(),
      sailed: (place, seconds) => this.#sail(place, seconds),
      released: () => {
        this.#atHelm = false;
        this.#vessel.dataset["steered"] = "false";
        this.#playback.set(this.#playback.place);
      },
    });
  }

  /** How far along it is when it is first shown. */
  get firstLook(): number {
    return Math.floor(FIRST_LOOK * this.last);
  }

  get last(): number {
    return Math.ceil((this.#end - this.#pursuit.begins) / TICK);
  }

  text(place: number): string {
    return timeOfDay(this.#pursuit.begins + place * TICK);
  }

  enter(): void {
    this.#view.forget();
  }

  set(settings: Settings): void {
    this.#pursuit.set(settings);
    this.#view.forget();
    this.#playback.set(this.#playback.place);
  }

  draw(deadline: number): boolean {
    const now = this.#now();
    const pursuit = this.#pursuit;
    const there = pursuit.seek(now, deadline);
    const { lookout } = pursuit;
    const place = this.#place();
    const traffic = this.#view.traffic;
    traffic?.clear();
    this.#view.lights(lookout);
    const current = this.#view.follow({
      lookout,
      name: null,
      place,
      now,
      from: pursuit.begins,
      to: this.#end,
      moving: this.#playback.playing || this.#atHelm || !there,
    });
    this.#handle(place);
    part("cost").textContent = `${(1000 * pursuit.cost).toFixed(2)} ms a report`;
    return there && current;
  }

  /** The last time of the voyage. */
  get #end(): number {
    return Math.max(this.#pursuit.lasts, this.#steered?.time ?? 0);
  }

  /** As exact as it was steered, where that is where the playback is. */
  #now(): number {
    const { place } = this.#playback;
    if (this.#steered && this.#tick(this.#steered.time) === place) return this.#steered.time;
    return Math.min(this.#end, this.#pursuit.begins + place * TICK);
  }

  #tick(time: number): number {
    return Math.ceil((time - this.#pursuit.begins) / TICK);
  }

  #place(): Place {
    const now = this.#now();
    return this.#steered?.time === now ? this.#steered.place : this.#pursuit.place(now);
  }

  #under({ x, y }: Place): Place {
    const { left, top } = part("chart").getBoundingClientRect();
    return this.#view.projection.toPlace({ x: x - left, y: y - top });
  }

  #choose(id: string): void {
    this.#steered = null;
    const voyage = this.#voyages.find((one) => one.id === id);
    if (voyage) this.#pursuit.follow(voyage.reports);
    else this.#pursuit.launch();
    this.#view.forget();
    this.#playback.set(0);
    this.#playback.change({ last: this.last });
    if (voyage && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.#playback.play();
    if (!voyage) this.#vessel.focus();
  }

  /** From here on it is the visitor's. */
  #take(): void {
    const [time, place] = [this.#now(), this.#place()];
    if (!this.#atHelm) {
      this.#pursuit.take(time);
      this.#steered = { time, place };
      this.#select.value = OWN;
    }
    this.#atHelm = true;
    this.#vessel.dataset["steered"] = "true";
    this.#show();
  }

  #sail(place: Place, seconds: number): void {
    const from = this.#steered;
    if (!from) return;
    const time = from.time + seconds;
    for (let next = this.#pursuit.lasts + INTERVAL; next <= time; next += INTERVAL) {
      const share = (next - from.time) / seconds;
      this.#pursuit.add({
        time: next,
        x: from.place.x + share * (place.x - from.place.x),
        y: from.place.y + share * (place.y - from.place.y),
      });
    }
    this.#steered = { time, place };
    this.#show();
  }

  #show(): void {
    this.#playback.change({ last: this.last });
    this.#playback.set(this.last);
  }

  /** Puts the handle where the vessel is. */
  #handle(place: Place): void {
    const { style, dataset } = this.#vessel;
    const { x, y } = this.#view.projection.toScreen(place);
    const { velocity } = this.#pursuit.lookout.latest ?? { velocity: { x: 0, y: 1 } };
    style.setProperty("--x", `${x.toFixed(1)}px`);
    style.setProperty("--y", `${y.toFixed(1)}px`);
    style.setProperty("--heading", `${((180 / Math.PI) * Math.atan2(velocity.x, velocity.y)).toFixed(1)}deg`);
    dataset["placed"] = "true";
    const kilometres = (metres: number) => Math.round(metres / 1000);
    this.#vessel.setAttribute("aria-label", `Vessel, ${kilometres(place.x)} km east and ${kilometres(place.y)} km north`);
  }
}
