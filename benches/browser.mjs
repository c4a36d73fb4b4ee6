// The part in Chromium: wall-clock time of the page's one thread. Bundled by scripts/bench.mjs, called from outside.
import { ForesightManager } from "js.foresight";
import { init, pointerScenario, Predictor } from "whither";
import { init as initPointing, PointerPredictor } from "whither/pointing";
import { cases } from "./cases.mjs";
import { interleave } from "./measure.mjs";
import { effort, measureCases } from "./suite.mjs";

const clock = () => performance.now();

/** What one pointer event costs with ForesightJS, with ours and with an empty listener: 21 elements, none of which is hit. */
async function measureForesight(options) {
  const count = 21;
  // It works in animation frames, of which a headless page has few: here a frame is over as soon as it is requested.
  const frames = [];
  globalThis.requestAnimationFrame = (callback) => frames.push(callback);
  globalThis.cancelAnimationFrame = () => {};
  let called = 0;
  const manager = ForesightManager.initialize({ enableTabPrediction: false, enableScrollPrediction: false });
  const size = 60;
  const targets = Array.from({ length: count }, (_, i) => ({
    id: `d${i}`,
    x: 100 + 150 * (i % 7),
    y: 200 + 150 * Math.floor(i / 7),
    width: size,
    height: size,
  }));
  for (const { x, y } of targets) {
    const element = document.createElement("div");
    const place = { left: `${x - size / 2}px`, top: `${y - size / 2}px`, width: `${size}px`, height: `${size}px` };
    Object.assign(element.style, { position: "absolute", ...place });
    document.body.append(element);
    manager.register({ element, callback: () => called++ });
  }
  await new Promise((resolve) => setTimeout(resolve, 500));
  const visible = [...manager.getManagerData.registeredElements.values()].filter((state) => state.isIntersectingWithViewport);
  if (visible.length !== count) throw new Error(`ForesightJS tracks ${visible.length} elements of ${count}`);

  // Above all the elements: whatever is called back is not looked at any more.
  let next = 0;
  const dispatch = (target, after) => (times) => {
    for (let k = 0; k < times; k++, next++) {
      const clientX = 600 + 500 * Math.sin(next / 40);
      target.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY: 40, pointerType: "mouse" }));
      after?.();
    }
  };
  await initPointing();
  const predictor = new PointerPredictor(targets);
  const into = new Float64Array(count);
  let time = 0;
  const ours = new EventTarget();
  ours.addEventListener("pointermove", ({ clientX, clientY }) => {
    predictor.observe((time += 0.008), [clientX, clientY]);
    predictor.probabilities(into);
  });
  const idle = new EventTarget();
  idle.addEventListener("pointermove", () => {});
  const frame = () => frames.splice(0).forEach((callback) => callback(0));
  const entries = [
    { name: "theirs", run: dispatch(document, frame) },
    { name: "ours", run: dispatch(ours) },
    { name: "idle", run: dispatch(idle) },
  ];
  const spent = interleave(entries, clock, options);
  if (called > 0) throw new Error("an element was hit, so that ForesightJS had less to do");
  const [{ x: clientX, y: clientY }] = targets;
  document.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY, pointerType: "mouse" }));
  frame();
  if (called === 0) throw new Error("ForesightJS did not handle the pointer event");
  const net = (name) => 1000 * (spent[name] - spent.idle);
  return { microseconds: net("theirs"), ours: net("ours") };
}

globalThis.measure = async (quick) => {
  await init();
  const options = effort(quick);
  const progress = (name) => globalThis.progress(`Chromium: ${name}`);
  const whither = { Predictor, pointerScenario };
  return {
    ...(await measureCases("in Chromium", whither, cases({ quick }), clock, options, progress)),
    foresight: (await progress("ForesightJS, one pointer event"), await measureForesight(options)),
  };
};
