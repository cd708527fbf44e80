//! Who may import whom (ARCHITECTURE.md, "Who may import whom"), read off the sources.

use std::fs;
use std::path::{Path, PathBuf};

/// Each room and the rooms of this crate that it may use.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("model", &[]),
    ("oracle", &["model"]),
    ("gpu", &[]),
    ("sim", &["model", "gpu"]),
    ("render", &["model", "gpu", "sim"]),
    ("ocean", &["model", "gpu", "sim", "render"]),
    ("bench", &["model", "gpu", "sim", "ocean"]),
    ("app", &["model", "gpu", "sim", "ocean", "bench"]),
    ("cli", &["model", "gpu", "sim", "ocean", "oracle", "bench", "app"]),
];
/// Crates that a room must not name.
const FORBIDDEN: &[(&str, &[&str])] = &[
    ("model", &["wgpu", "egui", "eframe", "web_sys", "bytemuck"]),
    ("oracle", &["wgpu", "egui", "eframe", "web_sys"]),
    ("gpu", &["egui", "eframe", "web_sys"]),
    ("sim", &["egui", "eframe", "web_sys"]),
    ("render", &["egui", "eframe", "web_sys"]),
    ("ocean", &["egui", "eframe", "web_sys"]),
    ("bench", &["egui", "eframe", "web_sys"]),
    ("cli", &["egui", "eframe", "web_sys"]),
];

fn sources(at: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(at).expect("src") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

/// The room of a file: the first folder below src, or the file itself.
fn room(root: &Path, file: &Path) -> String {
    let first = file.strip_prefix(root).expect("below src").components().next().expect("a name");
    Path::new(first.as_os_str()).file_stem().expect("a stem").to_string_lossy().into_owned()
}

/// The code of a file: without comments and unit tests, which may use what they like.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    text.lines().map(|l| l.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// Words that follow `crate::`, with groups `crate::{a, b::c}` taken apart.
fn edges(code: &str) -> Vec<String> {
    let word = |s: &str| s.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    code.split("crate::")
        .skip(1)
        .flat_map(|rest| match rest.strip_prefix('{') {
            Some(group) => group.split('}').next().unwrap_or_default().split(',').map(word).collect(),
            None => vec![word(rest)],
        })
        .filter(|w| !w.is_empty())
        .collect()
}

#[test]
fn rooms_import_only_what_they_may() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut seen = 0;
    for file in files {
        let room = room(&root, &file);
        if room == "lib" || room == "main" {
            continue;
        }
        let text = code(&fs::read_to_string(&file).expect("source"));
        let (_, allowed) = MAY_IMPORT.iter().find(|(r, _)| *r == room).unwrap_or_else(|| panic!("no rule for {room}"));
        for target in edges(&text) {
            seen += 1;
            let fine =
                target == room || allowed.contains(&target.as_str()) || !MAY_IMPORT.iter().any(|(r, _)| *r == target);
            assert!(fine, "{} imports {target}", file.display());
        }
        for (_, crates) in FORBIDDEN.iter().filter(|(r, _)| *r == room) {
            for name in *crates {
                let named = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|w| w == *name);
                assert!(!named, "{} names {name}", file.display());
            }
        }
        if room == "render" {
            for part in text.split("crate::sim::").skip(1) {
                let seen_only = ["Maps", "MapCascade", "FoamLevel", "{", "maps"].iter().any(|w| part.starts_with(w));
                assert!(seen_only, "{} sees more of the simulation than its maps", file.display());
            }
        }
    }
    assert!(seen > 30, "the test reads the sources: {seen} edges");
}
