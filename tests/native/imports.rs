//! What may import what (design, 3), how long a file may be, and that nothing outside tests can panic by name: read from the
//! sources line by line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Each part of the crate and the parts that it may name with `crate::`. `error` and `value` are at the bottom.
const RUST: [(&str, &[&str]); 16] = [
    ("error", &[]),
    // the numbers of messages, as JavaScript prints them
    ("value", &["wasm"]),
    ("math", &["math"]),
    ("model", &["math", "model"]),
    ("conditionally_markov", &["math", "model", "conditionally_markov"]),
    ("posterior", &["math", "model", "posterior"]),
    ("engine", &["math", "model", "posterior"]),
    ("likelihood", &["math", "model", "posterior", "engine", "likelihood"]),
    ("pointing", &["math", "model", "posterior", "engine", "pointing"]),
    ("scenario", &["math", "model", "engine", "likelihood", "pointing", "scenario"]),
    ("pointer", &["model", "pointing", "scenario"]),
    ("predictor", &["math", "model", "posterior", "engine", "likelihood", "scenario", "predictor"]),
    ("snapshot", &["model", "scenario", "predictor"]),
    ("study", &["math", "model", "likelihood", "pointing", "scenario", "predictor", "snapshot", "study"]),
    ("internals", &["math", "model", "conditionally_markov", "scenario", "predictor", "snapshot", "study"]),
    (
        "wasm",
        &[
            "internals",
            "math",
            "conditionally_markov",
            "posterior",
            "pointing",
            "scenario",
            "pointer",
            "predictor",
            "snapshot",
            "study",
            "wasm",
        ],
    ),
];

/// Methods of the papers never import one another.
const METHODS: [&str; 5] = ["algorithm1", "algorithm2", "bridging", "pseudo_observation/dense", "single_filter"];

/// Each folder of js/ and the others that it may import.
const JAVASCRIPT: [(&str, &[&str]); 10] = [
    ("core", &[]),
    ("pointing", &["core"]),
    ("study", &["core"]),
    ("dom", &["core"]),
    ("links", &["core"]),
    ("menu", &["core"]),
    ("overlay", &["core"]),
    ("react", &[]),
    ("testing", &["core"]),
    ("entries", &["core", "pointing", "dom", "links", "menu", "overlay", "react", "testing", "study"]),
];

/// Folders of entries beside `whither/dom`: they import its public names, as `#dom`.
const BESIDE_DOM: [&str; 4] = ["links", "menu", "overlay", "react"];

/// Folders of which another may import types alone: its code comes later, by `import()`.
const TYPES: [(&str, &str); 1] = [("dom", "pointing")];

/// What `import()` may name, and the folder of js/ that may do so: bundlers make a chunk of each.
const LATER: [(&str, &str); 3] = [("dom", "#pointing"), ("dom", "#prediction"), ("dom", "#keyboard")];

/// Who imports the generated code: `#wasm` and `#bytes` are that of the entry's own module.
const GENERATED: [&str; 5] = [
    "js/core/loading/embedded.ts",
    "js/core/loading/instance.ts",
    "js/entries/study.ts",
    "js/pointing/predictor.ts",
    "js/study/fit.ts",
];

const LONGEST: usize = 450;

