//! Imports under numbers: their names, which nobody but the build reads, are long and stand in the code a second time.

use anyhow::Result;

/// Writes to `to` the module in `from` with its imports named by their order, from `"0"`. They come from a module whose name
/// differs where any of their own names did, so that another build's code and file do not fit together.
pub fn number(from: &str, to: &str) -> Result<()> {
    let mut module = walrus::Module::from_file(from)?;
    let names = module.imports.iter().flat_map(|import| format!("{} {} ", import.module, import.name).into_bytes());
    let sum =
        format!("{:08x}", names.fold(0x811c_9dc5, |sum: u32, byte| (sum ^ u32::from(byte)).wrapping_mul(0x0100_0193)));
    for (i, import) in module.imports.iter_mut().enumerate() {
        import.module.clone_from(&sum);
        import.name = i.to_string();
    }
    module.emit_wasm_file(to)
}
