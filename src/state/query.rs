//! The state string: one URL query string that holds all shareable state.
//!
//! A string such as `wind=14&fetch=300&seed=7&t=40` follows the `?` of the URL on the web, and is an argument of every
//! command. The keys are those of [`FIELDS`] and four more: `measured` holds a buoy's spectrum, `sky` the name of a sky
//! file, `afloat` the floating objects, and `v` the version of the string (`state::versions`). Reading never fails: bad
//! values become notices. Only values that differ from the default are written.

use super::fields::{self, FIELDS, InvalidValue};
use super::floats;
use super::look::SkyFile;
use super::params::Params;
use super::text::{quoted_excerpt, truncate_notices};
use super::versions::{self, VERSION_STEPS, VersionStep};
use crate::files::MAX_STATE_BYTES;
use crate::files::measured::MeasuredSpectrum;
use std::sync::Arc;

/// Key of the measured buoy spectrum in a state string.
const MEASURED_KEY: &str = "measured";
/// Key of the name of the sky file in a state string.
pub(super) const SKY_KEY: &str = "sky";
/// Key of the floating objects in a state string.
pub(super) const FLOATING_OBJECTS_KEY: &str = "afloat";
/// The keys that are not in [`FIELDS`].
pub(super) const OTHER_KEYS: [&str; 3] = [MEASURED_KEY, SKY_KEY, FLOATING_OBJECTS_KEY];

/// Result of reading a state string: parameters, the keys that it sets, and messages to the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParsedState {
    /// Parameters; those that the string does not set have their defaults.
    pub params: Params,
    /// Keys, sorted, whose values were taken from the string, as written or clamped; besides those of [`FIELDS`],
    /// `measured`, `afloat` and `sky` can occur.
    pub keys_taken: Vec<&'static str>,
    /// Messages to the user about values that were ignored or changed, repeated keys, an unknown version or a too long
    /// string.
    pub notices: Vec<String>,
}

/// Reads a state string (the parameters as a URL query such as `wind=14&t=40`), with or without a leading `?`, or a
/// whole URL. Returns the parameters and messages to the user, one for each value that was ignored or changed.
///
/// ```
/// use seastate::state::query;
///
/// let (params, notices) = query::parse("wind=14&fetch=300&unknown=1");
/// assert_eq!(notices.len(), 1);
/// assert_eq!(query::write(&params), "wind=14&fetch=300");
/// ```
pub fn parse(text: &str) -> (Params, Vec<String>) {
    let ParsedState { params, notices, .. } = parse_with_keys(text);
    (params, notices)
}

/// Reads a state string (the parameters as a URL query such as `wind=14&t=40`) or a whole URL. Returns the parameters,
/// the keys that it sets, and messages to the user; [`parse`] returns no keys.
pub fn parse_with_keys(text: &str) -> ParsedState {
    read_with(text, VERSION_STEPS)
}

/// Does the work of [`parse_with_keys`]. `steps` translate old state strings to the newest version: [`VERSION_STEPS`],
/// or others in tests.
fn read_with(text: &str, steps: &[VersionStep]) -> ParsedState {
    let mut reading = ParsedState::default();
    let mut query = query_part(text);
    if query.len() > MAX_STATE_BYTES {
        query = &query[..query.floor_char_boundary(MAX_STATE_BYTES)];
        reading.notices.push(format!("the state string is longer than {MAX_STATE_BYTES} bytes: the rest was ignored"));
    }
    let version = if is_link(text) { versions::FIRST_VERSION } else { versions::newest(steps) };
    let (pairs, notice) = versions::upgrade_pairs(form_urlencoded::parse(query.as_bytes()).collect(), version, steps);
    reading.notices.extend(notice);
    let mut seen = Vec::new();
    for (key, value) in pairs {
        match &*key {
            MEASURED_KEY => {
                let spectrum = MeasuredSpectrum::from_state(&value);
                reading.set_or_notify(MEASURED_KEY, &mut seen, spectrum, |p, spectrum| {
                    p.sea.measured = Some(Arc::new(spectrum));
                });
            }
            FLOATING_OBJECTS_KEY => {
                reading.set_or_notify(
                    FLOATING_OBJECTS_KEY,
                    &mut seen,
                    floats::parse_floating_objects(&value),
                    |p, floats| {
                        p.floating_objects = floats;
                    },
                );
            }
            SKY_KEY => {
                let file = SkyFile::from_path(&value).ok_or_else(|| "the name has no printable character".to_owned());
                reading.set_or_notify(SKY_KEY, &mut seen, file, |p, file| p.look.sky.file = Some(file));
            }
            _ => reading.set_field(&key, &value, &mut seen),
        }
    }
    truncate_notices(&mut reading.notices);
    reading.keys_taken.sort_unstable();
    reading.keys_taken.dedup();
    reading
}

