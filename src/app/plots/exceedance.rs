//! Plot of the probability that crests and wave heights of a buoy's record exceed a value, beside theory.

use super::super::App;
use super::{PLOT_COLOURS, PlotTable, fixed_plot};
use crate::app::language::{local_number, say, tr};
use crate::waves::crest_theory::{CrestTheory, EXCEEDANCE_COLUMNS, Weibull, exceedance_table};
use crate::waves::crests::{Estimate, WaveRecordStatistics};
use egui_plot::{GridMark, HoverPosition, Legend, Line, LineStyle, PlotPoints, Points};

/// Lowest decimal logarithm of the probability of exceedance in the plot: a record of half an hour has a few hundred
/// waves.
const LOWEST_LOG_PROBABILITY: f64 = -3.0;
/// Number of intervals of the curves by theory.
const CURVE_INTERVALS: usize = 60;

/// Curve of a distribution: values, multiplied by `factor`, over the decimal logarithm of their probability of
/// exceedance.
fn curve(law: Weibull, factor: f64) -> PlotPoints<'static> {
    (0..=CURVE_INTERVALS)
        .map(|i| LOWEST_LOG_PROBABILITY * i as f64 / CURVE_INTERVALS as f64)
        .map(|log| [law.value_m(10f64.powf(log)) * factor, log])
        .collect()
}

/// Text about the shape of the record's heights and, as soon as there are two, the groups of its waves.
fn shape_and_groups(record: &WaveRecordStatistics, theory: &CrestTheory) -> String {
    let ([skewness, kurtosis], groups) = ([record.moments.skewness, record.moments.kurtosis], &record.groups);
    let with_error = |e: Estimate| local_number(format!("{:.2} ± {:.2}", e.value, e.standard_error));
    let text = say!(
        "{count} waves; skewness {skewness}, kurtosis {kurtosis}",
        count = record.crests.count(),
        skewness = with_error(skewness),
        kurtosis = with_error(kurtosis)
    );
    if groups.mean_repeat_length <= 0.0 {
        return text;
    }
    let groups_in_words = say!(
        "waves above Hs in groups of {length}, a group every {distance} waves (theory {theory_length}, \
         {theory_distance})",
        length = local_number(format!("{:.1}", groups.mean_run_length)),
        distance = format!("{:.0}", groups.mean_repeat_length),
        theory_length = local_number(format!("{:.1}", theory.groups.mean_run_length)),
        theory_distance = format!("{:.0}", theory.groups.mean_repeat_length),
    );
    format!("{text}; {groups_in_words}")
}

/// A probability that a wave is higher, in words.
fn one_wave_in(probability: f64) -> String {
    say!("one wave in {count} is higher", count = format!("{:.0}", 1.0 / probability.clamp(1e-9, 1.0)))
}

/// Plots the exceedance of crests and heights in the record (at the first floating object or below the camera) with the
/// distributions of Rayleigh, Forristall and Boccotti for the sea's spectrum. Returns the data as a table for a CSV file.
pub fn show_exceedance_plot(app: &App, ui: &mut egui::Ui) -> PlotTable {
    let (record, theory, scale) = (app.record.waves(), app.derived.crest_theory(), app.length_scale());
    ui.weak(say!(
        "Probability that a crest or a wave height at {place} is higher; {unit}",
        place = app.record_label_and_position().0,
        unit = scale.unit
    ));
    let plot = fixed_plot("exceedance")
        .legend(Legend::default().background_alpha(0.4))
        .include_y(LOWEST_LOG_PROBABILITY)
        .include_y(0.0)
        .include_x(0.0)
        .label_formatter(|pointed| match pointed {
            HoverPosition::NearDataPoint { plot_name, position, .. } => Some(format!(
                "{plot_name}\n{} {}\n{}",
                local_number(format!("{:.2}", position.x)),
                scale.unit,
                one_wave_in(10f64.powf(position.y))
            )),
            HoverPosition::Elsewhere { .. } => None,
        })
        .y_grid_spacer(|_| (-3..=0).map(|i| GridMark { value: f64::from(i), step_size: 1.0 }).collect())
        .y_axis_formatter(|mark, _| format!("{}", 10f64.powf(mark.value)));
    plot.show(ui, |plot| {
        let laws = [
            (tr("Rayleigh, crests"), theory.rayleigh_crests, 0, LineStyle::dashed_loose()),
            (tr("Forristall, crests"), theory.forristall_3d_crests, 0, LineStyle::Solid),
            (tr("Rayleigh, heights"), theory.rayleigh_heights, 1, LineStyle::dashed_loose()),
            (tr("Boccotti, heights"), theory.boccotti_heights, 1, LineStyle::Solid),
        ];
        for (name, law, colour, style) in laws {
            plot.line(Line::new(name, curve(law, scale.factor)).color(PLOT_COLOURS[colour]).style(style));
        }
        let Some(record) = record else { return };
        for (name, values, colour) in [(tr("crests"), &record.crests, 0), (tr("heights"), &record.heights, 1)] {
            let points: PlotPoints<'_> =
                values.points().into_iter().map(|[x, p]| [x * scale.factor, p.log10()]).collect();
            plot.points(Points::new(name, points).radius(1.8).color(PLOT_COLOURS[colour]));
        }
    });
    ui.label(record.map_or_else(
        || tr("The first waves appear after 10 s of record.").to_owned(),
        |r| shape_and_groups(r, theory),
    ));
    let rows = record.map_or_else(Vec::new, |r| exceedance_table(r, theory));
    PlotTable {
        name: "crests.csv",
        heading: EXCEEDANCE_COLUMNS.into(),
        rows: rows.into_iter().map(Vec::from).collect(),
    }
}
