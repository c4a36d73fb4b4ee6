// The page on which benches/dom.mjs measures what watching costs: a grid of targets, and a pointer at 1 kHz.
import { ForesightManager } from "js.foresight";
import { hand, random } from "whither/testing";

/** How targets are watched: each returns what tells whether it really works. */
const watchers = {
  none: () => ({ tracked: () => 0, work: () => 0 }),

  async whither() {
    const { watch } = await import("whither/dom");
    let predictions = 0;
    const watcher = watch(".target", { load: "eager", onPrediction: ({ best }) => (predictions += Number(best !== null)) });
    await watcher.ready;
    return { tracked: () => watcher.targets.length, work: () => predictions };
  },

  async foresight() {
    let called = 0;
    const manager = ForesightManager.initialize({ enableTabPrediction: false, enableScrollPrediction: false });
    const callback = () => called++;
    const register = (element) => manager.register({ element, callback, reactivateAfter: 0 });
    document.querySelectorAll(".target").forEach(register);
    // it is given each element by the page, which knows what it mounts; it finds by itself what is gone
    globalThis.mounted = (elements) => elements.forEach(register);
    // it keeps what is out of the document, parked
    const tracked = () => manager.getManagerData.registeredElements.size - manager.getManagerData.parkedElementCount;
    return { tracked, work: () => called };
  },
};

const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** Fills the window with so many targets and watches them. */
globalThis.prepare = async (name, columns, rows) => {
  const side = Math.min(innerWidth / columns, innerHeight / rows);
  const style = document.createElement("style");
  style.textContent = `body { margin: 0 } .target { position: absolute; width: ${side - 4}px; height: ${side - 4}px; background: #ccd }
    .row { position: static; width: auto; height: 20px }`;
  document.head.append(style);
  for (let k = 0; k < columns * rows; k++) {
    const target = document.createElement("div");
    target.className = "target";
    Object.assign(target.style, { left: `${side * (k % columns)}px`, top: `${side * Math.floor(k / columns)}px` });
    document.body.append(target);
  }
  globalThis.watched = await watchers[name]();
  await wait(500);
  return watched.tracked();
};

/** One event as the browser sends it before a frame: the samples since the last one, at their own times. */
function dispatch(samples) {
  const event = ([time, clientX, clientY], coalescedEvents = []) => {
    const init = {
      view: window,
      clientX,
      clientY,
      pointerType: "mouse",
      pointerId: 1,
      isPrimary: true,
      bubbles: true,
      composed: true,
    };
    const made = new PointerEvent("pointermove", { ...init, coalescedEvents });
    Object.defineProperty(made, "timeStamp", { value: time });
    return made;
  };
  document.body.dispatchEvent(
    event(
      samples.at(-1),
      samples.map((sample) => event(sample)),
    ),
  );
}

/** A hand that crosses the window in about a second, at 1 kHz, and goes on at once. */
const MANNER = { size: 30, rate: 1000, pace: 5, noise: 0.1, dwell: 0, resolution: 0 };

/** From one place to another for so many seconds, with no rest between; returns what the watcher has done meanwhile. */
globalThis.wander = async (seconds) => {
  const next = random(11);
  const place = () => ({ x: innerWidth * (0.1 + 0.8 * next()), y: innerHeight * (0.1 + 0.8 * next()) });
  const samples = [];
  for (let from = place(), time = 0; time < seconds; ) {
    const to = place();
    const part = hand(from, to, { ...MANNER, seed: samples.length });
    samples.push(...part.map(([at, x, y]) => [time + at, x, y]));
    time += part.at(-1)[0] + 0.001;
    from = to;
  }
  const before = watched.work();
  const start = performance.now();
  let sent = 0;
  let frames = 0;
  while (sent < samples.length) {
    await frame();
    // after the frame, in a task of its own: what it makes a watcher do belongs to the next one
    await new Promise((resolve) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = resolve;
      port2.postMessage(null);
    });
    frames++;
    performance.mark("bench-frame");
    const due = [];
    for (const now = performance.now(); sent < samples.length && start + 1000 * samples[sent][0] <= now; sent++) {
      const [time, x, y] = samples[sent];
      due.push([start + 1000 * time, x, y]);
    }
    if (due.length > 0) dispatch(due);
  }
  performance.mark("bench-end");
  return { frames, samples: sent, work: watched.work() - before };
};

/** Mounts so many rows and unmounts them; returns how many were tracked at most and at the end. */
globalThis.mountRows = async (count) => {
  const list = document.createElement("div");
  document.body.append(list);
  const before = watched.tracked();
  performance.mark("bench-mount");
  const rows = Array.from({ length: count }, () => {
    const row = document.createElement("div");
    row.className = "target row";
    return row;
  });
  list.append(...rows);
  globalThis.mounted?.(rows);
  for (let k = 0; k < 10; k++) await frame();
  performance.mark("bench-mounted");
  const most = watched.tracked() - before;
  performance.mark("bench-unmount");
  list.remove();
  for (let k = 0; k < 10; k++) await frame();
  performance.mark("bench-unmounted");
  return { most, left: watched.tracked() - before };
};
