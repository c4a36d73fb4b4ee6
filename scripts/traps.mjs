// What follows a panic can reach nobody in WebAssembly: there is no place to print its message to. So the functions that begin a
// panic trap at once, and neither what their callers would pass to them nor the places in source files that they would name need
// be in the file: 3% of it under gzip.
import { readFileSync, writeFileSync } from "node:fs";

/** None of them returns. The names are demangled, those of the standard library with a hash of its crates. */
const PANICS = [
  "core::panicking::",
  "core::option::expect_failed",
  "core::option::unwrap_failed",
  "core::result::unwrap_failed",
  "core::slice::index::slice_index_fail",
  "core::slice::copy_from_slice_impl::len_mismatch_fail",
  "alloc::raw_vec::capacity_overflow",
  "alloc::raw_vec::handle_error",
];

/** The instructions of `build-wasm.mjs`, as this library names them: with all of them it writes what engines cannot read yet. */
const FEATURES = [
  "SIMD128",
  "BulkMemory",
  "BulkMemoryOpt",
  "CallIndirectOverlong",
  "Multivalue",
  "MutableGlobals",
  "NontrappingFPToInt",
  "ReferenceTypes",
  "SignExt",
];

/** Rewrites a file of WebAssembly that has names, so that each of its panics is a trap. */
export async function trapPanics(file) {
  const { default: binaryen } = await import("binaryen");
  const module = binaryen.readBinary(readFileSync(file));
  module.setFeatures(FEATURES.reduce((all, name) => all | binaryen.Features[name], 0));
  const found = new Set();
  for (let i = 0; i < module.getNumFunctions(); i++) {
    const pointer = module.getFunctionByIndex(i);
    const { name, base, results } = binaryen.getFunctionInfo(pointer);
    const plain = name.replaceAll(/\[\w+\]/g, "");
    const panic = PANICS.find((part) => plain.includes(part));
    if (panic === undefined || base) continue;
    if (results !== binaryen.none) throw new Error(`${name} of ${file} returns something: is it a panic?`);
    binaryen.Function(pointer).body = module.unreachable();
    found.add(panic);
  }
  // every module has some: rustc has other names for them now where there is none
  if (!found.has(PANICS[0])) throw new Error(`no function of ${file} is called ${PANICS[0]}`);
  const bytes = module.emitBinary();
  module.dispose();
  if (clearLocations(dataOf(bytes)) === 0) throw new Error(`no place in a source file was found in ${file}`);
  writeFileSync(file, bytes);
}

/** The data of a module: where each part lies in memory, and its bytes, which can be written to. */
function dataOf(bytes) {
  let at = 8;
  const number = () => {
    let [value, shift, byte] = [0, 0, 0x80];
    for (; byte & 0x80; shift += 7) {
      byte = bytes[at++];
      value |= (byte & 0x7f) << shift;
    }
    return value >>> 0;
  };
  const parts = [];
  while (at < bytes.length) {
    const section = bytes[at++];
    const end = number() + at;
    if (section === 11) {
      for (let count = number(); count > 0; count--) {
        // each at an address that is a constant: the instruction before it and the end after it
        if (number() !== 0 || bytes[at++] !== 0x41) throw new Error("data without an address");
        const address = number();
        at++;
        const length = number();
        parts.push({ address, bytes: bytes.subarray(at, at + length) });
        at += length;
      }
    }
    at = end;
  }
  return parts;
}

/**
 * Clears the places in source files, `core::panic::Location`: the address and the length of a file's name, a line, a column; and those
 * names. Returns how many there were.
 */
function clearLocations(parts) {
  const names = new Map();
  for (const { address, bytes } of parts) {
    const text = Buffer.from(bytes).toString("latin1");
    for (const { 0: name, index } of text.matchAll(/(?:(?:\/rustc|cargo|kernel|src)\/)[\w./-]+?\.rs/g))
      names.set(address + index, name.length);
  }
  let cleared = 0;
  for (const { address, bytes } of parts) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    for (let i = -address & 3; i + 16 <= bytes.length; i += 4) {
      if (names.get(view.getUint32(i, true)) !== view.getUint32(i + 4, true)) continue;
      bytes.fill(0, i, i + 16);
      cleared++;
    }
  }
  for (const { address, bytes } of parts) {
    for (const [name, length] of names) {
      if (name >= address && name < address + bytes.length) bytes.fill(0, name - address, name - address + length);
    }
  }
  return cleared;
}
