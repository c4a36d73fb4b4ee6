/** The most probable destination. */
export interface Best {
  /** Its id. */
  readonly id: string;
  /** Its index in {@link Predictor.destinations}. */
  readonly index: number;
  /** Its probability. */
  readonly probability: number;
}

/** Makes one, a plain object, for `src/wasm/predictor.rs`. */
export function best(id: string, index: number, probability: number): Best {
  return { id, index, probability };
}
