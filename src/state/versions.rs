//! Versions of the state string, which let old links keep their meaning.
//!
//! A state string without the key `v` has version 1. A new version is needed only when a key or its absence changes its
//! meaning (another unit, formula or default), not when keys are added. Then [`VERSION_STEPS`] gets a function that
//! translates the old string, and [`query`](super::query) writes `v`. Strings are translated from each version to the
//! next; tests/links.txt holds links that must keep their meaning.

use std::borrow::Cow;

/// Key of the version number in a state string.
pub(super) const VERSION_KEY: &str = "v";

/// Keys and values of a state string such as `wind=14&t=40`, percent-decoded, in their order in the string.
pub(super) type KeyValuePairs<'a> = Vec<(Cow<'a, str>, Cow<'a, str>)>;

/// Function that translates the keys and values of a state string from one version of the string to the next.
pub(super) type VersionStep = for<'a> fn(KeyValuePairs<'a>) -> KeyValuePairs<'a>;

/// Translations of a state string from version 1 to 2, from 2 to 3 and so on. The list is empty: no key has changed its
/// meaning yet.
pub(super) const VERSION_STEPS: &[VersionStep] = &[];

/// Translates the keys and values of a state string from its version to the newest by `steps`, and removes the key `v`.
/// If the version is unknown, only removes it, and returns a message to the user.
pub(super) fn upgrade_pairs<'a>(
    pairs: KeyValuePairs<'a>,
    steps: &[VersionStep],
) -> (KeyValuePairs<'a>, Option<String>) {
    let newest = steps.len() + 1;
    let (versions, pairs): (KeyValuePairs<'a>, KeyValuePairs<'a>) =
        pairs.into_iter().partition(|(key, _)| key == VERSION_KEY);
    let (version, notice) = match versions.last().map(|(_, text)| text.trim().parse::<usize>()) {
        None => (1, None),
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

/// Version number to write into a new state string: one more than the number of translations in `steps`; `None`, which
/// means version 1, if there are none.
pub(super) fn version_to_write(steps: &[VersionStep]) -> Option<String> {
    (!steps.is_empty()).then(|| (steps.len() + 1).to_string())
}
