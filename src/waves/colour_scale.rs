//! Colour scales and captions of the false-colour views, which show maps or surface quantities. A scale depends only on
//! the planned sea, so it does not change with time.

use super::foam::FOAM_LEVEL_COUNT;
use super::plan::Plan;
use super::statistics;
use crate::state::views::{DisplayedView, MapView, SurfaceView, ViewChoice};

/// Colours in which a false-colour view shows the values of a map or of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// Viridis, from dark to bright, for quantities that are not negative.
    Sequential,
    /// Blue to red through white at the middle of the range, for quantities with a sign.
    Diverging,
    /// For complex numbers: brightness shows the magnitude, hue the phase.
    Phase,
    /// Fixed colours of surface normals or of mesh triangles, for which no colour bar is drawn.
    Direction,
}

/// Number of evenly spaced colours that define a palette; colours between them are interpolated.
pub const STOPS: usize = 11;

impl Palette {
    /// Colours from low to high values, sRGB (r, g, b) from 0 to 1: viridis (matplotlib) for `Sequential`, reversed
    /// RdBu (ColorBrewer) for `Diverging`, greys from black to white for the others.
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
            // The exponent below 1 brightens the greys, because the hue of the phase darkens them.
            Self::Phase | Self::Direction => std::array::from_fn(|i| {
                let grey = (i as f64 / (STOPS - 1) as f64).powf(0.6);
                0x01_01_01 * (255.0 * grey).round() as u32
            }),
        };
        hex.map(|c| [16, 8, 0].map(|shift| ((c >> shift) & 0xff) as f32 / 255.0))
    }
}

/// Colour scale of a false-colour view: the range of values and the palette that shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourScale {
    /// Value shown in the first colour of the palette, in `unit`.
    pub low: f64,
    /// Value shown in the last colour of the palette, in `unit`.
    pub high: f64,
    /// Unit of the values `low` and `high`; empty if they are dimensionless.
    pub unit: &'static str,
    /// Whether the scale is logarithmic instead of linear.
    pub logarithmic: bool,
    /// Palette that maps the range from `low` to `high` to colours.
    pub palette: Palette,
}

impl ColourScale {
    /// Chooses the colour scale of the view `displayed` of a planned sea for `layer`, the index of the cascade (in
    /// views of foam: of the foam level).
    pub fn new(displayed: DisplayedView, plan: &Plan, layer: usize) -> Self {
        let (k_low, k_high) = plan.cascades.get(layer).map_or((0.0, 0.0), |c| (c.k_low, c.k_high));
        let (mss, m0) = (
            plan.spectrum_integrals.mss_between_wave_numbers(k_low, k_high),
            plan.spectrum_integrals.m0_between_wave_numbers(k_low, k_high),
        );
        // The lower limits give a calm sea a scale of non-zero width.
        let (slope, height_m) = (mss.sqrt().max(1e-4), m0.sqrt().max(1e-3));
        // In shallow water the horizontal displacement exceeds the vertical one.
        let orbit = if m0 > 0.0 { plan.dispersion.orbit_width_over_height((mss / m0).sqrt()) } else { 1.0 };
        let chop = plan.sea.choppiness_xz().into_iter().fold(0.0, f64::max);
        let symmetric = |unit, limit: f64| Self::linear(-limit, limit, unit, Palette::Diverging);
        let positive = |limit: f64| Self::linear(0.0, limit, "", Palette::Sequential);
        match displayed {
            DisplayedView::Picture | DisplayedView::Surface(SurfaceView::Wireframe) => {
                Self::linear(0.0, 1.0, "", Palette::Direction)
            }
            DisplayedView::Map(MapView::InitialSpectrum) => Self::amplitude_scale(height_m, Palette::Sequential),
            DisplayedView::Map(MapView::Spectrum) => Self::amplitude_scale(height_m, Palette::Phase),
            DisplayedView::Map(MapView::Height) => symmetric("m", 3.0 * height_m),
            DisplayedView::Map(MapView::Dx | MapView::Dz) => symmetric("m", 3.0 * height_m * orbit),
            DisplayedView::Map(MapView::SlopeX | MapView::SlopeZ) => symmetric("", 2.5 * slope),
            DisplayedView::Map(MapView::DxDz | MapView::DxDx | MapView::DzDz) => symmetric("", 2.5 * slope * orbit),
            DisplayedView::Map(MapView::MomentXx | MapView::MomentZz) => positive(3.0 * slope * slope),
            DisplayedView::Map(MapView::MomentXz) => symmetric("", 1.5 * slope * slope),
            DisplayedView::Map(MapView::Jacobian) => Self::jacobian_scale(slope * orbit * chop),
            DisplayedView::Map(MapView::Foam | MapView::Source) | DisplayedView::Surface(SurfaceView::Foam) => {
                positive(1.0)
            }
            DisplayedView::Surface(SurfaceView::Normals) => Self::linear(-1.0, 1.0, "", Palette::Direction),
            DisplayedView::Surface(SurfaceView::Jacobian) => {
                Self::jacobian_scale(plan.strain_variance(0.0).sqrt() * chop)
            }
            DisplayedView::Surface(SurfaceView::Roughness) => {
                let wind = plan.sea.first_system().wind_m_s;
                positive(plan.resolved_slope_variance_below(f64::INFINITY).max(statistics::cox_munk_mss(wind)))
            }
            DisplayedView::Surface(SurfaceView::Mips) => positive(f64::from(plan.n.ilog2() - 2)),
        }
    }

