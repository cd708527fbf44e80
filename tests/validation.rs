//! The validation page: its theoretical numbers are the program's, and a part of it can be measured and written.

use seastate::gpu::Gpu;
use seastate::lab::validate::{self, PAGE_PARTS, cells::PENDING_CELL};
use std::fs;
use std::path::PathBuf;

fn committed() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// The cells of every line of a table.
fn rows(text: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| line.trim_matches('|').split('|').map(|c| c.trim().to_owned()).collect();
    text.lines().filter(|l| l.starts_with('|')).map(cells).collect()
}

/// The first number of a cell, and the value of one unit of its last digit.
fn number(cell: &str) -> Option<(f64, f64)> {
    let word: String = cell.chars().take_while(|c| c.is_ascii_digit() || "+-.e".contains(*c)).collect();
    let value = word.parse().ok()?;
    let (digits, exponent) = word.split_once('e').unwrap_or((&word, "0"));
    let after = digits.split_once('.').map_or(0, |(_, after)| after.len() as i32);
    Some((value, 10f64.powi(exponent.parse::<i32>().ok()? - after)))
}

fn agree(a: &str, b: &str) -> bool {
    a == b
        || match (number(a), number(b)) {
            // The last digit may round the other way on another platform.
            (Some((x, digit)), Some((y, _))) => (x - y).abs() < 1.5 * digit,
            _ => false,
        }
}

#[test]
fn the_page_is_what_the_program_computes() {
    let now = validate::build_validation_page(None, 12, &PAGE_PARTS).expect("theory needs no GPU");
    let page = fs::read_to_string(committed().join("validation.md")).expect("docs/validation.md");
    let (ours, theirs) = (rows(&now.markdown()), rows(&page));
    assert_eq!(ours.len(), theirs.len(), "rows of tables");
    let (mut compared, mut stale) = (0, Vec::new());
    for (a, b) in ours.iter().zip(&theirs) {
        assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
        for (x, y) in a.iter().zip(b).filter(|(x, _)| *x != PENDING_CELL) {
            compared += 1;
            if !agree(x, y) {
                stale.push(format!("{x} but the page has {y} in {b:?}"));
            }
        }
    }
    assert!(stale.is_empty(), "run seastate validate:\n{}", stale.join("\n"));
    assert!(compared > 700, "{compared}");
    let prose = |text: &str| -> Vec<String> {
        let own = text.lines().filter(|l| !l.starts_with('|') && !l.starts_with("Measured over") && !l.is_empty());
        own.map(str::to_owned).collect()
    };
    for (ours, theirs) in prose(&now.markdown()).iter().zip(&prose(&page)) {
        assert_eq!(ours, theirs, "run seastate validate");
    }
    assert!(!page.contains(PENDING_CELL), "the page is measured");
    for (name, _) in now.figure_svgs() {
        let svg = fs::read_to_string(committed().join(format!("validation/{name}.svg"))).expect(name);
        assert!(svg.len() < 60_000, "{name}: {} bytes", svg.len());
        assert!(page.contains(&format!("validation/{name}.svg")), "{name} is shown");
    }
    let files = fs::read_dir(committed().join("validation")).expect("the figures").count();
    assert_eq!(files, now.figure_svgs().len(), "no figure is left over");
}

#[test]
fn a_slice_is_measured_and_written() {
    let gpu = pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers");
    let page = validate::build_validation_page(Some(&gpu), 2, &["dispersion"]).expect("a page");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("validation");
    // The folder may be left from an earlier run.
    let _ = fs::remove_dir_all(&folder);
    page.write(&folder).expect("the folder is writable");
    let text = fs::read_to_string(folder.join("validation.md")).expect("the page");
    let svg = fs::read_to_string(folder.join("validation/dispersion.svg")).expect("the figure");
    for label in ["wave number k, rad/m", "phase speed ω/k, m/s", "2 m of water"] {
        assert!(svg.contains(label), "{label}");
    }
    let rows = rows(&text);
    assert_eq!(rows.len(), 2 + 6);
    for row in &rows[2..] {
        assert!(row[1..].iter().all(|cell| number(cell).is_some()), "{row:?}");
        let (worst, _) = number(row.last().expect("cells")).expect("a number");
        assert!(worst < 0.1, "every wave runs at its speed: {row:?}");
        assert!(number(&row[5]).expect("a count").0 > 1000.0, "{row:?}");
    }
}
