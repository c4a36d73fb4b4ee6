/** How much is learnt from how many movements. */

/** Each third of the movements is scored with what was learnt from the other two. */
export const FOLDS = 3;

/** As many movements are learnt from for each constant as `fit` asks for. */
const EACH = 10;

/** What `fit` learns of the pointing model, the ones first that matter most. */
export const PATHS = [
  "pointing.power.to",
  "pointing.timeToGo.median",
  "motion.noise",
  "pointing.direction.power",
  "pointing.alongNoise",
];

/** The fewest constants that are learnt. */
const FEWEST = 2;

/** Movements that two thirds of are enough for so many constants. */
const enoughFor = (constants: number) => Math.ceil((EACH * constants * FOLDS) / (FOLDS - 1));

export const LEAST_MOVEMENTS = enoughFor(FEWEST);
export const MOVEMENTS_FOR_ALL = enoughFor(PATHS.length);

/** The constants that so many movements are enough for; null for too few. */
export function pathsFor(movements: number): readonly string[] | null {
  const count = PATHS.filter((_, k) => movements >= enoughFor(k + 1)).length;
  return count < FEWEST ? null : PATHS.slice(0, count);
}
