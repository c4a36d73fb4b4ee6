//! Every type that a user can name has an example in its own documentation.

use std::path::Path;

/// The types of the module at `path`, and of those below it, whose files lie in `folder`: where each is, and whether its
/// comment has an example. Modules for the crate alone are left out, and those that only some builds have.
fn types(path: &Path, folder: &Path, found: &mut Vec<(String, bool)>) {
    let text = std::fs::read_to_string(path).unwrap();
    let (mut commented, mut example, mut conditional) = (false, false, false);
    for (number, line) in text.lines().enumerate() {
        if line.starts_with("///") {
            example = (commented && example) || line.starts_with("/// ```");
            commented = true;
            continue;
        }
        let public = line.strip_prefix("pub ");
        let mut words = public.unwrap_or(line).split(|c: char| !(c.is_alphanumeric() || c == '_'));
        match (words.next(), words.next()) {
            (Some("mod"), Some(name)) if line.ends_with(';') && !conditional => {
                let below = folder.join(name);
                let file = [below.with_extension("rs"), below.join("mod.rs")].into_iter().find(|file| file.exists());
                types(&file.unwrap(), &below, found);
            }
            (Some("struct" | "enum" | "trait" | "type"), Some(name)) if public.is_some() => {
                found.push((format!("{}:{}: {name}", path.display(), number + 1), commented && example));
            }
            _ => {}
        }
        conditional = line.starts_with("#[cfg");
        // attributes stand between a comment and its type
        commented &= line.starts_with(['#', ' ', ')']);
    }
}

#[test]
fn every_public_type_has_an_example() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    types(&source.join("lib.rs"), &source, &mut found);
    assert!(found.iter().any(|(place, _)| place.ends_with("StepModel")), "this test no longer finds the types");
    let missing: Vec<&str> = found.iter().filter(|(_, example)| !example).map(|(place, _)| place.as_str()).collect();
    assert!(missing.is_empty(), "no example in the documentation of\n{}", missing.join("\n"));
}
