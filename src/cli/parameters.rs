//! docs/parameters.md, written from [`FIELDS`] by `seastate keys --markdown`.

use crate::lab::validate::page::Page;
use crate::state::fields::{FIELDS, Field, Group};

/// The page.
pub fn page() -> String {
    let mut page = Page::default();
    page.heading(1, "Parameters");
    page.prose(
        "Every parameter has a key in the state string; only values that differ from the default are written there. \
         This page is written by `seastate keys --markdown` from the table that the program itself uses; `seastate \
         keys` prints the same for a terminal.",
    );
    for group in Group::ALL {
        page.heading(2, group.label());
        let rows: Vec<_> = FIELDS.iter().filter(|f| f.group == group).map(row).collect();
        page.table(&["key", "name", "unit", "values", "default", "meaning"], &rows);
    }
    page.heading(2, "Outside the table");
    page.prose(
        "`measured` carries a buoy's spectrum, shown by `spectrum=measured`: bands f\\*S or \
         f\\*S\\*alpha1\\*alpha2\\*r1\\*r2, separated by _, in Hz, m²/Hz, degrees that the waves come from, and 0..1. \
         The program writes it when it reads a buoy's file.",
    );
    page.prose(
        "`sky` is the name of a sky's file, an equirectangular `.hdr` or `.exr` in linear light, that is dropped on the sea or \
         given by `--sky`. A link cannot hold the picture: where it is not at hand the built sky is shown, with a notice.",
    );
    page.prose(
        "`afloat` says what floats where: `buoy` or `boat`, metres east, metres south, joined by \\*, separated by _: \
         `buoy*20*-30_boat*0*40`. At most 16 things float.",
    );
    format!("{}\n", page.text().trim_end())
}

fn row(field: &Field) -> Vec<String> {
    let unit = match field.unit {
        "deg" => "°",
        unit => unit,
    };
    let default = field.default_value();
    let default = if default == 0.0 && !field.zero.is_empty() { field.zero.to_owned() } else { field.format(default) };
    vec![code(field.key), field.label.into(), unit.into(), field.range(), default, escaped(field.help)]
}

fn code(key: &str) -> String {
    format!("`{key}`")
}

/// Text that Markdown shows as it is.
fn escaped(text: &str) -> String {
    text.replace('*', "\\*").replace('|', "\\|").replace('_', "\\_")
}
