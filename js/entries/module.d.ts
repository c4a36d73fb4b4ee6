/**
 * A WebAssembly file of this package where importing one gives a compiled module (Cloudflare Workers): for
 * `init({ wasm })` and `initSync({ module })`. Where a bundler makes it an address, pass that to `init({ wasm })`.
 */
declare const compiledModule: Compiled;
export default compiledModule;

/** `WebAssembly.Module`, where the program's libraries have it. */
type Compiled = typeof globalThis extends { WebAssembly: { Module: { prototype: infer Module } } } ? Module : object;
