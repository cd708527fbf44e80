//! The axis along which spectra are plotted: the period of the waves, their frequency, or their angular frequency. The
//! density of the variance has the unit that belongs to the axis, so that the area under a curve is the variance.

use super::super::App;
use super::{fixed_plot, number, round_marks};
use crate::app::language::{local_number, say, text, tr};
use crate::waves::dispersion::Dispersion;
use egui_plot::{Bar, BarChart, GridInput, GridMark, HoverPosition, Plot};
use std::f64::consts::TAU;

/// Periods that may stand at the axis, s, the most welcome ones first.
const ROUND_PERIODS_S: [f64; 28] = [
    10.0, 5.0, 1.0, 20.0, 2.0, 0.5, 0.2, 3.0, 4.0, 7.0, 0.3, 0.4, 30.0, 15.0, 8.0, 6.0, 2.5, 1.5, 0.7, 12.0, 1.2, 0.25,
    0.15, 0.1, 50.0, 40.0, 25.0, 100.0,
];
/// Least distance of two periods at the axis, points: room for `2.5 s`.
const LEAST_MARK_DISTANCE_POINTS: f32 = 36.0;

/// The quantity along the horizontal axis of a plotted spectrum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpectrumAxis {
    /// Period, s. The axis itself is linear in the frequency, so that long waves are at the left, and areas under the
    /// curve stay right.
    #[default]
    Period,
    /// Frequency f, Hz.
    Frequency,
    /// Angular frequency omega, rad/s.
    AngularFrequency,
}

impl SpectrumAxis {
    const ALL: [Self; 3] = [Self::Period, Self::Frequency, Self::AngularFrequency];

    /// Word in the stored preferences.
    pub fn word(self) -> &'static str {
        match self {
            Self::Period => "period",
            Self::Frequency => "hz",
            Self::AngularFrequency => "rad/s",
        }
    }

    /// The axis with a word of the stored preferences; the usual one for another text.
    pub fn from_word(word: &str) -> Self {
        Self::ALL.into_iter().find(|axis| axis.word() == word).unwrap_or_default()
    }

    fn label(self) -> &'static str {
        match self {
            Self::Period => tr("Period"),
            Self::Frequency => "Hz",
            Self::AngularFrequency => "rad/s",
        }
    }

    /// Caption of a spectrum with this axis: its quantities and their units, or a plain sentence for periods.
    fn caption(self) -> &'static str {
        match self {
            Self::Period => text!(
                "Energy by wave period, m²/Hz: each peak is one group of waves, long waves at the left, short ones at \
                the right."
            ),
            Self::Frequency => text!("Variance density S(f), m²/Hz, over the frequency f, Hz"),
            Self::AngularFrequency => text!("Variance density S(ω), m² s, over ω, rad/s"),
        }
    }

    /// Number of units of this axis in one rad/s.
    fn factor(self) -> f64 {
        if self == Self::AngularFrequency { 1.0 } else { 1.0 / TAU }
    }

    /// Place on the axis of an angular frequency, rad/s.
    pub fn at(self, omega_rad_s: f64) -> f64 {
        omega_rad_s * self.factor()
    }

    /// Point of the plot, given an angular frequency, rad/s, and the variance density over it, m² s.
    pub fn point(self, [omega_rad_s, density]: [f64; 2]) -> [f64; 2] {
        [self.at(omega_rad_s), density / self.factor()]
    }

    /// Angular frequency, rad/s, at a place on the axis.
    fn omega(self, at: f64) -> f64 {
        at / self.factor()
    }

    /// The waves at a place of the plot, in words: their period and length, and at last the formula's quantities.
    fn in_words(self, name: &str, [at, density]: [f64; 2], length: Option<String>) -> String {
        let omega = self.omega(at.max(1e-3));
        let number = |x: f64, digits: usize| local_number(format!("{x:.digits$}"));
        let period = number(TAU / omega, 1);
        let waves = match length {
            Some(length) => say!("waves of {period} s, {length} long", period = period, length = length),
            None => say!("waves of {period} s", period = period),
        };
        let formula = match self {
            Self::AngularFrequency => format!("ω = {} rad/s, S(ω) = {} m² s", number(omega, 3), number(density, 3)),
            _ => format!("f = {} Hz, S(f) = {} m²/Hz", number(omega / TAU, 3), number(density, 3)),
        };
        format!("{name}\n{waves}\n{formula}")
    }

    /// Bars of the variance density, m² s, each `width_rad_s` wide, the first one from 0.
    pub fn bars(self, name: &'static str, width_rad_s: f64, density: &[f64]) -> BarChart {
        let bar = |(i, s): (usize, &f64)| {
            let [at, height] = self.point([(i as f64 + 0.5) * width_rad_s, *s]);
            Bar::new(at, height).width(self.at(width_rad_s))
        };
        let bars = density.iter().enumerate().map(bar).collect();
        let words = move |bar: &Bar, _: &BarChart| self.in_words(name, [bar.argument, bar.value], None);
        BarChart::new(name, bars).element_formatter(Box::new(words))
    }
}