    fn linear(low: f64, high: f64, unit: &'static str, palette: Palette) -> Self {
        Self { low, high, unit, logarithmic: false, palette }
    }

    /// Logarithmic scale over four decades of wave amplitude, up to 0.3 of the standard deviation of the elevation (m).
    /// The strongest wave of a narrow-banded sea has an amplitude of about 0.2 standard deviations.
    fn amplitude_scale(deviation_m: f64, palette: Palette) -> Self {
        let high = 0.3 * deviation_m;
        Self { low: 1e-4 * high, high, unit: "m", logarithmic: true, palette }
    }

    /// Scale for the Jacobian, from its standard deviation `deviation`: 2.5 deviations to either side of 1 (flat
    /// water), at most from 0 (a fold) to 2.
    fn jacobian_scale(deviation: f64) -> Self {
        let limit = (2.5 * deviation).clamp(1e-3, 1.0);
        Self::linear(1.0 - limit, 1.0 + limit, "", Palette::Diverging)
    }
}

/// Caption below a false-colour view, which explains its colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// Palette of the caption's colour bar; `None` for views without a colour bar.
    pub palette: Option<Palette>,
    /// Text lines: the range of values, one line for each cascade or foam level, or the meaning of the colours.
    pub lines: Vec<String>,
}

/// Returns the caption that explains the colours of the false-colour view `view` of a planned sea.
pub fn caption(view: ViewChoice, plan: &Plan) -> Caption {
    let levels = matches!(view.displayed, DisplayedView::Map(MapView::Foam | MapView::Source));
    let cascade_layers = view.shown_layers(if levels { FOAM_LEVEL_COUNT } else { plan.cascades.len() });
    let range = |layer: usize| {
        let s = ColourScale::new(view.displayed, plan, layer);
        let unit = if s.unit.is_empty() { String::new() } else { format!(" {}", s.unit) };
        let spacing = if s.logarithmic { ", logarithmic" } else { "" };
        format!("{} to {}{unit}{spacing}", three_digits(s.low), three_digits(s.high))
    };
    let palette = ColourScale::new(view.displayed, plan, 0).palette;
    let lines = match view.displayed {
        DisplayedView::Surface(SurfaceView::Normals) => vec!["red: east, green: north, blue: up".to_owned()],
        DisplayedView::Surface(SurfaceView::Wireframe) | DisplayedView::Picture => {
            vec!["triangles as they are drawn".to_owned()]
        }
        DisplayedView::Map(_) if levels => cascade_layers.map(|i| format!("level {}: {}", i + 1, range(i))).collect(),
        DisplayedView::Map(_) | DisplayedView::Surface(SurfaceView::Mips) => {
            let patch = |i: usize| three_digits(plan.cascades[i].patch_m);
            cascade_layers.map(|i| format!("cascade {}, patch {} m: {}", i + 1, patch(i), range(i))).collect()
        }
        DisplayedView::Surface(_) => vec![range(0)],
    };
    Caption { palette: (palette != Palette::Direction).then_some(palette), lines }
}

/// Formats a number with at least three significant digits (0.00123, 12.3, 12345), or with two and an exponent if its
/// magnitude is below 0.001 (1.2e-4).
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
    use crate::state::views::DISPLAYED_VIEWS;

    #[test]
    fn every_scale_of_every_sea_has_a_width() {
        for state in ["", "wind=0", "wind=60&fetch=2000", "depth=1", "cascades=1", "chop=0", "height=0.1&wind=0.5"] {
            let plan = Plan::new(&query::parse(state).0);
            for (word, displayed, _) in DISPLAYED_VIEWS {
                for layer in 0..5 {
                    let s = ColourScale::new(*displayed, &plan, layer);
                    assert!(s.low.is_finite() && s.high.is_finite() && s.low < s.high, "{state} {word}: {s:?}");
                    assert!(!s.logarithmic || s.low > 0.0, "{state} {word}: {s:?}");
                }
            }
        }
    }

    #[test]
    fn captions_say_what_is_seen() {
        let plan = Plan::new(&query::parse("wind=12&cascades=3").0);
        let lines = |displayed, cascade| caption(ViewChoice { displayed, cascade }, &plan).lines;
        assert_eq!(lines(DisplayedView::Map(MapView::Height), 0).len(), 3);
        assert!(lines(DisplayedView::Map(MapView::Height), 2)[0].starts_with("cascade 2, patch "));
        assert!(lines(DisplayedView::Map(MapView::Height), 2)[0].ends_with(" m"));
        assert!(lines(DisplayedView::Map(MapView::Spectrum), 1)[0].ends_with(" m, logarithmic"));
        assert!(lines(DisplayedView::Surface(SurfaceView::Mips), 0)[0].starts_with("cascade 3, "));
        assert_eq!(lines(DisplayedView::Map(MapView::Foam), 4), ["level 4: 0 to 1.00"]);
        assert_eq!([1234.5, -0.01234, 12.3, 1e-5].map(three_digits), ["1234", "-0.0123", "12.3", "1.0e-5"]);
    }
}
