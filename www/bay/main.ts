/** Puts the bay together: one vessel or a hundred, a playback for both, and everything drawn once a frame. */
import { init } from "whither";
import { begin, part } from "../shared/page.ts";
import { Playback } from "../shared/playback.ts";
import { onResolution } from "../shared/resolution.ts";
import { Status } from "../shared/status.ts";
import { theme } from "../shared/theme.ts";
import { Controls } from "./controls.ts";
import example from "./example.js?raw";
import { Hundred } from "./hundred.ts";
import { OneVessel } from "./one-vessel.ts";
import { DEFAULT } from "./scenario.ts";
import { TICK, type Scene } from "./scene.ts";
import { View } from "./view.ts";

/** Milliseconds of a frame that go into predictions. */
const BUDGET = 8;
/** Milliseconds of a frame. */
const FRAME = 17;

const status = new Status(part("status"), part("announcement"));
part("listing").textContent = example.trim();

async function start(): Promise<void> {
  await init();
  await document.fonts.ready;
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const speed = part<HTMLSelectElement>("speed");
  const rate = () => Number(speed.value);
  const pace = () => (1000 * TICK) / rate();

  let scene: Scene | null = null;
  let frame = 0;
  const draw = () => {
    frame = 0;
    const done = scene?.draw(performance.now() + BUDGET) ?? true;
    part("chart").setAttribute("aria-busy", String(!done));
    if (!done) refresh();
  };
  const refresh = () => {
    if (frame === 0) frame = requestAnimationFrame(draw);
  };
  const playback = new Playback(
    { play: part("play"), slider: part("time") },
    { last: 0, pace: pace(), text: (place) => scene?.text(place) ?? "", moved: refresh },
  );
  const view = new View(status);
  const one = new OneVessel(view, playback, DEFAULT, rate);
  let hundred: Hundred | null = null;

  /** Where each scene was left. */
  const places = new Map<Scene, number>();
  const show = (next: Scene) => {
    if (scene) places.set(scene, playback.place);
    scene = next;
    playback.change({ last: next.last });
    playback.set(places.get(next) ?? next.firstLook);
    next.enter();
    if (!calm) playback.play();
  };
  /** What the page consists of. */
  const arrange = (fleet: boolean) => {
    document.documentElement.dataset["mode"] = fleet ? "fleet" : "one";
    part("one").setAttribute("aria-pressed", String(!fleet));
    part("hundred").setAttribute("aria-pressed", String(fleet));
    for (const id of ["vessel", "voyage-choice", "helm-help", "controls"]) part(id).hidden = fleet;
    for (const id of ["fleet-help", "master"]) part(id).hidden = !fleet;
  };
  part("one").addEventListener("click", () => {
    arrange(false);
    show(one);
  });
  part("hundred").addEventListener("click", () => {
    arrange(true);
    part("chart").setAttribute("aria-busy", "true");
    // a hundred voyages are simulated once this is painted
    setTimeout(() => {
      hundred ??= new Hundred(view, playback);
      if (document.documentElement.dataset["mode"] === "fleet") show(hundred);
    }, 2 * FRAME);
  });
  speed.addEventListener("change", () => playback.change({ pace: pace() }));
  new Controls(part<HTMLFormElement>("model"), (settings) => one.set(settings));

  const fit = () => {
    view.fit();
    refresh();
  };
  theme(part<HTMLButtonElement>("theme"), fit);
  new ResizeObserver(fit).observe(part("chart"));
  onResolution(fit);
  view.fit();
  arrange(false);
  show(one);
  draw();
}

begin(status, start);
