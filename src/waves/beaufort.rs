//! The Beaufort wind force scale and the sea state code, as tables.
//!
//! Source: WMO Manual on Codes (WMO-No. 306, volume I.1) as printed in the Met Office National Meteorological Library
//! fact sheet 6, with the descriptions paraphrased; sea states are WMO code table 3700. All heights apply to the open
//! sea, far from land, and the WMO gives them as a guide only.

use crate::state::params::{Params, Sea, WaveSystemParams};

/// One force of the Beaufort scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeaufortForce {
    /// Name of the force in weather forecasts, for example "Fresh breeze".
    pub name: &'static str,
    /// Description of what the open sea looks like at this force.
    pub appearance: &'static str,
    /// Lowest and highest wind speed at 10 m height, m/s, rounded to 0.1 m/s; infinity is the upper end of a hurricane.
    pub wind_m_s: (f64, f64),
    /// Probable wave height at this force in the WMO's Beaufort table, m, read as significant wave height.
    pub probable_hs_m: f64,
    /// Representative wind speed at 10 m height, m/s: 0.836 B^1.5 for the Beaufort number B, rounded to 0.1 m/s.
    pub mean_wind_m_s: f64,
    /// Fetch for this force, km. From force 4 up, a JONSWAP sea with this fetch and the wind `mean_wind_m_s` has the
    /// significant wave height `probable_hs_m`; at forces 1 to 3 the sea stays lower, and a calm has no waves.
    pub fetch_km: f64,
}

const fn beaufort_entry(
    name: &'static str,
    wind_m_s: (f64, f64),
    mean_wind_m_s: f64,
    probable_hs_m: f64,
    fetch_km: f64,
    appearance: &'static str,
) -> BeaufortForce {
    BeaufortForce { name, appearance, wind_m_s, probable_hs_m, mean_wind_m_s, fetch_km }
}

/// The Beaufort scale. The index is the Beaufort number, 0 to 12.
///
/// From force 4 up, the fetch is chosen so that the significant wave height of a JONSWAP sea equals the WMO's probable
/// wave height to 2 %. The winds of forces 1 to 3 (0.8, 2.4 and 4.3 m/s) cannot raise the probable waves of 0.1, 0.2
/// and 0.6 m: a fully developed sea has heights of 0.01, 0.13 and 0.42 m (Pierson and Moskowitz 1964). JONSWAP waves,
/// which keep growing with the fetch, would be as high as the probable ones after 23, 14 and 39 km. Forces 1 to 3 use a
/// dimensionless fetch g F / U^2 (gravity g, fetch F, wind speed U) of at most 1.6e4 instead, the largest one without a
/// notice about full development. It gives heights of 0.02, 0.16 and 0.52 m. A calm has no waves at any fetch.
#[rustfmt::skip]
pub static BEAUFORT_FORCES: [BeaufortForce; 13] = [
    beaufort_entry("Calm", (0.0, 0.2), 0.0, 0.0, 1.0, "Sea like a mirror."),
    beaufort_entry("Light air", (0.3, 1.5), 0.8, 0.1, 1.0,
        "Ripples like scales, without foam on their crests."),
    beaufort_entry("Light breeze", (1.6, 3.3), 2.4, 0.2, 9.0,
        "Small wavelets, short but plainly seen; their crests look glassy and do not break."),
    beaufort_entry("Gentle breeze", (3.4, 5.4), 4.3, 0.6, 30.0,
        "Large wavelets whose crests begin to break; glassy foam and perhaps a few scattered white horses."),
    beaufort_entry("Moderate breeze", (5.5, 7.9), 6.7, 1.0, 50.0,
        "Small waves growing longer, with fairly frequent white horses."),
    beaufort_entry("Fresh breeze", (8.0, 10.7), 9.3, 2.0, 100.0,
        "Moderate waves of a plainly longer form, many white horses and a chance of some spray."),
    beaufort_entry("Strong breeze", (10.8, 13.8), 12.3, 3.0, 130.0,
        "Large waves begin to form; white foam crests are everywhere, with probably some spray."),
    beaufort_entry("Near gale", (13.9, 17.1), 15.5, 4.0, 150.0,
        "The sea heaps up, and white foam from breaking waves begins to be blown in streaks along the wind."),
    beaufort_entry("Gale", (17.2, 20.7), 18.9, 5.5, 200.0,
        "Moderately high and longer waves; the edges of crests break into spindrift, \
        and foam lies in well-marked streaks along the wind."),
    beaufort_entry("Strong gale", (20.8, 24.4), 22.6, 7.0, 230.0,
        "High waves with dense streaks of foam; crests begin to topple and roll over, and spray may dim the view."),
    beaufort_entry("Storm", (24.5, 28.4), 26.4, 9.0, 280.0,
        "Very high waves with long overhanging crests; foam in great patches makes the sea look white, \
        its tumbling is heavy and shock-like, and the view is dimmed."),
    beaufort_entry("Violent storm", (28.5, 32.6), 30.5, 11.5, 350.0,
        "Exceptionally high waves that hide medium-sized ships; the sea is covered with long \
        white patches of foam, all crest edges are blown into froth, and the view is dimmed."),
    beaufort_entry("Hurricane", (32.7, f64::INFINITY), 34.8, 14.0, 400.0,
        "Air full of foam and spray, the sea wholly white with driving spray; hardly anything can be seen."),
];

