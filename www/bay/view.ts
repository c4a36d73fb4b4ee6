/** The canvases of the page, and what is shown of one vessel that is followed, whether it is alone or one of a hundred. */
import { part } from "../shared/page.ts";
import type { Status } from "../shared/status.ts";
import { Chart } from "./chart.ts";
import { timeOfDay } from "./clock.ts";
import { harbourAt, HARBOURS, type Place } from "./coast.ts";
import { drawEvidence } from "./evidence.ts";
import type { Lookout } from "./lookout.ts";
import { Outlook } from "./outlook.ts";
import { Panel } from "./panel.ts";
import { paper, type Paper } from "./paper.ts";
import { Projection } from "./projection.ts";
import { Traffic, type Light } from "./traffic.ts";
import { knots, percent, sentence } from "./words.ts";

/** One vessel at one time. */
export interface Subject {
  readonly lookout: Lookout;
  /** For a vessel among many. */
  readonly name: string | null;
  readonly place: Place;
  readonly now: number;
  /** The first and the last time of the evidence. */
  readonly from: number;
  readonly to: number;
  /** It is on its way now: what is costly to compute may be late. */
  readonly moving: boolean;
}

export class View {
  readonly #status: Status;
  readonly #chart = new Chart();
  readonly #panel = new Panel();
  readonly #outlook = new Outlook();
  #projection = new Projection(1, 1);
  #traffic: Traffic | null = null;
  #evidence: Paper | null = null;

  constructor(status: Status) {
    this.#status = status;
  }

  get projection(): Projection {
    return this.#projection;
  }

  get traffic(): Traffic | null {
    return this.#traffic;
  }

  /** After a change of size, resolution or theme. */
  fit(): void {
    const sheet = paper(part<HTMLCanvasElement>("sheet"));
    const moving = paper(part<HTMLCanvasElement>("traffic"));
    if (sheet && moving) {
      this.#projection = new Projection(sheet.width, sheet.height);
      this.#chart.draw(sheet, this.#projection);
      const strength = Number(getComputedStyle(document.documentElement).getPropertyValue("--glow-strength"));
      this.#traffic = new Traffic(moving, this.#projection, strength);
    }
    this.#evidence = paper(part<HTMLCanvasElement>("history"));
    this.#panel.fit();
  }

  /** Another vessel is followed from now on, or the same one by another model. */
  forget(): void {
    this.#outlook.forget();
  }

  /** The vessel's paths on the chart, and its numbers everywhere else; true where all of it is up to date. */
  follow({ lookout, name, place, now, from, to, moving }: Subject): boolean {
    const { latest } = lookout;
    const leading = latest && HARBOURS[latest.best];
    if (!leading) return true;
    const current = this.#outlook.look(lookout, moving);
    const anomalies = lookout.anomalies();
    const harbour = harbourAt(place);
    const arriving = harbour || lookout.moments.length < 2 ? null : lookout.arrivalAt(latest.best);
    this.#traffic?.track([...lookout.moments.map(({ report }) => report), place]);
    if (!harbour && lookout.moments.length > 1) this.#traffic?.paths(this.#outlook.paths, this.#outlook.forecasts, place);
    this.#traffic?.spots(
      anomalies.map(({ time }, index) => ({
        place: lookout.moments.find(({ report }) => report.time >= time)?.report ?? place,
        number: index + 1,
      })),
    );
    this.#panel.show(latest, now, arriving, anomalies);
    if (this.#evidence) drawEvidence(this.#evidence, lookout.moments, anomalies, { from, to });
    part("clock").textContent = `${timeOfDay(now)}, ${knots(Math.hypot(latest.velocity.x, latest.velocity.y))}`;
    const text = sentence({
      time: now,
      harbour,
      leading,
      probability: latest.probabilities[latest.best] ?? 0,
      none: latest.none,
      expected: arriving,
      anomaly: anomalies.findLast(({ until }) => until >= latest.report.time) ?? null,
      reports: lookout.moments.length,
    });
    const shown = name === null ? text : `${name}, ${text}`;
    this.#status.show(shown);
    if (!moving) this.#status.announce(shown);
    return current;
  }

  /** The harbours, lit as one vessel's probabilities have it. */
  lights({ latest }: Lookout): void {
    this.#traffic?.lights(HARBOURS.map((_, index) => light(latest?.probabilities[index] ?? 0)));
  }
}

function light(share: number): Light {
  return { share, figure: percent(share), ringed: share >= 0.5 };
}
