//! Versions of the state string, so that a link means for good what it meant when it was made.
//!
//! A string without `v` is of version 1. There is a new version only when what a key or its absence means changes (another unit,
//! another formula, another default), not when keys are added: then [`STEPS`] gets a step that says the same in the new
//! words, and [`query`](super::query) writes `v`. Strings are brought forward step by step; tests/links.txt holds real ones.

use std::borrow::Cow;

/// Key of the version.
pub(super) const KEY: &str = "v";

/// Keys and values, decoded, in their order.
pub(super) type Pairs<'a> = Vec<(Cow<'a, str>, Cow<'a, str>)>;

/// What a version said, in the words of the next.
pub(super) type Step = for<'a> fn(Pairs<'a>) -> Pairs<'a>;

/// The first step leads from version 1 to 2. No key has changed its meaning yet.
pub(super) const STEPS: &[Step] = &[];

/// What a string of any version says, in the words of the newest, and what to notice.
pub(super) fn brought_forward<'a>(pairs: Pairs<'a>, steps: &[Step]) -> (Pairs<'a>, Option<String>) {
    let newest = steps.len() + 1;
    let (versions, pairs): (Pairs<'a>, Pairs<'a>) = pairs.into_iter().partition(|(key, _)| key == KEY);
    let (version, notice) = match versions.last().map(|(_, text)| text.trim().parse::<usize>()) {
        None => (1, None),
        Some(Ok(version)) if (1..=newest).contains(&version) => (version, None),
        Some(Ok(version)) if version > newest => {
            let notice = format!(
                "the link is of version {version}, newer than this program's {newest}: some of it may mean something else"
            );
            (newest, Some(notice))
        }
        Some(_) => (newest, Some("the link's version (v) is none that there is: read as the newest".to_owned())),
    };
    (steps[version - 1..].iter().fold(pairs, |pairs, step| step(pairs)), notice)
}

/// The version to write; none while there is one only.
pub(super) fn to_write(steps: &[Step]) -> Option<String> {
    (!steps.is_empty()).then(|| (steps.len() + 1).to_string())
}
