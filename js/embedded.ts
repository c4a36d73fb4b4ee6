/**
 * The WebAssembly that is in the package, unpacked.
 *
 * @module
 */
import { base64 } from "./generated/bytes.js";
import { unavailable } from "./source.js";

/** The bytes of the WebAssembly, from their gzipped base64. */
export async function embedded(): Promise<ArrayBuffer> {
  if (typeof DecompressionStream !== "function") {
    throw unavailable('DecompressionStream does not exist here: use "whither/slim" with init({ wasm })');
  }
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
