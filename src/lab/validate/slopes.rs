//! Part 4 of the validation page, continued: mean square slope and whitecap coverage against wind.

use super::cells::{format_estimate, format_number, relative_deviation, relative_to_published};
use super::measurement::{MeasurementSetup, parse_params, theoretical_statistics};
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::waves::Plan;
use crate::waves::foam::FoamModel;
use crate::waves::statistics::{cox_munk_mss, monahan_coverage};

/// Wind speeds at which the mean square slope of the spectrum `jonswap` is measured, m/s.
const JONSWAP_SLOPE_WINDS_M_S: [f64; 7] = [2.0, 5.0, 8.0, 10.0, 12.0, 14.0, 20.0];
/// Wind speeds at which slope and foam of the spectra other than `jonswap` are measured, m/s.
const WINDS_OF_OTHER_SPECTRA: [f64; 2] = [5.0, 10.0];
/// Wind speeds at which the foam coverage of the spectrum `jonswap` is measured, m/s.
const FOAM_WINDS_M_S: [f64; 7] = [5.0, 7.0, 10.0, 12.0, 15.0, 20.0, 25.0];
/// Scatter (±) of the mean square slopes, dimensionless, that Cox and Munk measured in 1954.
const COX_MUNK_MSS_SCATTER: f64 = 0.004;
/// Number of seeds over which foam is measured. It is small, because each seed needs 48 foam steps, each with an
/// evaluation of the waves.
const FOAM_SEEDS: u32 = 3;

/// Adds the second half of part 4 to the validation page: mean square slope and whitecap coverage against wind.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    add_mean_square_slopes(page, lab)?;
    add_whitecap_coverage(page, lab)
}

fn add_mean_square_slopes(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    page.heading(3, "Mean square slope");
    page.paragraph(
        "Cox and Munk 1954 measured the mean square slope in the sun's glitter for winds of 1 to 14 m/s: 0.003 + \
         0.00512 U ± 0.004. The cascades hold the slope of waves up to k_max (resolved). Shading adds what is missing \
         from Cox and Munk (the residual, at least 0), so the picture shows the larger of the two. Fetch 250 km, n = \
         256, half of the seeds.",
    );
    let half = MeasurementSetup { gpu: lab.gpu, seed_count: lab.seed_count.div_ceil(2) };
    let (rows, points) = slope_rows(&half)?;
    let mut figure = slope_figure()?;
    if lab.gpu.is_some() {
        figure = figure.with_series(FigureSeries::new("jonswap, measured on the GPU", 0, SeriesData::Points(points)));
    }
    page.figure(
        "slopes",
        &figure,
        "Mean square slope that the cascades hold against wind, by spectrum (lines), measured on the GPU (points), and \
         Cox and Munk 1954 with their scatter (shaded), extrapolated above 14 m/s.",
    )?;
    page.table(
        "spectrum | wind, m/s | Cox and Munk | k_max, rad/m | resolved | measured | deviation | residual, shaded | \
         resolved + residual | against Cox and Munk",
        &rows,
    );
    page.paragraph(
        "With an ω⁻⁵ tail the cascades hold half of the slope or more, and shading adds the rest: by construction the \
         sum is Cox and Munk's. `donelan` and `torsethaugen` have an ω⁻⁴ tail, fitted up to a few times the peak \
         frequency. Continued to centimetres it holds three to six times the slope of the sea, and the picture is \
         rougher than Cox and Munk by the same factor. A `fade` removes it. The steps in a curve lie where the plan \
         changes the number of cascades, and with it k_max.",
    );
    Ok(())
}

/// Figure of mean square slope against wind: Cox and Munk's measurements with their scatter, and theory up to the
/// shortest waves of the cascades.
fn slope_figure() -> Result<Figure, String> {
    let x = Axis::linear("wind at 10 m, m/s", 0.0, 25.0);
    let y = Axis::log("mean square slope", 5e-4, 1.0);
    let edges =
        |u: f64| [u, (cox_munk_mss(u) - COX_MUNK_MSS_SCATTER).max(5e-4), cox_munk_mss(u) + COX_MUNK_MSS_SCATTER];
    let band = (0..=25).map(f64::from).map(edges).collect();
    let mut figure = Figure::new("Mean square slope against wind", x.clone(), y, LegendCorner::LowerRight)
        .with_series(FigureSeries::new("Cox and Munk 1954, ± 0.004", 6, SeriesData::Band(band)))
        .with_series(FigureSeries::new("", 6, SeriesData::Dashes(sample_curve(&x, 25, cox_munk_mss))));
    for (i, name) in ["jonswap", "pm", "elfouhaily", "karaev", "donelan", "torsethaugen"].into_iter().enumerate() {
        let mut line = Vec::new();
        for [wind, _] in sample_curve(&x, 25, |_| 0.0).into_iter().skip(1) {
            line.push([wind, theoretical_statistics(&format!("spectrum={name}&wind={wind}&fetch=250&n=256"))?.mss]);
        }
        figure = figure.with_series(FigureSeries::new(name, i, SeriesData::Line(line)));
    }
    Ok(figure)
}

