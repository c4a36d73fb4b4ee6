// What intents were worth: counted for each movement, summed by user and by set.

import { randomOf } from "./random.mjs";

/** How often users are drawn for an interval. */
const DRAWS = 1000;

/**
 * Of one movement: `wrong`, how many intents before the press were of other targets than the pressed one; whether that was intended
 * `before` the press, `early` (before the pointer came to it), and early as the `first` of all; whether the early intent was still
 * `held` at the press; the seconds from its intent to the press and to the entry; and `wrongSeconds`, for which wrong ones ran.
 */
export function judge({ entry, press }, intents) {
  const begun = intents.filter(({ begin }) => begin < press);
  const right = begun.find((intent) => intent.right);
  const early = right !== undefined && right.begin < entry;
  const wrong = begun.filter((intent) => !intent.right);
  return {
    wrong: wrong.length,
    wrongSeconds: wrong.reduce((sum, { begin, end }) => sum + (end ?? press) - begin, 0),
    before: right !== undefined,
    early,
    first: early && begun[0] === right,
    held: early && right.end === null,
    leads: right && { press: press - right.begin, entry: entry - right.begin },
  };
}

const COUNTED = ["wrong", "wrongSeconds", "before", "early", "first", "held"];

/** Sums over movements. */
export class Sums {
  movements = 0;
  seconds = 0;
  wrong = 0;
  wrongSeconds = 0;
  before = 0;
  early = 0;
  first = 0;
  held = 0;
  /** Intents where the target was withheld: all of them false. */
  withheld = 0;
  leads = { press: [], entry: [] };

  add({ seconds, judged, withheld }) {
    this.movements++;
    this.seconds += seconds;
    this.withheld += withheld;
    for (const key of COUNTED) this[key] += Number(judged[key]);
    for (const key of ["press", "entry"]) if (judged.leads) this.leads[key].push(judged.leads[key]);
  }

  /** Adds other movements. */
  merge(other) {
    for (const key of ["movements", "seconds", "withheld", ...COUNTED]) this[key] += other[key];
    for (const key of ["press", "entry"]) this.leads[key] = this.leads[key].concat(other.leads[key]);
  }

  /** Shares and means over movements; medians in seconds; null where nothing was intended. */
  figures() {
    const { movements, seconds } = this;
    const each = (key) => this[key] / movements;
    return {
      movements,
      wrong: each("wrong"),
      wrongPerMinute: (60 * this.wrong) / seconds,
      wrongSeconds: each("wrongSeconds"),
      early: each("early"),
      first: each("first"),
      before: each("before"),
      held: this.early > 0 ? this.held / this.early : null,
      leadToPress: median(this.leads.press),
      leadToEntry: median(this.leads.entry),
      withheld: each("withheld"),
      withheldPerMinute: (60 * this.withheld) / seconds,
    };
  }
}

/** Sums over the movements of streams, of which some wander. */
export class StreamSums {
  pressed = new Sums();
  wandered = 0;
  seconds = 0;
  /** Intents of what was not pressed, and those of them in movements that wander. */
  wrong = 0;
  false = 0;

  /** Adds a movement, with its score for one of the options. */
  add({ wanders, seconds }, score) {
    this.seconds += seconds;
    this.wrong += score.wrong;
    if (wanders) {
      this.wandered++;
      this.false += score.wrong;
    } else this.pressed.add({ seconds, judged: score, withheld: 0 });
  }

  /** Adds other streams. */
  merge(other) {
    for (const key of ["wandered", "seconds", "wrong", "false"]) this[key] += other[key];
    this.pressed.merge(other.pressed);
  }

  /** As those of {@link Sums}, of the movements that end in a press; wrong intents a minute of everything, and the share of right ones. */
  figures() {
    const { pressed, wandered, wrong } = this;
    const { movements, early, first, before, leadToPress, leadToEntry } = pressed.figures();
    return {
      movements,
      wandered,
      wrongPerMinute: (60 * wrong) / this.seconds,
      wrong: pressed.wrong / movements,
      false: wandered > 0 ? this.false / wandered : null,
      early,
      first,
      before,
      right: pressed.before + wrong > 0 ? pressed.before / (pressed.before + wrong) : null,
      leadToPress,
      leadToEntry,
    };
  }
}

/** From the 2.5th to the 97.5th percentile of what is computed of users drawn with replacement, always the same ones; null for fewer than two. */
export function intervalOf(users, figureOf) {
  if (users.length < 2) return null;
  const random = randomOf("users");
  const drawn = Array.from({ length: DRAWS }, () => figureOf(users.map(() => users[Math.floor(users.length * random())])));
  drawn.sort((a, b) => a - b);
  return [0.025, 0.975].map((share) => drawn[Math.round(share * (DRAWS - 1))]);
}

function median(values) {
  if (values.length === 0) return null;
  const sorted = values.toSorted((a, b) => a - b);
  const middle = sorted.length / 2;
  return (sorted[Math.ceil(middle) - 1] + sorted[Math.floor(middle)]) / 2;
}
