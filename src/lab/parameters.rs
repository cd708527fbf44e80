//! `seastate keys`: lists the keys of the state string from [`FIELDS`], as text or as Markdown.

use super::page::MarkdownPage;
use crate::state::fields::{FIELDS, Field, Group};
use std::fmt::Write as _;

/// Keys of the state string that are not in [`FIELDS`], each with its meaning as Markdown text. [`parameter_listing`]
/// removes the markup.
const KEYS_NOT_IN_FIELDS: [(&str, &str); 3] = [
    (
        "measured",
        "A buoy's spectrum, shown by `spectrum=measured`: bands f\\*S or f\\*S\\*alpha1\\*alpha2\\*r1\\*r2, separated \
         by _, in Hz, m²/Hz, degrees that the waves come from, and 0..1. The program writes it when it reads a buoy's \
         file.",
    ),
    (
        "sky",
        "Name of a sky file, an equirectangular `.hdr` or `.exr` in linear light, that is dropped on the window or \
         given by `--sky`. A link does not contain the file: without it, the built-in sky is shown, with a notice.",
    ),
    (
        "afloat",
        "Floating objects: `buoy`, `boat` or `yacht`, metres east, metres south, joined by \\*, separated by _: \
         `buoy*20*-30_boat*0*40`. At most 16.",
    ),
];

/// Lists the keys of the state string with units, ranges, defaults and meaning, as text for a terminal.
pub fn parameter_listing() -> String {
    let mut text = String::new();
    for field in FIELDS.iter() {
        let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
        let default = field.format(field.default_value());
        let _ = writeln!(text, "{:<10} {} (default {default}{unit})", field.key, field.allowed_values_text());
        let _ = writeln!(text, "           {}", field.help);
    }
    for (key, meaning) in KEYS_NOT_IN_FIELDS {
        let _ = writeln!(text, "{key:<10} {}", meaning.replace(['\\', '`'], ""));
    }
    text
}

/// The Markdown text of docs/parameters.md.
pub fn parameters_markdown() -> String {
    let mut page = MarkdownPage::default();
    page.heading(1, "Parameters");
    page.paragraph(
        "Every parameter has a key in the state string, which holds only the values that differ from their defaults. \
         `seastate keys --markdown` writes this page from the program's own table; `seastate keys` prints the table to \
         a terminal.",
    );
    for group in Group::ALL {
        page.heading(2, group.label());
        let rows: Vec<_> = FIELDS.iter().filter(|f| f.group == group).map(parameter_table_row).collect();
        page.table("key | name | unit | values | default | meaning", &rows);
    }
    page.heading(2, "Other keys");
    for (key, meaning) in KEYS_NOT_IN_FIELDS {
        page.paragraph(&format!("`{key}`: {meaning}"));
    }
    page.markdown()
}

fn parameter_table_row(field: &Field) -> Vec<String> {
    let unit = match field.unit {
        "deg" => "°",
        unit => unit,
    };
    let default = field.default_value();
    let default =
        if default == 0.0 && !field.zero_word.is_empty() { field.zero_word.to_owned() } else { field.format(default) };
    let key = format!("`{}`", field.key);
    vec![key, field.label.into(), unit.into(), field.allowed_values_text(), default, escape_markdown(field.help)]
}

/// Puts a backslash before each `*`, `|` and `_` of a text, so that Markdown shows these characters as they are.
fn escape_markdown(text: &str) -> String {
    text.replace('*', "\\*").replace('|', "\\|").replace('_', "\\_")
}
