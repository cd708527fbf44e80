//! Links keep their meaning: each link in tests/links.txt opens a sea of the recorded significant wave height.

use seastate::lab::gallery::GALLERY_PICTURES;
use seastate::state::start::START;
use seastate::state::{presets, query};
use seastate::waves::Plan;
use seastate::waves::statistics::SpectrumStatistics;

/// Largest relative error of a height: the file has four decimals, and the error of the quadrature is smaller.
const TOLERANCE: f64 = 2e-3;

/// A state string as the end of a link, if it is none already.
fn as_link(text: &str) -> String {
    if text.contains('?') { text.to_owned() } else { format!("?{text}") }
}

/// Significant wave height in m and link of every line.
fn links() -> Vec<(f64, String)> {
    let lines = include_str!("links.txt").lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let split = |line: &'static str| {
        let (height, link) = line.split_once(' ')?;
        Some((height.parse().ok()?, as_link(link)))
    };
    lines.map(|line| split(line).unwrap_or_else(|| panic!("{line}: no height and link"))).collect()
}

#[test]
fn every_link_opens_the_sea_that_it_opened_before() {
    let links = links();
    assert!(links.len() >= 44, "lines are added, never taken away: {}", links.len());
    for (height_m, link) in links {
        let (params, notices) = query::parse(&link);
        assert_eq!(notices, Vec::<String>::new(), "{link}");
        let hs_m = SpectrumStatistics::new(&Plan::new(&params)).hs_m;
        assert!((hs_m / height_m - 1.0).abs() < TOLERANCE, "{link}: {hs_m} m, and {height_m} m before");
        let today = query::write_to_keep(&params);
        assert_eq!(query::parse(&as_link(&today)), (params, vec![]), "{link}");
    }
}

#[test]
fn what_the_program_and_its_pages_link_to_is_among_them() {
    let known: Vec<_> = links().iter().map(|(_, link)| query::parse(link).0).collect();
    let gallery = GALLERY_PICTURES.iter().map(|sea| sea.state.to_owned());
    let built_in = presets::built_in().iter().map(|preset| preset.state.clone());
    let pages = [include_str!("../README.md"), include_str!("../docs/using.md"), include_str!("../docs/embedding.md")];
    let all =
        std::iter::once(START.to_owned()).chain(gallery).chain(built_in).chain(pages.into_iter().flat_map(quoted));
    let missing: Vec<String> = all.filter(|state| !known.contains(&query::parse(&as_link(state)).0)).collect();
    assert_eq!(missing, Vec::<String>::new(), "tests/links.txt lacks these");
}

/// State strings in a document: quoted words with a known key that are read without a notice.
fn quoted(page: &str) -> Vec<String> {
    let pieces =
        page.split(['\'', '`', '"']).filter(|piece| piece.contains('=') && !piece.contains(char::is_whitespace));
    let states = pieces.filter(|piece| {
        let reading = query::parse_with_keys(piece);
        !reading.keys_taken.is_empty() && reading.notices.is_empty()
    });
    states.map(str::to_owned).collect()
}
