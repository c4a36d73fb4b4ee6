/** Puts the page of the sequences together: settings in, flights and predictions out. */
import { init } from "whither";
import { begin, part } from "../shared/page.ts";
import { Playback } from "../shared/playback.ts";
import { onResolution } from "../shared/resolution.ts";
import { theme } from "../shared/theme.ts";
import { Status } from "../shared/status.ts";
import { Airliner, at, PAPER, STEPS, type Prediction, type Settings } from "./airliner.ts";
import { Controls } from "./controls.ts";
import example from "./example.js?raw";
import { length } from "./length.ts";
import { FlightMap } from "./map.ts";
import { Waypoint } from "./waypoint.ts";

/** As many measurements as in the paper's Figure 2. */
const MEASURED = 9;
/** Milliseconds from one measurement to the next while it plays. */
const PACE = 110;

const status = new Status(part("status"), part("announcement"));
part("listing").textContent = example.trim();

async function start(): Promise<void> {
  const map = new FlightMap(part<HTMLCanvasElement>("canvas"));
  await init();
  await document.fonts.ready;

  let settings: Settings = PAPER;
  let seed = 7;
  let airliner = new Airliner(settings, seed);
  const playback = new Playback(
    { play: part("play"), slider: part("measured") },
    { last: STEPS - 1, pace: PACE, text: (step) => `${step} of ${STEPS} steps`, moved: () => refresh(false) },
    MEASURED,
  );

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
    const measured = playback.place;
    const { directed, markov } = airliner.predict(measured);
    map.draw(airliner, measured, directed);
    const end = at(airliner.followed, STEPS);
    part("so-far").textContent = `${measured} of ${STEPS}`;
    part("deviation").textContent = length(deviation(directed));
    part("markov-deviation").textContent = length(deviation(markov));
    part("error").textContent = length(error(directed, end.x, end.y));
    part("markov-error").textContent = length(error(markov, end.x, end.y));
    part("kind").textContent = airliner.kind();
    part("given").textContent = given(settings);
    part("remove").hidden = settings.waypoint === null;
    status.show(known(measured, directed, markov));
    if (!playback.playing) status.announce(known(measured, directed, markov));
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

/** What the two models know before the first measurement. */
function given({ destination, waypoint }: Settings): string {
  const also = waypoint === null ? "" : ", and the waypoint";
  return `Both are given how an airliner moves and where the flight began. The first is also given where it will land, to ${length(destination)}${also}.`;
}

/** The numbers in a sentence. */
function known(measured: number, directed: Prediction, markov: Prediction): string {
  const after = measured === 1 ? "After 1 measurement" : `After ${measured} measurements`;
  return `${after} the landing place is known to ${length(deviation(directed))}; to ${length(deviation(markov))} from the motion alone.`;
}

/** One deviation of the landing place, over both axes. */
function deviation({ end: { mean, covariance } }: Prediction): number {
  return Math.sqrt(((covariance[0] ?? 0) + (covariance[mean.length + 1] ?? 0)) / 2);
}

function error({ end: { mean } }: Prediction, x: number, y: number): number {
  return Math.hypot((mean[0] ?? 0) - x, (mean[1] ?? 0) - y);
}

begin(status, start);
