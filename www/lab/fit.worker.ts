/** Learns constants from movements in a thread of its own, and what they gain on movements that were left out. */
import { init, pointerScenario } from "whither";
import { fit, type FittedConstant } from "whither/study";
import { reasonOf } from "../shared/page.ts";
import { meanOf, scoreOf, type Score } from "./metrics.ts";
import { approachOf, type Movement } from "./movement.ts";
import { byPointing, type Constants } from "./predictions.ts";
import { FOLDS } from "./folds.ts";

export interface FitRequest {
  readonly movements: readonly Movement[];
  /** The paths of the constants to learn. */
  readonly paths: readonly string[];
}

/** Log loss in nats a sample, and percent of the time with the right target on top. */
export interface Quality {
  readonly loss: number;
  readonly time: number;
}

export interface FitResult {
  readonly movements: number;
  /** On all movements, each with constants that were learnt without it. */
  readonly before: Quality;
  readonly after: Quality;
  /** What the log loss is lower by, and half of the 95% interval over movements. */
  readonly gain: { readonly mean: number; readonly half: number };
  /** Learnt from all of them. */
  readonly constants: readonly FittedConstant[];
  /** The sections of a scenario that hold them. */
  readonly sections: Constants;
}

export type FitReport =
  | { readonly kind: "progress"; readonly share: number }
  | { readonly kind: "result"; readonly result: FitResult }
  | { readonly kind: "error"; readonly message: string };

const report = (message: FitReport) => postMessage(message);

addEventListener("message", async ({ data }: MessageEvent<FitRequest>) => {
  try {
    await init();
    report({ kind: "result", result: await crossValidate(data) });
  } catch (error) {
    report({ kind: "error", message: reasonOf(error) });
  }
});

/** Each of the folds, movements that follow one another, is scored with constants from the others; then all are learnt from. */
async function crossValidate({ movements, paths }: FitRequest): Promise<FitResult> {
  const pairs: { before: Score; after: Score }[] = [];
  const place = (k: number) => Math.floor((k * movements.length) / FOLDS);
  const learn = async (from: readonly Movement[], run: number) => {
    const progress = ({ share }: { share: number }) => report({ kind: "progress", share: (run + share) / (FOLDS + 1) });
    const tracks = from.map(({ targets, target, samples }) => ({ targets, target, samples }));
    return fit(tracks, pointerScenario([{ id: "any", x: 0, y: 0, width: 1, height: 1 }]), { constants: paths, progress });
  };
  for (let fold = 0; fold < FOLDS; fold += 1) {
    const isOut = (_: Movement, k: number) => k >= place(fold) && k < place(fold + 1);
    const { scenario } = await learn(
      movements.filter((movement, k) => !isOut(movement, k)),
      fold,
    );
    for (const movement of movements.filter(isOut)) {
      const length = approachOf(movement) ?? 0;
      const score = (constants: Constants) => scoreOf(movement, byPointing(movement, length, constants));
      pairs.push({ before: score({}), after: score(sectionsOf(scenario, paths)) });
    }
  }
  const { scenario, constants } = await learn(movements, FOLDS);
  return { ...compare(pairs), movements: movements.length, constants, sections: sectionsOf(scenario, paths) };
}

function compare(pairs: readonly { before: Score; after: Score }[]): Pick<FitResult, "before" | "after" | "gain"> {
  const sum = (of: (pair: { before: Score; after: Score }) => number) => pairs.reduce((total, pair) => total + of(pair), 0);
  const samples = sum(({ before }) => before.samples);
  const quality = (which: "before" | "after"): Quality => ({
    loss: sum((pair) => pair[which].loss) / samples,
    time: (100 * sum((pair) => pair[which].time)) / pairs.length,
  });
  // the loss is a mean over samples, of which a movement has many that agree: the interval is over movements
  const found = meanOf(pairs.map(({ before, after }) => before.loss - after.loss));
  const each = pairs.length / samples;
  return {
    before: quality("before"),
    after: quality("after"),
    gain: { mean: each * (found?.mean ?? 0), half: each * (found?.half ?? 0) },
  };
}

/** Of a scenario what holds the constants: as `constants` of `watch`, or spread over `pointerScenario(...)`. */
function sectionsOf(scenario: Constants, paths: readonly string[]): Constants {
  const keys = new Set(paths.map((path) => path.split(".")[0]));
  return Object.fromEntries(Object.entries(scenario).filter(([key]) => keys.has(key)));
}
