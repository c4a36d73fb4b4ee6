/** What is the case, whoever moves the hand. */
import type { Position } from "./cabin.ts";
import type { Moment } from "./forecast.ts";

export interface Scene {
  /** The hand, and where it was before; in mm. */
  readonly trail: readonly Position[];
  /** The movement, by who expects shake and by who does not, and where in it it is now. */
  readonly moments: { readonly shake: readonly Moment[]; readonly calm: readonly Moment[] };
  readonly at: number;
  /** Whether the movement's last moment is a touch; of which icon, else of which one leads. */
  readonly touched: boolean;
  readonly icon: number;
  /** Whether it goes on by itself: then it is shown, and not announced. */
  readonly playing: boolean;
  /** The numbers in a sentence. */
  words(moments: readonly Moment[]): string;
}
