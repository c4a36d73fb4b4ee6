//! What nothing refers to any more: data, and functions that only a table names.
//!
//! The linker keeps whatever a panic might have told and printed, since it cannot know that the panics will be cut. Asked to
//! (`--emit-relocs`) it leaves behind where each address and each place in the table of functions stands, in code and in data;
//! followed from the exports on, they tell what is still in use. Of the rest, data becomes zeros, which weigh nothing, and
//! functions leave the table, so that wasm-opt can drop them.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use anyhow::{Context, Result, bail};
use walrus::ir::InstrLocId;
use walrus::{ElementItems, ExportItem, FunctionId, FunctionKind, Module};
use wasmparser::{KnownCustom, Linking, Parser, Payload, RelocationEntry, RelocationType, SymbolInfo};

use crate::snip::sequences;

/// What the linker gave a name.
enum Symbol {
    Function(u32),
    Data { segment: usize, range: Range<usize> },
    Other,
}

/// What refers to what, as the linker wrote it down.
pub struct References {
    symbols: Vec<Symbol>,
    /// By the instruction that refers.
    by_instruction: HashMap<u32, Vec<u32>>,
    /// In data: the segment, where in it, the symbol.
    by_data: Vec<(usize, usize, u32)>,
    /// By their numbers in the file.
    functions: Vec<FunctionId>,
    /// What tells where in the sources a panic would be: read by panics alone, even where the code still names it.
    places: HashSet<u32>,
}

impl References {
    /// Reads them from the file that `module` was parsed from.
    pub fn read(file: &[u8], module: &Module) -> Result<Self> {
        let (mut symbols, mut segments) = (Vec::new(), Vec::new());
        let (mut code, mut data) = (Vec::new(), Vec::new());
        let mut data_start = 0;
        for payload in Parser::new(0).parse_all(file) {
            match payload? {
                Payload::DataSection(section) => {
                    data_start = section.range().start;
                    for segment in section {
                        let segment = segment?;
                        // what the segment holds ends where the segment does
                        segments.push(segment.range.end - segment.data.len()..segment.range.end);
                    }
                }
                Payload::CustomSection(section) => match section.as_known() {
                    KnownCustom::Linking(linking) => {
                        for part in linking.subsections() {
                            let Linking::SymbolTable(table) = part? else { continue };
                            for symbol in table {
                                symbols.push(Symbol::of(&symbol?));
                            }
                        }
                    }
                    KnownCustom::Reloc(relocations) => {
                        let list = if section.name() == "reloc.CODE" { &mut code } else { &mut data };
                        for entry in relocations.entries() {
                            list.push(entry?);
                        }
                    }
                    _ => {}
                },
                _ => {}
            }
        }
        if symbols.is_empty() || code.is_empty() {
            bail!("no relocations: was it linked with --emit-relocs?");
        }
        let named = |entry: &&RelocationEntry| entry.ty != RelocationType::TypeIndexLeb;
        // both count from where the code begins
        let mut instructions: Vec<(usize, InstrLocId)> = Vec::new();
        for (_, function) in module.funcs.iter_local() {
            instructions.extend(&function.instruction_mapping);
        }
        instructions.sort_unstable_by_key(|(start, _)| *start);
        let mut by_instruction: HashMap<u32, Vec<u32>> = HashMap::new();
        for entry in code.iter().filter(named) {
            let after = instructions.partition_point(|(start, _)| *start <= entry.offset as usize);
            let (_, owner) = instructions[..after].last().context("a relocation before all code")?;
            by_instruction.entry(owner.data()).or_default().push(entry.index);
        }
        let mut by_data = Vec::new();
        for entry in data.iter().filter(named) {
            let position = data_start + entry.offset as usize;
            let segment = segments.iter().position(|range| range.contains(&position));
            let segment = segment.context("a relocation outside all data")?;
            by_data.push((segment, position - segments[segment].start, entry.index));
        }
        let functions = module.funcs.iter().map(walrus::Function::id).collect();
        let mut references = Self { symbols, by_instruction, by_data, functions, places: HashSet::new() };
        references.places = references.find_places(module);
        Ok(references)
    }

