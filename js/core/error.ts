/**
 * The kind of an error. These strings are part of the interface: code may depend on them.
 *
 * | code | means |
 * |---|---|
 * | `unknown-key` | an object has a key that is not legal there |
 * | `missing-key` | a key that has no default is absent |
 * | `wrong-type` | a value has another type than is legal there |
 * | `wrong-length` | a list or matrix has another length than is legal there |
 * | `not-finite` | a number is NaN or infinite |
 * | `out-of-range` | a number or word is outside what is legal |
 * | `not-positive-definite` | a covariance is not symmetric positive definite |
 * | `duplicate-id` | two destinations have the same id |
 * | `unknown-id` | no destination has this id |
 * | `no-destinations` | there must be at least one destination |
 * | `time-not-increasing` | a time is before the last observation's |
 * | `method-accumulates` | the method accumulates evidence for each destination, so it cannot do this in the middle of a movement |
 * | `too-large` | more than the stated limit |
 * | `bad-snapshot` | a snapshot is damaged or from another version |
 * | `freed` | the object was freed |
 * | `not-initialised` | `init` has not finished |
 * | `wasm-unavailable` | WebAssembly cannot be loaded here |
 */
export type ErrorCode =
  | "unknown-key"
  | "missing-key"
  | "wrong-type"
  | "wrong-length"
  | "not-finite"
  | "out-of-range"
  | "not-positive-definite"
  | "duplicate-id"
  | "unknown-id"
  | "no-destinations"
  | "time-not-increasing"
  | "method-accumulates"
  | "too-large"
  | "bad-snapshot"
  | "freed"
  | "not-initialised"
  | "wasm-unavailable";

/**
 * The one error that everything here throws.
 *
 * @example
 * ```ts
 * try {
 *   new Predictor(scenario);
 * } catch (error) {
 *   if (error instanceof WhitherError && error.code === "unknown-key") console.warn(error.path);
 * }
 * ```
 */
export class WhitherError extends Error {
  override readonly name = "WhitherError";
  /** The kind of the error. */
  readonly code: ErrorCode;
  /** The field it is about, such as `destinations[3].covariance`; empty where it is about no field. */
  readonly path: string;

  /**
   * @param code - The kind of the error.
   * @param path - The field it is about, or an empty string.
   * @param message - The value and what is legal. The error's own `message` is the path, a colon and this.
   * @param options - The error that caused this one.
   */
  constructor(code: ErrorCode, path: string, message: string, options?: { cause?: unknown }) {
    super(path === "" ? message : `${path}: ${message}`, options);
    this.code = code;
    this.path = path;
  }
}
