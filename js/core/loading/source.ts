/**
 * From a user's source of the WebAssembly to a compiled module.
 *
 * @module
 */
import { WhitherError } from "#error";

/**
 * A compiled `WebAssembly.Module`: an `object` here, so that the declarations need neither the DOM library nor Node's types.
 */
export type CompiledModule = object;

/** The parts of a `Response` that are read. */
export interface ResponseLike {
  readonly ok: boolean;
  readonly status: number;
  readonly url: string;
  /** The bytes of the answer. */
  arrayBuffer(): Promise<ArrayBuffer>;
}

/** The part of a `URL` that is read. */
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
 * @param source - Returns the source; not called where the platform has no WebAssembly.
 * @throws {@link WhitherError} `wasm-unavailable`, where the address does not answer with WebAssembly, or WebAssembly is not
 * allowed here; `wrong-type` for anything that is no source.
 */
export async function compile(source: () => WasmSource): Promise<WebAssembly.Module> {
  checkPlatform();
  let given: WasmLocation;
  try {
    given = await source();
  } catch (error) {
    if (error instanceof WhitherError) throw error;
    throw unavailable(`the promise of it was rejected: ${reason(error)}`, error);
  }
  if (isModule(given)) return given;
  const [bytes, what] = await bytesOf(given);
  try {
    return await WebAssembly.compile(bytes);
  } catch (error) {
    throw notCompiled(error, bytes, what);
  }
}

/** Compiles without waiting, for `initSync`. */
export function compileNow(source: ArrayBuffer | ArrayBufferView | CompiledModule): WebAssembly.Module {
  checkPlatform();
  if (isModule(source)) return source;
  if (!isBytes(source)) throw wrongType("module", "a WebAssembly.Module or its bytes");
  const [bytes, what] = checked(source, GIVEN);
  try {
    return new WebAssembly.Module(bytes);
  } catch (error) {
    throw notCompiled(error, bytes, what);
  }
}

/** Checked first: without WebAssembly, parts of the platform that are built on it end the process (Node's `fetch`). */
function checkPlatform(): void {
  for (const name of ["WebAssembly", "TextDecoder", "TextEncoder"] as const) {
    if (typeof globalThis[name] === "undefined") throw unavailable(`${name} does not exist here`);
  }
}

/** What is compiled, and how errors name it. */
type Named = readonly [bytes: Uint8Array<ArrayBuffer>, what: string];

const GIVEN = "the given bytes";

async function bytesOf(source: WasmLocation): Promise<Named> {
  if (isBytes(source)) return checked(source, GIVEN);
  if (isResponse(source)) return bytesOfResponse(source, source.url || "the given response");
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
  return bytesOfResponse(response, address);
}

async function bytesOfResponse(response: ResponseLike, address: string): Promise<Named> {
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
function checked(source: ArrayBuffer | ArrayBufferView, what: string): Named {
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    // A copy: memory that is shared, or can be resized, is not compiled from.
    bytes = ArrayBuffer.isView(source)
      ? new Uint8Array(new Uint8Array(source.buffer, source.byteOffset, source.byteLength))
      : new Uint8Array(new Uint8Array(source));
  } catch (error) {
    throw unavailable(`${what} cannot be read: ${reason(error)}`, error);
  }
  const magic = [0x00, 0x61, 0x73, 0x6d];
  if (magic.every((byte, i) => bytes[i] === byte)) return [bytes, what];
  throw unavailable(`${what} must be WebAssembly, ${beginning(bytes)}`);
}

function beginning(bytes: Uint8Array): string {
  if (bytes.length === 0) return "has no bytes";
  if (bytes[0] === 0x1f && bytes[1] === 0x8b) return "is gzipped";
  const start = new TextDecoder().decode(bytes.subarray(0, 200)).trim();
  if (/^<(!doctype|!--|html|head)/i.test(start)) return "is an HTML page";
  return `begins with ${JSON.stringify(start.slice(0, 20))}`;
}

// No `instanceof`: objects of another realm (a test runner's, an edge runtime's, another window's) are of other classes.

function isModule(value: unknown): value is WebAssembly.Module {
  try {
    WebAssembly.Module.exports(value as WebAssembly.Module);
    return true;
  } catch {
    return false;
  }
}

function isBytes(value: unknown): value is ArrayBuffer | ArrayBufferView {
  return ArrayBuffer.isView(value) || /^\[object (Shared)?ArrayBuffer\]$/.test(Object.prototype.toString.call(value));
}

function isResponse(value: unknown): value is ResponseLike {
  return typeof (value as Partial<ResponseLike> | null | undefined)?.arrayBuffer === "function";
}

/** Why these bytes do not compile: they are invalid, or the engine lacks SIMD, or else the surroundings do not allow it. */
function notCompiled(error: unknown, bytes: Uint8Array<ArrayBuffer>, what: string): WhitherError {
  const why = reason(error);
  if (WebAssembly.validate(bytes)) {
    const policy = "a Content-Security-Policy needs 'wasm-unsafe-eval' in script-src, and nothing else";
    return unavailable(`WebAssembly was refused here: ${why} (${policy})`, error);
  }
  if (!WebAssembly.validate(simd())) return unavailable(`the WebAssembly of this engine has no SIMD: ${why}`, error);
  return unavailable(`${what} must be WebAssembly, is damaged or cut off after ${bytes.length} bytes: ${why}`, error);
}

/** The smallest module with an instruction of SIMD. */
function simd(): Uint8Array<ArrayBuffer> {
  const sections = "\x01\x05\x01`\0\x01{\x03\x02\x01\0\x0a\x0a\x01\x08\0A\0\xfd\x0f\xfdb\x0b";
  return Uint8Array.from(`\0asm\x01\0\0\0${sections}`, (character) => character.charCodeAt(0));
}

/** The error where WebAssembly cannot be loaded. */
export function unavailable(message: string, cause?: unknown): WhitherError {
  return new WhitherError("wasm-unavailable", "", message, cause === undefined ? undefined : { cause });
}

function wrongType(path: string, legal: string): WhitherError {
  return new WhitherError("wrong-type", path, `must be ${legal}`);
}

/** The message of an error, of whatever realm it is. */
export function reason(error: unknown): string {
  const message: unknown = (error as Partial<Error> | null | undefined)?.message;
  if (typeof message === "string") return message;
  return typeof error === "object" ? Object.prototype.toString.call(error) : String(error);
}