/// Words for a force on the Beaufort scale before or after its number, in the languages of the interface, in lower
/// case. A longer word stands before those that it contains.
const FORCE_WORDS: [&str; 14] = [
    "beaufort",
    "windstärke",
    "stärke",
    "force",
    "fuerza",
    "força",
    "forca",
    "bft",
    "風力",
    "风力",
    "級",
    "级",
    "f",
    "b",
];

/// Beaufort number (0 to 12) of a wind speed at 10 m height, m/s. A speed in the gap of 0.1 m/s between two forces
/// counts as the lower force; negative values and NaN count as 0.
pub fn beaufort_number(wind_m_s: f64) -> usize {
    BEAUFORT_FORCES.iter().rposition(|f| wind_m_s >= f.wind_m_s.0).unwrap_or(0)
}

/// The text without a word for a force, if it has one at its beginning or end.
fn without_force_word(text: &str) -> Option<&str> {
    let strip = |word: &&str| text.strip_suffix(*word).or_else(|| text.strip_prefix(*word));
    FORCE_WORDS.iter().find_map(strip).map(str::trim)
}

/// Whether a text in lower case names a force on the Beaufort scale, and no speed.
pub fn names_force(text: &str) -> bool {
    without_force_word(text.trim()).is_some()
}

/// The Beaufort number in a text in lower case such as `7 bft`, `f7`, `windstärke 7` or `风力7级`; `None` if it has none
/// from 0 to 12.
pub fn parse_force(text: &str) -> Option<usize> {
    let rest = without_force_word(text.trim())?;
    // Chinese has a word on both sides.
    let number = without_force_word(rest).unwrap_or(rest);
    number.parse().ok().filter(|force| *force < BEAUFORT_FORCES.len())
}

impl BeaufortForce {
    /// Returns the parameters `now` with the wind and fetch of this Beaufort force for the local wave system. This
    /// system keeps its direction; its other parameters get their defaults, so that they do not change its height.
    #[must_use]
    pub fn apply(&self, now: &Params) -> Params {
        let mut next = now.clone();
        let [default, ..] = Sea::default().systems;
        let from_deg = now.sea.first_system().from_deg;
        next.sea.systems[0] =
            WaveSystemParams { wind_m_s: self.mean_wind_m_s, fetch_km: self.fetch_km, from_deg, ..default };
        next
    }
}

/// Upper limit of the significant wave height, m, and name of each sea state from 0 to 9 (WMO code table 3700).
const SEA_STATES: [(f64, &str); 10] = [
    (0.0, "calm, glassy"),
    (0.1, "calm, rippled"),
    (0.5, "smooth, wavelets"),
    (1.25, "slight"),
    (2.5, "moderate"),
    (4.0, "rough"),
    (6.0, "very rough"),
    (9.0, "high"),
    (14.0, "very high"),
    (f64::INFINITY, "phenomenal"),
];

