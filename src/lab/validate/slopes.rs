//! Part 4, continued: slopes and whitecaps against wind.

use super::figure::{Axis, Figure, Legend, Mark, Series, curve};
use super::lab::{Lab, params};
use super::page::{Page, against, deviation, measured, number};
use crate::waves::Plan;
use crate::waves::foam::FoamModel;
use crate::waves::statistics::{cox_munk_mss, monahan_coverage};

/// Winds of the tables, m/s.
const WINDS: [f64; 7] = [2.0, 5.0, 8.0, 10.0, 12.0, 14.0, 20.0];
const FEW_WINDS: [f64; 2] = [5.0, 10.0];
const FOAM_WINDS: [f64; 7] = [5.0, 7.0, 10.0, 12.0, 15.0, 20.0, 25.0];
/// Scatter of Cox and Munk's slopes.
const SCATTER: f64 = 0.004;
/// Seeds of the foam, which takes 48 evaluations each.
const FOAM_SEEDS: u32 = 3;

/// Writes the part.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    slopes(page, lab)?;
    whitecaps(page, lab)
}

fn slopes(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    page.heading(3, "Mean square slope");
    page.prose(
        "Cox and Munk 1954, from the glitter of the sun for winds of 1 to 14 m/s: 0.003 + 0.00512 U ± 0.004. Ours: the slope \
         that the cascades hold, up to k_max; the picture shades what Cox and Munk have beyond that (the residual, never \
         below 0), so that what is seen in all is the greater of the two. Fetch 250 km, n = 256, \
         half of the seeds.",
    );
    let x = Axis::linear("wind at 10 m, m/s", 0.0, 25.0);
    let band = (0..=25)
        .map(f64::from)
        .map(|u| [u, (cox_munk_mss(u) - SCATTER).max(5e-4), cox_munk_mss(u) + SCATTER])
        .collect();
    let mut figure = Figure::new(
        "Mean square slope against wind",
        x.clone(),
        Axis::log("mean square slope", 5e-4, 1.0),
        Legend::LowerRight,
    )
    .with(Series::new("Cox and Munk 1954, ± 0.004", 6, Mark::Band(band)))
    .with(Series::new("", 6, Mark::Dashes(curve(&x, 25, cox_munk_mss))));
    for (i, name) in ["jonswap", "pm", "elfouhaily", "karaev", "donelan", "torsethaugen"].into_iter().enumerate() {
        let mut line = Vec::new();
        for [wind, _] in curve(&x, 25, |_| 0.0).into_iter().skip(1) {
            let t = super::published::theory(&format!("spectrum={name}&wind={wind}&fetch=250&n=256"))?;
            line.push([wind, t.mss]);
        }
        figure = figure.with(Series::new(name, i, Mark::Line(line)));
    }
    let mut rows = Vec::new();
    let mut points = Vec::new();
    let half = Lab { gpu: lab.gpu, seeds: lab.seeds.div_ceil(2) };
    for name in ["jonswap", "elfouhaily", "donelan", "torsethaugen"] {
        for &wind in if name == "jonswap" { &WINDS[..] } else { &FEW_WINDS } {
            let sea = half.sea(&format!("spectrum={name}&wind={wind}&fetch=250&n=256"), 0, &|_| None)?;
            let (cox_munk, resolved) = (cox_munk_mss(wind), sea.resolved.mss);
            let seen = sea.get(|m| m.mss);
            if let (Some(e), "jonswap") = (seen, name) {
                points.push([wind, e.value, e.error.unwrap_or(0.0)]);
            }
            let residual = (cox_munk - resolved).max(0.0);
            rows.push(vec![
                name.to_owned(),
                number(wind, 0),
                number(cox_munk, 4),
                number(sea.theory.k_max, 0),
                number(resolved, 4),
                measured(seen.as_ref(), 4),
                deviation(seen.as_ref(), resolved),
                number(residual, 4),
                number(resolved + residual, 4),
                against(resolved + residual, cox_munk),
            ]);
        }
    }
    if lab.gpu.is_some() {
        figure = figure.with(Series::new("jonswap, measured on the GPU", 0, Mark::Points(points)));
    }
    page.figure(
        "slopes",
        &figure,
        "Mean square slope that the cascades hold against wind, by spectrum (lines), measured on the GPU (points), and Cox \
         and Munk 1954 with their scatter (shaded), extrapolated above 14 m/s.",
    )?;
    let head = [
        "spectrum",
        "wind, m/s",
        "Cox and Munk",
        "k_max, rad/m",
        "resolved",
        "measured",
        "deviation",
        "residual, shaded",
        "seen in all",
        "against Cox and Munk",
    ];
    page.table(&head, &rows);
    page.prose(
        "An ω⁻⁵ tail holds half and more of the slope, and shading makes up the rest: Cox and Munk to the digit, by construction. \
         `donelan` and `torsethaugen` have an ω⁻⁴ tail, fitted up to a few times the peak frequency; carried on to centimetres \
         it holds three to six times the slope of the sea, and the picture is that much rougher than Cox and Munk. A `fade` \
         takes it away. The steps in a curve are where the plan changes the number of cascades, hence k_max.",
    );
    Ok(())
}

fn whitecaps(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    page.heading(3, "Whitecaps");
    page.prose(
        "Monahan and O'Muircheartaigh 1980: W = 3.84·10⁻⁶ U^3.41. Ours: mean foam over all levels after a cold start. The \
         threshold from which foam forms is derived from that law and the variance of the Jacobian, with one constant fitted \
         on the GPU for winds of 7 to 20 m/s: this is a check of the calibration, not a prediction. Fetch 250 km, \
         n = 128, three seeds.",
    );
    let x = Axis::linear("wind at 10 m, m/s", 4.0, 26.0);
    let mut figure =
        Figure::new("Whitecap coverage against wind", x.clone(), Axis::log("coverage", 5e-4, 0.5), Legend::LowerRight)
            .with(Series::new("Monahan and O'Muircheartaigh 1980", 6, Mark::Dashes(curve(&x, 60, monahan_coverage))));
    let mut rows = Vec::new();
    for (i, name) in ["jonswap", "elfouhaily"].into_iter().enumerate() {
        let mut points = Vec::new();
        for &wind in if name == "jonswap" { &FOAM_WINDS[..] } else { &FEW_WINDS } {
            let state = format!("spectrum={name}&wind={wind}&fetch=250&n=128&t=30");
            let expected = FoamModel::new(&Plan::new(&params(&state)?)).coverage;
            let seen = lab.foam(&state, FOAM_SEEDS)?;
            if let Some(e) = seen {
                points.push([wind, e.value, e.error.unwrap_or(0.0)]);
            }
            rows.push(vec![
                name.to_owned(),
                number(wind, 0),
                number(monahan_coverage(wind), 4),
                number(expected, 4),
                measured(seen.as_ref(), 4),
                deviation(seen.as_ref(), monahan_coverage(wind)),
            ]);
        }
        if lab.gpu.is_some() {
            figure = figure.with(Series::new(&format!("{name}, measured on the GPU"), i, Mark::Points(points)));
        }
    }
    page.figure(
        "whitecaps",
        &figure,
        "Whitecap coverage against wind: the published law (dashed) and the mean foam on the GPU (points).",
    )?;
    page.table(&["spectrum", "wind, m/s", "published", "model expects", "measured", "deviation from published"], &rows);
    Ok(())
}
