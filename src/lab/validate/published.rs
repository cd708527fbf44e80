//! Part 4 of the validation page: published measurements of growth with fetch and full development; the Beaufort scale.

use super::cells::{format_number, relative_to_published};
use super::measurement::theoretical_statistics;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use std::f64::consts::TAU;

const GRAVITY_M_S2: f64 = 9.81;
/// Wind speed for the growth curves, m/s. The curves are dimensionless, so every wind speed gives the same curves.
const WIND_M_S: f64 = 10.0;
/// Wind speed at a height of 19.5 m, which Pierson and Moskowitz use, divided by that at 10 m.
const WIND_RATIO_19M_10M: f64 = 1.026;

/// Beaufort scale by WMO-No. 306 and the Met Office: Beaufort number, middle of its range of wind speeds (m/s),
/// probable wave height (m) and probable highest wave height (m, NaN if not given).
const BEAUFORT_WIND_AND_WAVE_HEIGHTS: [(u32, f64, f64, f64); 10] = [
    (3, 4.4, 0.6, 1.0),
    (4, 6.7, 1.0, 1.5),
    (5, 9.35, 2.0, 2.5),
    (6, 12.3, 3.0, 4.0),
    (7, 15.5, 4.0, 5.5),
    (8, 18.95, 5.5, 7.5),
    (9, 22.6, 7.0, 10.0),
    (10, 26.45, 9.0, 12.5),
    (11, 30.55, 11.5, 16.0),
    (12, 35.0, 14.0, f64::NAN),
];
/// Upper limit of the significant wave height in each of the sea states 0 to 8, m (WMO code table 3700).
const SEA_STATE_TOP_HS_M: [f64; 9] = [0.0, 0.1, 0.5, 1.25, 2.5, 4.0, 6.0, 9.0, 14.0];

/// Dimensionless energy m0 g^2 / U^4 and peak frequency f_p U / g that the program's spectrum called `spectrum` has at
/// the dimensionless fetch `x` = g F / U^2 (m0 variance, U wind speed, F fetch).
fn growth_of_spectrum(spectrum: &str, x: f64) -> Result<[f64; 2], String> {
    let fetch_km = x * WIND_M_S * WIND_M_S / GRAVITY_M_S2 / 1000.0;
    let t = theoretical_statistics(&format!("spectrum={spectrum}&wind={WIND_M_S}&fetch={fetch_km}&n=64"))?;
    Ok([t.variance_m2 * GRAVITY_M_S2 * GRAVITY_M_S2 / WIND_M_S.powi(4), WIND_M_S / (GRAVITY_M_S2 * t.tp_s)])
}

/// Growth with fetch F as published by Hasselmann et al. 1973 for wind speed U: dimensionless energy m0 g^2 / U^4 (m0
/// is the variance) and peak frequency f_p U / g at the dimensionless fetch `x` = g F / U^2.
fn published_growth_jonswap(x: f64) -> [f64; 2] {
    [1.6e-7 * x, 3.5 * x.powf(-0.33)]
}

/// Growth with fetch F as published by Donelan, Hamilton and Hui 1985 for wind speed U: dimensionless energy m0 g^2 /
/// U^4 (m0 is the variance) and peak frequency f_p U / g at the dimensionless fetch `x` = g F / U^2.
fn published_growth_donelan(x: f64) -> [f64; 2] {
    let age = 11.6 * x.powf(-0.23);
    [2.74e-3 * age.powf(-3.3), age / TAU]
}

/// Adds the first half of part 4 to the validation page: published growth with fetch, full development, Beaufort scale.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(2, "4. Published measurements");
    add_growth_with_fetch(page)?;
    add_full_development(page)?;
    add_beaufort_scale(page)
}

