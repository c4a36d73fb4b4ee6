/** Puts the page of the sequences together: settings in, flights and predictions out. */
import { init } from "whither";
import { onResolution } from "../shared/resolution.ts";
import { theme } from "../shared/theme.ts";
import { Status } from "../shared/status.ts";
import { Airliner, at, PAPER, STEPS, type Prediction, type Settings } from "./airliner.ts";
import { Controls } from "./controls.ts";
import { length } from "./length.ts";
import { FlightMap } from "./map.ts";
import { Waypoint } from "./waypoint.ts";

/** As many measurements as in the paper's Figure 2. */
const MEASURED = 9;
/** Milliseconds from one measurement to the next while it plays. */
const PACE = 110;

/** An element that index.html promises. */
function part<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

const status = new Status(part("status"), part("announcement"));

async function start(): Promise<void> {
  const map = new FlightMap(part<HTMLCanvasElement>("canvas"));
  const slider = part<HTMLInputElement>("measured");
  const play = part<HTMLButtonElement>("play");
  await init();
  await document.fonts.ready;

  let settings: Settings = PAPER;
  let seed = 7;
  let measured = MEASURED;
  let airliner = new Airliner(settings, seed);
  let playing = 0;

  /** Everything is drawn once a frame, from what is then the case. */
  let stale = { model: false, frame: 0 };
  const refresh = (model: boolean) => {
    stale.model ||= model;
    stale.frame ||= requestAnimationFrame(draw);
  };
  const draw = () => {
    if (stale.model) {
      airliner.free();
      airliner = new Airliner(settings, seed);
    }
    stale = { model: false, frame: 0 };
    const { directed, markov } = airliner.predict(measured);
    map.draw(airliner, measured, directed);
    slider.value = String(measured);
    slider.setAttribute("aria-valuetext", `${measured} of ${STEPS} steps`);
    const end = at(airliner.followed, STEPS);
    part("so-far").textContent = `${measured} of ${STEPS}`;
    part("deviation").textContent = length(deviation(directed));
    part("markov-deviation").textContent = length(deviation(markov));
    part("error").textContent = length(error(directed, end.x, end.y));
    part("markov-error").textContent = length(error(markov, end.x, end.y));
    part("kind").textContent = airliner.kind();
    part("remove").hidden = settings.waypoint === null;
    status.show(known(measured, directed, markov));
    if (!playing) status.announce(known(measured, directed, markov));
  };

  const set = (change: Partial<Settings>) => {
    settings = { ...settings, ...change };
    refresh(true);
  };
  const waypoint = new Waypoint(part<HTMLButtonElement>("waypoint"), map, (place) => set({ waypoint: place }));
  const controls = new Controls(part<HTMLFormElement>("controls"), settings, set);
  part("remove").addEventListener("click", () => {
    waypoint.set(null);
    set({ waypoint: null });
  });
  part("paper").addEventListener("click", () => {
    controls.set(PAPER);
    waypoint.set(PAPER.waypoint);
    set(PAPER);
  });
  part("another").addEventListener("click", () => {
    seed += 1;
    refresh(true);
  });

  const stop = () => {
    clearInterval(playing);
    playing = 0;
    play.textContent = "Play";
    refresh(false);
  };
  play.addEventListener("click", () => {
    if (playing) return stop();
    if (measured >= STEPS - 1) measured = 0;
    play.textContent = "Pause";
    status.announce("Playing.");
    playing = window.setInterval(() => {
      measured += 1;
      if (measured >= STEPS - 1) stop();
      refresh(false);
    }, PACE);
  });
  slider.addEventListener("input", () => {
    measured = Number(slider.value);
    if (playing) stop();
    refresh(false);
  });

  const fit = () => {
    map.fit();
    waypoint.fit();
    refresh(false);
  };
  theme(part<HTMLButtonElement>("theme"), fit);
  new ResizeObserver(fit).observe(part("map"));
  onResolution(fit);
  refresh(false);
}

/** The numbers in a sentence. */
function known(measured: number, directed: Prediction, markov: Prediction): string {
  const after = measured === 1 ? "After 1 measurement" : `After ${measured} measurements`;
  return `${after} the landing place is known to ${length(deviation(directed))}; without a destination to ${length(deviation(markov))}.`;
}

/** One deviation of the landing place, over both axes. */
function deviation({ end: { mean, covariance } }: Prediction): number {
  return Math.sqrt(((covariance[0] ?? 0) + (covariance[mean.length + 1] ?? 0)) / 2);
}

function error({ end: { mean } }: Prediction, x: number, y: number): number {
  return Math.hypot((mean[0] ?? 0) - x, (mean[1] ?? 0) - y);
}

start().catch((error: unknown) => {
  status.write(`The sequences could not start: ${error instanceof Error ? error.message : String(error)}`, true);
  document.documentElement.dataset["failed"] = "true";
});
