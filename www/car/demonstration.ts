/** What the page shows of its two watchers: one follows the visitor, the other the ghost, which counts for nothing. */
import { watch, type Outcome, type Release, type Snapshot, type Watcher, type WatchOptions } from "whither/dom";
import { DEFAULTS, isSame, type Settings } from "./model/settings.ts";
import type { Ride } from "./devices.ts";
import { Errands } from "./errands.ts";
import { GHOST, type Stage } from "./ghost.ts";
import type { Point } from "./geometry.ts";
import { History } from "./history.ts";
import type { Press } from "./press.ts";
import { SHAKEN } from "./shaken.ts";
import type { ProbabilityList } from "./view/probabilities.ts";
import type { Chart } from "./view/chart.ts";
import type { Fan } from "./view/fan.ts";
import type { Numbers } from "./view/numbers.ts";
import { ranking } from "../shared/ranking.ts";
import type { Screen } from "./view/screen.ts";
import { outcome, prediction } from "./view/sentences.ts";
import type { Status } from "../shared/status.ts";

export interface Views {
  readonly screen: Screen;
  readonly fan: Fan;
  readonly chart: Chart;
  readonly status: Status;
  readonly probabilityList: ProbabilityList;
  readonly numbers: Numbers;
  /** Counts what was selected at the threshold. */
  readonly tally: HTMLElement;
}

type Icon = HTMLButtonElement;

/** The ring is the posterior's alone: what a pointer rests on, or what has the focus, closes none. */
const REASONS: WatchOptions["reasons"] = { hover: false, press: false, focus: false, touch: false, scroll: false };

/** So many of the most probable icons have a path, and seconds from now for which its places are drawn: to the last arrival. */
const PATHS = 3;
const SECONDS = Array.from({ length: 14 }, (_, step) => (1.2 * step) / 13);

/** The ellipse is that of the arrival, and at least so far ahead (seconds): nearer it would be a dot. */
const AHEAD = 0.15;

/** Until an icon is as probable as this, a movement shows nothing, and what is shown of the last one stays. */
const NOTICEABLE = 0.1;

/** Milliseconds for which the light stays after a movement, and in which it then fades. */
const AFTERGLOW = 700;
const FADE = 400;

export class Demonstration {
  readonly #labels: readonly string[];
  readonly #views: Views;
  readonly #invitation: string;
  readonly #visitor: Watcher<Icon>;
  readonly #ghost: Watcher<Icon>;
  readonly #errands: Errands;
  readonly #history = new History();
  #settings = DEFAULTS;
  /** Whether the ghost plays. */
  #simulated = false;
  /** The icons that are ringed, in the order in which their rings closed. */
  readonly #ringed = new Set<Icon>();
  #corner: Point | null = null;
  /** Whether rows and chart are of the movement under way. */
  #drawn = false;
  /** The icon whose press by a pointer was judged, until its click. */
  #judged: Icon | null = null;
  /** While the light of a movement that is over stays or fades. */
  #glowing: ReturnType<typeof setTimeout> | null = null;
  /** Whether it stays because of a press. */
  #pressed = false;
  /** Whether the sentence is the outcome of a press, which stays until the next movement. */
  #reported = false;

