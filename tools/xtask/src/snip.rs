//! Cuts the panic machinery out of a WebAssembly file: `snip IN OUT`.
//!
//! No panic is reachable through the public interface (tests and fuzzers hold that, natively and with every check on), but
//! the compiler cannot know it: each index that it cannot prove keeps a call with the place and the text of a panic, and
//! with them the formatting of numbers and of debugging text. A panic ends as a trap in any case, since nothing prints its
//! message; here it becomes the trap itself. No check is removed. What only panics would have told and called goes with them.

use std::collections::HashSet;

use anyhow::{Context, Result, bail};
use walrus::ir::{Instr, InstrSeqId, Unreachable, Visitor, dfs_in_order};
use walrus::{FunctionId, LocalFunction, ModuleConfig};

use crate::unused::References;

/// What the names of the functions contain that only ever panic, in either mangling.
const PANICS: [&str; 14] = [
    "9panicking",
    "13unwrap_failed",
    "13expect_failed",
    "13assert_failed",
    "17len_mismatch_fail",
    "16slice_index_fail",
    "16slice_error_fail",
    "19slice_error_fail_rt",
    "12handle_error",
    "17capacity_overflow",
    "18handle_alloc_error",
    "18panic_access_error",
    "22panic_already_borrowed",
    "30panic_already_mutably_borrowed",
];

/// Writes to `to` what `from` is without its panics.
pub fn snip(from: &str, to: &str) -> Result<()> {
    let file = std::fs::read(from).with_context(|| format!("cannot read {from}"))?;
    let mut module = ModuleConfig::new().parse(&file).with_context(|| format!("cannot read {from}"))?;
    let references = References::read(&file, &module)?;
    let mut traps: HashSet<FunctionId> = module
        .funcs
        .iter()
        .filter(|function| function.name.as_ref().is_some_and(|name| PANICS.iter().any(|panic| name.contains(panic))))
        .map(walrus::Function::id)
        .collect();
    traps.retain(|&id| match &module.funcs.get(id).kind {
        walrus::FunctionKind::Local(function) => never_returns(function),
        _ => false,
    });
    if traps.is_empty() {
        bail!("no panic in {from}: was its name section stripped?");
    }
    for id in &traps {
        let function = module.funcs.get_mut(*id).kind.unwrap_local_mut();
        let entry = function.entry_block();
        function.block_mut(entry).instrs = vec![(Unreachable {}.into(), Default::default())];
    }
    // A function of which only a trap is left makes traps of the calls to it.
    loop {
        let before = traps.len();
        let more: Vec<FunctionId> =
            module.funcs.iter_local_mut().filter_map(|(id, function)| cut(function, &traps).then_some(id)).collect();
        traps.extend(more);
        if traps.len() == before {
            break;
        }
    }
    let trap = *traps.iter().min().context("no panic")?;
    references.drop_unused(&mut module, trap);
    module.emit_wasm_file(to)
}

/// The sequences of a function, outer ones first.
pub fn sequences(function: &LocalFunction) -> Vec<InstrSeqId> {
    struct Seen(Vec<InstrSeqId>);
    impl<'a> Visitor<'a> for Seen {
        fn start_instr_seq(&mut self, sequence: &'a walrus::ir::InstrSeq) {
            self.0.push(sequence.id());
        }
    }
    let mut seen = Seen(Vec::new());
    dfs_in_order(&mut seen, function, function.entry_block());
    seen.0
}

fn never_returns(function: &LocalFunction) -> bool {
    let ends = function.block(function.entry_block()).last().is_some_and(|(last, _)| last.is_unreachable());
    let returns = |id: InstrSeqId| function.block(id).iter().any(|(instruction, _)| instruction.is_return());
    ends && !sequences(function).into_iter().any(returns)
}

/// Turns calls of `traps` into traps, and drops what comes before a trap where nobody can see it. Whether the function is
/// only a trap now.
fn cut(function: &mut LocalFunction, traps: &HashSet<FunctionId>) -> bool {
    for id in sequences(function) {
        let instructions = &mut function.block_mut(id).instrs;
        let is_trap = |instruction: &Instr| match instruction {
            Instr::Call(call) => traps.contains(&call.func),
            other => other.is_unreachable(),
        };
        let Some(end) = instructions.iter().position(|(instruction, _)| is_trap(instruction)) else { continue };
        let start = instructions[..end].iter().rposition(|(instruction, _)| !unseen(instruction)).map_or(0, |i| i + 1);
        instructions.truncate(start);
        instructions.push((Unreachable {}.into(), Default::default()));
    }
    matches!(&function.block(function.entry_block()).instrs[..], [(only, _)] if only.is_unreachable())
}

/// Whether nothing is seen of an instruction that a trap follows: it neither calls nor jumps.
fn unseen(instruction: &Instr) -> bool {
    matches!(
        instruction,
        Instr::LocalGet(_)
            | Instr::LocalSet(_)
            | Instr::LocalTee(_)
            | Instr::GlobalGet(_)
            | Instr::GlobalSet(_)
            | Instr::Const(_)
            | Instr::Binop(_)
            | Instr::Unop(_)
            | Instr::TernOp(_)
            | Instr::Select(_)
            | Instr::Drop(_)
            | Instr::Load(_)
            | Instr::Store(_)
            | Instr::LoadSimd(_)
    )
}
