/**
 * WebAssembly that is embedded in the package.
 *
 * @module
 */
import { reason, unavailable } from "./source.js";

/** The bytes of WebAssembly, from their gzipped base64; `instead` is the advice in the error where they cannot be unpacked. */
export async function unpack(base64: string, instead: string): Promise<Uint8Array> {
  if (typeof DecompressionStream !== "function") throw unavailable(`DecompressionStream does not exist here: ${instead}`);
  try {
    return await unzipped(Uint8Array.from(atob(base64), (character) => character.charCodeAt(0)));
  } catch (error) {
    throw unavailable(`the WebAssembly inside the package cannot be unpacked: ${reason(error)}; ${instead}`, error);
  }
}

/** By the stream's own writer and reader: where tests run, `Blob.stream` and `Response` may not exist. */
async function unzipped(packed: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const { writable, readable } = new DecompressionStream("gzip");
  const writer = writable.getWriter();
  // where one of these fails, so does the reading, which is awaited
  for (const done of [writer.write(packed), writer.close()]) done.catch(() => {});
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = readable.getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    parts.push(next.value);
    length += next.value.length;
  }
  const bytes = new Uint8Array(length);
  for (const part of parts.reverse()) bytes.set(part, (length -= part.length));
  return bytes;
}
