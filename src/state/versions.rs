//! Versions of the state string, which keep the meaning of old links.
//!
//! A string without `v` has version 1. A new version is needed only when a key or its absence changes its meaning
//! (another unit, formula or default), not when keys are added. Then [`VERSION_STEPS`] gets a step that translates the
//! old string, and [`query`](super::query) writes `v`. Strings are translated step by step; tests/links.txt holds real
//! ones.

use std::borrow::Cow;

/// Key of the version.
pub(super) const KEY: &str = "v";

/// Decoded keys and values in the order of the string.
pub(super) type Pairs<'a> = Vec<(Cow<'a, str>, Cow<'a, str>)>;

/// Translates the pairs of one version to the next.
pub(super) type VersionStep = for<'a> fn(Pairs<'a>) -> Pairs<'a>;

/// The steps from version 1 on. No key has changed its meaning yet.
pub(super) const VERSION_STEPS: &[VersionStep] = &[];

/// Translates a string of any version to the newest version, and returns a notice if the version is not known.
pub(super) fn upgraded<'a>(pairs: Pairs<'a>, steps: &[VersionStep]) -> (Pairs<'a>, Option<String>) {
    let newest = steps.len() + 1;
    let (versions, pairs): (Pairs<'a>, Pairs<'a>) = pairs.into_iter().partition(|(key, _)| key == KEY);
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

/// The version to write, if there is more than one.
pub(super) fn to_write(steps: &[VersionStep]) -> Option<String> {
    (!steps.is_empty()).then(|| (steps.len() + 1).to_string())
}
