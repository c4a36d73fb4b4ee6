/** The numbers in a sentence. */
import { LABELS } from "./cabin.ts";
import { leader, type Moment } from "./forecast.ts";
import { percent, seconds } from "../shared/format.ts";

/** Below this no icon leads by enough to be named. */
const SURE = 0.15;

/** A moment of a movement that is under way. */
export function prediction(moment: Moment): string {
  const { label, probability } = leader(moment);
  if (!moment.remaining || probability < SURE) return "Not clear yet: the hand has only just set out.";
  const { mean, low, high } = moment.remaining;
  return `${label} ${percent(probability)}, there in ${seconds(mean)} (80%: ${low.toFixed(2)} to ${high.toFixed(2)} s).`;
}

/** A touch, and since when what it touches had led. */
export function outcome(moments: readonly Moment[], icon: number | null): string {
  if (icon === null) return "The screen is touched between the icons.";
  const name = LABELS[icon] ?? "";
  const lead = leadOf(moments, icon);
  return lead > 0
    ? `${name} is touched; it had been the most probable for ${seconds(lead)}.`
    : `${name} is touched; another icon was the most probable.`;
}

/** For how many seconds before the last moment an icon has been the most probable. */
export function leadOf(moments: readonly Moment[], icon: number): number {
  const wrong = moments.findLastIndex((moment) => leader(moment).icon !== icon);
  const [since, last] = [moments[wrong + 1], moments.at(-1)];
  return since && last ? last.sample[0] - since.sample[0] : 0;
}
