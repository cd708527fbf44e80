//! Versions of the state string, which let old links keep their meaning.
//!
//! A link without the key `v` has version 1, because somebody may have kept it. A bare state string, as one types it,
//! has the newest version. A new version is needed only when a key or its absence changes its
//! meaning (another unit, formula or default), not when keys are added. Then [`VERSION_STEPS`] gets a function that
//! translates the old string. Strings are translated from each version to the next; tests/links.txt holds links that must
//! keep their meaning. [`query`](super::query) writes `v` where a link without it would be translated to another string.

use super::params::{DEEP_WATER_DEPTH_M, Sea, SpectrumKind};
use std::borrow::Cow;

/// Key of the version number in a state string.
pub(super) const VERSION_KEY: &str = "v";

/// Keys and values of a state string such as `wind=14&t=40`, percent-decoded, in their order in the string.
pub(super) type KeyValuePairs<'a> = Vec<(Cow<'a, str>, Cow<'a, str>)>;

/// Function that translates the keys and values of a state string from one version of the string to the next.
pub(super) type VersionStep = for<'a> fn(KeyValuePairs<'a>) -> KeyValuePairs<'a>;

/// Translations of a state string from version 1 to 2, from 2 to 3 and so on.
pub(super) const VERSION_STEPS: &[VersionStep] = &[with_values_before_version_2];

/// A value that a key had before a version, although strings did not name it: the key, the value, and whether the value
/// can matter for the sea of a string with the given pairs.
type ValueBefore = (&'static str, &'static str, fn(&KeyValuePairs<'_>) -> bool);

/// Keys whose default value changed with version 2, each with its default value before.
const VALUES_BEFORE_VERSION_2: &[ValueBefore] =
    &[("depthlimit", "none", has_spectrum_for_deep_water_in_shallow_water), ("order", "1", names_a_parameter)];

/// Translates version 1 to 2: adds the values of [`VALUES_BEFORE_VERSION_2`] whose keys are absent. A string without any
/// pair stays empty: it is the default sea of each version, not a sea that somebody kept.
fn with_values_before_version_2(mut pairs: KeyValuePairs<'_>) -> KeyValuePairs<'_> {
    if pairs.is_empty() {
        return pairs;
    }
    for (key, value, matters) in VALUES_BEFORE_VERSION_2 {
        if last_value(&pairs, key).is_none() && matters(&pairs) {
            pairs.push(((*key).into(), (*value).into()));
        }
    }
    pairs
}

/// Value of the last pair with the key `key`, which is the one that counts.
fn last_value<'p>(pairs: &'p KeyValuePairs<'_>, key: &str) -> Option<&'p str> {
    pairs.iter().rev().find(|(k, _)| k == key).map(|(_, value)| value.trim())
}

/// Whether a string names anything that this program knows: what it does not know is no sea that somebody kept.
fn names_a_parameter(pairs: &KeyValuePairs<'_>) -> bool {
    pairs.iter().any(|(key, _)| super::fields::find(key).is_some() || super::query::OTHER_KEYS.contains(&&**key))
}

/// Whether a string names a depth below [`DEEP_WATER_DEPTH_M`], and a wave system that is on has a spectrum on which the
/// depth limit acts.
fn has_spectrum_for_deep_water_in_shallow_water(pairs: &KeyValuePairs<'_>) -> bool {
    // As for a field, a number that is not finite is ignored.
    let number = |key: &str| last_value(pairs, key)?.parse().ok().filter(|x: &f64| x.is_finite());
    let is_limited = |(i, default): (usize, &super::params::WaveSystemParams)| {
        let suffix = if i == 0 { String::new() } else { (i + 1).to_string() };
        let word = last_value(pairs, &format!("spectrum{suffix}")).unwrap_or(default.spectrum.word());
        let spectrum = SpectrumKind::ALL.into_iter().find(|kind| kind.word().eq_ignore_ascii_case(word));
        let height_factor = number(&format!("scale{suffix}")).unwrap_or(default.height_factor);
        height_factor > 0.0 && spectrum.unwrap_or(default.spectrum).is_for_deep_water()
    };
    number("depth").is_some_and(|depth_m| depth_m < DEEP_WATER_DEPTH_M)
        && Sea::default().systems.iter().enumerate().any(is_limited)
}

/// Version of a link without the key `v`.
pub(super) const FIRST_VERSION: usize = 1;

/// The newest version, which `steps` lead to.
pub(super) fn newest(steps: &[VersionStep]) -> usize {
    FIRST_VERSION + steps.len()
}

/// Translates the keys and values of a state string from its version to the newest by `steps`, and removes the key `v`.
/// Without this key the string has the version `unnamed_version`.
/// If the version is unknown, only removes it, and returns a message to the user.
pub(super) fn upgrade_pairs<'a>(
    pairs: KeyValuePairs<'a>,
    unnamed_version: usize,
    steps: &[VersionStep],
) -> (KeyValuePairs<'a>, Option<String>) {
    let newest = newest(steps);
    let (versions, pairs): (KeyValuePairs<'a>, KeyValuePairs<'a>) =
        pairs.into_iter().partition(|(key, _)| key == VERSION_KEY);
    let (version, notice) = match versions.last().map(|(_, text)| text.trim().parse::<usize>()) {
        None => (unnamed_version, None),
        Some(Ok(version)) if (1..=newest).contains(&version) => (version, None),
        Some(Ok(version)) if version > newest => {
            let notice = format!(
                "the link has version {version}, newer than this program's {newest}: some of it may mean something else"
            );
            (newest, Some(notice))
        }
        Some(_) => (newest, Some("the link has an unknown version (v): read as the newest".to_owned())),
    };
    (steps[version - 1..].iter().fold(pairs, |pairs, step| step(pairs)), notice)
}

/// Version number to write into a new state string with the given pairs: one more than the number of translations in
/// `steps`, or `None` if a link with these pairs means the same without a version.
pub(super) fn version_to_write(pairs: &KeyValuePairs<'_>, steps: &[VersionStep]) -> Option<String> {
    let borrowed: KeyValuePairs<'_> = pairs.iter().map(|(k, v)| (Cow::from(&**k), Cow::from(&**v))).collect();
    let translated = steps.iter().fold(borrowed, |pairs, step| step(pairs));
    (translated != *pairs).then(|| newest(steps).to_string())
}
