/** What is the case, whoever moves the hand. */
import type { Position } from "./cabin.ts";
import type { Moment } from "./forecast.ts";

export interface Scene {
  /** The hand, and where it was before; in mm. */
  readonly trail: readonly Position[];
  /** The movement, by who expects shake and by who does not, and where in it it is now. */
  readonly moments: { readonly shake: readonly Moment[]; readonly calm: readonly Moment[] };
  readonly at: number;
  /** Whether the movement's last moment is a touch; the index of the icon that is touched, where it is one. */
  readonly touched: boolean;
  readonly hit: number | null;
  /** The icon whose probability is charted: the one that is touched, else the one that leads. */
  readonly icon: number;
  /** Whether it goes on by itself: then it is shown, and not announced. */
  readonly playing: boolean;
  /** The numbers in a sentence. */
  words(moments: readonly Moment[]): string;
}
