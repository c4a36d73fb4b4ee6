// Pages whose watchers keep a log, and pointer events with a clock of their own, for what Chromium's own pointer cannot do.
import { movement } from "../browser/hand.mjs";
import { open as openPage, REST } from "./support.mjs";

export { hosted, mouse, nextFrame, REST } from "./support.mjs";

/** As `open` of the support, with what `prepare` gives the page. */
export function open(site, body, { head = "", ...options } = {}) {
  return openPage(site, body, { ...options, head: `<script>(${prepare})()</script>${head}` });
}

/** Buttons in their places: `[id, left, top, width, height]`. */
export const buttons = (...places) =>
  places
    .map(([id, left, top, width = 80, height = 60]) => {
      const box = `left:${left}px;top:${top}px;width:${width}px;height:${height}px`;
      return `<button id="${id}" style="position:absolute;${box}">${id}</button>`;
    })
    .join("");

/** Three buttons far apart, and the middle of each. */
export const CORNERS = buttons(["a", 80, 80], ["b", 840, 80], ["c", 840, 560]);
export const MIDDLE = { a: { x: 120, y: 110 }, b: { x: 880, y: 110 }, c: { x: 880, y: 590 } };

/** Eight buttons in a row, 100 px apart, with their middles at 150, 250, ... */
export const ROW = buttons(...[..."abcdefgh"].map((id, index) => [id, 110 + 100 * index, 320]));

/** Where nothing is, in both of them. */
export const AWAY = { x: 120, y: 640 };

/** What the page's log has of a kind. */
export const logged = (page, kind) => page.evaluate((kind) => log.filter((entry) => entry.kind === kind), kind);

/** Until the log has so many entries of a kind. */
export const until = (page, kind, count = 1) =>
  page.waitForFunction(([kind, count]) => log.filter((entry) => entry.kind === kind).length >= count, [kind, count], {
    timeout: 3000,
  });

export const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

/** What a watcher on the page has computed, after the next frame. */
export function read(page, name = "watcher") {
  return page.evaluate(async (name) => {
    await frames(2);
    return posterior(window[name]);
  }, name);
}

/** A hand of Chromium's own that goes to a place, from where it rests. */
export async function reach(hand, goal, { from = AWAY, ...options } = {}) {
  await hand.play([[0, from.x, from.y]]);
  await hand.rest(REST);
  await hand.play(movement(from, goal, 60, { seed: 1, ...options }));
}

/**
 * The page of a scripted posterior: `watcher` watches the row of eight with `options` (text), with a model that
 * returns what `step` is given. `step` moves the pointer up to 50 px below the most probable one, where as much is asked for as the threshold
 * has it, and returns after the frame that has the posterior.
 */
export async function scripted(site, options = "{}", body = ROW) {
  const opened = await open(site, body, {
    script: `window.watcher = record("button", { predictor: scriptedPredictor, rest: 600, ...${options} });
      await watcher.ready;
      await frames(3);`,
  });
  const { page } = opened;
  return {
    ...opened,
    /** Moves on by one event, after which the posterior is this: `{ c: 0.9 }`. */
    step: (posterior) => page.evaluate((posterior) => scriptedStep(posterior), posterior),
    /** The same pointer presses. */
    press: ({ x, y }) =>
      page.evaluate(
        async ([x, y]) => {
          press(x, y);
          await frames(2);
        },
        [x, y],
      ),
    /** A new movement: the pointer rests, then begins again. */
    rest: async () => {
      await sleep(0.7);
      await page.evaluate(() => scriptedStep({}));
      await page.evaluate(() => scriptedStep({}));
    },
  };
}