  /** `invitation` is the text shown while nothing moves. */
  constructor(labels: readonly string[], invitation: string, views: Views) {
    this.#labels = labels;
    this.#invitation = invitation;
    this.#views = views;
    this.#errands = new Errands(labels, views, () => this.#rest(this.#simulated));
    this.#visitor = this.#watch(false);
    this.#ghost = this.#watch(true);
    this.#ghost.pause();
    addEventListener("scroll", () => (this.#corner = null), { capture: true, passive: true });
    views.status.show(invitation);
  }

  /** A press that a watcher judges is shown already; the others had no movement. */
  press(index: number, pointed: boolean): void {
    const { screen, status } = this.#views;
    const judged = pointed && screen.icons[index] === this.#judged;
    this.#judged = null;
    if (judged) return;
    // the second press of a double one
    const again = pointed && this.#pressed;
    if (this.#glowing === null) this.#quieten();
    screen.acknowledge(index);
    if (again) return;
    this.#reported = true;
    status.write(`${this.#labels[index]} pressed, without a movement to predict it from.`, true);
  }

  /** Takes settings: those that need other models than the default one load them first. */
  async configure(settings: Settings): Promise<void> {
    const before = this.#settings;
    this.#settings = settings;
    const update = (options: WatchOptions<Icon>) => {
      for (const watcher of [this.#visitor, this.#ghost]) watcher.update(options);
    };
    update({ threshold: settings.threshold, none: settings.none });
    if (isSame(settings, before)) return;
    const options = isSame({ ...settings, shake: 0 }, DEFAULTS)
      ? { constants: { pointing: { shake: settings.shake } }, predictor: undefined }
      : await (await import("./model/models.ts")).optionsOf(settings);
    if (isSame(settings, this.#settings)) update(options);
  }

  /** Follows the visitor's pointer itself, or what is handed on of it in its place. */
  follow(handedOn: boolean): void {
    this.#visitor.update({ pointers: handedOn ? [SHAKEN] : undefined });
  }

  /** Whether icons are selected when the ring closes. */
  select(active: boolean): void {
    this.#errands.activate(active);
    this.#reported = false;
    this.#rest(this.#simulated, true);
  }

  /** The stage on which the ghost plays. */
  stage(ride: () => Ride): Stage {
    const { screen, status } = this.#views;
    return {
      targets: () => screen.measure(),
      corner: () => screen.corner(),
      visible: () => screen.isVisible(),
      ride,
      enter: () => {
        status.announce("A simulated hand shows how it works. Move to take over.");
        this.#simulated = true;
        this.#errands.enter(true);
        this.#ghost.resume();
      },
      heads: (index) => this.#errands.heads(index),
      presses: () => !this.#errands.active,
      gone: () => {
        this.#ghost.pause();
        this.#simulated = false;
        this.#errands.enter(false);
        this.#quieten();
        this.#reported = false;
        this.#rest(false, true);
      },
    };
  }

  #watch(simulated: boolean): Watcher<Icon> {
    const { icons } = this.#views.screen;
    const watcher = watch<Icon>(icons, {
      threshold: DEFAULTS.threshold,
      none: DEFAULTS.none,
      reasons: REASONS,
      reactivate: 0,
      load: "eager",
      learning: !simulated,
      target: (icon) => ({ name: this.#labelOf(icon) }),
      pointers: simulated ? [GHOST] : undefined,
      onIntent: ({ target, remaining }) => {
        this.#ringed.add(target);
        this.#errands.ringed(target, remaining);
        this.#describe(simulated);
      },
      onRelease: (release) => this.#release(release, simulated),
      onPrediction: (snapshot) => this.#paint(watcher, snapshot, simulated),
      onOutcome: (outcome) => this.#judge(outcome, simulated),
    });
    return watcher;
  }

  #paint(watcher: Watcher<Icon>, { moving, none, intended }: Snapshot<Icon>, simulated: boolean): void {
    const { screen, probabilityList, fan, chart, numbers } = this.#views;
    if (!moving) {
      this.#history.end();
      this.#corner = null;
      probabilityList.rest(this.#drawn ? (simulated ? "The simulated hand’s last" : "Your last movement") : null);
      this.#drawn = false;
      this.#errands.rested();
      // what is ringed stays lit under a pointer that rests on it
      if (this.#glowing !== null || intended.length > 0) return;
      this.#glow(null);
      this.#rest(simulated);
      return;
    }
    this.#cancel();
    this.#reported = false;
    const probabilities = Float64Array.from(screen.icons, (icon) => watcher.probability(icon));
    const { remaining } = watcher;
    this.#history.add({ time: performance.now() / 1000, probabilities });
    this.#corner ??= screen.corner();
    screen.paint(probabilities);
    this.#describe(simulated);
    probabilityList.move(none);
    this.#drawn ||= Math.max(...probabilities) > NOTICEABLE;
    if (!this.#drawn) return;
    probabilityList.paint({ probabilities, none, remaining });
    const leading = ranking(probabilities).slice(0, PATHS);
    const paths = leading.flatMap((index) => {
      const icon = screen.icons[index];
      return icon ? { probability: probabilities[index] ?? 0, points: watcher.path(icon, SECONDS) } : [];
    });
    const arrival = remaining && watcher.forecast(Math.max(AHEAD, remaining.mean));
    fan.draw({ paths, arrival }, this.#corner);
    chart.draw(this.#history.current, null);
    numbers.movement(simulated);
  }

  /** A ring opens; that of the pressed icon stays as long as its light. */
  #release({ target, pressed }: Release<Icon>, simulated: boolean): void {
    this.#ringed.delete(target);
    if (pressed) this.#glowPressed(target);
    else if (this.#glowing === null) this.#describe(simulated);
  }

  #judge(judged: Outcome<Icon>, simulated: boolean): void {
    const { screen, chart, numbers, status } = this.#views;
    const press: Press = {
      index: screen.icons.indexOf(judged.target),
      label: judged.name ?? "",
      time: judged.time / 1000,
      verdict: judged.verdict,
      mistaken: judged.mistaken && this.#labelOf(judged.mistaken),
      lead: judged.lead,
    };
    if (!this.#pressed) this.#glowPressed(null);
    screen.acknowledge(press.index);
    chart.draw(this.#history.take(press.time - press.lead), press);
    numbers.last(press.label, simulated);
    this.#reported = true;
    const text = outcome(press, simulated);
    if (simulated) {
      status.show(`A simulated hand. ${text}`);
      return;
    }
    this.#judged = judged.target;
    const summary = this.#visitor.ledger.summary();
    if (summary) numbers.total(summary, judged.learnt);
    this.#errands.pressed(press.index);
    status.write(this.#errands.sentence ?? text, true);
  }

  #labelOf(icon: Icon): string {
    return this.#labels[this.#views.screen.icons.indexOf(icon)] ?? "";
  }

  #describe(simulated: boolean): void {
    const ringed = [...this.#ringed].at(-1);
    const text = this.#errands.sentence ?? prediction(ringed ? this.#labelOf(ringed) : null);
    if (simulated) this.#views.status.show(`A simulated hand. ${text}`);
    else this.#views.status.write(text);
  }

  /** The sentence between movements: the outcome of a press stays. */
  #rest(simulated: boolean, now = false): void {
    if (this.#reported) return;
    const { sentence } = this.#errands;
    const text = sentence ?? this.#invitation;
    if (simulated) this.#views.status.show(sentence ? `A simulated hand. ${sentence}` : text);
    else if (now || sentence) this.#views.status.write(text, now);
    else this.#views.status.show(text);
  }

  #glowPressed(held: Icon | null): void {
    this.#glow(held);
    this.#pressed = true;
  }

  /** The light of a movement that is over stays, with the ring of an icon, then fades, unless the pointer moves before. */
  #glow(held: Icon | null): void {
    this.#cancel();
    this.#views.screen.hold(held);
    this.#glowing = setTimeout(() => {
      this.#quieten(true);
      this.#glowing = setTimeout(() => this.#quieten(), FADE);
    }, AFTERGLOW);
  }

  /** Cancels what is still to fade. */
  #cancel(): void {
    if (this.#glowing !== null) clearTimeout(this.#glowing);
    this.#glowing = null;
    this.#pressed = false;
    this.#views.screen.fade(false);
    this.#views.screen.hold(null);
  }

  /** As between movements: dark, and what was last known of the probabilities stays, faint. */
  #quieten(fading = false): void {
    const { screen, fan } = this.#views;
    this.#cancel();
    screen.fade(fading);
    screen.paint(new Float64Array(screen.icons.length));
    if (!fading) fan.clear();
  }
}
