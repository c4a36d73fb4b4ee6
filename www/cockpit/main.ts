/** Puts the cockpit together: a hand that is replayed or driven, what is predicted, and the methods compared. */
import { init } from "whither";
import { percent } from "../shared/format.ts";
import { begin, part } from "../shared/page.ts";
import { PLACES } from "../shared/places.ts";
import { onResolution } from "../shared/resolution.ts";
import { showValue } from "../shared/slider.ts";
import { Status } from "../shared/status.ts";
import { theme } from "../shared/theme.ts";
import { LABELS, TARGETS } from "./cabin.ts";
import { Driven } from "./driven.ts";
import example from "./example.js?raw";
import { Experiment } from "./experiment/experiment.ts";
import type { Moment } from "./forecast.ts";
import { Panel } from "./panel.ts";
import { PosteriorChart } from "./posterior.ts";
import { Replayed } from "./replayed.ts";
import type { Road } from "./road.ts";
import { FROM_THE_SEAT, type Turn } from "./view/camera.ts";
import { trace } from "./view/glyphs.ts";
import { Stage } from "./view/stage.ts";

/** A road as a car has it on cobbles; and degrees for a press on a button. */
const ROAD: Road = { deviation: 4, frequency: 6 };
const TURN = 8;
const TURNS: Readonly<Record<string, Turn>> = {
  left: { azimuth: -TURN, elevation: 0 },
  right: { azimuth: TURN, elevation: 0 },
  up: { azimuth: 0, elevation: TURN },
  down: { azimuth: 0, elevation: -TURN },
};

const status = new Status(part("status"), part("announcement"));
part("listing").textContent = example.trim();

async function start(): Promise<void> {
  await init();
  await document.fonts.ready;
  const { whereTo } = await import("./example.js");
  const stage = await Stage.on(part("scene"), trace(PLACES.map(({ icon }) => icon)));
  const panel = new Panel({ rows: part("rows"), none: part("none"), remaining: part("remaining"), interval: part("interval") });
  const posterior = new PosteriorChart(part("posterior"));
  const controls = part<HTMLFormElement>("controls");
  const field = (name: string) => controls.elements.namedItem(name) as HTMLInputElement;
  let road = ROAD;

  /** Everything is drawn once a frame, from what is then the case. */
  let frame = 0;
  /** The movement on which the example ran. */
  let ran: readonly Moment[] = [];
  const refresh = () => {
    if (frame === 0) frame = requestAnimationFrame(draw);
  };
  const draw = (now: number) => {
    frame = 0;
    const scene = hand.scene(now / 1000);
    const shake = field("shake").checked;
    const [moments, others] = shake ? [scene.moments.shake, scene.moments.calm] : [scene.moments.calm, scene.moments.shake];
    const moment = moments[scene.at] ?? null;
    const over = scene.touched && scene.at >= moments.length - 1;
    stage.draw({ trail: scene.trail, moment, touched: over ? scene.hit : null });
    panel.show(moment, over);
    posterior.draw({ ...scene, moments, others, shake });
    const words = scene.words(moments);
    status.show(words);
    if (!scene.playing) status.announce(words);
    if (over && ran !== moments) {
      ran = moments;
      const samples = moments.map(({ sample }) => sample);
      const { index, probability } = whereTo(TARGETS, samples);
      part("ran").textContent =
        `They ran just now, on the ${samples.length} samples of this movement: ${LABELS[index]} ${percent(probability)}.`;
    }
    if (hand === driven) refresh();
  };
  const replayed = new Replayed(
    { play: part("play"), time: part("time"), another: part("another"), root: part("playback") },
    road,
    refresh,
  );
  const driven = new Driven(
    {
      stage: part("scene"),
      handle: part("handle"),
      distance: part("distance"),
      shown: part("distance-shown"),
      root: part("driving"),
    },
    stage.camera,
  );
  let hand: Replayed | Driven = replayed;

  part("modes").addEventListener("change", ({ target }) => {
    const next = (target as HTMLInputElement).value === "drive" ? driven : replayed;
    hand.leave();
    hand = next;
    hand.enter(road);
    refresh();
  });
  const setRoad = () => {
    road = { deviation: Number(field("deviation").value), frequency: Number(field("frequency").value) };
    showValue(controls, "deviation", `${road.deviation} mm`);
    showValue(controls, "frequency", `${road.frequency} Hz`);
    part("other-model").textContent = field("shake").checked ? "without shake" : "with shake";
    hand.drive(road);
    refresh();
  };
  field("deviation").value = String(ROAD.deviation);
  field("frequency").value = String(ROAD.frequency);
  controls.addEventListener("input", setRoad);
  controls.addEventListener("submit", (event) => event.preventDefault());
  setRoad();

  for (const button of document.querySelectorAll<HTMLElement>("[data-turn]")) {
    button.addEventListener("click", () => {
      const { azimuth, elevation } = stage.camera.turn;
      const by = TURNS[button.dataset["turn"] ?? ""];
      stage.camera.turnTo(by ? { azimuth: azimuth + by.azimuth, elevation: elevation + by.elevation } : FROM_THE_SEAT);
      driven.turned();
      refresh();
    });
  }

  const experiment = new Experiment(
    {
      chart: part("curves"),
      table: part("scores"),
      run: part("run"),
      progress: part("progress"),
      state: part("hundred-state"),
      equal: part("equal"),
    },
    () => road,
  );
  whenVisible(part("hundred"), () => experiment.startOnce());

  const fit = () => {
    stage.fit();
    driven.turned();
    refresh();
  };
  theme(part("theme"), () => {
    fit();
    posterior.restyle();
    experiment.restyle();
  });
  new ResizeObserver(fit).observe(part("scene"));
  onResolution(fit);
  stage.onLost(() => {
    stage.replace();
    refresh();
  });
  draw(performance.now());
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) replayed.begin();
}

/** Once, when an element comes into view. */
function whenVisible(element: HTMLElement, then: () => void): void {
  const observer = new IntersectionObserver(([entry]) => {
    if (!entry?.isIntersecting) return;
    observer.disconnect();
    then();
  });
  observer.observe(element);
}

begin(status, start);
