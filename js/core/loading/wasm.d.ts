// What differs between the entries' modules of WebAssembly; scripts/build.mjs puts in each entry's own. `#wasm`, the generated
// code, and `#bytes` are in tsconfig.json, with the types of those of `whither`.

/** The module, compiled: what an import of its file is in the `workerd` entries. */
declare module "#module" {
  const compiledModule: WebAssembly.Module;
  export default compiledModule;
}

/** The name of the module's file. */
declare const WASM_FILE: "whither.wasm" | "pointing.wasm" | "study.wasm";
