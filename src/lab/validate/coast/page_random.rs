//! The page's sections on random seas: gauges over the built-in coasts, and run-up.

use super::random::{self, GAUGES, PointStatistics, SEA, SEEDS, WAVES};
use super::runup::{self, HEIGHTS_M, PERIODS_S, RunUpCase, SLOPES};
use crate::lab::estimate::EstimateWithError;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::lab::validate::cells::{format_estimate, format_number};

/// Mean over points of one of their statistics; its error is the mean of the points' errors, because the gauges share
/// their seeds.
pub fn mean_over(points: &[PointStatistics], of: fn(&PointStatistics) -> EstimateWithError) -> EstimateWithError {
    let count = points.len().max(1) as f64;
    let value = points.iter().map(|p| of(p).value).sum::<f64>() / count;
    let error = points.iter().map(|p| of(p).standard_error.unwrap_or(0.0)).sum::<f64>() / count;
    EstimateWithError { value, standard_error: Some(error) }
}

/// Least value over points of one of their statistics.
pub fn least_over(points: &[PointStatistics], of: fn(&PointStatistics) -> EstimateWithError) -> f64 {
    points.iter().map(|p| of(p).value).fold(f64::INFINITY, f64::min)
}

/// Adds the section on random seas over the built-in coasts.
///
/// # Errors
/// If a coast cannot be solved or the figure cannot be drawn.
pub fn add_random_sea(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Random sea over the built-in coasts");
    page.paragraph(&format!(
        "The sea `{SEA}` in the depth of each coast's seaward edge: the {WAVES} strongest waves of the program's lattice \
         that are longer than 25 m and travel towards the land, with the transfer functions of the coast (parabolic, and \
         elliptic at the harbour) and the random amplitudes of {SEEDS} seeds. {GAUGES} gauges a coast record 14 minutes \
         for each seed. The component sum adds the energy of the components. The deviation is the mean difference of the \
         variance of a record and the component sum with the amplitudes of its seed, in standard errors of that mean; one \
         gauge in twenty is expected beyond 2 σ. \
         Groupiness is the standard deviation of the squared envelope over its mean, succession the correlation of the \
         heights of successive waves; with too few components kurtosis and groupiness would fall below those of the open \
         sea, whose record holds the waves of all directions and lengths that have 99 % of the variance."
    ));
    let open = random::open_sea()?;
    let coasts = random::all_coasts()?;
    let highest = coasts.iter().flat_map(|c| &c.gauges).map(|g| g.hs_m().0).fold(0.0, f64::max);
    let end = (highest + 0.5).ceil();
    let x = Axis::linear("Hs by the component sum, m", 0.0, end);
    let diagonal = sample_curve(&x, 1, |hs| hs);
    let mut figure = Figure::new("Gauges", x, Axis::linear("Hs of the records, m", 0.0, end), LegendCorner::UpperLeft)
        .with_series(FigureSeries::new("", 6, SeriesData::Dashes(diagonal)));
    let cells = |points: &[PointStatistics]| {
        [
            format_estimate(Some(mean_over(points, |p| p.kurtosis)), 3),
            format_number(least_over(points, |p| p.kurtosis), 3),
            format_estimate(Some(mean_over(points, |p| p.groupiness)), 3),
            format_number(least_over(points, |p| p.groupiness), 3),
            format_estimate(Some(mean_over(points, |p| p.succession)), 3),
            format_number(least_over(points, |p| p.succession), 3),
        ]
    };
    let deviation_cells = |points: &[PointStatistics]| {
        let largest = points.iter().map(|p| p.deviation().abs()).fold(0.0, f64::max);
        let beyond = points.iter().filter(|p| p.deviation().abs() > 2.0).count();
        [format!("{largest:.1} σ"), format!("{beyond} of {}", points.len())]
    };
    let alone = [open];
    let mut rows = vec![
        ["open sea".to_owned(), "99 %".to_owned()]
            .into_iter()
            .chain(deviation_cells(&alone))
            .chain(cells(&alone))
            .collect(),
    ];
    for (colour, coast) in coasts.iter().enumerate() {
        let point = |g: &PointStatistics| {
            let (expected, recorded) = g.hs_m();
            recorded.x_value_error(expected)
        };
        let points = coast.gauges.iter().map(point).collect();
        figure = figure.with_series(FigureSeries::new(coast.title, colour, SeriesData::Points(points)));
        let first = [coast.title.to_owned(), format!("{:.0} %", 100.0 * coast.share)];
        rows.push(first.into_iter().chain(deviation_cells(&coast.gauges)).chain(cells(&coast.gauges)).collect());
    }
    page.figure(
        "coast-gauges",
        &figure,
        "Significant wave height at the gauges: records of all seeds with their standard errors against the component \
         sum.",
    )?;
    page.table(
        "coast | share of the variance | largest deviation | gauges beyond 2 σ | kurtosis, mean | least | groupiness, mean \
         | least | succession, mean | least",
        &rows,
    );
    Ok(())
}

/// Adds the section on run-up.
///
/// # Errors
/// If a beach cannot be solved or the figure cannot be drawn.
pub fn add_run_up(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Run-up");
    page.paragraph(
        "Run-up that 2 % of the waves exceed on plane beaches, as `seastate coast` prints it: the program finds the slope \
         of the foreshore on the grid, and height and length of the open sea from its spectrum. Theory is the formula of \
         Stockdon et al. (2006) with the nominal slope, height and peak period, written anew: R2 = 1.1 (0.35 β √(HL) + \
         √(HL (0.563 β² + 0.004)) / 2), and 0.043 √(HL) where β / √(H/L) is below 0.3.",
    );
    let cases = runup::cases()?;
    let x = Axis::log("slope of the foreshore", 0.01, 0.2);
    let y = Axis::log("run-up exceeded by 2 % of the waves, m", 0.1, 10.0);
    let mut figure = Figure::new("Run-up", x.clone(), y, LegendCorner::LowerRight);
    for (colour, (hs_m, tp_s)) in HEIGHTS_M.into_iter().zip(PERIODS_S).enumerate() {
        let theory = sample_curve(&x, 200, |slope| runup::stockdon_m(hs_m, tp_s, slope));
        let own = cases.iter().filter(|c| c.hs_m == hs_m);
        let circles = own.map(|c| [c.slope, c.run_up_m, 0.0]).collect();
        figure = figure
            .with_series(FigureSeries::new(&format!("{hs_m} m, {tp_s} s"), colour, SeriesData::Line(theory)))
            .with_series(FigureSeries::new("", colour, SeriesData::Points(circles)));
    }
    page.figure(
        "coast-runup",
        &figure,
        "Run-up against the slope of the foreshore: Stockdon's formula (lines) and the program (circles).",
    )?;
    let mut rows = Vec::new();
    for slope in SLOPES {
        let mut row = vec![format_number(slope, 2)];
        for case in cases.iter().filter(|c| c.slope == slope) {
            let RunUpCase { run_up_m, expected_m, .. } = case;
            row.push(format!("{run_up_m:.3} ({expected_m:.3})"));
        }
        rows.push(row);
    }
    let seas = HEIGHTS_M.iter().zip(PERIODS_S).map(|(hs_m, tp_s)| format!(" | R2 for {hs_m} m, {tp_s} s, m (theory)"));
    page.table(&format!("slope{}", seas.collect::<String>()), &rows);
    Ok(())
}
