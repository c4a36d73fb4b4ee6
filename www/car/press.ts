/** A press on an icon, and how it was predicted: the sentence, the chart and the numbers are made from this. */
import type { Outcome } from "whither/dom";

export interface Press extends Pick<Outcome, "verdict" | "lead"> {
  /** The icon's place in the reading order. */
  readonly index: number;
  readonly label: string;
  /** Seconds on the page's clock. */
  readonly time: number;
  /** The label of the first other icon that was ringed; null where the verdict is not "wrong". */
  readonly mistaken: string | null;
}