/// Marks at round periods, s, of an axis that is linear in the frequency, Hz. Their least distance is the share
/// `least_share` of its length.
fn period_marks(input: &GridInput, least_share: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let least = least_share * (high - low);
    let mut marks: Vec<GridMark> = Vec::new();
    for value in ROUND_PERIODS_S.iter().map(|period_s| 1.0 / period_s).filter(|f| (low..=high).contains(f)) {
        if marks.iter().all(|mark| (mark.value - value).abs() >= least) {
            marks.push(GridMark { value, step_size: least });
        }
    }
    marks.sort_by(|a, b| a.value.total_cmp(&b.value));
    marks
}

/// An empty plot of spectra with the axis that the visitor has chosen.
pub fn spectrum_plot<'a>(app: &'a App, name: &'a str, ui: &egui::Ui) -> Plot<'a> {
    let (axis, scale) = (app.visitor.preferences.spectrum_axis, app.length_scale());
    let dispersion: &Dispersion = &app.derived.plan.dispersion;
    let plot = fixed_plot(name).y_grid_spacer(|input| round_marks(&input)).y_axis_formatter(|mark, _| number(mark));
    let plot = plot.label_formatter(move |pointed| match pointed {
        HoverPosition::NearDataPoint { plot_name, position, .. } => {
            let length_m = TAU / dispersion.wave_number(axis.omega(position.x.max(1e-3)));
            let length = scale.format(length_m, if length_m < 10.0 { 1 } else { 0 });
            Some(axis.in_words(plot_name, [position.x, position.y], Some(length)))
        }
        HoverPosition::Elsewhere { .. } => None,
    });
    if axis != SpectrumAxis::Period {
        return plot;
    }
    let least_share = f64::from((LEAST_MARK_DISTANCE_POINTS / ui.available_width()).clamp(0.0, 0.5));
    plot.x_grid_spacer(move |input| period_marks(&input, least_share))
        .x_axis_formatter(|mark, _| format!("{} s", local_number(format!("{}", 1e-3 * (1e3 / mark.value).round()))))
}

/// Adds the choice of the axis of all spectra, and a sentence about the chosen one.
pub fn show_axis_choice(app: &mut App, ui: &mut egui::Ui) {
    let mut axis = app.visitor.preferences.spectrum_axis;
    let before = axis;
    ui.horizontal(|ui| {
        ui.label(tr("Along the axis:"));
        for each in SpectrumAxis::ALL {
            ui.selectable_value(&mut axis, each, each.label());
        }
    });
    if axis != before {
        app.change_preferences(|preferences| preferences.spectrum_axis = axis);
    }
    show_caption(app, ui);
}

/// Adds a sentence about what a spectrum shows along the chosen axis.
pub fn show_caption(app: &App, ui: &mut egui::Ui) {
    let help = tr(
        "The area under the curve is the variance of the water's height. Four times its root is the significant wave \
         height Hs.",
    );
    ui.weak(tr(app.visitor.preferences.spectrum_axis.caption())).on_hover_text(help);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_under_a_curve_is_the_variance_along_each_axis() {
        let curve: Vec<[f64; 2]> = (0..400).map(|i| 0.01 * f64::from(i)).map(|w| [w, w * (-w).exp()]).collect();
        let area = |axis: SpectrumAxis| -> f64 {
            let points: Vec<_> = curve.iter().map(|p| axis.point(*p)).collect();
            points.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][1] + p[1][1])).sum()
        };
        let variance = area(SpectrumAxis::AngularFrequency);
        for axis in SpectrumAxis::ALL {
            assert!((area(axis) / variance - 1.0).abs() < 1e-12, "{axis:?}");
            assert_eq!(SpectrumAxis::from_word(axis.word()), axis);
            assert!((axis.omega(axis.at(0.7)) - 0.7).abs() < 1e-12);
        }
        assert_eq!(SpectrumAxis::from_word("x"), SpectrumAxis::Period);
    }

    #[test]
    fn the_marks_are_round_periods_that_keep_their_distance() {
        // Long swell, a usual sea, ripples.
        for (bounds, some) in [((0.02, 0.2), 10.0), ((0.05, 0.5), 5.0), ((0.5, 6.0), 0.5)] {
            let marks = period_marks(&GridInput { bounds, base_step_size: 0.01 }, 0.1);
            assert!((4..=9).contains(&marks.len()), "{marks:?}");
            assert!(marks.iter().any(|m| (1.0 / m.value - some).abs() < 1e-9), "{some} s of {marks:?}");
            let least = 0.1 * (bounds.1 - bounds.0);
            assert!(marks.windows(2).all(|m| m[1].value - m[0].value >= least), "{marks:?}");
        }
    }

    #[test]
    fn a_point_is_told_by_its_period_first() {
        let axis = SpectrumAxis::Period;
        let words = axis.in_words("swell", [0.1, 2.5], Some("156 m".to_owned()));
        assert_eq!(words, "swell\nwaves of 10.0 s, 156 m long\nf = 0.100 Hz, S(f) = 2.500 m²/Hz");
        let axis = SpectrumAxis::AngularFrequency;
        let words = axis.in_words("swell", axis.point([TAU / 10.0, 2.5 / TAU]), None);
        assert_eq!(words, "swell\nwaves of 10.0 s\nω = 0.628 rad/s, S(ω) = 0.398 m² s");
    }
}
