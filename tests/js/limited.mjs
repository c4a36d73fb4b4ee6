// WebAssembly with little memory.
import { readFileSync } from "node:fs";

const bytes = readFileSync(new URL("../../dist/whither.wasm", import.meta.url));

/** Its bytes with a memory that cannot grow beyond so many megabytes. */
export function limited(megabytes) {
  let at = 8;
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  };
  const written = (value) => (value < 128 ? [value] : [(value & 127) | 128, ...written(value >> 7)]);
  for (;;) {
    const start = at;
    const section = bytes[at++];
    const size = number();
    const end = at + size;
    if (section === 5) {
      number(); // one memory
      at += 1; // without a limit
      const memory = [1, 1, ...written(number()), ...written(16 * megabytes)];
      return Uint8Array.from([...bytes.subarray(0, start), 5, ...written(memory.length), ...memory, ...bytes.subarray(end)]);
    }
    at = end;
  }
}