fn add_growth_with_fetch(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Growth with fetch");
    page.paragraph(
        "Dimensionless energy ε = m0 g² / U⁴ and peak frequency ν = f_p U / g over the dimensionless fetch x = g F / \
         U². Published: JONSWAP (Hasselmann et al. 1973) ε = 1.6·10⁻⁷ x, ν = 3.5 x^-0.33; Donelan et al. 1985 ε = \
         2.74·10⁻³ (U/c_p)^-3.3 with U/c_p = 11.6 x^-0.23. The program's numbers (ours) are integrals of the spectra \
         `jonswap` and `donelan`.",
    );
    let x = Axis::log("dimensionless fetch g F / U²", 100.0, 10_000.0);
    let grid: Vec<f64> = sample_curve(&x, 24, |x| x).iter().map(|p| p[0]).collect();
    let axes = [
        ("growth-energy", "Energy against fetch", Axis::log("ε = m0 g² / U⁴", 1e-5, 1e-2), LegendCorner::UpperLeft),
        ("growth-peak", "Peak frequency against fetch", Axis::log("ν = f_p U / g", 0.1, 1.0), LegendCorner::UpperRight),
    ];
    let mut ours: [Vec<[f64; 2]>; 2] = [vec![], vec![]];
    for &x in &grid {
        ours[0].push(growth_of_spectrum("jonswap", x)?);
        ours[1].push(growth_of_spectrum("donelan", x)?);
    }
    let mut figures = Vec::new();
    for (i, (name, title, y, legend)) in axes.into_iter().enumerate() {
        let line = |values: &[[f64; 2]]| grid.iter().zip(values).map(|(x, v)| [*x, v[i]]).collect::<Vec<_>>();
        let figure = Figure::new(title, x.clone(), y, legend)
            .with_series(FigureSeries::new(
                "Hasselmann et al. 1973",
                0,
                SeriesData::Dashes(sample_curve(&x, 60, |x| published_growth_jonswap(x)[i])),
            ))
            .with_series(FigureSeries::new("jonswap, ours", 0, SeriesData::Line(line(&ours[0]))))
            .with_series(FigureSeries::new(
                "Donelan et al. 1985",
                1,
                SeriesData::Dashes(sample_curve(&x, 60, |x| published_growth_donelan(x)[i])),
            ))
            .with_series(FigureSeries::new("donelan, ours", 1, SeriesData::Line(line(&ours[1]))));
        figures.push((name.to_owned(), figure));
    }
    page.figures(&figures, "Growth curves: published fits (dashed) and integrals of the program's spectra (full).")?;
    let mut rows = Vec::new();
    for x in [100.0, 300.0, 1000.0, 3000.0, 10_000.0] {
        for (name, published) in [("jonswap", published_growth_jonswap(x)), ("donelan", published_growth_donelan(x))] {
            let ours = growth_of_spectrum(name, x)?;
            rows.push(vec![
                format_number(x, 0),
                name.to_owned(),
                format!("{:.3e}", published[0]),
                format!("{:.3e}", ours[0]),
                relative_to_published(ours[0], published[0]),
                format_number(published[1], 4),
                format_number(ours[1], 4),
                relative_to_published(ours[1], published[1]),
            ]);
        }
    }
    page.table("g F / U² | spectrum | ε, published | ε, ours | deviation | ν, published | ν, ours | deviation", &rows);
    page.paragraph(
        "The JONSWAP fits are not consistent with each other. The spectrum with α = 0.076 x^-0.22, ν = 3.5 x^-1/3 and \
         γ = 3.3 integrates to ε = 9.9·10⁻⁸ x^1.11, but the separate fit of ε is 1.6·10⁻⁷ x. So `jonswap` holds more \
         energy than that fit: 4 % more at x = 10² and 76 % more (a third more height) at 10⁴. The program keeps the \
         spectrum. The exponent 1/3 in ν, instead of 0.33, comes from the rounded dimensional form 22 (g²/UF)^1/3. \
         `donelan` uses its own growth curve of U/c_p; ε follows from the integral.",
    );
    Ok(())
}

fn add_full_development(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Full development");
    page.paragraph(
        "Pierson and Moskowitz 1964 give S with α = 8.1·10⁻³ and β = 0.74 for the wind at 19.5 m. Its integral is m0 = \
         α g² / 4B with B = β (g/U19.5)⁴, so Hs = 2 sqrt(α/β) U²/g = 0.2092 U19.5²/g, published rounded as 0.21. The \
         peak is ω_p = (4β/5)^1/4 g/U19.5 = 0.877 g/U19.5 or f_p = 0.140 g/U19.5, published as 0.14 g/U19.5 (0.13 \
         g/U10 in Hasselmann et al. 1973). With U19.5 = 1.026 U10, these become 0.2203 U10²/g and 0.1361 g/U10.",
    );
    let t = theoretical_statistics(&format!("spectrum=pm&wind={WIND_M_S}&n=64"))?;
    let (height, peak) = (t.hs_m * GRAVITY_M_S2 / (WIND_M_S * WIND_M_S), WIND_M_S / (GRAVITY_M_S2 * t.tp_s));
    let entry = |what: &str, published: f64, ours: f64| {
        vec![
            what.to_owned(),
            format_number(published, 4),
            format_number(ours, 4),
            relative_to_published(ours, published),
        ]
    };
    page.table(
        "quantity | published | ours | deviation",
        &[
            entry("Hs g / U10², from the integral", 0.20925 * WIND_RATIO_19M_10M * WIND_RATIO_19M_10M, height),
            entry("Hs g / U10², rounded: 0.21 for U19.5", 0.21 * WIND_RATIO_19M_10M * WIND_RATIO_19M_10M, height),
            entry("f_p U10 / g, from the spectrum", 0.592f64.powf(0.25) / TAU / WIND_RATIO_19M_10M, peak),
            entry("f_p U10 / g, rounded: 0.14 for U19.5", 0.14 / WIND_RATIO_19M_10M, peak),
            entry("f_p U10 / g, Hasselmann et al. 1973: 0.13", 0.13, peak),
        ],
    );
    Ok(())
}

