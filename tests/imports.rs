//! The structure of the sources: imports between rooms (the table in ARCHITECTURE.md), sizes of rooms and files, and
//! cycles of imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms with the crates that they must not name.
const FORBIDDEN: &[(&str, &[&str])] = &[
    ("optics", NO_GPU),
    ("files", NO_GPU),
    ("state", NO_GPU),
    ("waves", NO_GPU),
    ("coast", NO_GPU),
    ("point", NO_GPU),
    ("oracle", NO_GPU),
    ("gpu", NO_WINDOW),
    ("shaders", NO_WINDOW),
    ("sim", NO_WINDOW),
    ("render", NO_WINDOW),
    ("ocean", NO_WINDOW),
    ("bench", NO_WINDOW),
    ("governor", NO_GPU),
    ("lab", NO_WINDOW),
    ("cli", NO_WINDOW),
];
const NO_GPU: &[&str] = &["wgpu", "bytemuck", "egui", "eframe", "web_sys"];
const NO_WINDOW: &[&str] = &["egui", "eframe", "web_sys"];

/// Most lines of a file of Rust and of WGSL.
const RUST_LINES: usize = 400;
const WGSL_LINES: usize = 250;
/// Largest share of the source that one room may hold.
const ROOM_SHARE: f64 = 0.15;
/// Most files in a cycle of imports.
const CIRCLE: usize = 3;

struct Source {
    /// Path relative to the package, such as `src/waves/plan.rs`.
    name: String,
    /// First folder below src, or the file's stem.
    room: String,
    lines: usize,
    /// Without comments and unit tests.
    code: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(at: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(at).expect("a folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() { files(&path, out) } else { out.push(path) }
    }
}

/// All files below a folder of the package that end in `.extension`.
fn sources(folder: &str, extension: &str) -> Vec<Source> {
    let mut paths = Vec::new();
    files(&root().join(folder), &mut paths);
    paths.retain(|p| p.extension().is_some_and(|e| e == extension));
    paths.sort();
    let source = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("source");
        let name = path.strip_prefix(root()).expect("below the package").to_string_lossy().replace('\\', "/");
        let room = name.split('/').nth(1).expect("a folder").trim_end_matches(".rs").to_owned();
        let is_test = name.ends_with("/tests.rs") || name.contains("/tests/");
        let code = if is_test { "" } else { text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default() };
        let code = code.lines().map(|l| l.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n");
        Source { lines: text.lines().count(), name, room, code }
    };
    paths.into_iter().map(source).collect()
}

/// Paths in code that begin with `crate`, `super` or `self`; each item of a group gives a path.
fn paths(code: &str) -> Vec<Vec<String>> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for start in ["crate::", "super::", "self::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| is_word(c) || c == ':') {
                continue;
            }
            expand(&code[at..], Vec::new(), &mut found);
        }
    }
    found
}

/// Adds the paths of a use tree that begins at `text`; returns what follows it.
fn expand<'a>(text: &'a str, prefix: Vec<String>, out: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        loop {
            rest = expand(rest, prefix.clone(), out).trim_start();
            match rest.strip_prefix(',') {
                Some(next) if next.trim_start().starts_with('}') => return &next.trim_start()[1..],
                Some(next) => rest = next,
                None => return rest.strip_prefix('}').unwrap_or(rest),
            }
        }
    }
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    let mut path = prefix;
    path.push(text[..end].to_owned());
    match text[end..].strip_prefix("::") {
        Some(rest) => expand(rest, path, out),
        None => {
            out.push(path);
            &text[end..]
        }
    }
}

/// The file of the item that a path names in the file `from`: the longest prefix of the path that is a module decides.
fn target(from: &str, path: &[String], known: &BTreeSet<String>) -> Option<String> {
    let mut module: Vec<&str> = from.trim_start_matches("src/").trim_end_matches(".rs").split('/').collect();
    if module.last() == Some(&"mod") {
        module.pop();
    }
    for word in path {
        match word.as_str() {
            "crate" => module.clear(),
            "super" => drop(module.pop()),
            "self" => {}
            word => module.push(word),
        }
    }
    (1..=module.len()).rev().find_map(|length| {
        let stem = format!("src/{}", module[..length].join("/"));
        [format!("{stem}.rs"), format!("{stem}/mod.rs")].into_iter().find(|name| known.contains(name))
    })
}

/// The files that each file imports.
fn imports(sources: &[Source]) -> BTreeMap<&str, BTreeSet<String>> {
    let known: BTreeSet<String> = sources.iter().map(|s| s.name.clone()).collect();
    let of = |s: &Source| -> BTreeSet<String> {
        paths(&s.code).iter().filter_map(|p| target(&s.name, p, &known)).filter(|name| *name != s.name).collect()
    };
    sources.iter().map(|s| (s.name.as_str(), of(s))).collect()
}

