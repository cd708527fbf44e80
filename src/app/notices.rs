//! Notices in the language of the interface. The rooms that compose notices know nothing of languages: they write them in
//! English, which the command line prints. The app finds the pattern of each notice and translates the pattern.

use crate::app::language::{fill, text};

/// Patterns of the notices about state strings, named seas, skies, wave theory and the app's own measurements. Names in
/// braces stand for values. A pattern that fits more texts stands below those that fit fewer.
const PATTERNS: &[&str] = &[
    text!("the state string is longer than {limit} bytes: the rest was ignored"),
    text!("{key} appears more than once: the last one counts"),
    text!("unknown setting \"{key}\" ignored"),
    text!("{key} cannot be \"{value}\": {needed}, so the value is ignored"),
    text!("{key}={value} is outside {range}: {taken} taken"),
    text!("the link has version {version}, newer than this program's {newest}: some of it may mean something else"),
    text!("the link has an unknown version (v): read as the newest"),
    text!("and {count} more"),
    text!("more than {limit} objects float"),
    text!("the name has no printable character"),
    text!("a named sea does not set these parameters, they keep their values: {keys}"),
    text!("more than {limit} seas or {size} KiB cannot be kept: forget some of yours first"),
    text!("a sea without a name: ignored"),
    text!("{name}: no state: ignored"),
    text!("{name}: the state is longer than {limit} bytes: ignored"),
    text!("{name}: the name is cut to {limit} characters"),
    text!("{name}: \"{key}\" is not about, source or state: ignored"),
    text!("{count} line(s) before the first [name]: ignored"),
    text!("more than {limit} seas: {count} ignored"),
    text!("the file is longer than {size} KiB: the rest was ignored"),
    text!(
        "the sky \"{name}\" is not loaded, the computed sky is shown: drop the file on the sea, or name it with --sky"
    ),
    text!(
        "the coast is a file, which a link cannot carry: drop the bathymetry on the sea, or name it with --bathymetry"
    ),
    text!("the sea is {depth} m deep, and the coast begins in {edge} m: the waves jump where they meet"),
    text!("the waves near the coast could not be computed: they run on as in the open sea"),
    text!("the short-wave fade removes all waves: it is longer than they are"),
    text!("the short-wave fade removes all waves of a system whose height is set (hs)"),
    text!("a significant wave height of {height} m is too high for {depth} m of water: capped at {limit} m"),
    text!("waves with an rms slope of {slope} are too steep: their height is reduced"),
    text!("the loop is shorter than 30 peak periods: rounding the frequencies to it changes the sea"),
    text!("the waves are too high for second-order theory in this depth: their bound waves are reduced"),
    text!("Cascades: {cascades} of {points} points, which hold {percent} % of the wave energy."),
    text!("tessendorf has its own cos^2 directional spreading: spread is ignored"),
    text!("the directions come from the measured spectrum: dir and spread are ignored"),
    text!("height and period are set (hs, tp): wind and fetch have little effect on them"),
    text!("the {name} wave system is off: set {key} to switch it on"),
    text!("the sea is fully developed after {fetch} km (spectrum=pm); jonswap and tma keep growing"),
    text!("karaev covers g F / U^2 from {least} to {most}: a fetch of {fetch} km is used"),
    text!(
        "spectrum=measured needs a buoy's file: drop one here or give it with --spectrum; until then jonswap is used"
    ),
    text!("{count} pixels were negative, infinite or not a number: they were corrected"),
    text!("the image was reduced to {width} x {height} pixels"),
    text!("the image shows no compact sun: only the sky lights the sea"),
    text!("the sea was not measured: {reason}"),
    text!("your own seas: {notice}"),
    text!("{key}: {reason}: ignored"),
];

/// A notice in the language of the interface; a notice without a pattern stays English.
pub fn translate(notice: &str) -> String {
    let fitting = PATTERNS.iter().find_map(|pattern| values(pattern, notice).map(|values| (pattern, values)));
    let Some((pattern, values)) = fitting else { return notice.to_owned() };
    // Reasons within a notice are notices, too.
    let values: Vec<_> = values.into_iter().map(|(name, value)| (name, nested(name, value))).collect();
    fill(pattern, &values)
}

fn nested(name: &str, value: &str) -> String {
    if matches!(name, "notice" | "reason") { translate(value) } else { value.to_owned() }
}

/// The values at the places of a pattern, with their names, in a text that fits it; `None` if the text does not.
fn values<'a>(pattern: &'a str, text: &'a str) -> Option<Vec<(&'a str, &'a str)>> {
    let mut pieces = pattern.split('{');
    let mut rest = text.strip_prefix(pieces.next().unwrap_or_default())?;
    let mut values = Vec::new();
    for piece in pieces {
        let (name, after) = piece.split_once('}')?;
        let end = if after.is_empty() {
            rest.len()
        } else if pattern.ends_with(piece) {
            rest.strip_suffix(after)?.len()
        } else {
            rest.find(after)?
        };
        values.push((name, &rest[..end]));
        rest = &rest[end + after.len()..];
    }
    rest.is_empty().then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;
    use crate::waves::Plan;

    #[test]
    fn values_are_found_in_their_places() {
        assert_eq!(values("{a} of {b}: end", "1 of 2 of 3: end"), Some(vec![("a", "1"), ("b", "2 of 3")]));
        assert_eq!(values("more than {n}", "more than 7"), Some(vec![("n", "7")]));
        assert_eq!((values("{a}: end", "1"), values("no value", "another")), (None, None));
        assert_eq!(values("no value", "no value"), Some(vec![]));
        // The end of a text that is shorter than the pattern's.
        assert_eq!(values("{a}b{c}b", "xb"), None);
    }

    /// Texts of the program itself: each fits a pattern, and English stays as it was.
    #[test]
    fn notices_of_states_and_waves_have_patterns() {
        let states = [
            "wind=NaN&fetch=-3&spectrum=nonsense&wind=200&nothing=1",
            "v=99&wind=3",
            "?v=x",
            "hs=30&depth=4",
            "loop=20&spectrum=measured&hs2=3",
            "spectrum=tessendorf&spread=mitsuyasu&hs=2&tp=7&wind=20",
            "wind=10&fetch=20000",
            "spectrum=karaev&fetch=20000",
            "fade=3000",
            "afloat=boat",
            "sky=a.hdr",
            "n=64&wind=30&cascades=1",
        ];
        let mut count = 0;
        for state in states {
            let (params, mut notices) = query::parse(state);
            let plan = Plan::new(&params);
            notices.extend(plan.notices.iter().cloned());
            notices.extend(plan.resolution_note.clone());
            notices.extend(params.look.sky.missing_file_notice());
            assert!(!notices.is_empty(), "{state}");
            for notice in notices {
                count += 1;
                assert!(PATTERNS.iter().any(|pattern| values(pattern, &notice).is_some()), "{state}: {notice}");
                assert_eq!(translate(&notice), notice);
            }
        }
        assert!(count >= 16, "{count}");
    }
}
