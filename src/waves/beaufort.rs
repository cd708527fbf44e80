//! The Beaufort scale of wind and the code of sea states, as tables.
//!
//! Names, wind ranges, appearance and heights follow the WMO Manual on Codes (WMO-No. 306, volume I.1, Beaufort scale)
//! as printed in the Met Office's National Meteorological Library fact sheet 6; the sentences are paraphrased. The sea
//! states are WMO code table 3700. The heights are those of the open sea, far from land, and a guide only, as the WMO
//! says itself.

use crate::state::params::{Params, Sea, System};

/// One force of the Beaufort scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force {
    /// 0 to 12.
    pub number: u8,
    /// Name in forecasts.
    pub name: &'static str,
    /// What the open sea looks like.
    pub appearance: &'static str,
    /// Lowest and highest wind 10 m above the sea, m/s, in the tenths of the WMO's table; the last is open.
    pub wind_m_s: (f64, f64),
    /// Probable wave height, m: near the significant height of a sea that has had time and room.
    pub probable_m: f64,
    /// Probable maximum of the wave height, m; none is given for a hurricane.
    pub highest_m: Option<f64>,
    /// Wind that stands for the force, m/s: 0.836 B^1.5, by which the scale is defined, to the tenth.
    pub mean_m_s: f64,
    /// Fetch over which that wind raises the probable height by the default spectrum, km; see [`FORCES`].
    pub fetch_km: f64,
}

macro_rules! force {
    ($number:literal, $name:literal, $wind:expr, $mean:literal, $probable:literal, $highest:expr, $fetch:literal, $appearance:literal) => {
        Force {
            number: $number,
            name: $name,
            appearance: $appearance,
            wind_m_s: $wind,
            probable_m: $probable,
            highest_m: $highest,
            mean_m_s: $mean,
            fetch_km: $fetch,
        }
    };
}

/// The scale, calm first.
///
/// The fetches were searched for, in round kilometres, so that JONSWAP's significant height is the probable height.
/// From force 4 it is, to 2 %. Light winds never raise the heights of the table: a fully developed sea of 0.8, 2.4 and
/// 4.3 m/s has 0.01, 0.13 and 0.42 m (Pierson and Moskowitz 1964), where the table has 0.1, 0.2 and 0.6 m. JONSWAP's
/// fits know no full development and would come to these after 23, 14 and 39 km; the fetches of forces 1 to 3 end
/// instead where the program says that the sea has left it behind, g F / U^2 = 1.6e4, and give 0.02, 0.16 and 0.52 m. A
/// calm has no waves whatever its fetch.
#[rustfmt::skip]
pub static FORCES: [Force; 13] = [
    force!(0, "Calm", (0.0, 0.2), 0.0, 0.0, Some(0.0), 1.0, "Sea like a mirror."),
    force!(1, "Light air", (0.3, 1.5), 0.8, 0.1, Some(0.1), 1.0,
        "Ripples like scales, without foam on their crests."),
    force!(2, "Light breeze", (1.6, 3.3), 2.4, 0.2, Some(0.3), 9.0,
        "Small wavelets, short but plainly seen; their crests look glassy and do not break."),
    force!(3, "Gentle breeze", (3.4, 5.4), 4.3, 0.6, Some(1.0), 30.0,
        "Large wavelets whose crests begin to break; glassy foam and perhaps a few scattered white horses."),
    force!(4, "Moderate breeze", (5.5, 7.9), 6.7, 1.0, Some(1.5), 50.0,
        "Small waves growing longer, with fairly frequent white horses."),
    force!(5, "Fresh breeze", (8.0, 10.7), 9.3, 2.0, Some(2.5), 100.0,
        "Moderate waves of a plainly longer form, many white horses and a chance of some spray."),
    force!(6, "Strong breeze", (10.8, 13.8), 12.3, 3.0, Some(4.0), 130.0,
        "Large waves begin to form; white foam crests are everywhere, with probably some spray."),
    force!(7, "Near gale", (13.9, 17.1), 15.5, 4.0, Some(5.5), 150.0,
        "The sea heaps up, and white foam from breaking waves begins to be blown in streaks along the wind."),
    force!(8, "Gale", (17.2, 20.7), 18.9, 5.5, Some(7.5), 200.0,
        "Moderately high and longer waves; the edges of crests break into spindrift, and foam lies in well-marked streaks along the wind."),
    force!(9, "Strong gale", (20.8, 24.4), 22.6, 7.0, Some(10.0), 230.0,
        "High waves with dense streaks of foam; crests begin to topple and roll over, and spray may dim the view."),
    force!(10, "Storm", (24.5, 28.4), 26.4, 9.0, Some(12.5), 280.0,
        "Very high waves with long overhanging crests; foam in great patches makes the sea look white, its tumbling is heavy and shock-like, and the view is dimmed."),
    force!(11, "Violent storm", (28.5, 32.6), 30.5, 11.5, Some(16.0), 350.0,
        "Exceptionally high waves that hide medium-sized ships; the sea is covered with long white patches of foam, all crest edges are blown into froth, and the view is dimmed."),
    force!(12, "Hurricane", (32.7, f64::INFINITY), 34.8, 14.0, None, 400.0,
        "Air full of foam and spray, the sea wholly white with driving spray; hardly anything can be seen."),
];