/** Runs in the page before anything else. */
function prepare() {
  window.log = [];
  window.nameOf = (target) => (target ? target.dataset?.name || target.id : null);
  window.frames = async (count) => {
    for (let i = 0; i < count; i += 1) await new Promise(requestAnimationFrame);
  };

  /** Watches with callbacks that write into the log. */
  window.record = (targets, options = {}, log = window.log) => {
    const add = (kind, entry) => log[log.push({ kind, time: performance.now(), ...entry }) - 1];
    const plain = ({ target, reason, probability, remaining, id, name, data }) => {
      return { target: nameOf(target), reason, probability, remaining, id, name, data };
    };
    return whither.watch(targets, {
      load: "eager",
      onIntent: (intent) => {
        const over = nameOf([...document.querySelectorAll(":hover")].at(-1));
        const entry = add("intent", { ...plain(intent), over, aborted: null });
        intent.signal.addEventListener("abort", () => (entry.aborted = performance.now()));
      },
      onRelease: (release) => add("release", { ...plain(release), pressed: release.pressed, aborted: release.signal.aborted }),
      onOutcome: ({ target, mistaken, ...outcome }) =>
        add("outcome", { ...outcome, pressedAt: outcome.time, target: nameOf(target), mistaken: nameOf(mistaken) }),
      onError: (error) => add("error", { name: error.name, code: error.code, path: error.path, message: error.message }),
      ...options,
    });
  };

  /** All that a watcher has computed, as plain data. */
  window.posterior = (watcher) => ({
    best: watcher.best && { target: nameOf(watcher.best.target), id: watcher.best.id, probability: watcher.best.probability },
    none: watcher.none,
    moving: watcher.getSnapshot().moving,
    intended: watcher.getSnapshot().intended.map(nameOf),
    probabilities: Object.fromEntries(watcher.targets.map((target) => [nameOf(target), watcher.probability(target)])),
  });

  const event = (type, [time, x, y], init) => {
    const made = new PointerEvent(type, {
      bubbles: true,
      composed: true,
      cancelable: true,
      pointerId: 7,
      pointerType: "mouse",
      isPrimary: true,
      clientX: x,
      clientY: y,
      ...init,
    });
    Object.defineProperty(made, "timeStamp", { value: time });
    return made;
  };

  /** Dispatches a pointer event at `[milliseconds, x, y]` to what is there; `list` are its coalesced events, null for no such method. */
  window.point = (type, sample, { list = [], ...init } = {}) => {
    const made = event(type, sample, init);
    const value = list && (() => list.map((each) => event("pointermove", each, init)));
    Object.defineProperty(made, "getCoalescedEvents", { value: value ?? undefined });
    (document.elementFromPoint(sample[1], sample[2]) ?? document.documentElement).dispatchEvent(made);
  };

  /** Presses and lifts at a place. */
  window.press = (x, y, init) => {
    for (const type of ["pointerdown", "pointerup"]) point(type, [performance.now(), x, y], init);
  };

  /** Dispatches a movement, `[seconds, x, y]` from a time in milliseconds, one event for each sample. */
  window.stroke = (samples, start, init) => {
    for (const [time, x, y] of samples) point("pointermove", [start + 1000 * time, x, y], init);
  };

  /** A time in milliseconds that is a binary fraction of a second: what follows it in such steps is the same to the bit. */
  window.exactNow = () => Math.ceil((performance.now() * 64) / 1000) * (1000 / 64);

  let current = {};
  let x = 150;
  /** A model that returns the posterior of the last step; `made` and `freed` count its instances, `given` are its last targets. */
  window.scriptedPredictor = (targets, options) => {
    let now = targets;
    const stats = scriptedPredictor;
    stats.made += 1;
    Object.assign(stats, { given: targets, options });
    const probability = ({ x }) => current["abcdefgh"[Math.floor(x / 100) - 1]] ?? 0;
    return {
      observe: (time, [x, y]) => stats.observed.push([time, x, y]),
      probabilities: (into = new Float64Array(now.length)) => {
        now.forEach((target, index) => (into[index] = probability(target)));
        return into;
      },
      get none() {
        return 1 - now.reduce((sum, target) => sum + probability(target), 0);
      },
      get remaining() {
        return { mean: 0.5, low: 0.25, high: 1 };
      },
      forecast: () => null,
      path: () => new Float64Array(),
      setTargets: (targets) => (stats.given = now = targets),
      reset() {},
      free: () => (stats.freed += 1),
    };
  };
  Object.assign(scriptedPredictor, { made: 0, freed: 0, observed: [] });

  window.scriptedStep = async (posterior) => {
    current = posterior;
    const [most] = Object.keys(posterior).sort((one, other) => posterior[other] - posterior[one]);
    if (most) x = 150 + 100 * "abcdefgh".indexOf(most);
    const now = performance.now();
    const list = [
      [now - 40, x, 520],
      [now, x, 430],
    ];
    point("pointermove", list[1], { list });
    await frames(3);
  };
}
