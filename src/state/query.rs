//! The state string: one query string that holds all shareable state.
//!
//! `wind=14&fetch=300&seed=7&t=40` is the URL on the web, the argument of the desktop program and of every command.
//! All values are rows of [`FIELDS`] but three: `measured` holds a buoy's spectrum (`MeasuredSpectrum::to_state`), `sky` the
//! name of a sky's file, which a link cannot hold, `afloat` what floats where (`floats::write`).
//! Reading never fails: what cannot be taken becomes a notice. Only values that differ from the default are written.
//! `v` says which version of the words a string is in, once there are several (`versions.rs`).

use super::fields::{self, FIELDS, Refusal};
use super::floats;
use super::look::SkyFile;
use super::params::Params;
use super::versions::{self, STEPS, Step};
use crate::files::measured::MeasuredSpectrum;
use std::sync::Arc;

/// Longest state string that is read; the rest is ignored with a notice. The longest that [`write`] writes is shorter.
pub const MAX_BYTES: usize = crate::files::MAX_STATE_BYTES;
/// Key of the buoy's spectrum.
const MEASURED: &str = "measured";
/// Key of the name of the sky's file.
pub(super) const SKY: &str = "sky";
/// Key of what floats.
pub(super) const FLOATS: &str = "afloat";
const MAX_NOTICES: usize = 24;
const MAX_SHOWN: usize = 40;

/// What a state string says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The parameters, defaults where it says nothing.
    pub params: Params,
    /// The keys whose values were taken, `measured` and `sky` included.
    pub taken: Vec<&'static str>,
    /// One notice for each thing that was not taken as written.
    pub notices: Vec<String>,
}

/// Reads a state string, with or without a leading `?`, or a whole pasted URL. Returns the parameters and one notice
/// for each thing that was not taken as written.
pub fn parse(text: &str) -> (Params, Vec<String>) {
    let Reading { params, notices, .. } = read(text);
    (params, notices)
}

/// As [`parse`], for those who want to know which values are the string's own.
pub fn read(text: &str) -> Reading {
    read_by(text, STEPS)
}

/// As [`read`], where these steps lead to the newest version.
fn read_by(text: &str, steps: &[Step]) -> Reading {
    let Reading { mut params, mut taken, mut notices } = Reading::default();
    let mut seen: Vec<&str> = Vec::new();
    let mut query = query_part(text);
    if query.len() > MAX_BYTES {
        let end = (0..=MAX_BYTES).rev().find(|&i| query.is_char_boundary(i)).unwrap_or(0);
        query = &query[..end];
        notices.push(format!("the state string is longer than {MAX_BYTES} bytes: the rest was ignored"));
    }
    let (pairs, notice) = versions::brought_forward(form_urlencoded::parse(query.as_bytes()).collect(), steps);
    notices.extend(notice);
    for (key, value) in pairs {
        if key == MEASURED {
            match MeasuredSpectrum::from_state(&value) {
                Ok(m) => {
                    params.sea.measured = Some(Arc::new(m));
                    taken.push(MEASURED);
                }
                Err(reason) => notices.push(format!("measured: {reason}: ignored")),
            }
            continue;
        }
        if key == FLOATS {
            match floats::read(&value) {
                Ok(floats) => {
                    params.floats = floats;
                    taken.push(FLOATS);
                }
                Err(reason) => notices.push(format!("afloat: {reason}: ignored")),
            }
            continue;
        }
        if key == SKY {
            params.look.sky.file = SkyFile::named(&value);
            if params.look.sky.file.is_some() {
                taken.push(SKY);
            }
            continue;
        }
        let Some(field) = fields::find(&key) else {
            notices.push(format!("unknown setting \"{}\" ignored", shown(&key)));
            continue;
        };
        if seen.contains(&field.key) {
            notices.push(format!("{} appears more than once: the last one counts", field.key));
        } else {
            seen.push(field.key);
        }
        match field.parse(&value) {
            Ok(v) => {
                (field.set)(&mut params, v);
                taken.push(field.key);
            }
            Err(Refusal::Ignored) => {
                notices.push(format!("{}={} is not one of: {}", field.key, shown(&value), field.range()));
            }
            Err(Refusal::Clamped(v)) => {
                (field.set)(&mut params, v);
                taken.push(field.key);
                notices.push(format!(
                    "{}={} is outside {}: {} taken",
                    field.key,
                    shown(&value),
                    field.range(),
                    field.format(v)
                ));
            }
        }
    }
    if notices.len() > MAX_NOTICES {
        let more = notices.len() - MAX_NOTICES;
        notices.truncate(MAX_NOTICES);
        notices.push(format!("and {more} more"));
    }
    taken.sort_unstable();
    taken.dedup();
    Reading { params, taken, notices }
}

/// Writes the values that differ from the default, in the order of [`FIELDS`], percent-encoded, without a `?`.
pub fn write(params: &Params) -> String {
    write_by(params, STEPS)
}

/// As [`write`], where these steps lead to the newest version.
fn write_by(params: &Params, steps: &[Step]) -> String {
    let defaults = Params::default();
    let mut out = form_urlencoded::Serializer::new(String::new());
    if let Some(version) = versions::to_write(steps) {
        out.append_pair(versions::KEY, &version);
    }
    for field in FIELDS.iter() {
        let value = (field.get)(params);
        if value != (field.get)(&defaults) {
            out.append_pair(field.key, &field.format(value));
        }
    }
    if let Some(measured) = &params.sea.measured {
        out.append_pair(MEASURED, &measured.to_state());
    }
    if !params.floats.is_empty() {
        out.append_pair(FLOATS, &floats::write(&params.floats));
    }
    if let Some(file) = &params.look.sky.file {
        out.append_pair(SKY, &file.name);
    }
    out.finish()
}

