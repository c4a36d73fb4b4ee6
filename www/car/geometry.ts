/** In px. */
export interface Point {
  readonly x: number;
  readonly y: number;
}

/** A box by its centre and size, in px. */
export interface Box extends Point {
  readonly width: number;
  readonly height: number;
}