/// Sea state code (0 to 9) and its name for a significant wave height in m, by WMO code table 3700. A height on the
/// boundary of two states gets the lower code, as the table demands; negative values and NaN count as calm.
pub fn sea_state(hs_m: f64) -> (u8, &'static str) {
    let code = SEA_STATES.partition_point(|&(upper_m, _)| hs_m > upper_m);
    (code as u8, SEA_STATES[code].1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_is_read_in_every_language() {
        for text in
            ["7 bft", "f7", "f 7", "force 7", "7 beaufort", "bft7", "b7", "windstärke 7", "stärke 7", "fuerza 7"]
        {
            assert_eq!(parse_force(text), Some(7), "{text}");
        }
        for text in ["força 9", "風力9", "风力9级", "9级", "風力 9"] {
            assert_eq!(parse_force(text), Some(9), "{text}");
        }
        for text in ["13 bft", "x", "f", "force", "f-1", "7.5 bft", "12"] {
            assert_eq!(parse_force(text), None, "{text}");
        }
        assert!(names_force("f99") && !names_force("12 m/s") && !names_force("25 kn"));
    }
    use crate::state::{fields, query};
    use crate::waves::Plan;
    use crate::waves::statistics::SpectrumStatistics;

    #[test]
    fn the_scale_is_whole() {
        for (i, f) in BEAUFORT_FORCES.iter().enumerate() {
            let (low, high) = f.wind_m_s;
            assert!(low <= f.mean_wind_m_s && f.mean_wind_m_s <= high, "{f:?}");
            assert!((0.836 * (i as f64).powf(1.5) - f.mean_wind_m_s).abs() < 0.051, "{f:?}");
            let fetch = fields::find("fetch").expect("fetch");
            assert_eq!(fetch.check_value(f.fetch_km), Ok(f.fetch_km));
            assert_eq!((beaufort_number(low), beaufort_number(f.mean_wind_m_s)), (i, i));
            assert_eq!(beaufort_number(low + 0.01), i);
            if let Some(next) = BEAUFORT_FORCES.get(i + 1) {
                assert!((next.wind_m_s.0 - high - 0.1).abs() < 1e-9, "no gap but the tenth: {f:?}");
                assert_eq!((beaufort_number(high), beaufort_number(next.wind_m_s.0 - 0.01)), (i, i));
            }
        }
        assert_eq!([f64::NAN, -3.0, 0.0, 0.29, 0.3, 1e9, f64::INFINITY].map(beaufort_number), [0, 0, 0, 0, 1, 12, 12]);
    }

    /// Compares the significant wave heights of all forces with the WMO table. The fetches are rounded to two digits,
    /// which costs up to 2 %; [`BEAUFORT_FORCES`] explains the larger differences of forces 1 to 3.
    #[test]
    fn heights_of_the_textbook() {
        let limits = [0.0, 0.85, 0.25, 0.15, 0.02, 0.02, 0.02, 0.02, 0.02, 0.03, 0.02, 0.02, 0.02];
        for (f, limit) in BEAUFORT_FORCES.iter().zip(limits) {
            let plan = Plan::new(&f.apply(&Params::default()));
            let hs_m = SpectrumStatistics::new(&plan).hs_m;
            assert!((hs_m - f.probable_hs_m).abs() <= limit * f.probable_hs_m, "{}: {hs_m}", f.name);
            assert_eq!(plan.notices, Vec::<String>::new(), "{}", f.name);
        }
    }

    #[test]
    fn a_force_changes_the_wind_sea_alone() {
        let state = "dir=33&seed=9&depth=50&scale2=1&hs2=2&sun=5&heading=80&t=12&n=128&chop=0.8&foambias=0.1";
        let own = "&spectrum=tma&hs=3&tp=9&scale=2&gamma=5&spread=cos2&wind=3";
        let now = query::parse(&format!("{state}{own}")).0;
        for f in &BEAUFORT_FORCES[1..] {
            let wanted = query::parse(&format!("{state}&wind={}&fetch={}", f.mean_wind_m_s, f.fetch_km));
            assert_eq!((f.apply(&now), vec![]), wanted);
        }
        assert!(Plan::new(&BEAUFORT_FORCES[0].apply(&Params::default())).is_calm());
    }

    #[test]
    fn sea_states_by_height() {
        let code = |hs_m: f64| sea_state(hs_m).0;
        assert_eq!([0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 1.25, 2.5].map(code), [0, 1, 1, 2, 2, 3, 3, 4]);
        assert_eq!([2.6, 4.0, 4.1, 6.0, 7.0, 9.0, 14.0, 14.1].map(code), [5, 5, 6, 6, 7, 7, 8, 9]);
        assert_eq!([f64::NAN, -1.0, f64::INFINITY, f64::NEG_INFINITY].map(code), [0, 0, 9, 0]);
        assert_eq!(sea_state(5.0), (6, "very rough"));
    }
}