/// What stands between `?` and `#` of a URL; a bare state string as it is.
fn query_part(text: &str) -> &str {
    let text = text.trim();
    let text = text.split('#').next().unwrap_or_default();
    match text.split_once('?') {
        Some((_, query)) => query,
        None if text.contains("://") => "",
        None => text,
    }
}

fn shown(text: &str) -> String {
    let mut short: String = text.chars().filter(|c| !c.is_control()).take(MAX_SHOWN).collect();
    if text.chars().count() > MAX_SHOWN {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::versions::Pairs;
    use super::*;

    #[test]
    fn defaults_write_nothing() {
        assert_eq!(write(&Params::default()), "");
        assert_eq!(parse(""), (Params::default(), vec![]));
    }

    #[test]
    fn a_pasted_url_is_read() {
        for text in ["wind=14&fetch=300", "?wind=14&fetch=300", "https://example.org/sea/?wind=14&fetch=300#top"] {
            let (p, notices) = parse(text);
            assert_eq!((p.sea.local().wind_m_s, p.sea.local().fetch_km, notices.len()), (14.0, 300.0, 0), "{text}");
            assert_eq!(write(&p), "wind=14&fetch=300");
        }
        assert_eq!(parse("https://example.org/").1.len(), 0);
    }

    #[test]
    fn bad_values_become_notices() {
        let (p, notices) = parse("wind=NaN&fetch=-3&spectrum=nonsense&colour=red&seed=4294967296&wind=200");
        assert_eq!(p.sea.local().wind_m_s, 60.0);
        assert_eq!(p.sea.local().fetch_km, 0.5);
        assert_eq!(p.sea.seed, u32::MAX);
        assert_eq!(notices.len(), 7, "{notices:?}");
    }

    #[test]
    fn percent_encoding_is_read() {
        let (p, notices) = parse("%77ind=%31%34&spread=donelan%2Dbanner");
        assert_eq!((p.sea.local().wind_m_s, notices.len()), (14.0, 0));
    }

    #[test]
    fn a_sky_is_carried_by_its_name() {
        let (p, notices) = parse("sky=some/where/Kloofendal%2048d.hdr&skyturn=30");
        assert_eq!((p.look.sky.file.as_ref().map(|f| f.name.as_str()), notices.len()), (Some("Kloofendal 48d.hdr"), 0));
        assert_eq!(write(&p), "skyturn=30&sky=Kloofendal+48d.hdr");
        assert!(p.look.sky.missing_file().is_some_and(|n| n.contains("Kloofendal 48d.hdr")));
        assert_eq!(parse("sky=%00").0, Params::default());
    }

    #[test]
    fn what_was_taken_is_known() {
        let r = read("wind=14&fetch=-3&wind=15&spectrum=nonsense&unknown=1&sky=a.hdr&gamma=3.3");
        assert_eq!(r.taken, ["fetch", "gamma", "sky", "wind"]);
    }

    /// Two versions that never were: the second took the wind in m/s where the first had knots, the third named the seed `seed`
    /// instead of `draw` and made 100 km of fetch the default's 150.
    const MADE_UP: &[Step] = &[in_metres_a_second, with_another_default];

    fn in_metres_a_second(mut pairs: Pairs<'_>) -> Pairs<'_> {
        for (_, value) in pairs.iter_mut().filter(|(key, _)| key == "wind") {
            if let Ok(knots) = value.parse::<f64>() {
                *value = (knots / 2.0).to_string().into();
            }
        }
        pairs
    }

    fn with_another_default(mut pairs: Pairs<'_>) -> Pairs<'_> {
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
            ("wind=20&draw=7", "v=3&wind=10&fetch=100&seed=7"),
            ("v=1&wind=20&draw=7&fetch=80", "v=3&wind=10&fetch=80&seed=7"),
            ("wind=20&v=2&draw=7", "v=3&wind=20&fetch=100&seed=7"),
            ("v=1&wind=20&v=3", "v=3&wind=20"),
            ("v=3&wind=20&seed=7", "v=3&wind=20&seed=7"),
            ("?v=3", "v=3"),
            ("", "v=3&fetch=100"),
        ] {
            let Reading { params, notices, .. } = read_by(link, MADE_UP);
            assert_eq!((write_by(&params, MADE_UP).as_str(), notices), (want, vec![]), "{link}");
            assert_eq!(read_by(want, MADE_UP).params, params, "{link}");
        }
        assert_eq!(read_by("v=2&wind=20&wrong=1", MADE_UP).taken, ["fetch", "wind"]);
    }

    #[test]
    fn versions_that_are_not_known_are_noticed() {
        for (link, says) in [
            ("v=4&wind=20", "newer than this program's 3"),
            ("v=0&wind=20", "read as the newest"),
            ("v=a&wind=20", "read as the newest"),
        ] {
            let Reading { params, notices, .. } = read_by(link, MADE_UP);
            assert_eq!(params.sea.local().wind_m_s, 20.0, "{link}");
            assert!(notices.len() == 1 && notices[0].contains(says), "{notices:?}");
        }
        // Today there is one version, and no string names it.
        assert_eq!((parse("v=1&wind=20").1, write(&parse("v=1&wind=20").0)), (vec![], "wind=20".to_owned()));
        assert_eq!(parse("v=2&wind=20").1.len(), 1);
    }

    #[test]
    fn directions_wrap_without_a_notice() {
        assert_eq!(parse("dir=-90"), (parse("dir=270").0, vec![]));
        assert_eq!(parse("dir=720").0.sea.local().from_deg, 0.0);
    }
}
