/** What the page knows at any moment, and who is told when it changes. Drawing happens once a frame. */
import type { Belief, Predictions } from "./belief/predictions.ts";
import type { Settings } from "./belief/settings.ts";
import type { Stage } from "./ghost.ts";
import { History, judge, leader, type Outcome } from "./movement/history.ts";
import { Segmenter, type Sample } from "./movement/segmenter.ts";
import { Tally } from "./movement/tally.ts";
import type { Announcer } from "./view/announcer.ts";
import type { Believer } from "./view/believer.ts";
import type { Chart } from "./view/chart.ts";
import type { Fan } from "./view/fan.ts";
import { sentence, type Numbers } from "./view/numbers.ts";
import type { Screen } from "./view/screen.ts";

export interface Views {
  readonly screen: Screen;
  readonly fan: Fan;
  readonly chart: Chart;
  readonly announcer: Announcer;
  readonly believer: Believer;
  readonly numbers: Numbers;
}

/** One pointer's own story. */
interface Track {
  readonly segmenter: Segmenter;
  history: History;
  /** When it was last heard of, while there is something to draw. */
  latest: number | null;
}

/** The history is no coarser than this, however seldom the page is drawn (seconds). */
const RESOLUTION = 0.016;

const START = "Move towards an icon.";

/** The ghost is a pointer like any other; real ones have identifiers from 0. */
const GHOST = -1;

export class Demonstration {
  readonly #predictions: Predictions;
  readonly #labels: readonly string[];
  readonly #views: Views;
  readonly #tally = new Tally();
  readonly #tracks = new Map<number, Track>();
  #settings: Settings;
  /** The pointer whose belief is on show. */
  #shown: number | null = null;
  #frame: number | null = null;
  /** What has been said of the movement on show; undefined: nothing yet. */
  #announced: number | null | undefined = undefined;

  constructor(predictions: Predictions, settings: Settings, labels: readonly string[], views: Views) {
    this.#predictions = predictions;
    this.#settings = settings;
    this.#labels = labels;
    this.#views = views;
    this.#quieten();
  }

  /** Samples of one pointer, oldest first. */
  move(pointerId: number, samples: readonly Sample[]): void {
    const track = this.#track(pointerId);
    for (const sample of samples) {
      const cut = track.segmenter.add(sample);
      if (cut.fresh) {
        this.#predictions.begin(pointerId);
        track.history = new History();
      }
      if (cut.samples.length === 0) continue;
      this.#predictions.observe(pointerId, cut.samples);
      track.latest = sample.time;
      this.#shown = pointerId;
      if (sample.time - (track.history.moments.at(-1)?.time ?? -Infinity) >= RESOLUTION) this.#record(pointerId, track);
    }
    if (track.latest !== null) this.#frame ??= requestAnimationFrame(() => this.#draw());
  }

