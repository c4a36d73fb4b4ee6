/**
 * From what a user names as the WebAssembly to a compiled module.
 *
 * @module
 */
import { WhitherError } from "./error.js";

/**
 * A compiled `WebAssembly.Module`. Named so plainly that the declarations need neither the DOM library nor Node's types.
 */
export type CompiledModule = object;

/** What is read of a `Response`. */
export interface ResponseLike {
  readonly ok: boolean;
  readonly status: number;
  readonly url: string;
  /** The bytes of the answer. */
  arrayBuffer(): Promise<ArrayBuffer>;
}

/** What is read of a `URL`. */
export interface UrlLike {
  readonly href: string;
}

/**
 * Where the WebAssembly comes from: an address (as a string or a `URL`), a `Response`, its bytes (an `ArrayBuffer` or a
 * view of one), or a compiled `WebAssembly.Module`.
 */
export type WasmLocation = string | UrlLike | ResponseLike | ArrayBuffer | ArrayBufferView | CompiledModule;

/** Where the WebAssembly comes from, or a promise of it. */
export type WasmSource = WasmLocation | PromiseLike<WasmLocation>;

/**
 * The compiled module.
 *
 * @throws {@link WhitherError} `wasm-unavailable`, where the address does not answer with WebAssembly, or WebAssembly is not
 * allowed here; `wrong-type` for anything that is no source.
 */
export async function compiled(source: WasmSource): Promise<WebAssembly.Module> {
  if (typeof WebAssembly !== "object") throw unavailable("WebAssembly does not exist here");
  let given: WasmLocation;
  try {
    given = await source;
  } catch (error) {
    if (error instanceof WhitherError) throw error;
    throw unavailable(`the promise of it was rejected: ${reason(error)}`, error);
  }
  if (given instanceof WebAssembly.Module) return given;
  return compile(await bytesOf(given));
}

/** Compiles without waiting, for `initSync`. */
export function compiledNow(source: ArrayBuffer | ArrayBufferView | CompiledModule): WebAssembly.Module {
  if (typeof WebAssembly !== "object") throw unavailable("WebAssembly does not exist here");
  if (source instanceof WebAssembly.Module) return source;
  if (!isBytes(source)) throw wrongType("module", "a WebAssembly.Module or its bytes");
  try {
    return new WebAssembly.Module(checked(source, "the given bytes"));
  } catch (error) {
    throw refused(error);
  }
}

async function compile(bytes: BufferSource): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(bytes);
  } catch (error) {
    throw refused(error);
  }
}

async function bytesOf(source: WasmLocation): Promise<BufferSource> {
  if (isBytes(source)) return checked(source, "the given bytes");
  if (isResponse(source)) return answered(source, source.url || "the given response");
  const address = typeof source === "string" ? source : (source as Partial<UrlLike> | null | undefined)?.href;
  if (typeof address !== "string") {
    throw wrongType("wasm", "an address, a Response, the bytes or a WebAssembly.Module");
  }
  let response: ResponseLike;
  try {
    response = await fetch(address);
  } catch (error) {
    throw unavailable(`${address} cannot be fetched: ${reason(error)}`, error);
  }
  return answered(response, address);
}

async function answered(response: ResponseLike, address: string): Promise<BufferSource> {
  if (!response.ok) throw unavailable(`${address} answered with status ${response.status}`);
  let bytes: ArrayBuffer;
  try {
    bytes = await response.arrayBuffer();
  } catch (error) {
    throw unavailable(`the answer from ${address} cannot be read: ${reason(error)}`, error);
  }
  return checked(bytes, `the answer from ${address}`);
}

/** Servers like to answer an unknown address with status 200 and a page, so the first bytes decide. */
function checked(source: ArrayBuffer | ArrayBufferView, what: string): BufferSource {
  const bytes = (
    ArrayBuffer.isView(source)
      ? new Uint8Array(source.buffer, source.byteOffset, source.byteLength)
      : new Uint8Array(source)
  ) as Uint8Array<ArrayBuffer>;
  const magic = [0x00, 0x61, 0x73, 0x6d];
  if (magic.every((byte, i) => bytes[i] === byte)) return bytes;
  const start = new TextDecoder().decode(bytes.subarray(0, 200)).trim();
  const found = /^<(!doctype html|html)/i.test(start) ? "is an HTML page" : `begins with "${start.slice(0, 20)}"`;
  throw unavailable(`${what} must be WebAssembly, ${found}`);
}

function isBytes(value: unknown): value is ArrayBuffer | ArrayBufferView {
  return ArrayBuffer.isView(value) || Object.prototype.toString.call(value) === "[object ArrayBuffer]";
}

function isResponse(value: unknown): value is ResponseLike {
  return typeof (value as Partial<ResponseLike> | null | undefined)?.arrayBuffer === "function";
}

/** Our own bytes are sound, so where they do not compile it is the surroundings that refuse. */
function refused(error: unknown): WhitherError {
  if (error instanceof WhitherError) return error;
  return unavailable(
    `WebAssembly was refused here (a Content-Security-Policy needs 'wasm-unsafe-eval' in script-src; ` +
      `the engine needs SIMD): ${reason(error)}`,
    error,
  );
}

/** An error that says why WebAssembly cannot be loaded. */
export function unavailable(message: string, cause?: unknown): WhitherError {
  return new WhitherError("wasm-unavailable", "", message, cause === undefined ? undefined : { cause });
}

function wrongType(path: string, legal: string): WhitherError {
  return new WhitherError("wrong-type", path, `must be ${legal}`);
}

function reason(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
