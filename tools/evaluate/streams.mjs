// Movements on a page that whither/dom watches: reads one a line, { targets, target, events: [[time, [[time, x, y], ...]], ...],
// moments }, and writes what is predicted at the moments, [[top, its probability, the target's], ...], top null where nothing is,
// and how many movements it was taken for.
import { rm } from "node:fs/promises";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";
import { init, PointerPredictor } from "../../dist/pointing.js";
import { bundle } from "../../scripts/bundle.mjs";
import { root } from "../../scripts/run.mjs";

/** Milliseconds on the page's clock before the first event: what is watched has been read by then. */
const BEFORE = 100;

const bundled = await bundle([join(root, "js/dom/testing/page.ts")]);
const { TestPage } = await import(pathToFileURL(join(bundled, "page.mjs")).href);
await rm(bundled, { recursive: true });
await init();

async function replay({ targets, target, events, moments }) {
  let movements = 0;
  const predictor = (list, options) => {
    const made = new PointerPredictor(list, options);
    const reset = made.reset.bind(made);
    made.reset = () => {
      movements++;
      reset();
    };
    return made;
  };
  const page = new TestPage({ core: predictor });
  const elements = targets.map(([x, y, width, height]) =>
    page.append("a", { x: x - width / 2, y: y - height / 2, width, height }),
  );
  const fail = (error) => {
    throw error;
  };
  const watcher = page.watch("a", { load: "eager", decorate: false, none: 0, onError: fail });
  await watcher.ready;
  const origin = moments[0];
  const onPage = (time) => BEFORE + 1000 * (time - origin);
  const fieldsOf = ([time, x, y]) => ({ timeStamp: onPage(time), clientX: x, clientY: y });
  let next = 0;
  const predicted = moments.map((moment) => {
    for (; next < events.length && events[next][0] <= moment + 1e-9; next++) {
      const [time, samples] = events[next];
      page.clock.advanceTo(onPage(time));
      const [, x, y] = samples.at(-1);
      page.point("pointermove", x, y, { ...fieldsOf(samples.at(-1)), getCoalescedEvents: () => samples.map(fieldsOf) });
    }
    page.clock.advanceTo(onPage(moment));
    const { best } = watcher;
    if (!best) return [null, 1 / targets.length, 1 / targets.length];
    return [elements.indexOf(best.target), best.probability, watcher.probability(elements[target])];
  });
  watcher.stop();
  if (page.errors.length > 0) throw page.errors[0];
  return [predicted, movements];
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(await replay(JSON.parse(line)))}\n`);
}