impl ParsedState {
    /// Stores the parsed value of the key `measured`, `afloat` or `sky` in the parameters by calling `set`, and adds
    /// the key to `keys_taken`. If `value` is an error, adds its reason to the messages to the user instead. `seen`
    /// holds the keys earlier in the string; a key in it gives a message, too.
    fn set_or_notify<T>(
        &mut self,
        key: &'static str,
        seen: &mut Vec<&'static str>,
        value: Result<T, String>,
        set: impl FnOnce(&mut Params, T),
    ) {
        self.note_repetition(key, seen);
        match value {
            Ok(value) => {
                set(&mut self.params, value);
                self.keys_taken.push(key);
            }
            Err(reason) => self.notices.push(format!("{key}: {reason}: ignored")),
        }
    }

    /// Adds a key to `seen`, the keys earlier in the string, or a message to the user if the key is in it already.
    fn note_repetition(&mut self, key: &'static str, seen: &mut Vec<&'static str>) {
        if seen.contains(&key) {
            self.notices.push(format!("{key} appears more than once: the last one counts"));
        } else {
            seen.push(key);
        }
    }

    /// Parses the value of a key in [`FIELDS`] and stores it in the parameters. Adds a notice if the key is unknown or
    /// in `seen`, the keys earlier in the string, or if the value is ignored or clamped.
    fn set_field(&mut self, key: &str, value: &str, seen: &mut Vec<&'static str>) {
        let Some(field) = fields::find(key) else {
            self.notices.push(format!("unknown setting \"{}\" ignored", quoted_excerpt(key)));
            return;
        };
        let key = field.key;
        self.note_repetition(key, seen);
        let parsed = field.parse(value);
        match parsed {
            Ok(_) => {}
            Err(InvalidValue::Ignored) => {
                self.notices.push(format!(
                    "{key} cannot be \"{}\": {}, so the value is ignored",
                    quoted_excerpt(value),
                    field.needed_value_text()
                ));
            }
            Err(InvalidValue::Clamped(v)) => {
                let (range, taken) = (field.allowed_values_text(), field.format(v));
                self.notices.push(format!("{key}={} is outside {range}: {taken} taken", quoted_excerpt(value)));
            }
        }
        let (Ok(taken) | Err(InvalidValue::Clamped(taken))) = parsed else { return };
        (field.set)(&mut self.params, taken);
        self.keys_taken.push(key);
    }
}

/// Writes a state string, such as `wind=14&t=40`: the parameters that differ from their default, in the order of
/// [`FIELDS`], then the buoy spectrum, the floating objects and the name of the sky file. All values are URL-encoded.
pub fn write(params: &Params) -> String {
    write_with(params, &[])
}

/// Writes the state string for a link, a picture or a list that somebody may keep: as [`write()`], after the version `v`
/// if a link without it would be read as another sea.
pub fn write_to_keep(params: &Params) -> String {
    write_with(params, VERSION_STEPS)
}

/// Does the work of [`write_to_keep`], with `steps`, the translations from each version to the next: [`VERSION_STEPS`],
/// or invented ones in tests.
fn write_with(params: &Params, steps: &[VersionStep]) -> String {
    let defaults = Params::default();
    let mut pairs = versions::KeyValuePairs::new();
    for field in FIELDS.iter() {
        let value = (field.get)(params);
        if value != (field.get)(&defaults) {
            pairs.push((field.key.into(), field.format(value).into()));
        }
    }
    if let Some(measured) = &params.sea.measured {
        pairs.push((MEASURED_KEY.into(), measured.to_state().into()));
    }
    if !params.floating_objects.is_empty() {
        pairs.push((FLOATING_OBJECTS_KEY.into(), floats::format_floating_objects(&params.floating_objects).into()));
    }
    if let Some(file) = &params.look.sky.file {
        pairs.push((SKY_KEY.into(), (&*file.name).into()));
    }
    let version = versions::version_to_write(&pairs, steps).map(|v| (versions::VERSION_KEY.into(), v.into()));
    form_urlencoded::Serializer::new(String::new()).extend_pairs(version.into_iter().chain(pairs)).finish()
}