    /// The `core::panic::Location`s: the address of a file's name, its length, a line and a column.
    fn find_places(&self, module: &Module) -> HashSet<u32> {
        let contents: Vec<&[u8]> = module.data.iter().map(|data| data.value.as_slice()).collect();
        let named = |index: u32| match &self.symbols[index as usize] {
            Symbol::Data { segment, range } => {
                let name = contents[*segment][range.clone()].as_ref();
                Some(name.strip_suffix(b"\0").unwrap_or(name))
            }
            _ => None,
        };
        let is_place = |symbol: &Symbol| {
            let Symbol::Data { segment, range } = symbol else { return false };
            let first = self.by_data.iter().find(|(s, at, _)| s == segment && *at == range.start);
            let name = first.and_then(|(_, _, index)| named(*index));
            range.len() == 16 && name.is_some_and(|name| name.ends_with(b".rs"))
        };
        (0..).zip(&self.symbols).filter(|(_, symbol)| is_place(symbol)).map(|(index, _)| index).collect()
    }

    /// Takes out of `module` what is not in use. In the table `trap` stands for every function that is not.
    pub fn drop_unused(&self, module: &mut Module, trap: FunctionId) {
        let used = Used::of(self, module);
        let segments: Vec<_> = module.data.iter().map(walrus::Data::id).collect();
        let mut kept: Vec<Vec<bool>> =
            segments.iter().map(|&id| vec![false; module.data.get(id).value.len()]).collect();
        let mut known = kept.clone();
        for (i, symbol) in self.symbols.iter().enumerate() {
            let Symbol::Data { segment, range } = symbol else { continue };
            known[*segment][range.clone()].fill(true);
            if used.symbols.contains(&(i as u32)) {
                kept[*segment][range.clone()].fill(true);
            }
        }
        for ((id, kept), known) in segments.into_iter().zip(kept).zip(known) {
            let bytes = module.data.get_mut(id).value.iter_mut();
            bytes
                .zip(kept.into_iter().zip(known))
                .filter(|(_, (kept, known))| *known && !kept)
                .for_each(|(b, _)| *b = 0);
        }
        for element in module.elements.iter_mut() {
            if let ElementItems::Functions(list) = &mut element.items {
                list.iter_mut().filter(|id| !used.functions.contains(id)).for_each(|id| *id = trap);
            }
        }
        for name in ["linking", "reloc.CODE", "reloc.DATA"] {
            module.customs.remove_raw(name);
        }
    }
}

impl Symbol {
    fn of(symbol: &SymbolInfo<'_>) -> Self {
        match symbol {
            SymbolInfo::Func { index, .. } => Self::Function(*index),
            SymbolInfo::Data { symbol: Some(place), .. } => {
                let start = place.offset as usize;
                Self::Data { segment: place.index as usize, range: start..start + place.size as usize }
            }
            _ => Self::Other,
        }
    }
}

/// What can be reached from the exports.
struct Used {
    functions: HashSet<FunctionId>,
    symbols: HashSet<u32>,
}

impl Used {
    fn of(references: &References, module: &Module) -> Self {
        let mut used = Self { functions: HashSet::new(), symbols: HashSet::new() };
        let exported = module.exports.iter().filter_map(|export| match export.item {
            ExportItem::Function(id) => Some(id),
            _ => None,
        });
        let mut open: Vec<FunctionId> = exported.chain(module.start).collect();
        while let Some(id) = open.pop() {
            if !used.functions.insert(id) {
                continue;
            }
            let FunctionKind::Local(function) = &module.funcs.get(id).kind else { continue };
            for sequence in sequences(function) {
                let block = function.block(sequence);
                for (_, place) in &block.instrs {
                    used.follow(references, *place, &mut open);
                }
            }
        }
        used
    }

    fn follow(&mut self, references: &References, place: InstrLocId, open: &mut Vec<FunctionId>) {
        if place.is_default() {
            return; // a trap that was put in
        }
        let mut named = references.by_instruction.get(&place.data()).cloned().unwrap_or_default();
        while let Some(index) = named.pop() {
            if !self.symbols.insert(index) {
                continue;
            }
            if references.places.contains(&index) {
                continue;
            }
            match &references.symbols[index as usize] {
                Symbol::Function(number) => open.push(references.functions[*number as usize]),
                Symbol::Data { segment, range } => {
                    let inside = references.by_data.iter().filter(|(s, at, _)| s == segment && range.contains(at));
                    named.extend(inside.map(|(_, _, symbol)| symbol));
                }
                Symbol::Other => {}
            }
        }
    }
}
