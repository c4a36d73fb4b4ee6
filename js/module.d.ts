/**
 * A WebAssembly file of this package, as it is where an import of one gives a compiled module (Cloudflare Workers): for
 * `init({ wasm })` and `initSync({ module })`. A bundler that makes an address of it gives that to `init({ wasm })` as well.
 */
declare const compiledModule: import("./index.js").CompiledModule;
export default compiledModule;
