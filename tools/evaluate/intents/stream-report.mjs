// What was measured of streams, as tables and as JSON.
import { table } from "../../../scripts/table.mjs";
import { intervalOf, StreamSums } from "./figures.mjs";
import { milliseconds, percent, writeJson } from "./report.mjs";
import { SHARES } from "./wandering.mjs";

/** The sums of users. */
function total(users) {
  const sums = new StreamSums();
  for (const each of users) sums.merge(each);
  return sums;
}

/** What the columns are. */
export const STREAM_LEGEND = `Streams: each movement of a user begins where the last one came to, after a pause of .1 to 2 s. A share of them wanders: what these lead to
is not on the page, and they are not pressed. Default reasons; thresholds and priors of "none" varied.
wrong / min: intents of what was not pressed, in a minute of the stream (95% over users). wrong: before and after a press, a movement that was
pressed; false: a movement that wanders. early, first, before press, leads: of what was pressed, as with --intents. right: the share
of all intents before a press that were of what was pressed.
`;

const HEADINGS = [
  "wrong / min",
  "wrong / press",
  "false / wandering",
  "early %",
  "first % (95%)",
  "before press %",
  "right %",
  "lead to press ms",
  "to entry ms",
];

/** Prints a set's tables, one for each share that wanders: all rows, and the defaults by user. */
export function printStreams(name, users, rows, byUser) {
  SHARES.forEach((share, s) => {
    const all = rows.map((row, i) => [nameOf(row, rows), [...users.values()].map((sums) => sums[s][i])]);
    const { movements, wandered } = total(all[0][1]).figures();
    console.log(
      `${name}: ${movements} movements that are pressed and ${wandered} that wander (${share}), of ${users.size} users\n`,
    );
    table(["options", ...HEADINGS], all.map(cells));
    if (byUser)
      table(
        ["user", ...HEADINGS],
        Array.from(users, ([user, sums]) => cells([user, [sums[s][0]]])),
      );
  });
}

/** A row of a table, of the sums of users. */
function cells([name, users]) {
  const f = total(users).figures();
  const range = (key, show) => {
    const interval = intervalOf(users, (drawn) => total(drawn).figures()[key]);
    return interval ? ` [${interval.map(show).join(", ")}]` : "";
  };
  const rate = (x) => x.toFixed(1);
  return [
    name,
    rate(f.wrongPerMinute) + range("wrongPerMinute", rate),
    f.wrong.toFixed(3),
    f.false === null ? "-" : f.false.toFixed(3),
    percent(f.early),
    percent(f.first) + range("first", percent),
    percent(f.before),
    percent(f.right),
    milliseconds(f.leadToPress),
    milliseconds(f.leadToEntry),
  ];
}

function nameOf({ threshold, none }, [defaults]) {
  const isDefault = threshold === defaults.threshold && none === defaults.none;
  return `${isDefault ? "default: " : ""}threshold ${threshold}, none ${none}`;
}

/** All figures, by set, share and user: shares, and seconds. */
export async function writeStreams(file, sets, rows) {
  const list = (users, s) => rows.map((row, i) => ({ ...row, ...total(users.map((sums) => sums[s][i])).figures() }));
  const wandering = Array.from(sets, ([set, users]) => ({
    set,
    shares: SHARES.map((share, s) => ({
      share,
      rows: list([...users.values()], s),
      users: Object.fromEntries(Array.from(users, ([user, sums]) => [user, list([sums], s)])),
    })),
  }));
  await writeJson(file, { wandering });
}