/// Which force a wind is, by the lower ends of the ranges; what is no wind is a calm.
pub fn number_of(wind_m_s: f64) -> usize {
    FORCES.iter().rposition(|f| wind_m_s >= f.wind_m_s.0).unwrap_or(0)
}

impl Force {
    /// `now` with this force's wind and fetch. The local system has its defaults besides, so that its height is the
    /// wind's, but keeps its direction; everything else stays: the second system, depth, seed, light, camera, time.
    #[must_use]
    pub fn apply(&self, now: &Params) -> Params {
        let mut next = now.clone();
        let [usual, _] = Sea::default().systems;
        let from_deg = now.sea.local().from_deg;
        next.sea.systems[0] = System { wind_m_s: self.mean_m_s, fetch_km: self.fetch_km, from_deg, ..usual };
        next
    }
}

/// Upper end of each sea state, m, and its name.
const STATES: [(f64, &str); 10] = [
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

/// The sea state of a significant height: figure and name of WMO code table 3700, after Douglas. A height on a bound
/// has the lower figure, as the table demands; what is no height is a calm.
pub fn sea_state(hs_m: f64) -> (u8, &'static str) {
    let is_height = hs_m > 0.0;
    (0u8..)
        .zip(STATES)
        .find(|&(_, (up_to_m, _))| !is_height || hs_m <= up_to_m)
        .map_or((9, STATES[9].1), |(n, (_, s))| (n, s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::{fields, query};
    use crate::waves::Plan;
    use crate::waves::statistics::Theory;

    #[test]
    fn the_scale_is_whole() {
        for (i, f) in FORCES.iter().enumerate() {
            assert_eq!(usize::from(f.number), i);
            let (low, high) = f.wind_m_s;
            assert!(low <= f.mean_m_s && f.mean_m_s <= high, "{f:?}");
            assert!((0.836 * f64::from(f.number).powf(1.5) - f.mean_m_s).abs() < 0.051, "{f:?}");
            assert!(f.highest_m.is_none_or(|h| h >= f.probable_m), "{f:?}");
            let fetch = fields::find("fetch").expect("fetch");
            assert_eq!(fetch.accept(f.fetch_km), Ok(f.fetch_km));
            assert_eq!((number_of(low), number_of(f.mean_m_s)), (i, i));
            assert_eq!(number_of(low + 0.01), i);
            if let Some(next) = FORCES.get(i + 1) {
                assert!((next.wind_m_s.0 - high - 0.1).abs() < 1e-9, "no gap but the tenth: {f:?}");
                assert_eq!((number_of(high), number_of(next.wind_m_s.0 - 0.01)), (i, i));
            }
        }
        assert_eq!([f64::NAN, -3.0, 0.0, 0.29, 0.3, 1e9, f64::INFINITY].map(number_of), [0, 0, 0, 0, 1, 12, 12]);
    }

    /// From force 4 the fetch can be chosen, and rounding it to two figures moves the height by 2 % at most (it grows
    /// with the fetch to the power 0.56). Below, the sea is as high as such a wind makes it, and the table says more:
    /// see [`FORCES`].
    #[test]
    fn heights_of_the_textbook() {
        let limits = [0.0, 0.85, 0.25, 0.15, 0.02, 0.02, 0.02, 0.02, 0.02, 0.03, 0.02, 0.02, 0.02];
        for (f, limit) in FORCES.iter().zip(limits) {
            let plan = Plan::new(&f.apply(&Params::default()));
            let hs_m = Theory::new(&plan).hs_m;
            assert!((hs_m - f.probable_m).abs() <= limit * f.probable_m, "{}: {hs_m}", f.name);
            assert_eq!(plan.notices, Vec::<String>::new(), "{}", f.name);
        }
    }

    #[test]
    fn a_force_changes_the_wind_sea_alone() {
        let state = "dir=33&seed=9&depth=50&scale2=1&hs2=2&sun=5&heading=80&t=12&n=128&chop=0.8&foambias=0.1";
        let own = "&spectrum=tma&hs=3&tp=9&scale=2&gamma=5&spread=cos2&wind=3";
        let now = query::parse(&format!("{state}{own}")).0;
        for f in &FORCES[1..] {
            let wanted = query::parse(&format!("{state}&wind={}&fetch={}", f.mean_m_s, f.fetch_km));
            assert_eq!((f.apply(&now), vec![]), wanted);
        }
        assert!(Plan::new(&FORCES[0].apply(&Params::default())).is_calm());
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
