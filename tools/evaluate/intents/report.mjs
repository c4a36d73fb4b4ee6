// What was measured, as tables and as JSON.
import { mkdir, writeFile } from "node:fs/promises";
import { dirname } from "node:path";
import { table } from "../../../scripts/table.mjs";
import { Sums } from "./figures.mjs";
import { nameOfSettings, PEER } from "./foresight.mjs";
import { isVaried, nameOf, REASONS } from "./rows.mjs";

/** The sums of all users for the i-th options. */
function total(users, i) {
  const sums = new Sums();
  for (const each of users.values()) sums.merge(each[i]);
  return sums;
}

/** What the columns are. */
export const LEGEND = `wrong: intents of other targets before the press, and for how long. early: movements whose target was intended before the pointer came to it;
first: early, and before any other; before press: early or not; held: of the early ones, not taken back before the press.
lead: median from the target's first intent. withheld: intents where the target is not on the page, all of them false.
ForesightJS is given the same events and frames, and each target once, but for what the movement begins on; nothing takes its calls back.
`;

const HEADINGS = [
  "wrong / movement",
  "wrong / min",
  "wrong ms / movement",
  "early %",
  "first %",
  "before press %",
  "held %",
  "lead to press ms",
  "to entry ms",
  "withheld: false / movement",
  "false / min",
];

/** Prints a set's tables: for each of the reasons the options varied one at a time, those of ForesightJS, and the defaults by user. */
export function print(name, users, combinations, rows, byUser) {
  const title = ({ reasons, row }) => (reasons === PEER ? nameOfSettings(row) : nameOf(row, rows));
  for (const reasons of [...REASONS, PEER]) {
    const mine = combinations.flatMap((each, i) => (each.reasons === reasons ? { ...each, i } : []));
    const listed = mine.filter(({ row }) => reasons === PEER || isVaried(row, rows));
    const all = listed.map((each) => [title(each), total(users, each.i).figures()]);
    const { movements } = all[0][1];
    console.log(`${name}: ${movements} movements of ${users.size} users, ${reasons.name}\n`);
    table(["options", ...HEADINGS], cells(all));
    if (byUser) table(["user", ...HEADINGS], cells([...users].map(([user, sums]) => [user, sums[mine[0].i].figures()])));
  }
}

/** Rows of a table: shares in percent, leads in milliseconds. */
function cells(rows) {
  return rows.map(([name, f]) => [
    name,
    f.wrong.toFixed(3),
    f.wrongPerMinute.toFixed(1),
    milliseconds(f.wrongSeconds),
    ...[f.early, f.first, f.before, f.held].map(percent),
    ...[f.leadToPress, f.leadToEntry].map(milliseconds),
    f.withheld.toFixed(3),
    f.withheldPerMinute.toFixed(1),
  ]);
}

/** A share in percent. */
export function percent(share) {
  return share === null ? "-" : (100 * share).toFixed(1);
}

export function milliseconds(seconds) {
  return seconds === null ? "-" : (1000 * seconds).toFixed(0);
}

/** All figures, those of the combinations too, by set and by user: shares, and seconds. */
export async function write(file, sets, combinations) {
  const list = (figures) => combinations.map(({ row, reasons }, i) => ({ reasons: reasons.name, ...row, ...figures(i) }));
  const intents = Array.from(sets, ([set, users]) => ({
    set,
    rows: list((i) => total(users, i).figures()),
    users: Object.fromEntries(Array.from(users, ([user, sums]) => [user, list((i) => sums[i].figures())])),
  }));
  await writeJson(file, { intents });
}

/** Writes the report. */
export async function writeJson(file, report) {
  await mkdir(dirname(file), { recursive: true });
  await writeFile(file, `${JSON.stringify(report)}\n`);
  console.log(`report: ${file}`);
}
