/** What the build knows of the package; vite.config.js writes it. */
declare const __WHITHER__: {
  readonly version: string;
  readonly license: string;
  /** The address of its source; null as long as it has none. */
  readonly repository: string | null;
  /** Bytes under gzip of `whither/dom`. */
  readonly dom: number;
  /** Bytes under gzip of what that loads when a pointer moves: `whither/pointing`, and what belongs to it. */
  readonly later: number;
};