fn sea_state(hs_m: f64) -> usize {
    SEA_STATE_TOP_HS_M.iter().position(|&top| hs_m <= top).unwrap_or(SEA_STATE_TOP_HS_M.len())
}

fn add_beaufort_scale(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Beaufort scale and sea states");
    page.paragraph(
        "The World Meteorological Organization lists probable wave heights in the open sea with the Beaufort scale \
         (Manual on Codes, WMO-No. 306; the Met Office has the same table). The program's heights are compared with \
         them at the middle of each force's winds, and classified by the sea states of code table 3700.",
    );
    let x = Axis::linear("wind at 10 m, m/s", 0.0, 36.0);
    let y = Axis::linear("significant wave height Hs, m", 0.0, 20.0);
    let seas = [
        ("pm, fully developed", "spectrum=pm", 0),
        ("jonswap, fetch 500 km", "spectrum=jonswap&fetch=500", 1),
        ("jonswap, fetch 100 km", "spectrum=jonswap&fetch=100", 2),
        ("donelan, fetch 500 km", "spectrum=donelan&fetch=500", 3),
    ];
    let height = |state: &str, wind: f64| theoretical_statistics(&format!("{state}&wind={wind}&n=64")).map(|t| t.hs_m);
    let probable = BEAUFORT_WIND_AND_WAVE_HEIGHTS.iter().filter(|b| b.3.is_finite()).map(|b| [b.1, b.2, b.3]).collect();
    let mut figure = Figure::new("Wave height against wind", x.clone(), y, LegendCorner::UpperLeft)
        .with_series(FigureSeries::new("WMO, probable to highest", 6, SeriesData::Band(probable)));
    for (label, state, colour) in seas {
        let mut line = Vec::new();
        for [wind, _] in sample_curve(&x, 36, |_| 0.0).into_iter().skip(1) {
            line.push([wind, height(state, wind)?]);
        }
        figure = figure.with_series(FigureSeries::new(label, colour, SeriesData::Line(line)));
    }
    let points = BEAUFORT_WIND_AND_WAVE_HEIGHTS.iter().map(|b| [b.1, b.2, 0.0]).collect();
    figure = figure.with_series(FigureSeries::new("WMO, probable", 6, SeriesData::Points(points)));
    page.figure(
        "beaufort",
        &figure,
        "Significant wave height against wind: the program's spectra (lines), and probable (points) to probable \
         highest (shaded) wave heights of the Beaufort scale in the open sea (WMO-No. 306).",
    )?;
    let mut rows = Vec::new();
    for (force, wind, probable, _) in BEAUFORT_WIND_AND_WAVE_HEIGHTS {
        let [pm, fetch] = [height(seas[0].1, wind)?, height(seas[1].1, wind)?];
        rows.push(vec![
            force.to_string(),
            format_number(wind, 2),
            format_number(probable, 1),
            sea_state(probable).to_string(),
            format_number(pm, 2),
            relative_to_published(pm, probable),
            sea_state(pm).to_string(),
            format_number(fetch, 2),
            relative_to_published(fetch, probable),
            sea_state(fetch).to_string(),
        ]);
    }
    page.table(
        "force | wind, m/s | WMO, m | state | pm, m | deviation | state | jonswap 500 km, m | deviation | state",
        &rows,
    );
    page.paragraph(
        "The columns \"state\" hold the sea state of code 3700: 2 up to 0.5 m, 3 to 1.25, 4 to 2.5, 5 to 4, 6 to 6, 7 \
         to 9, 8 to 14, 9 above. Up to force 7 the scale describes a fully developed sea, within 35 %. Above force 7, \
         storms seldom blow long and far enough: Pierson and Moskowitz's heights grow with U² and are twice the \
         probable heights at force 12. `jonswap` over 500 km is too high at every force, by a factor of four at force \
         3 and by 14 % at force 12. Its growth curves are fitted for x = g F / U² up to 10⁴ and have no limit: it is \
         higher than a fully developed sea beyond x = 1.1·10⁴ and longer beyond 1.7·10⁴ (112 and 173 km at 10 m/s). A \
         notice appears where it is a quarter higher. `donelan` and `elfouhaily` stop growing at full development.",
    );
    Ok(())
}
