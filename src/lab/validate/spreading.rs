//! Part 2 of the validation page: the seven directional spreadings.

use super::cells::{angle_deviation, format_estimate, format_number, relative_deviation};
use super::choice_parameter_values;
use super::measurement::{MeasuredSea, MeasurementSetup, WaveBin};
use crate::lab::ensemble::{TravellingWave, spread_deg};
use crate::lab::estimate::EstimateWithError;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::waves::quadrature::{integrate_adaptive, integrate_panels};
use crate::waves::{Plan, statistics};
use std::f64::consts::{PI, TAU};

/// State string that all seas in part 2 of the page share; `spread=` is added to it.
const SEA_STATE_STRING: &str = "wind=10&fetch=100&dir=240&n=256";
/// Centre frequencies of the bands in which spreading is measured, relative to the peak frequency.
const BAND_PEAK_RATIOS: [f64; 3] = [1.0, 2.0, 4.0];
/// Half the width of each band in which spreading is measured, relative to the centre frequency of the band.
const RELATIVE_BAND_HALF_WIDTH: f64 = 0.1;
/// Number of direction bins into which the waves are sorted, equally wide over the full circle.
const DIRECTION_BINS: usize = 24;

/// Angle, rad in (-pi, pi], from the downwind direction (in which the wind blows) to the unit vector (x, z), positive
/// clockwise seen from above.
fn angle_from_downwind(plan: &Plan, unit: [f64; 2]) -> f64 {
    let [x, z] = plan.downwind;
    (x * unit[1] - z * unit[0]).atan2(x * unit[0] + z * unit[1])
}

/// Angle from the downwind direction to the middle of a direction bin, rad: bin 0 begins at -pi (upwind).
fn direction_bin_angle_rad(bin: usize) -> f64 {
    (bin as f64 + 0.5) / DIRECTION_BINS as f64 * TAU - PI
}

/// Mean of `f`, a function of the angular frequency (rad/s), over the band of `omega` (1 ±
/// [`RELATIVE_BAND_HALF_WIDTH`]), weighted by the spectral density of the sea of `plan`.
fn frequency_band_mean(plan: &Plan, omega: f64, f: impl Fn(f64) -> f64) -> f64 {
    let ends =
        [(1.0 - RELATIVE_BAND_HALF_WIDTH) * omega, 0.95 * omega, omega, (1.0 + RELATIVE_BAND_HALF_WIDTH) * omega];
    let s = |w: f64| plan.density(w);
    integrate_panels(|w| s(w) * f(w), &ends, 1) / integrate_panels(s, &ends, 1)
}

/// Two theoretical values at `ratio` times the peak frequency: the integral of the directional spreading over the
/// circle (it should be 1), and the first directional moment r1, averaged over a band as in [`frequency_band_mean`].
fn spreading_integral_and_r1(plan: &Plan, ratio: f64) -> [f64; 2] {
    let spreading = &plan.systems[0].spreading;
    let omega = ratio * plan.omega_p;
    let knots = [-PI, -0.5 * PI, -0.5, 0.0, 0.5, 0.5 * PI, PI];
    let integral = integrate_adaptive(|theta| spreading.density(omega, theta), &knots, 1e-10);
    [integral, frequency_band_mean(plan, omega, |w| spreading.first_moment(w))]
}

/// Draws the density of one directional spreading over direction, by theory and as measured. The measured variance in
/// each bin of directions is divided by that of `isotropic_sea`, because bins hold different numbers of waves.
fn spreading_figure(name: &str, sea: &MeasuredSea, isotropic_sea: &MeasuredSea) -> Figure {
    let x = Axis::linear("angle from the wind's direction, degrees", -180.0, 180.0);
    let spreading = &sea.plan.systems[0].spreading;
    let mut curves = Vec::new();
    let mut points = Vec::new();
    for (i, ratio_p) in BAND_PEAK_RATIOS.into_iter().enumerate() {
        let omega = ratio_p * sea.plan.omega_p;
        let label = if ratio_p == 1.0 { "at ω_p".to_owned() } else { format!("at {ratio_p} ω_p") };
        let line = sample_curve(&x, 240, |deg| {
            frequency_band_mean(&sea.plan, omega, |w| spreading.density(w, deg.to_radians()))
        });
        curves.push(FigureSeries::new(&label, i, SeriesData::Line(line)));
        if sea.measured.is_some() {
            points.push(FigureSeries::new("", i, SeriesData::Points(measured_spreading_points(sea, isotropic_sea, i))));
        }
    }
    let top = curves.iter().chain(&points).map(FigureSeries::max_y).fold(0.0, f64::max);
    let y = Axis::linear("D(θ), 1/rad", 0.0, (1.12 * top).max(0.3));
    curves.into_iter().chain(points).fold(Figure::new(name, x, y, LegendCorner::UpperRight), Figure::with_series)
}

/// Points of the figure in a frequency band: angle (degrees), measured directional spreading D (1/rad) and its standard
/// error. D is the variance of a direction bin over that of the same waves in `isotropic_sea`, whose D is 1 / (2 pi).
fn measured_spreading_points(sea: &MeasuredSea, isotropic_sea: &MeasuredSea, band: usize) -> Vec<[f64; 3]> {
    let point = |i: usize| {
        let at = band * DIRECTION_BINS + i;
        let variances: Vec<f64> = sea.wave_bins[at].measured_moments_by_seed.iter().map(|v| v[0]).collect();
        EstimateWithError::mean(&variances)
            .scaled(1.0 / (TAU * isotropic_sea.wave_bins[at].expected_moments[0]))
            .x_value_error(direction_bin_angle_rad(i).to_degrees())
    };
    (0..DIRECTION_BINS).map(point).collect()
}

