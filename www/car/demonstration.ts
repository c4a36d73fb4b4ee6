/** The state of the page, and the updates of its views. Drawing happens once a frame. */
import type { Belief, Predictions } from "./belief/predictions.ts";
import type { Settings } from "./belief/settings.ts";
import type { Stage } from "./ghost.ts";
import { reach, seeded } from "./movement/hand.ts";
import type { Box } from "./movement/intent.ts";
import type { Sample } from "./movement/segmenter.ts";
import { Tally } from "./movement/tally.ts";
import { Track } from "./movement/track.ts";
import type { ProbabilityList } from "./view/probabilities.ts";
import type { Chart } from "./view/chart.ts";
import type { Fan } from "./view/fan.ts";
import type { Numbers } from "./view/numbers.ts";
import type { Screen } from "./view/screen.ts";
import { prediction, verdict } from "./view/sentences.ts";
import type { Status } from "../shared/status.ts";

export interface Views {
  readonly screen: Screen;
  readonly fan: Fan;
  readonly chart: Chart;
  readonly status: Status;
  readonly probabilityList: ProbabilityList;
  readonly numbers: Numbers;
}

/** The history is no coarser than this, however seldom the page is drawn (seconds). */
const RESOLUTION = 0.016;

/** Milliseconds for which the light stays after a press, and in which it then fades. */
const AFTERGLOW = 700;
const FADE = 400;

/** The ghost and the example are pointers like any other; real ones have identifiers from 0. */
const GHOST = -1;
const EXAMPLE = -2;

export class Demonstration {
  readonly #predictions: Predictions;
  readonly #labels: readonly string[];
  readonly #views: Views;
  readonly #invitation: string;
  readonly #tally = new Tally();
  readonly #tracks = new Map<number, Track>();
  #boxes: readonly Box[];
  #settings: Settings;
  /** The pointer whose posterior is shown. */
  #shown: number | null = null;
  #frame: number | null = null;
  /** While the light of a press stays or fades. */
  #glowing: ReturnType<typeof setTimeout> | null = null;

  /** `invitation` is the text shown while nothing moves. */
  constructor(predictions: Predictions, settings: Settings, labels: readonly string[], invitation: string, views: Views) {
    this.#predictions = predictions;
    this.#settings = settings;
    this.#labels = labels;
    this.#invitation = invitation;
    this.#views = views;
    this.#boxes = views.screen.measure();
    this.#quieten();
    views.status.show(invitation);
  }

