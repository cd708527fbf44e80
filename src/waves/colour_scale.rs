//! Colour scales and captions of the false-colour views. A scale depends on the plan alone, so it is constant in time.

use super::plan::Plan;
use super::statistics;
use crate::state::views::{Map, Shown, Surface, ViewChoice};

/// Number of foam levels.
const FOAM_LEVELS: usize = 4;

/// Colours for the values of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// From dark to bright.
    Sequential,
    /// Two hues that meet in white at the middle of the range.
    Diverging,
    /// Brightness for the magnitude, hue for the phase.
    Phase,
    /// Colours for directions or triangles, without a scale.
    Direction,
}

/// Number of evenly spaced colours in a palette.
pub const STOPS: usize = 11;

impl Palette {
    /// Colours in sRGB, 0 to 1: viridis (matplotlib), RdBu (ColorBrewer) or grey.
    pub fn stops(self) -> [[f32; 3]; STOPS] {
        let hex: [u32; STOPS] = match self {
            Self::Sequential => [
                0x44_01_54, 0x48_24_75, 0x41_44_87, 0x35_5f_8d, 0x2a_78_8e, 0x21_91_8c, 0x22_a8_84, 0x44_bf_70,
                0x7a_d1_51, 0xbd_df_26, 0xfd_e7_25,
            ],
            Self::Diverging => [
                0x05_30_61, 0x21_66_ac, 0x43_93_c3, 0x92_c5_de, 0xd1_e5_f0, 0xf7_f7_f7, 0xfd_db_c7, 0xf4_a5_82,
                0xd6_60_4d, 0xb2_18_2b, 0x67_00_1f,
            ],
            // Brighter than linear, because the hue darkens the colour.
            Self::Phase | Self::Direction => std::array::from_fn(|i| {
                let grey = (i as f64 / (STOPS - 1) as f64).powf(0.6);
                0x01_01_01 * (255.0 * grey).round() as u32
            }),
        };
        hex.map(|c| [16, 8, 0].map(|shift| ((c >> shift) & 0xff) as f32 / 255.0))
    }
}

/// Values that the colours of a view stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourScale {
    /// Quantity that the first colour of the scale stands for.
    pub low: f64,
    /// Value of the last colour.
    pub high: f64,
    /// Unit of `low` and `high`; empty if dimensionless.
    pub unit: &'static str,
    /// Whether the colours are spaced evenly in the logarithm of the value.
    pub logarithmic: bool,
    /// The colours.
    pub palette: Palette,
}

impl ColourScale {
    /// Colour scale of a view, for one layer of the maps (cascade or foam level, counted from 0).
    pub fn new(shown: Shown, plan: &Plan, layer: usize) -> Self {
        let (k_low, k_high) = plan.cascades.get(layer).map_or((0.0, 0.0), |c| (c.k_low, c.k_high));
        let (mss, m0) = (plan.energy.mss_between(k_low, k_high), plan.energy.m0_between(k_low, k_high));
        // Lower limits, so that a calm sea has a scale.
        let (slope, height_m) = (mss.sqrt().max(1e-4), m0.sqrt().max(1e-3));
        // In shallow water the horizontal displacement exceeds the vertical one.
        let orbit = if m0 > 0.0 { plan.dispersion.orbit((mss / m0).sqrt()) } else { 1.0 };
        let chop = plan.sea.lambda().into_iter().fold(0.0, f64::max);
        let symmetric = |unit, limit: f64| Self::linear(-limit, limit, unit, Palette::Diverging);
        let positive = |limit: f64| Self::linear(0.0, limit, "", Palette::Sequential);
        match shown {
            Shown::Picture | Shown::Surface(Surface::Wireframe) => Self::linear(0.0, 1.0, "", Palette::Direction),
            Shown::Map(Map::InitialSpectrum) => Self::amplitude(height_m, Palette::Sequential),
            Shown::Map(Map::Spectrum) => Self::amplitude(height_m, Palette::Phase),
            Shown::Map(Map::Height) => symmetric("m", 3.0 * height_m),
            Shown::Map(Map::Dx | Map::Dz) => symmetric("m", 3.0 * height_m * orbit),
            Shown::Map(Map::SlopeX | Map::SlopeZ) => symmetric("", 2.5 * slope),
            Shown::Map(Map::Shear | Map::StretchX | Map::StretchZ) => symmetric("", 2.5 * slope * orbit),
            Shown::Map(Map::MomentXx | Map::MomentZz) => positive(3.0 * slope * slope),
            Shown::Map(Map::MomentXz) => symmetric("", 1.5 * slope * slope),
            Shown::Map(Map::Jacobian) => Self::jacobian(slope * orbit * chop),
            Shown::Map(Map::Foam | Map::Source) | Shown::Surface(Surface::Foam) => positive(1.0),
            Shown::Surface(Surface::Normals) => Self::linear(-1.0, 1.0, "", Palette::Direction),
            Shown::Surface(Surface::Jacobian) => Self::jacobian(plan.strain_variance(0.0).sqrt() * chop),
            Shown::Surface(Surface::Roughness) => {
                let wind = plan.sea.local().wind_m_s;
                positive(plan.slope_variance(f64::INFINITY).max(statistics::cox_munk_mss(wind)))
            }
            Shown::Surface(Surface::Mips) => positive(f64::from(plan.n.ilog2() - 2)),
        }
    }