/// Adds part 2 to the validation page: the directional spreadings.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    let mut seas = Vec::new();
    for name in choice_parameter_values("spread") {
        let state = format!("spread={name}&{SEA_STATE_STRING}");
        let plan = Plan::new(&super::measurement::parse_params(&state)?);
        let bin = |wave: &TravellingWave| {
            let is_near = |ratio: &f64| (wave.omega / (ratio * plan.omega_p) - 1.0).abs() <= RELATIVE_BAND_HALF_WIDTH;
            let band = BAND_PEAK_RATIOS.iter().position(is_near)?;
            let place = (angle_from_downwind(&plan, wave.travel_direction) + PI) / TAU * DIRECTION_BINS as f64;
            Some(band * DIRECTION_BINS + (place as usize).min(DIRECTION_BINS - 1))
        };
        seas.push((name, lab.measure_binned_sea(&state, BAND_PEAK_RATIOS.len() * DIRECTION_BINS, &bin)?));
    }
    page.heading(2, "2. Directional spreading");
    page.paragraph(
        "JONSWAP, wind 10 m/s over 100 km, from 240°. The waves within 10 % of a frequency are sorted by direction of \
         travel into bins of 15°. The measured distribution is the variance of a bin divided by the variance of the \
         same waves in a sea with isotropic spreading.",
    );
    let isotropic_sea = &seas[0].1;
    let figures: Vec<_> =
        seas.iter().map(|(name, sea)| (format!("spread-{name}"), spreading_figure(name, sea, isotropic_sea))).collect();
    page.figures(
        &figures,
        "Directional distribution at one, two and four times the peak frequency, averaged over the bands: theory \
         (lines) and measured on the GPU (points with standard errors). Sources: Mitsuyasu et al. 1975; Hasselmann, \
         Dunckel and Ewing 1980; Donelan et al. 1985 with Banner 1990; Elfouhaily et al. 1997; docs/sea.md lists the \
         others.",
    )?;
    page.paragraph(
        "The integral of D over the circle must be 1. The spread is sqrt(2 (1 - r1)) with the first directional moment \
         r1 of the band; 81.03° means that the waves run equally in all directions.",
    );
    let rows: Vec<_> = (seas.iter())
        .flat_map(|(name, sea)| {
            BAND_PEAK_RATIOS
                .into_iter()
                .enumerate()
                .map(move |(band, ratio)| spreading_table_row(name, sea, band, ratio))
        })
        .collect();
    page.table(
        "spread | ω / ω_p | ∫D dθ | spread, theory | resolved | measured | deviation | from, theory | measured \
         | deviation",
        &rows,
    );
    Ok(())
}

fn spreading_table_row(name: &str, sea: &MeasuredSea, band: usize, ratio: f64) -> Vec<String> {
    let bins = &sea.wave_bins[band * DIRECTION_BINS..][..DIRECTION_BINS];
    let total = |part: &dyn Fn(&WaveBin) -> [f64; 3]| {
        bins.iter().map(part).fold([0.0; 3], |a, b| std::array::from_fn(|i| a[i] + b[i]))
    };
    let [integral, r1_theory] = spreading_integral_and_r1(&sea.plan, ratio);
    let [m, x, z] = total(&|b| b.expected_moments);
    let r1 = x.hypot(z) / m;
    let has_direction = r1 > statistics::MIN_R1_FOR_DIRECTION;
    let resolved_deg = statistics::spread_deg(r1);
    let (mut spread, mut from) = (None, None);
    if sea.measured.is_some() {
        let seeds: Vec<[f64; 3]> = (0..bins[0].measured_moments_by_seed.len())
            .map(|seed| total(&|b| b.measured_moments_by_seed[seed]))
            .collect();
        let variance: Vec<f64> = seeds.iter().map(|s| s[0]).collect();
        let [x, z] = sea.plan.downwind;
        // Components of the directional moments along the wind and across it.
        let along: Vec<f64> = seeds.iter().map(|s| x * s[1] + z * s[2]).collect();
        let across: Vec<f64> = seeds.iter().map(|s| x * s[2] - z * s[1]).collect();
        spread = Some(spread_deg(EstimateWithError::ratio(&along, &variance)));
        let turn_deg = EstimateWithError::ratio(&across, &along).scaled(180.0 / PI);
        from = Some(turn_deg.with_propagated_error(240.0 + turn_deg.value, 1.0));
    }
    let directed = |text: String| if has_direction { text } else { "none".to_owned() };
    vec![
        name.to_owned(),
        format_number(ratio, 0),
        format_number(integral, 6),
        format_number(statistics::spread_deg(r1_theory), 2),
        format_number(resolved_deg, 2),
        format_estimate(spread, 2),
        relative_deviation(spread, resolved_deg),
        directed(format_number(240.0, 0)),
        directed(format_estimate(from, 2)),
        directed(angle_deviation(from, 240.0)),
    ]
}
