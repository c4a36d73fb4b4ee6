//! Every type that a user can name has an example in its own documentation.

use std::collections::BTreeSet;
use std::path::Path;

/// The types that `src/lib.rs` exports, from its `pub use` lines that are not within a hidden module.
fn exported(source: &Path) -> BTreeSet<String> {
    let text = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let statements = text.split(';').filter_map(|statement| statement.split("\npub use ").nth(1));
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
    found.retain(|(name, _, _)| names.contains(name));
    assert!(found.len() >= 15, "this test no longer finds the types: {found:?}");
    let missing: Vec<&str> = found.iter().filter(|found| !found.2).map(|(_, place, _)| place.as_str()).collect();
    assert!(missing.is_empty(), "no example in the documentation of\n{}", missing.join("\n"));
}
