/**
 * WebAssembly that is inside the package.
 *
 * @module
 */
import { unavailable } from "./source.js";

/** The bytes of WebAssembly, from their gzipped base64; `instead` says what there is to do where they cannot be unpacked. */
export async function unpack(base64: string, instead: string): Promise<ArrayBuffer> {
  if (typeof DecompressionStream !== "function") throw unavailable(`DecompressionStream does not exist here: ${instead}`);
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
