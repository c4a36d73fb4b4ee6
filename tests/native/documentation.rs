//! Every type that a user can name has an example in its own documentation, and every file that the equation map names holds what
//! the map states.

use std::collections::BTreeSet;
use std::path::Path;

/// The types that `src/lib.rs` exports from its private modules.
fn exported(source: &Path) -> BTreeSet<String> {
    let text = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let statements = text.split(';').filter_map(|statement| statement.split("pub use ").nth(1));
    let words = statements.flat_map(|names| names.split(|c: char| !(c.is_alphanumeric() || c == '_')));
    words.filter(|word| word.starts_with(char::is_uppercase)).map(str::to_owned).collect()
}

/// The public types of the files in `folder`: name, place, and whether the comment has an example.
fn types(folder: &Path, found: &mut Vec<(String, String, bool)>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            // the boundary has names of its own
            if !path.ends_with("wasm") {
                types(&path, found);
            }
            continue;
        }
        let (mut commented, mut example) = (false, false);
        for (number, line) in std::fs::read_to_string(&path).unwrap().lines().enumerate() {
            if line.starts_with("///") {
                example = (commented && example) || line.starts_with("/// ```");
                commented = true;
                continue;
            }
            let public = line.strip_prefix("pub ");
            let mut words = public.unwrap_or_default().split(|c: char| !(c.is_alphanumeric() || c == '_'));
            if let (Some("struct" | "enum" | "trait" | "type"), Some(name)) = (words.next(), words.next()) {
                found.push((name.to_owned(), format!("{}:{}", path.display(), number + 1), commented && example));
            }
            // attributes are between a comment and its type
            commented &= line.starts_with(['#', ' ', ')']);
        }
    }
}

#[test]
fn every_public_type_has_an_example() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (names, mut found) = (exported(&source), Vec::new());
    types(&source, &mut found);
    // `study` is a public module: all of its types are
    found.retain(|(name, place, _)| names.contains(name) || place.contains("/study/"));
    assert!(found.len() >= 35, "this test no longer finds the types: {found:?}");
    let missing: Vec<&str> = found.iter().filter(|found| !found.2).map(|(_, place, _)| place.as_str()).collect();
    assert!(missing.is_empty(), "no example in the documentation of\n{}", missing.join("\n"));
}

/// The rows of the equation map in `src/lib.rs`: the references, and the files.
fn equations(source: &Path) -> Vec<(String, Vec<String>)> {
    let text = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let rows = text.lines().skip_while(|line| *line != "//! | equation | what | file |").skip(2);
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let is_file = |word: &&str| word.starts_with("src/") || word.starts_with("kernel/src/");
        let files = cells[3].split('`').filter(is_file).map(str::to_owned).collect();
        (cells[1].to_owned(), files)
    };
    rows.take_while(|line| line.starts_with("//! |")).map(row).collect()
}

/// What a file's own comment must name of a reference: `Liang (5)` of `Liang (5) for y_1`.
fn number(reference: &str) -> &str {
    reference.find(')').map_or(reference, |end| &reference[..=end])
}

#[test]
fn the_equation_map_names_files_that_name_the_equations() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let rows = equations(&root.join("src"));
    assert!(rows.len() >= 15, "this test no longer finds the map: {rows:?}");
    let mut wrong = Vec::new();
    for (references, files) in &rows {
        if files.is_empty() {
            wrong.push(format!("{references}: no file"));
        }
        let heads: Vec<String> = files
            .iter()
            .map(|file| {
                let text = std::fs::read_to_string(root.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
                text.lines().take_while(|line| line.starts_with("//!")).collect()
            })
            .collect();
        for reference in references.split(", ").filter(|reference| reference.starts_with(char::is_uppercase)) {
            let named = heads.iter().filter(|head| head.contains(number(reference))).count();
            // a row of several references may have a file for each
            if named == 0 || named < files.len() && !references.contains(", ") {
                wrong.push(format!("{reference}: not in the comment at the top of {}", files.join(", ")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