/// Whether a text is a link, whole or from its `?` on, which somebody may have kept, and not a bare state string.
fn is_link(text: &str) -> bool {
    text.contains('?')
}

/// Returns the state string in a text: the part between `?` and `#`; without `?` the whole text, unless it is a URL.
fn query_part(text: &str) -> &str {
    let text = text.trim().split('#').next().unwrap_or_default();
    match text.split_once('?') {
        Some((_, query)) => query,
        None if text.contains("://") => "",
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::versions::KeyValuePairs;
    use super::*;

    #[test]
    fn defaults_write_nothing() {
        assert_eq!(write(&Params::default()), "");
        assert_eq!(parse(""), (Params::default(), vec![]));
    }

    #[test]
    fn a_pasted_url_is_read() {
        let link = "https://example.org/sea/?v=2&wind=14&fetch=300#top";
        for text in ["wind=14&fetch=300", "?v=2&wind=14&fetch=300", link] {
            let (p, notices) = parse(text);
            assert_eq!(
                (p.sea.first_system().wind_m_s, p.sea.first_system().fetch_km, notices.len()),
                (14.0, 300.0, 0),
                "{text}"
            );
            assert_eq!(write(&p), "wind=14&fetch=300");
        }
        assert_eq!(parse("https://example.org/").1.len(), 0);
    }

    #[test]
    fn bad_values_become_notices() {
        let (p, notices) = parse("wind=NaN&fetch=-3&spectrum=nonsense&colour=red&seed=4294967296&wind=200");
        assert_eq!(p.sea.first_system().wind_m_s, 60.0);
        assert_eq!(p.sea.first_system().fetch_km, 0.5);
        assert_eq!(p.sea.seed, u32::MAX);
        assert_eq!(notices.len(), 7, "{notices:?}");
    }

    #[test]
    fn percent_encoding_is_read() {
        let (p, notices) = parse("%77ind=%31%34&spread=donelan%2Dbanner");
        assert_eq!((p.sea.first_system().wind_m_s, notices.len()), (14.0, 0));
    }

    #[test]
    fn a_sky_is_carried_by_its_name() {
        let (p, notices) = parse("sky=some/where/Kloofendal%2048d.hdr&skyturn=30");
        assert_eq!((p.look.sky.file.as_ref().map(|f| f.name.as_str()), notices.len()), (Some("Kloofendal 48d.hdr"), 0));
        assert_eq!(write(&p), "skyturn=30&sky=Kloofendal+48d.hdr");
        assert!(p.look.sky.missing_file_notice().is_some_and(|n| n.contains("Kloofendal 48d.hdr")));
        assert_eq!(parse("sky=%00").0, Params::default());
    }

    #[test]
    fn what_was_taken_is_known() {
        let r = parse_with_keys("wind=14&fetch=-3&wind=15&spectrum=nonsense&unknown=1&sky=a.hdr&gamma=3.3");
        assert_eq!(r.keys_taken, ["fetch", "gamma", "sky", "wind"]);
    }

    /// Two invented version translations. Version 1 has the wind in knots, version 2 in m/s (taken as half the knots);
    /// version 3 renames `draw` to `seed` and changes the default fetch from 100 to 150 km.
    const MADE_UP: &[VersionStep] = &[in_metres_a_second, with_another_default];

    fn in_metres_a_second(mut pairs: KeyValuePairs<'_>) -> KeyValuePairs<'_> {
        for (_, value) in pairs.iter_mut().filter(|(key, _)| key == "wind") {
            if let Ok(knots) = value.parse::<f64>() {
                *value = (knots / 2.0).to_string().into();
            }
        }
        pairs
    }

    fn with_another_default(mut pairs: KeyValuePairs<'_>) -> KeyValuePairs<'_> {
        for (key, _) in pairs.iter_mut().filter(|(key, _)| key == "draw") {
            *key = "seed".into();
        }
        if pairs.iter().all(|(key, _)| key != "fetch") {
            pairs.push(("fetch".into(), "100".into()));
        }
        pairs
    }

    #[test]
    fn old_links_say_in_new_words_what_they_said() {
        for (link, want) in [
            ("?wind=20&draw=7", "v=3&wind=10&fetch=100&seed=7"),
            ("v=1&wind=20&draw=7&fetch=80", "v=3&wind=10&fetch=80&seed=7"),
            ("?wind=20&v=2&draw=7", "v=3&wind=20&fetch=100&seed=7"),
            ("?v=1&wind=20&v=3", "v=3&wind=20"),
            ("?v=3&wind=20&seed=7", "v=3&wind=20&seed=7"),
            ("?v=3", "v=3"),
            // A bare string has the newest version.
            ("wind=20&seed=7", "v=3&wind=20&seed=7"),
            // No step changes this link, so it needs no version.
            ("?", "fetch=100"),
        ] {
            let ParsedState { params, notices, .. } = read_with(link, MADE_UP);
            assert_eq!((write_with(&params, MADE_UP).as_str(), notices), (want, vec![]), "{link}");
            for text in [want.to_owned(), format!("?{want}"), format!("https://example.org/?{want}")] {
                assert_eq!(read_with(&text, MADE_UP).params, params, "{text}");
            }
        }
        assert_eq!(read_with("v=2&wind=20&wrong=1", MADE_UP).keys_taken, ["fetch", "wind"]);
    }

    #[test]
    fn versions_that_are_not_known_are_noticed() {
        for (link, says) in [
            ("v=4&wind=20", "newer than this program's 3"),
            ("v=0&wind=20", "read as the newest"),
            ("v=a&wind=20", "read as the newest"),
        ] {
            let ParsedState { params, notices, .. } = read_with(link, MADE_UP);
            assert_eq!(params.sea.first_system().wind_m_s, 20.0, "{link}");
            assert!(notices.len() == 1 && notices[0].contains(says), "{notices:?}");
        }
        assert_eq!(parse("v=3&wind=20").1.len(), 1);
    }

    #[test]
    fn links_of_version_1_keep_their_sea() {
        for (link, today) in [
            ("?depth=20", "depth=20&depthlimit=none&order=1"),
            ("v=1&depth=20&wind=9", "wind=9&depth=20&depthlimit=none&order=1"),
            ("?v=2&depth=20", "v=2&depth=20"),
            ("depth=20", "v=2&depth=20"),
            ("?depth=20&depthlimit=tma", "v=2&depth=20&order=1"),
            ("?depth=20&spectrum=PM", "spectrum=pm&depth=20&depthlimit=none&order=1"),
            ("?order=2", ""),
            ("?order=2&wind=9", "v=2&wind=9"),
            // The default sea of each program.
            ("", ""),
            ("?", ""),
            // Where the limit by depth acts on no spectrum.
            ("?wind=9", "wind=9&order=1"),
            ("?depth=4000", "order=1"),
            ("?depth=5000", "depth=5000&order=1"),
            ("?depth=30&depth=5000", "depth=5000&order=1"),
            ("?depth=deep&wind=9", "wind=9&order=1"),
            ("?depth=-inf&wind=9", "wind=9&order=1"),
            ("?spectrum=tma&depth=20", "spectrum=tma&depth=20&order=1"),
            ("?scale=0&depth=20", "scale=0&depth=20&order=1"),
            ("?spectrum=tma&depth=20&scale2=0", "spectrum=tma&depth=20&order=1"),
            ("?spectrum=tma&depth=20&spectrum2=tma&scale2=1", "spectrum=tma&spectrum2=tma&scale2=1&depth=20&order=1"),
            // The second system has the spectrum jonswap.
            ("?spectrum=tma&depth=20&scale2=1", "spectrum=tma&scale2=1&depth=20&depthlimit=none&order=1"),
        ] {
            let (params, _) = parse(link);
            assert_eq!(write_to_keep(&params), today, "{link}");
            for text in [today.to_owned(), format!("?{today}")] {
                assert_eq!(parse(&text), (params.clone(), vec![]), "{link}");
            }
        }
    }

    #[test]
    fn directions_wrap_without_a_notice() {
        assert_eq!(parse("dir=-90"), (parse("dir=270").0, vec![]));
        assert_eq!(parse("dir=720").0.sea.first_system().from_deg, 0.0);
    }
}
