//! The committed documents that the program generates are up to date.

use seastate::lab::gallery::{self, GALLERY_PICTURES};
use seastate::lab::parameters;
use seastate::state::fields::FIELDS;
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
    let now = parameters::parameters_markdown();
    assert!(committed("parameters.md") == now, "run: seastate keys --markdown > docs/parameters.md");
    for field in FIELDS.iter() {
        assert!(now.contains(&format!("| `{}` |", field.key)), "{}", field.key);
    }
}

#[test]
fn the_gallery_is_what_its_table_would_write() {
    assert!(committed("gallery.md") == gallery::gallery_markdown(), "run: seastate gallery");
    let mut files = BTreeSet::new();
    for picture in GALLERY_PICTURES {
        assert!(files.insert(picture.file_name()), "{}: two pictures of one name", picture.title);
        let (params, notices) = query::parse(picture.state);
        assert_eq!(notices, Vec::<String>::new(), "{}", picture.title);
        assert_eq!(Plan::new(&params).notices, Vec::<String>::new(), "{}", picture.title);
        // The keys stand in the order of FIELDS, without defaults.
        assert_eq!(query::write_to_keep(&params), picture.state, "{}", picture.title);
    }
}

#[test]
fn the_users_guide_lists_the_keys() {
    let guide = include_str!("../docs/using.md");
    for (key, does) in seastate::app::keys::KEYBOARD_HELP {
        let row = format!("| {key} | {does} |");
        assert!(guide.contains(&row), "docs/using.md lacks: {row}");
    }
}
