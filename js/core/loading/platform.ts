/**
 * The platform's classes that the generated code uses, under their own names, made at their first use: the generated code makes
 * them where it is imported, and an import must have no effect.
 *
 * @module
 */

/** A `TextDecoder` for UTF-8. */
class LazyDecoder {
  #real: globalThis.TextDecoder | undefined;

  decode(bytes?: Uint8Array): string {
    if (bytes === undefined) return "";
    return (this.#real ??= new globalThis.TextDecoder("utf-8", { ignoreBOM: true })).decode(bytes);
  }
}

/** A `TextEncoder`. */
class LazyEncoder {
  #real: globalThis.TextEncoder | undefined;

  encodeInto(text: string, into: Uint8Array): { written: number } {
    return (this.#real ??= new globalThis.TextEncoder()).encodeInto(text, into);
  }
}

/** A `FinalizationRegistry`; where the platform has none, only `free()` frees. */
class LazyRegistry<T> {
  readonly #free: (held: T) => void;
  #real: globalThis.FinalizationRegistry<T> | undefined;

  constructor(free: (held: T) => void) {
    this.#free = free;
  }

  register(object: object, held: T): void {
    if (typeof globalThis.FinalizationRegistry !== "function") return;
    (this.#real ??= new globalThis.FinalizationRegistry(this.#free)).register(object, held, object);
  }

  unregister(object: object): void {
    this.#real?.unregister(object);
  }
}

export { LazyDecoder as TextDecoder, LazyEncoder as TextEncoder, LazyRegistry as FinalizationRegistry };