/// Rows of the table of mean square slopes, and points for the figure: wind (m/s), mean square slope measured with the
/// spectrum `jonswap`, and its standard error.
fn slope_rows(lab: &MeasurementSetup<'_>) -> Result<(Vec<Vec<String>>, Vec<[f64; 3]>), String> {
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    for name in ["jonswap", "elfouhaily", "donelan", "torsethaugen"] {
        for &wind in if name == "jonswap" { &JONSWAP_SLOPE_WINDS_M_S[..] } else { &WINDS_OF_OTHER_SPECTRA } {
            let sea = lab.measure_sea(&format!("spectrum={name}&wind={wind}&fetch=250&n=256"))?;
            let (cox_munk, resolved) = (cox_munk_mss(wind), sea.resolved.mss);
            let mss = sea.measured_statistic(|m| m.mss);
            if name == "jonswap" {
                points.extend(mss.map(|e| e.x_value_error(wind)));
            }
            let residual = (cox_munk - resolved).max(0.0);
            rows.push(vec![
                name.to_owned(),
                format_number(wind, 0),
                format_number(cox_munk, 4),
                format_number(sea.theory.k_max, 0),
                format_number(resolved, 4),
                format_estimate(mss, 4),
                relative_deviation(mss, resolved),
                format_number(residual, 4),
                format_number(resolved + residual, 4),
                relative_to_published(resolved + residual, cox_munk),
            ]);
        }
    }
    Ok((rows, points))
}

fn add_whitecap_coverage(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    page.heading(3, "Whitecaps");
    page.paragraph(
        "Monahan and O'Muircheartaigh 1980: W = 3.84·10⁻⁶ U^3.41. Measured: mean foam over all levels after a cold \
         start. The threshold at which foam forms follows from that law and the variance of the Jacobian, with one \
         constant fitted on the GPU for winds of 7 to 20 m/s. So this table checks the calibration; it is not a \
         prediction. Fetch 250 km, n = 128, three seeds.",
    );
    let x = Axis::linear("wind at 10 m, m/s", 4.0, 26.0);
    let mut figure = Figure::new(
        "Whitecap coverage against wind",
        x.clone(),
        Axis::log("coverage", 5e-4, 0.5),
        LegendCorner::LowerRight,
    )
    .with_series(FigureSeries::new(
        "Monahan and O'Muircheartaigh 1980",
        6,
        SeriesData::Dashes(sample_curve(&x, 60, monahan_coverage)),
    ));
    let mut rows = Vec::new();
    for (i, name) in ["jonswap", "elfouhaily"].into_iter().enumerate() {
        let mut points = Vec::new();
        for &wind in if name == "jonswap" { &FOAM_WINDS_M_S[..] } else { &WINDS_OF_OTHER_SPECTRA } {
            let state = format!("spectrum={name}&wind={wind}&fetch=250&n=128&t=30");
            let expected = FoamModel::new(&Plan::new(&parse_params(&state)?)).expected_mean_foam;
            let foam = lab.measure_foam_coverage(&state, FOAM_SEEDS)?;
            points.extend(foam.map(|e| e.x_value_error(wind)));
            rows.push(vec![
                name.to_owned(),
                format_number(wind, 0),
                format_number(monahan_coverage(wind), 4),
                format_number(expected, 4),
                format_estimate(foam, 4),
                relative_deviation(foam, monahan_coverage(wind)),
            ]);
        }
        if lab.gpu.is_some() {
            figure = figure.with_series(FigureSeries::new(
                &format!("{name}, measured on the GPU"),
                i,
                SeriesData::Points(points),
            ));
        }
    }
    page.figure(
        "whitecaps",
        &figure,
        "Whitecap coverage against wind: the published law (dashed) and the mean foam on the GPU (points).",
    )?;
    page.table("spectrum | wind, m/s | published | model expects | measured | deviation from published", &rows);
    Ok(())
}