  /** Samples of one pointer, oldest first. */
  move(pointerId: number, samples: readonly Sample[]): void {
    if (this.#learn(pointerId, samples)) this.#frame ??= requestAnimationFrame(() => this.#draw());
  }

  /** A pointer pressed at `sample`: on an icon, or with null on none of them. What is learnt at the press itself comes too late. */
  press(pointerId: number, { time }: Sample, index: number | null): void {
    const track = this.#track(pointerId);
    const heard = track.heard;
    const belief = heard && heard.time < time ? this.#record(pointerId, track) : null;
    if (belief && this.#shown === pointerId) this.#paint(pointerId, track, belief);
    const judged = track.press(time, index);
    if (heard) this.#glow();
    if (index === null) return;
    this.#views.screen.acknowledge(index);
    if (!judged) {
      // the second press of a double one
      if (this.#glowing === null) this.#reportUnpredicted(index);
      return;
    }
    const { outcome, moments } = judged;
    this.#views.chart.draw(moments, outcome);
    this.#views.numbers.last(outcome, pointerId === GHOST);
    if (pointerId === GHOST) return;
    this.#tally.add(outcome);
    const summary = this.#tally.summary();
    if (summary) this.#views.numbers.total(summary);
    const label = this.#labels[index];
    this.#views.status.show(`${label} pressed.`);
    this.#views.status.announce(`${label} pressed: ${verdict(outcome, this.#labels)}.`, true);
  }

  /** Enter or an assistive tool: there is no movement to judge. */
  pressWithoutPointer(index: number): void {
    if (this.#glowing === null) this.#quieten();
    this.#views.screen.acknowledge(index);
    this.#reportUnpredicted(index);
  }

  /** A pointer turned away from the screen; it may come back. */
  lose(pointerId: number): void {
    this.#tracks.get(pointerId)?.forget();
    if (this.#shown !== pointerId) return;
    this.#shown = null;
    if (this.#glowing !== null) return;
    this.#quieten();
    this.#views.status.write(this.#invitation);
  }

  /** The page is hidden: every movement is over. */
  hide(): void {
    for (const pointerId of this.#tracks.keys()) this.lose(pointerId);
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
    for (const track of this.#tracks.values()) track.forget();
    this.#quieten();
  }

  /** Where the icons are: they may have moved. While the page is taken down or not laid out they have no size, and stay where they were. */
  place(): readonly Box[] {
    const targets = this.#views.screen.measure();
    if (targets.every(({ width, height }) => width > 0 && height > 0)) {
      this.#boxes = targets;
      this.#predictions.place(targets);
    }
    return this.#boxes;
  }

  /** A finished movement of a simulated hand, for a chart that has nothing of its own to show yet. */
  example(from: number, to: number): void {
    const [start, end] = [this.#boxes[from], this.#boxes[to]];
    if (!start || !end) return;
    const hand = reach(start, end, Math.min(end.width, end.height), seeded(5));
    const pressed = hand.duration + 0.1;
    const samples = Array.from({ length: Math.floor(hand.duration * 100) }, (_, step) => ({
      time: step / 100,
      ...hand.at(step / 100),
    }));
    this.#learn(EXAMPLE, samples);
    const judged = this.#track(EXAMPLE).press(pressed, to);
    this.forget(EXAMPLE);
    if (!judged) return;
    this.#views.chart.draw(judged.moments, judged.outcome, true);
    this.#views.numbers.example(judged.outcome);
  }

  /** The stage on which the ghost plays. */
  ghost(): Stage {
    return {
      targets: () => this.#boxes,
      visible: () => this.#views.screen.isVisible(),
      enter: () => this.#views.status.announce("A simulated hand shows how it works. Move to take over."),
      move: (sample) => this.move(GHOST, [sample]),
      press: (index, sample) => this.press(GHOST, sample, index),
      gone: () => {
        this.forget(GHOST);
        this.#quieten();
        this.#views.status.write(this.#invitation, true);
      },
    };
  }

  #track(pointerId: number): Track {
    let track = this.#tracks.get(pointerId);
    if (!track) {
      track = new Track();
      this.#tracks.set(pointerId, track);
    }
    return track;
  }

  /** Whether there was something to learn. */
  #learn(pointerId: number, samples: readonly Sample[]): boolean {
    const track = this.#track(pointerId);
    let learnt = false;
    for (const sample of samples) {
      // where a movement begins, the icons may have moved without an event
      const cut = track.add(sample, () => this.place());
      if (cut.fresh) this.#predictions.begin(pointerId);
      if (cut.samples.length === 0) continue;
      this.#predictions.observe(pointerId, cut.samples);
      this.#shown = pointerId;
      learnt = true;
      if (sample.time - (track.movement?.history.moments.at(-1)?.time ?? -Infinity) >= RESOLUTION) this.#record(pointerId, track);
    }
    return learnt;
  }

  /** Writes the belief at the latest sample into the movement's history. */
  #record(pointerId: number, track: Track): Belief | null {
    if (!track.heard) return null;
    const belief = this.#predictions.belief(pointerId, track.heard.time);
    track.record(belief.probabilities, belief.none, this.#settings.threshold);
    return belief;
  }

  #draw(): void {
    this.#frame = null;
    const track = this.#shown === null ? undefined : this.#tracks.get(this.#shown);
    const belief = this.#shown !== null && track ? this.#record(this.#shown, track) : null;
    if (this.#shown !== null && track && belief) this.#paint(this.#shown, track, belief);
  }

  #paint(pointerId: number, track: Track, belief: Belief): void {
    if (!track.movement || !track.heard) return;
    this.#cancel();
    const { intent, history } = track.movement;
    this.#views.screen.paint(belief.probabilities, intent.current);
    this.#views.probabilityList.paint(belief);
    const outlook = this.#predictions.outlook(pointerId, track.heard.time, this.#views.probabilityList.leading(3));
    if (outlook) this.#views.fan.draw(outlook, belief.probabilities);
    this.#views.chart.draw(history.moments, null);
    this.#views.numbers.movement(pointerId === GHOST);
    const label = (index: number | null) => (index === null ? null : (this.#labels[index] ?? null));
    const sentence = prediction(label(intent.current), label(intent.leaving));
    if (pointerId === GHOST) this.#views.status.show(`A simulated hand. ${sentence}`);
    else this.#views.status.write(sentence);
  }

  #reportUnpredicted(index: number): void {
    this.#views.status.write(`${this.#labels[index]} pressed, without a movement to predict it from.`, true);
  }

  /** The light of a press stays, then fades, unless the pointer moves before. */
  #glow(): void {
    this.#cancel();
    this.#glowing = setTimeout(() => {
      this.#quieten(true);
      this.#glowing = setTimeout(() => this.#quieten(), FADE);
    }, AFTERGLOW);
  }

  /** Cancels what is still to fade or to be drawn. */
  #cancel(): void {
    if (this.#frame !== null) cancelAnimationFrame(this.#frame);
    this.#frame = null;
    if (this.#glowing !== null) clearTimeout(this.#glowing);
    this.#glowing = null;
    this.#views.screen.fade(false);
  }

  /** Back to the prior. */
  #quieten(fading = false): void {
    this.#cancel();
    const prior = this.#predictions.prior();
    this.#views.screen.fade(fading);
    this.#views.screen.paint(prior.probabilities, null);
    this.#views.probabilityList.paint(prior);
    if (!fading) this.#views.fan.clear();
  }
}
