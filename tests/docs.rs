//! The pages that the program writes about itself are what it would write.

use seastate::cli::objectives::{AWAITED, OUTSIDE, SECTIONS};
use seastate::cli::parameters;
use seastate::lab::gallery::{self, SEAS};
use seastate::state::fields::{FIELDS, find};
use seastate::state::query;
use seastate::waves::Plan;
use std::collections::BTreeSet;
use std::path::PathBuf;

fn committed(file: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs").join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn the_page_of_parameters_is_what_the_program_writes() {
    let now = parameters::page();
    assert!(committed("parameters.md") == now, "run: seastate keys --markdown > docs/parameters.md");
    for field in FIELDS.iter() {
        assert!(now.contains(&format!("| `{}` |", field.key)), "{}", field.key);
    }
}

#[test]
fn every_objective_is_answered() {
    let mut seen = BTreeSet::new();
    for (section, objectives) in SECTIONS {
        for (number, text, keys, how) in *objectives {
            assert!(seen.insert((section, number)), "{section}, {number} twice");
            assert!(!keys.is_empty() || !how.is_empty(), "{section}, {number}: {text}");
            for key in *keys {
                assert!(
                    find(key).is_some() || AWAITED.contains(key) || OUTSIDE.contains(key),
                    "{section}, {number}: there is no {key}"
                );
            }
        }
    }
    assert_eq!(seen.len(), 30 + 29 + 51, "none is left out");
}

#[test]
fn the_gallery_is_what_its_table_would_write() {
    assert!(committed("gallery.md") == gallery::page(), "run: seastate gallery");
    let mut files = BTreeSet::new();
    for sea in SEAS {
        assert!(files.insert(sea.file()), "{}: two pictures of one name", sea.title);
        let (params, notices) = query::parse(sea.state);
        assert_eq!(notices, Vec::<String>::new(), "{}", sea.title);
        assert_eq!(Plan::new(&params).notices, Vec::<String>::new(), "{}", sea.title);
        // In the order of FIELDS, and without values that are the default anyway.
        assert_eq!(query::write(&params), sea.state, "{}", sea.title);
    }
}

#[test]
fn the_users_guide_lists_the_keys() {
    let guide = include_str!("../docs/using.md");
    for (key, does) in seastate::app::keys::KEYS {
        let row = format!("| {key} | {does} |");
        assert!(guide.contains(&row), "docs/using.md lacks: {row}");
    }
}
