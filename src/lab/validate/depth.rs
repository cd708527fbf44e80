//! Part 5 of the validation page: wave height in water of finite depth.

use super::cells::{format_estimate, format_number, relative_deviation, relative_to_published};
use super::measurement::{MeasurementSetup, theoretical_statistics};
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;

const WIND_STATE_STRING: &str = "wind=20&fetch=300&n=128";
const DEPTHS_M: [f64; 10] = [2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0, 50.0, 100.0, 200.0];
/// The three forms of the TMA spectrum's depth factor: name in part 5 of the validation page, and the part of a state
/// string that selects the form.
const TMA_DEPTH_FORMS: [(&str, &str); 3] =
    [("exact", "spectrum=tma"), ("branches", "spectrum=tma&tmafit=branches"), ("Bouws", "spectrum=tma&bouws=1")];

/// Adds part 5 to the validation page: wave height in water of finite depth.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    page.heading(2, "5. Depth");
    page.paragraph(
        "TMA is JONSWAP times Kitaigorodskii's depth factor. The program has three forms of it: exact, tanh²(kh) / (1 \
         + 2kh / sinh 2kh); in the three branches of Thompson and Vincent 1983; and exact with the α and γ of Bouws et \
         al. 1985. For every spectrum, breaking limits the sea to Hs = 0.6 h. Wind 20 m/s over 300 km.",
    );
    let x = Axis::log("depth h, m", 2.0, 200.0);
    let y = Axis::linear("significant wave height Hs, m", 0.0, 9.0);
    let mut figure = Figure::new("Wave height against depth", x.clone(), y, LegendCorner::LowerRight)
        .with_series(FigureSeries::new("cap, 0.6 h", 6, SeriesData::Dashes(sample_curve(&x, 200, |h| 0.6 * h))));
    for (i, (name, state)) in TMA_DEPTH_FORMS.into_iter().enumerate() {
        let mut line = Vec::new();
        for [depth, _] in sample_curve(&x, 60, |_| 0.0) {
            line.push([depth, theoretical_statistics(&format!("{state}&{WIND_STATE_STRING}&depth={depth}"))?.hs_m]);
        }
        let mark = if name == "branches" { SeriesData::Dashes(line) } else { SeriesData::Line(line) };
        figure = figure.with_series(FigureSeries::new(&format!("tma, {name}"), i, mark));
    }
    let deep = theoretical_statistics(&format!("spectrum=jonswap&{WIND_STATE_STRING}"))?.hs_m;
    figure = figure.with_series(FigureSeries::new(
        "jonswap in deep water",
        3,
        SeriesData::Dashes(sample_curve(&x, 60, |_| deep)),
    ));
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    for depth in DEPTHS_M {
        let state = |form: usize| format!("{}&{WIND_STATE_STRING}&depth={depth}", TMA_DEPTH_FORMS[form].1);
        let sea = lab.measure_sea(&state(0))?;
        let (exact, resolved) = (sea.theory.hs_m, sea.resolved.hs_m);
        let (branches, bouws) = (theoretical_statistics(&state(1))?.hs_m, theoretical_statistics(&state(2))?.hs_m);
        let hs = sea.measured_statistic(|m| m.hs_m);
        points.extend(hs.map(|e| e.x_value_error(depth)));
        rows.push(vec![
            format_number(depth, 0),
            format_number(0.6 * depth, 2),
            format_number(exact, 3),
            format_number(resolved, 3),
            format_estimate(hs, 3),
            relative_deviation(hs, resolved),
            format_number(branches, 3),
            relative_to_published(branches, exact),
            format_number(bouws, 3),
            relative_to_published(bouws, exact),
        ]);
    }
    if lab.gpu.is_some() {
        figure =
            figure.with_series(FigureSeries::new("tma, exact, measured on the GPU", 0, SeriesData::Points(points)));
    }
    page.figure(
        "depth",
        &figure,
        "Significant wave height against depth for the three forms of TMA, with the limit by breaking. Sources: \
         Kitaigorodskii et al. 1975; Thompson and Vincent 1983; Bouws et al. 1985.",
    )?;
    page.table(
        "depth, m | cap, m | exact, theory | resolved | measured | deviation | branches | against exact | Bouws \
         | against exact",
        &rows,
    );
    page.paragraph(
        "The branches fit the exact factor within 0.023. Bouws' α and γ grow with U² k_p / g. They come from other \
         measurements than JONSWAP's, and apply at every depth.",
    );
    Ok(())
}
