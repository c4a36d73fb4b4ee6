/** A hundred vessels at once: all on the chart, the harbours' boards, and one of them that is followed. */
import { part } from "../shared/page.ts";
import type { Playback } from "../shared/playback.ts";
import { Board } from "./board.ts";
import { timeOfDay } from "./clock.ts";
import { HARBOURS, type Place } from "./coast.ts";
import { HarbourMaster, type Followed } from "./harbour-master.ts";
import { placeAt } from "./sail.ts";
import { TICK, type Scene } from "./scene.ts";
import type { View } from "./view.ts";
import { percent } from "./words.ts";

/** When all are at sea, in seconds from the first report. */
const FIRST_LOOK = 1800;
/** Milliseconds between two changes of the boards while it plays. */
const PACE = 250;
/** Milliseconds of a frame that go into the boards' times. */
const EXPECT = 3;
/** A vessel is chosen by a click so many pixels from it, at most. */
const NEAR = 26;
/** With so many vessels expected a harbour is fully lit. */
const FULL = 30;

export class Hundred implements Scene {
  readonly #view: View;
  readonly #playback: Playback;
  readonly #master = new HarbourMaster();
  readonly #board: Board;
  #followed: Followed | null = null;
  #boards = 0;

  constructor(view: View, playback: Playback) {
    this.#view = view;
    this.#playback = playback;
    this.#board = new Board(part("berths"), (vessel) => this.#follow(vessel));
    part("traffic").addEventListener("click", (event) => {
      const { left, top } = part("traffic").getBoundingClientRect();
      const vessel = this.#nearest({ x: event.clientX - left, y: event.clientY - top });
      if (vessel) this.#follow(vessel);
    });
  }

  get firstLook(): number {
    return Math.floor(FIRST_LOOK / TICK);
  }

  get last(): number {
    return Math.ceil((this.#master.lasts - this.#master.begins) / TICK);
  }

  text(place: number): string {
    return timeOfDay(this.#master.begins + place * TICK);
  }

  enter(): void {
    this.#view.forget();
    this.#boards = 0;
  }

  /** The hundred are followed by the default model. */
  set(): void {}

  draw(deadline: number): boolean {
    const master = this.#master;
    const there = master.seek(master.begins + this.#playback.place * TICK, deadline);
    const expected = master.expect(performance.now() + EXPECT);
    const moving = this.#playback.playing || !there || !expected;
    this.#followed ??= this.#atSea()[0] ?? null;
    const due = master.due();
    const { traffic } = this.#view;
    traffic?.clear();
    traffic?.lights(
      HARBOURS.map((_, index) => ({
        share: Math.min(1, (due[index] ?? 0) / FULL),
        figure: `${(due[index] ?? 0).toFixed(0)} due`,
        ringed: false,
      })),
    );
    let current = true;
    if (this.#followed) {
      const { lookout, name, reports } = this.#followed;
      const { now } = master;
      const place = placeAt(reports, now);
      const [from, to] = [reports[0]?.time ?? now, reports.at(-1)?.time ?? now];
      current = this.#view.follow({ lookout, name, place, now, from, to, moving });
    }
    traffic?.fleet(
      this.#atSea().map((vessel) => {
        const { latest, moments } = vessel.lookout;
        return {
          place: placeAt(vessel.reports, master.now),
          velocity: latest?.velocity ?? { x: 0, y: 1 },
          probability: latest?.probabilities[latest.best] ?? 0,
          marked: moments.some(({ finding }) => finding),
          followed: vessel === this.#followed,
        };
      }),
    );
    this.#keepBooks(due, moving);
    return there && expected && current;
  }

  /** Boards and books, at a pace that can be read. */
  #keepBooks(due: Float64Array, moving: boolean): void {
    const now = performance.now();
    if (moving && now < this.#boards) return;
    this.#boards = now + PACE;
    const master = this.#master;
    this.#board.show(master.board(), due, this.#followed);
    const { reporting, arrived, half, right, within, marked, markedPassing, passing } = master.books();
    const share = (count: number) => (half > 0 ? `${count} of ${half}, ${percent(count / half)}` : "–");
    part("at-sea").textContent = `${reporting}, ${arrived}`;
    part("right").textContent = share(right);
    part("within").textContent = share(within);
    part("marked").textContent = `${markedPassing} of ${passing} that call nowhere, ${marked} others`;
    part("throughput").textContent = Math.round(master.throughput).toLocaleString("en");
  }

  #atSea(): Followed[] {
    return this.#master.vessels.filter(({ lookout, arrived }) => lookout.latest && !arrived);
  }

  #follow(vessel: Followed): void {
    this.#followed = vessel;
    this.#view.forget();
    this.#boards = 0;
    if (!this.#playback.playing) this.#playback.set(this.#playback.place);
  }

  #nearest(point: Place): Followed | null {
    const away = (vessel: Followed) => {
      const { x, y } = this.#view.projection.toScreen(placeAt(vessel.reports, this.#master.now));
      return Math.hypot(x - point.x, y - point.y);
    };
    const [nearest] = this.#atSea().sort((one, other) => away(one) - away(other));
    return nearest && away(nearest) <= NEAR ? nearest : null;
  }
}
