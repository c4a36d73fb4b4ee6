//! Functions in an order in which they compress well: gzip finds what it has met before in the last 32 kB only, so what is
//! alike should stand together.
//!
//! Each function in turn is the one that has most in common with those just before it, counted in pieces of five bytes that
//! few functions have.

use std::collections::HashMap;
use std::convert::Infallible;

use anyhow::{Result, anyhow};
use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{CodeSectionReader, FunctionSectionReader, Parser, Payload, TypeRef};

/// The length of the pieces that are compared.
const PIECE: usize = 5;

/// Pieces that more functions have tell nothing of any of them.
const COMMON: usize = 40;

/// How many bytes before a function count.
const WINDOW: usize = 12_000;

/// Writes to `to` the module in `from` with its functions in another order.
pub fn arrange(from: &str, to: &str) -> Result<()> {
    let file = std::fs::read(from)?;
    let (mut imported, mut bodies) = (0, Vec::new());
    for payload in Parser::new(0).parse_all(&file) {
        match payload? {
            Payload::ImportSection(section) => {
                for import in section.into_imports() {
                    imported += u32::from(matches!(import?.ty, TypeRef::Func(_) | TypeRef::FuncExact(_)));
                }
            }
            Payload::CodeSectionEntry(body) => bodies.push(&file[body.range()]),
            _ => {}
        }
    }
    let order = alike(&bodies);
    let mut numbers = vec![0; bodies.len()];
    for (number, &function) in (imported..).zip(&order) {
        numbers[function] = number;
    }
    let mut module = Module::new();
    let arranged = Arranged { imported, order, numbers }.parse_core_module(&mut module, Parser::new(0), &file);
    arranged.map_err(|error| anyhow!("{error}"))?;
    Ok(std::fs::write(to, module.finish())?)
}

/// An order in which what is alike stands together.
fn alike(bodies: &[&[u8]]) -> Vec<usize> {
    let pieces: Vec<Vec<&[u8]>> = bodies.iter().map(|body| pieces(body)).collect();
    let mut owners: HashMap<&[u8], Vec<usize>> = HashMap::new();
    for (function, pieces) in pieces.iter().enumerate() {
        pieces.iter().for_each(|piece| owners.entry(piece).or_default().push(function));
    }
    owners.retain(|_, functions| (2..=COMMON).contains(&functions.len()));
    // how often each piece stands in the window, and how many of those that do each function has
    let mut window: HashMap<&[u8], usize> = HashMap::new();
    let mut shared = vec![0usize; bodies.len()];
    let mut left: Vec<usize> = (0..bodies.len()).collect();
    let mut order: Vec<usize> = Vec::with_capacity(bodies.len());
    let (mut first, mut length) = (0, 0);
    while !left.is_empty() {
        let gain =
            |function: usize| shared[function] as f64 / ((pieces[function].len() as f64).powf(0.7) + PIECE as f64);
        let mut best = 0;
        for place in 1..left.len() {
            if gain(left[place]) > gain(left[best]) {
                best = place;
            }
        }
        let next = left.remove(best);
        order.push(next);
        length += bodies[next].len();
        for piece in &pieces[next] {
            let Some(functions) = owners.get(piece) else { continue };
            let times = window.entry(piece).or_default();
            *times += 1;
            if *times == 1 {
                functions.iter().for_each(|&function| shared[function] += 1);
            }
        }
        while length > WINDOW {
            let gone = order[first];
            (first, length) = (first + 1, length - bodies[gone].len());
            for piece in &pieces[gone] {
                let (Some(functions), Some(times)) = (owners.get(piece), window.get_mut(piece)) else { continue };
                *times -= 1;
                if *times == 0 {
                    functions.iter().for_each(|&function| shared[function] -= 1);
                }
            }
        }
    }
    order
}

/// Its pieces, each once.
fn pieces(body: &[u8]) -> Vec<&[u8]> {
    let mut pieces: Vec<&[u8]> = body.windows(PIECE).collect();
    pieces.sort_unstable();
    pieces.dedup();
    pieces
}

/// Writes a module anew, with its functions in this order.
struct Arranged {
    imported: u32,
    order: Vec<usize>,
    /// The new number of each function.
    numbers: Vec<u32>,
}

impl Reencode for Arranged {
    type Error = Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error<Infallible>> {
        let own = function.checked_sub(self.imported).and_then(|own| self.numbers.get(own as usize));
        Ok(own.copied().unwrap_or(function))
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let types = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        for function in self.order.clone() {
            functions.function(self.type_index(types[function])?);
        }
        Ok(())
    }

    fn parse_code_section(
        &mut self,
        code: &mut CodeSection,
        section: CodeSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let bodies = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        for function in self.order.clone() {
            self.parse_function_body(code, bodies[function].clone())?;
        }
        Ok(())
    }
}
