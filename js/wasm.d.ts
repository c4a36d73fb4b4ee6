/** A WebAssembly file that is imported is a compiled module (the `workerd` entry). */
declare module "*.wasm" {
  const compiledModule: WebAssembly.Module;
  export default compiledModule;
}