fn files(folder: &str, extension: &str) -> Vec<(String, String)> {
    fn walk(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                walk(&path, extension, found);
            } else if path.to_str().unwrap().ends_with(extension) {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    walk(&root.join(folder), extension, &mut found);
    found.sort();
    assert!(!found.is_empty(), "{folder}");
    let named = |path: PathBuf| {
        let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
        (name, std::fs::read_to_string(&path).unwrap())
    };
    found.into_iter().map(named).collect()
}

/// The Rust sources without their tests, comments left out.
fn rust() -> Vec<(String, Vec<String>)> {
    let is_test = |name: &str| name.ends_with("/tests.rs");
    let code = |text: &str| {
        let lines = text.lines().take_while(|line| *line != "#[cfg(test)]");
        lines.filter(|line| !line.trim_start().starts_with("//")).map(str::to_owned).collect()
    };
    let sources = files("src", ".rs").into_iter().chain(files("kernel/src", ".rs"));
    sources.filter(|(name, _)| !is_test(name)).map(|(name, text)| (name, code(&text))).collect()
}

/// The words after each `prefix::` in a line.
fn named<'a>(line: &'a str, prefix: &'a str) -> impl Iterator<Item = &'a str> {
    let word = |rest: &'a str| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
    line.split(prefix).skip(1).map(word)
}

#[test]
fn imports_go_one_way() {
    let legal: BTreeMap<&str, &[&str]> = RUST.into_iter().collect();
    let mut wrong = Vec::new();
    for (name, lines) in rust() {
        // a package of its own, which cannot name this one
        let Some(inside) = name.strip_prefix("src/") else { continue };
        let part = inside.split(['/', '.']).next().unwrap().to_owned();
        if part == "lib" {
            continue;
        }
        let may = legal.get(part.as_str()).unwrap_or_else(|| panic!("{name} belongs to no part"));
        for line in &lines {
            for import in named(line, "crate::") {
                let bottom =
                    ["error", "value"].contains(&import) && (part != "error" && part != "value" || import == "error");
                // a name from the crate's public root
                let root = part == "wasm" && import.chars().next().is_some_and(|c| c.is_uppercase() || c == '{');
                if !bottom && !root && import != part && !may.contains(&import) {
                    wrong.push(format!("{name}: {part} -> {import}: {}", line.trim()));
                }
            }
        }
        let method = METHODS.iter().find(|method| name == format!("src/likelihood/{method}.rs"));
        if let Some(method) = method {
            let others = |line: &&String| {
                line.trim_start().starts_with("use ")
                    && METHODS.iter().any(|other| other != method && line.contains(other))
            };
            wrong.extend(lines.iter().filter(others).map(|line| format!("{name}: {line}")));
        }
        if part != "wasm" && part != "lib" {
            let boundary = lines.iter().filter(|line| line.contains("wasm_bindgen") || line.contains("js_sys"));
            wrong.extend(boundary.map(|line| format!("{name}: {line}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The folder of js/ that a file there imports by `path`.
fn folder_of(file: &str, path: &str) -> String {
    let mut parts: Vec<&str> = file.split('/').collect();
    parts.pop();
    for step in path.split('/') {
        match step {
            "." => (),
            ".." => drop(parts.pop()),
            name => parts.push(name),
        }
    }
    parts.get(1).copied().unwrap_or_default().to_owned()
}

/// The paths that a file imports or exports from, and whether only types.
fn imports(text: &str) -> Vec<(&str, bool)> {
    let import = |(at, _): (usize, &str)| {
        let path = text[at..].split('"').nth(1).unwrap();
        let begin = text[..at].rfind("import ").max(text[..at].rfind("export ")).unwrap_or(at);
        (path, text[begin..].split(' ').nth(1) == Some("type"))
    };
    text.match_indices(" from \"").map(import).collect()
}

#[test]
fn javascript_imports_go_one_way() {
    let legal: BTreeMap<&str, &[&str]> = JAVASCRIPT.into_iter().collect();
    let mut wrong = Vec::new();
    // what tests alone use may take the rooms that they test apart
    let is_source = |name: &str| {
        let of_tests = name.ends_with(".test.ts") || name.starts_with("js/menu/testing/");
        !name.starts_with("js/generated/") && !of_tests
    };
    for (name, text) in files("js", ".ts").into_iter().filter(|(name, _)| is_source(name)) {
        let own = name.split('/').nth(1).unwrap();
        let may = legal.get(own).unwrap_or_else(|| panic!("{name} belongs to no folder of js/"));
        for (path, only_types) in imports(&text) {
            let legal = match path {
                "#error" | "#module" => true,
                "#dom" => BESIDE_DOM.contains(&own),
                "react" => own == "react",
                "#wasm" | "#bytes" => GENERATED.contains(&name.as_str()),
                _ => match folder_of(&name, path).as_str() {
                    "generated" => GENERATED.contains(&name.as_str()),
                    folder => folder == own || may.contains(&folder) || only_types && TYPES.contains(&(own, folder)),
                },
            };
            if !legal {
                wrong.push(format!("{name}: {path}"));
            }
        }
        let later = text.split("import(\"").skip(1).filter_map(|rest| rest.split('"').next());
        wrong.extend(
            later.filter(|path| !LATER.contains(&(own, path))).map(|path| format!("{name}: import(\"{path}\")")),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_page_imports_the_package_by_its_name() {
    let mut wrong = Vec::new();
    for (name, text) in files("www", ".ts") {
        for line in
            text.lines().filter(|line| line.contains(" from \"../") && (line.contains("js/") || line.contains("dist/")))
        {
            wrong.push(format!("{name}: {line}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_file_is_long() {
    let long: Vec<String> = files("src", ".rs")
        .into_iter()
        .chain(files("kernel/src", ".rs"))
        .chain(files("js", ".ts"))
        .chain(files("tests/native", ".rs"))
        .filter(|(name, _)| !name.ends_with("tests.rs") && !name.ends_with(".test.ts"))
        .map(|(name, text)| (name, text.lines().take_while(|line| *line != "#[cfg(test)]").count()))
        .filter(|(_, lines)| *lines > LONGEST)
        .map(|(name, lines)| format!("{name}: {lines} lines, at most {LONGEST}"))
        .collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn nothing_outside_tests_panics_by_name() {
    let words = [".unwrap()", ".expect(", "panic!(", "unreachable!(", "todo!(", "unimplemented!("];
    let mut wrong = Vec::new();
    for (name, lines) in rust() {
        let found = lines.iter().filter(|line| words.iter().any(|word| line.contains(word)));
        wrong.extend(found.map(|line| format!("{name}: {}", line.trim())));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
