/** A WebAssembly file that is imported is a compiled module (the `workerd` entries). */
declare module "*.wasm" {
  const compiledModule: WebAssembly.Module;
  export default compiledModule;
}

/** The file that an entry loads; the build puts it in. */
declare const WASM_FILE: "whither.wasm" | "pointing.wasm" | "study.wasm";
