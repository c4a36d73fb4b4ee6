// The options that intents are measured with.

const THRESHOLDS = [0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95];
const NONES = [0, 0.05, 0.1, 0.2, 0.3, 0.5];
const STREAM_THRESHOLDS = [0.8, 0.85, 0.9];
const STREAM_NONES = [0.02, 0.05, 0.1, 0.2, 0.3, 0.5];
const AFTERS = [0, 25, 50, 100];
const RELEASES = [0.1, 0.2, 0.3];

/** Every reason but the posterior off. */
const ALONE = { hover: false, press: false, focus: false, touch: false, scroll: false };

/** Each row once for `pointer` alone and once with whatever else is on by default. */
export const REASONS = [
  { name: "pointer alone", reasons: ALONE },
  { name: "all default reasons", reasons: {} },
];

/**
 * The rows, `{ threshold, none, after, release? }` each, the defaults first: one of them varied at a time, and with `grid` all
 * combinations of the first three.
 *
 * @param defaults - The settings of a watcher that was given no options.
 */
export function rowsOf({ threshold, none, reasons: { pointer } }, grid) {
  const defaults = { threshold, none, after: pointer };
  const varied = [
    ...THRESHOLDS.map((each) => ({ ...defaults, threshold: each })),
    ...NONES.map((each) => ({ ...defaults, none: each })),
    ...AFTERS.map((each) => ({ ...defaults, after: each })),
    ...RELEASES.map((each) => ({ ...defaults, release: each })),
  ];
  const all = THRESHOLDS.flatMap((each) => NONES.flatMap((n) => AFTERS.map((after) => ({ threshold: each, none: n, after }))));
  const rows = new Map([defaults, ...varied, ...(grid ? all : [])].map((row) => [JSON.stringify(row), row]));
  return [...rows.values()];
}

/** The rows of streams, the defaults first: each prior of "none" with each threshold. */
export function rowsOfStreams({ threshold, none }) {
  const all = STREAM_THRESHOLDS.flatMap((each) => STREAM_NONES.map((n) => ({ threshold: each, none: n })));
  const isDefault = (row) => row.threshold === threshold && row.none === none;
  return [{ threshold, none }, ...all.filter((row) => !isDefault(row))];
}

/** What `watch` is given for a row. */
export function optionsOf({ threshold, none, after = 0, release }, { reasons }) {
  return { threshold, release, none, reasons: { ...reasons, pointer: { after } } };
}

const NAMES = { threshold: "threshold", none: "none", after: "pointer.after", release: "release" };

const others = (row, [defaults]) => Object.keys(NAMES).filter((key) => row[key] !== defaults[key]);

/** Whether a row differs from the defaults in at most one option. */
export function isVaried(row, rows) {
  return others(row, rows).length <= 1;
}

/** A row's name: what it has other than by default. */
export function nameOf(row, rows) {
  const list = (keys) => keys.map((key) => `${NAMES[key]} ${row[key]}`).join(", ");
  return row === rows[0] ? `default: ${list(Object.keys(row))}` : list(others(row, rows));
}