  /** A pointer pressed at `sample`: on an icon, or with null beside them all. */
  press(pointerId: number, sample: Sample, index: number | null): void {
    const track = this.#track(pointerId);
    this.#record(pointerId, track);
    const { moments } = track.history;
    track.segmenter.end();
    track.history = new History();
    if (index === null) return;
    this.#quieten();
    this.#views.screen.acknowledge(index);
    if (moments.length === 0) {
      this.#views.announcer.say(`${this.#labels[index]} pressed, without a movement to predict it from.`, true);
      return;
    }
    const outcome = judge(moments, index, sample.time, this.#settings.threshold);
    this.#views.chart.draw(moments, outcome);
    this.#report(outcome, pointerId === GHOST);
  }

  /** Enter or an assistive tool: there is no movement to judge. */
  pressWithoutPointer(index: number): void {
    this.#quieten();
    this.#views.screen.acknowledge(index);
    this.#views.announcer.say(`${this.#labels[index]} pressed, without a movement to predict it from.`, true);
  }

  /** A movement ends here, with or without something to show for it. */
  end(pointerId: number): void {
    this.#tracks.get(pointerId)?.segmenter.end();
  }

  /** A pointer turned away from the screen; it may come back. */
  lose(pointerId: number): void {
    this.end(pointerId);
    if (this.#shown !== pointerId) return;
    this.#shown = null;
    this.#quieten();
    this.#views.announcer.say(START);
  }

  /** A pointer is gone for good. */
  forget(pointerId: number): void {
    this.#tracks.delete(pointerId);
    this.#predictions.release(pointerId);
    if (this.#shown === pointerId) this.#shown = null;
  }

  configure(settings: Settings): void {
    const { method, noise, points } = this.#settings;
    this.#settings = settings;
    if (method === settings.method && noise === settings.noise && points === settings.points) return;
    this.#predictions.configure(settings);
    for (const track of this.#tracks.values()) {
      track.segmenter.end();
      track.history = new History();
    }
    this.#quieten();
  }

  /** The icons may have moved. While the page is taken down or not laid out they have no size. */
  place(): void {
    const targets = this.#views.screen.measure();
    if (targets.every(({ width, height }) => width > 0 && height > 0)) this.#predictions.place(targets);
  }

  /** The stage on which the ghost plays. */
  ghost(): Stage {
    return {
      targets: () => this.#views.screen.measure(),
      move: (sample) => this.move(GHOST, [sample]),
      press: (index, sample) => {
        this.move(GHOST, [sample]);
        this.press(GHOST, sample, index);
      },
      gone: () => {
        this.forget(GHOST);
        this.#quieten();
        this.#views.announcer.say(START, true);
      },
    };
  }

  #track(pointerId: number): Track {
    let track = this.#tracks.get(pointerId);
    if (!track) {
      track = { segmenter: new Segmenter(), history: new History(), latest: null };
      this.#tracks.set(pointerId, track);
    }
    return track;
  }

  /** Writes the belief at the latest sample into the movement's history. */
  #record(pointerId: number, track: Track): Belief | null {
    if (track.latest === null) return null;
    const belief = this.#predictions.belief(pointerId, track.latest);
    track.history.add(track.latest, belief.probabilities, belief.none);
    return belief;
  }

  #draw(): void {
    this.#frame = null;
    const pointerId = this.#shown;
    const track = pointerId === null ? undefined : this.#tracks.get(pointerId);
    if (pointerId === null || !track || track.latest === null) return;
    const now = track.latest;
    const belief = this.#record(pointerId, track);
    track.latest = null;
    if (!belief) return;
    const best = leader(belief.probabilities);
    const predicted = (belief.probabilities[best] ?? 0) >= this.#settings.threshold ? best : null;
    this.#views.screen.paint(belief.probabilities, predicted);
    this.#views.believer.paint(belief);
    const outlook = this.#predictions.outlook(pointerId, now, this.#views.believer.leading(3));
    if (outlook) this.#views.fan.draw(outlook, belief.probabilities);
    this.#views.chart.draw(track.history.moments, null);
    this.#views.numbers.movement(pointerId === GHOST);
    if (pointerId === GHOST) this.#views.announcer.say("A simulated hand shows how it works. Move to take over.");
    else this.#announce(predicted);
  }

  /** Only what has changed: a screen reader would never come to the end of the percentages. */
  #announce(predicted: number | null): void {
    if (predicted === this.#announced) return;
    this.#announced = predicted;
    this.#views.announcer.say(predicted === null ? "Not sure yet." : `Heading for ${this.#labels[predicted]}.`);
  }

  #report(outcome: Outcome, simulated: boolean): void {
    const label = this.#labels[outcome.chosen] ?? "";
    this.#views.numbers.last(outcome, label, simulated);
    if (simulated) return;
    this.#tally.add(outcome);
    const summary = this.#tally.summary();
    if (summary) this.#views.numbers.total(summary);
    this.#views.announcer.say(`${label} pressed: ${sentence(outcome)}.`, true);
  }

  /** Back to what is believed before anything moves. */
  #quieten(): void {
    if (this.#frame !== null) cancelAnimationFrame(this.#frame);
    this.#frame = null;
    this.#announced = undefined;
    const prior = this.#predictions.prior();
    this.#views.screen.paint(prior.probabilities, null);
    this.#views.believer.paint(prior);
    this.#views.fan.clear();
  }
}