    fn linear(low: f64, high: f64, unit: &'static str, palette: Palette) -> Self {
        Self { low, high, unit, logarithmic: false, palette }
    }

    /// Four decades of wave amplitudes, for a standard deviation of the height. The strongest wave of a narrow-banded
    /// sea has about a fifth of it.
    fn amplitude(deviation_m: f64, palette: Palette) -> Self {
        let high = 0.3 * deviation_m;
        Self { low: 1e-4 * high, high, unit: "m", logarithmic: true, palette }
    }

    /// Range around J = 1 (undeformed water), at most down to J = 0, where the surface folds.
    fn jacobian(deviation: f64) -> Self {
        let limit = (2.5 * deviation).clamp(1e-3, 1.0);
        Self::linear(1.0 - limit, 1.0 + limit, "", Palette::Diverging)
    }
}

/// Caption below a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// Palette of the colour bar; `None` if the colours have no scale.
    pub palette: Option<Palette>,
    /// Ranges of the values, one line for each layer shown.
    pub lines: Vec<String>,
}

/// What the colours of a view of a sea stand for.
pub fn caption(view: ViewChoice, plan: &Plan) -> Caption {
    let levels = matches!(view.shown, Shown::Map(Map::Foam | Map::Source));
    let layers = view.layers(if levels { FOAM_LEVELS } else { plan.cascades.len() });
    let range = |layer: usize| {
        let s = ColourScale::new(view.shown, plan, layer);
        let unit = if s.unit.is_empty() { String::new() } else { format!(" {}", s.unit) };
        let spacing = if s.logarithmic { ", logarithmic" } else { "" };
        format!("{} to {}{unit}{spacing}", three_digits(s.low), three_digits(s.high))
    };
    let palette = ColourScale::new(view.shown, plan, 0).palette;
    let lines = match view.shown {
        Shown::Surface(Surface::Normals) => vec!["red: east, green: north, blue: up".to_owned()],
        Shown::Surface(Surface::Wireframe) | Shown::Picture => vec!["triangles as they are drawn".to_owned()],
        Shown::Map(_) if levels => layers.map(|i| format!("level {}: {}", i + 1, range(i))).collect(),
        Shown::Map(_) | Shown::Surface(Surface::Mips) => {
            let patch = |i: usize| three_digits(plan.cascades[i].patch_m);
            layers.map(|i| format!("cascade {}, patch {} m: {}", i + 1, patch(i), range(i))).collect()
        }
        Shown::Surface(_) => vec![range(0)],
    };
    Caption { palette: (palette != Palette::Direction).then_some(palette), lines }
}

/// Formats a number with three significant digits.
fn three_digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{x:.1e}"),
        size => format!("{x:.0$}", (2.0 - size.log10().floor()).clamp(0.0, 5.0) as usize),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;
    use crate::state::views::VIEWS;

    #[test]
    fn every_scale_of_every_sea_has_a_width() {
        for state in ["", "wind=0", "wind=60&fetch=2000", "depth=1", "cascades=1", "chop=0", "height=0.1&wind=0.5"] {
            let plan = Plan::new(&query::parse(state).0);
            for (word, shown, _) in VIEWS {
                for layer in 0..5 {
                    let s = ColourScale::new(*shown, &plan, layer);
                    assert!(s.low.is_finite() && s.high.is_finite() && s.low < s.high, "{state} {word}: {s:?}");
                    assert!(!s.logarithmic || s.low > 0.0, "{state} {word}: {s:?}");
                }
            }
        }
    }

    #[test]
    fn captions_say_what_is_seen() {
        let plan = Plan::new(&query::parse("wind=12&cascades=3").0);
        let lines = |shown, cascade| caption(ViewChoice { shown, cascade }, &plan).lines;
        assert_eq!(lines(Shown::Map(Map::Height), 0).len(), 3);
        assert!(lines(Shown::Map(Map::Height), 2)[0].starts_with("cascade 2, patch "));
        assert!(lines(Shown::Map(Map::Height), 2)[0].ends_with(" m"));
        assert!(lines(Shown::Map(Map::Spectrum), 1)[0].ends_with(" m, logarithmic"));
        assert!(lines(Shown::Surface(Surface::Mips), 0)[0].starts_with("cascade 3, "));
        assert_eq!(lines(Shown::Map(Map::Foam), 4), ["level 4: 0 to 1.00"]);
        assert_eq!([1234.5, -0.01234, 12.3, 1e-5].map(three_digits), ["1234", "-0.0123", "12.3", "1.0e-5"]);
    }
}
