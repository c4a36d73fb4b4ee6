// What holding was worth: counted for each scene, summed.
import { isInside } from "../intents/tracks.mjs";

/**
 * Of one scene: whether the panel was `wrong`, closed before the pointer came to it or still open when it came elsewhere; and for how many
 * `seconds` it was open after the pointer had come off the trigger, where it went elsewhere. What is never closed counts until two seconds
 * after the movement.
 */
export function judge({ kind, trigger, samples, arrival }, outcome) {
  const closed = outcome?.time ?? samples.at(-1)[0] + 2;
  if (kind === "panel") return { wrong: outcome !== null && closed < arrival };
  const [left] = samples.find((sample) => !isInside(sample, trigger));
  return { wrong: closed >= arrival, seconds: Math.max(0, closed - left) };
}

/** Sums over scenes of one kind. */
export class Sums {
  scenes = 0;
  wrong = 0;
  seconds = 0;

  add({ wrong, seconds = 0 }) {
    this.scenes++;
    this.wrong += Number(wrong);
    this.seconds += seconds;
  }

  /** The share that was wrong, and the mean seconds; null of none. */
  figures() {
    const { scenes, wrong, seconds } = this;
    return scenes > 0 ? { scenes, wrong: wrong / scenes, seconds: seconds / scenes } : null;
  }
}