/// The table of ARCHITECTURE.md: each room with its imports, from the lowest room to the highest.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let rows = text.lines().skip_while(|l| !l.starts_with("| room | imports |")).skip(2);
    rows.take_while(|l| l.starts_with('|'))
        .map(|row| {
            let mut cells = row.trim_matches('|').split('|').map(str::trim);
            let names = |cell: &str| cell.split(',').map(|n| n.trim().trim_matches('`').to_owned()).collect::<Vec<_>>();
            let room = names(cells.next().expect("a room")).remove(0);
            let imports = names(cells.next().expect("imports")).into_iter().filter(|n| !n.is_empty()).collect();
            (room, imports)
        })
        .collect()
}

#[test]
fn rooms_import_exactly_what_the_table_says() {
    let sources = sources("src", "rs");
    let mut seen: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, targets) in imports(&sources) {
        let room = |name: &str| name.split('/').nth(1).expect("a room").trim_end_matches(".rs").to_owned();
        if from == "src/lib.rs" || from == "src/main.rs" {
            continue;
        }
        let rooms = seen.entry(room(from)).or_default();
        rooms.extend(targets.iter().map(|t| room(t)).filter(|r| *r != room(from)));
    }
    let table = table();
    let mut below = BTreeSet::new();
    for (room, imports) in &table {
        let climbing: Vec<_> = imports.iter().filter(|i| !below.contains(*i)).collect();
        assert!(climbing.is_empty(), "{room} imports {climbing:?}, which the table lists above it or not at all");
        below.insert(room.clone());
    }
    let table: BTreeMap<_, _> = table.into_iter().collect();
    assert_eq!(seen, table, "left: what the sources import; right: the table in ARCHITECTURE.md");
}

#[test]
fn rooms_name_no_crate_that_is_not_theirs() {
    for source in sources("src", "rs") {
        for (_, crates) in FORBIDDEN.iter().filter(|(room, _)| *room == source.room) {
            let mut words = source.code.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let named = words.find(|word| crates.contains(word));
            assert_eq!(named, None, "{}", source.name);
        }
    }
}

#[test]
fn the_renderer_sees_only_the_maps_of_the_simulation() {
    for source in sources("src", "rs").iter().filter(|s| s.room == "render") {
        for path in paths(&source.code).iter().filter(|p| p.len() > 2 && p[..2] == ["crate", "sim"]) {
            let seen = ["Maps", "MapCascade", "FoamLevel", "maps"].contains(&path[2].as_str());
            assert!(seen, "{} imports {}", source.name, path.join("::"));
        }
    }
}

#[test]
fn circles_of_imports_are_short() {
    let sources = sources("src", "rs");
    let imports = imports(&sources);
    // Everything that a file reaches by one import or more.
    let reach = |from: &str| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(at) = next.pop() {
            for to in imports.get(at.as_str()).into_iter().flatten() {
                if seen.insert(to.clone()) {
                    next.push(to.clone());
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&str, BTreeSet<String>> = imports.keys().map(|name| (*name, reach(name))).collect();
    for (name, others) in &reached {
        let circle: Vec<_> = others.iter().filter(|o| reached[o.as_str()].contains(*name)).collect();
        assert!(circle.len() <= CIRCLE, "a circle of {} files: {circle:?}", circle.len());
    }
}

#[test]
fn files_and_rooms_are_small() {
    let (rust, wgsl) = (sources("src", "rs"), sources("shaders", "wgsl"));
    for (files, most) in [(&rust, RUST_LINES), (&wgsl, WGSL_LINES)] {
        for file in files {
            assert!(file.lines <= most, "{} has {} lines, more than {most}", file.name, file.lines);
        }
    }
    let all: usize = rust.iter().chain(&wgsl).map(|f| f.lines).sum();
    let mut rooms: BTreeMap<&str, usize> = BTreeMap::new();
    for file in &rust {
        *rooms.entry(&file.room).or_default() += file.lines;
    }
    for (room, lines) in rooms {
        let share = lines as f64 / all as f64;
        assert!(share <= ROOM_SHARE, "{room} holds {:.1} % of {all} lines", 100.0 * share);
    }
}

#[test]
fn paths_are_read_off_code() {
    let found = paths("use crate::a::{self, b::{C, D}, e}; let x = super::f::g(1); xsuper::no();");
    let found: Vec<String> = found.iter().map(|p| p.join("::")).collect();
    let expected = ["crate::a::self", "crate::a::b::C", "crate::a::b::D", "crate::a::e", "super::f::g"];
    assert_eq!(found, expected);
    let known = ["src/a/mod.rs", "src/a/b.rs", "src/f.rs"].map(str::to_owned).into();
    let to = |from: &str, path: &str| target(from, &path.split("::").map(str::to_owned).collect::<Vec<_>>(), &known);
    assert_eq!(to("src/f.rs", "crate::a::b::C").as_deref(), Some("src/a/b.rs"));
    assert_eq!(to("src/a/b.rs", "super::X").as_deref(), Some("src/a/mod.rs"));
    assert_eq!(to("src/a/mod.rs", "super::f::g").as_deref(), Some("src/f.rs"));
}
