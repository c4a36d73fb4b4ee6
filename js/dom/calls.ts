/**
 * Calls what the page gave, and keeps what that throws away from the rest of the page.
 *
 * @module
 */
import type { Platform } from "./platform.js";

export class Calls {
  readonly #platform: Platform;
  readonly #onError: () => ((error: unknown) => void) | undefined;
  /** What has been reported as an uncaught error. */
  readonly #reported = new Set<string>();

  constructor(platform: Platform, onError: () => ((error: unknown) => void) | undefined) {
    this.#platform = platform;
    this.#onError = onError;
  }

  /** Calls back; what is thrown is reported. */
  call<A>(callback: ((argument: A) => unknown) | undefined, argument: A): unknown {
    try {
      return callback?.(argument);
    } catch (error) {
      this.report(error);
      return undefined;
    }
  }

  /** Gives an error to `onError`; where there is none, or it throws itself, the error is uncaught, once. */
  readonly report = (error: unknown): void => {
    const onError = this.#onError();
    try {
      if (!onError) throw error;
      onError(error);
    } catch (uncaught) {
      const text = String(uncaught);
      if (!this.#reported.has(text)) this.#platform.report(uncaught);
      this.#reported.add(text);
    }
  };
}
