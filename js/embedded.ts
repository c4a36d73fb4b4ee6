/**
 * The engine that is inside the package.
 *
 * @module
 */
import { base64 } from "./generated/bytes.js";
import { unpack } from "./unpack.js";

/** The bytes of the engine's WebAssembly. */
export function embedded(): Promise<ArrayBuffer> {
  return unpack(base64, 'use "whither/slim" with init({ wasm })');
}
