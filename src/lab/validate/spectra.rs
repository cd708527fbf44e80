//! Part 1 of the validation page: the twelve frequency spectra.

use super::cells::{angle_deviation, format_estimate, format_number, relative_deviation};
use super::choice_parameter_values;
use super::measurement::{MeasuredSea, MeasurementSetup, WaveBin};
use crate::lab::ensemble::TravellingWave;
use crate::lab::estimate::EstimateWithError;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::waves::quadrature::integrate_panels;
use std::f64::consts::TAU;

/// State string that all seas in part 1 of the page share; `spectrum=` is added to it.
const SEA_STATE_STRING: &str = "wind=10&fetch=100&dir=240&n=256";
/// Range of angular frequency in the figures of the spectra, divided into [`FREQUENCY_BINS`] bins, rad/s.
const OMEGA_RANGE_RAD_S: (f64, f64) = (0.3, 100.0);
/// Number of frequency bins over [`OMEGA_RANGE_RAD_S`], equally wide in the logarithm of the frequency.
const FREQUENCY_BINS: usize = 72;

/// Lower edge of frequency bin `i`, rad/s.
fn frequency_bin_lower_edge_rad_s(i: usize) -> f64 {
    OMEGA_RANGE_RAD_S.0 * (OMEGA_RANGE_RAD_S.1 / OMEGA_RANGE_RAD_S.0).powf(i as f64 / FREQUENCY_BINS as f64)
}

/// Index of the frequency bin that contains a wave; `None` if its frequency is outside [`OMEGA_RANGE_RAD_S`].
fn frequency_bin(wave: &TravellingWave) -> Option<usize> {
    let place = (wave.omega / OMEGA_RANGE_RAD_S.0).ln() / (OMEGA_RANGE_RAD_S.1 / OMEGA_RANGE_RAD_S.0).ln()
        * FREQUENCY_BINS as f64;
    (place >= 0.0 && place < FREQUENCY_BINS as f64).then_some(place as usize)
}

/// A statistic with a table on the validation page: title, digits after the decimal point, and a function that returns
/// its theoretical, resolved (on the FFT grids) and measured value.
type TabulatedStatistic = (&'static str, usize, fn(&MeasuredSea) -> (f64, f64, Option<EstimateWithError>));

const TABULATED_STATISTICS: [TabulatedStatistic; 6] = [
    ("Significant wave height Hs, m", 3, |s| (s.theory.hs_m, s.resolved.hs_m, s.measured_statistic(|m| m.hs_m))),
    ("Peak period by Young 1995, 2π ∫S⁴dω / ∫ωS⁴dω over the figures' bins, s", 3, |s| {
        (
            young_peak_period_s(&theoretical_densities(s)),
            young_peak_period_s(&resolved_densities(s)),
            s.measured_statistic(|_| measured_peak_period(s)),
        )
    }),
    ("Mean period Tm01, s", 3, |s| (s.theory.tm01_s, s.resolved.tm01_s, s.measured_statistic(|m| m.tm01_s))),
    ("Zero-crossing period Tm02, s", 3, |s| (s.theory.tm02_s, s.resolved.tm02_s, s.measured_statistic(|m| m.tm02_s))),
    ("Mean square slope up to k_max", 5, |s| (s.theory.mss, s.resolved.mss, s.measured_statistic(|m| m.mss))),
    ("Directional spread, degrees", 2, |s| {
        (s.theory.spread_deg, s.resolved.spread_deg, s.measured_statistic(|m| m.spread_deg))
    }),
];

/// Theoretical spectral density S(omega), m^2 s, of all waves of the sea, averaged over each frequency bin.
fn theoretical_densities(sea: &MeasuredSea) -> Vec<f64> {
    let mean = |i| {
        integrate_panels(
            |w| sea.plan.density(w),
            &[frequency_bin_lower_edge_rad_s(i), frequency_bin_lower_edge_rad_s(i + 1)],
            2,
        ) / (frequency_bin_lower_edge_rad_s(i + 1) - frequency_bin_lower_edge_rad_s(i))
    };
    (0..FREQUENCY_BINS).map(mean).collect()
}

/// Expected spectral density S(omega), m^2 s, of only the waves on the FFT grids, averaged over each frequency bin.
fn resolved_densities(sea: &MeasuredSea) -> Vec<f64> {
    sea.wave_bins
        .iter()
        .enumerate()
        .map(|(i, b)| {
            b.expected_moments[0] / (frequency_bin_lower_edge_rad_s(i + 1) - frequency_bin_lower_edge_rad_s(i))
        })
        .collect()
}

/// Peak period, s, as defined by Young 1995: 2 pi over the mean angular frequency with the weight S^4. `density` holds
/// S in each frequency bin.
fn young_peak_period_s(density: &[f64]) -> f64 {
    let sum = |power: i32| {
        let term = |(i, s): (usize, &f64)| {
            s.powi(4)
                * (frequency_bin_lower_edge_rad_s(i) * frequency_bin_lower_edge_rad_s(i + 1)).sqrt().powi(power)
                * (frequency_bin_lower_edge_rad_s(i + 1) - frequency_bin_lower_edge_rad_s(i))
        };
        density.iter().enumerate().map(term).sum::<f64>()
    };
    TAU * sum(0) / sum(1)
}

/// Peak period, s, of the mean over all seeds of the measured spectra, with its jackknife error.
fn measured_peak_period(sea: &MeasuredSea) -> EstimateWithError {
    EstimateWithError::jackknife(sea.wave_bins[0].measured_moments_by_seed.len(), |left_out| {
        let sum = |bin: &WaveBin| -> f64 {
            bin.measured_moments_by_seed
                .iter()
                .enumerate()
                .filter(|(i, _)| Some(*i) != left_out)
                .map(|(_, v)| v[0])
                .sum()
        };
        let density = |(i, bin): (usize, &WaveBin)| {
            sum(bin) / (frequency_bin_lower_edge_rad_s(i + 1) - frequency_bin_lower_edge_rad_s(i))
        };
        young_peak_period_s(&sea.wave_bins.iter().enumerate().map(density).collect::<Vec<_>>())
    })
}

/// Points of a spectrum's figure: centre of a frequency bin (rad/s), measured spectral density S (m^2 s) and its
/// standard error over the seeds, for those bins that the cascades cover completely.
fn measured_density_points(sea: &MeasuredSea) -> Vec<[f64; 3]> {
    let held = sea.plan.resolved_bands();
    let waves = sea.plan.dispersion;
    let is_held = |i: usize| {
        let (a, b) = (
            waves.wave_number(frequency_bin_lower_edge_rad_s(i)),
            waves.wave_number(frequency_bin_lower_edge_rad_s(i + 1)),
        );
        held.iter().any(|&(low, high)| a >= low && b <= high)
    };
    let point = |(i, bin): (usize, &WaveBin)| {
        let variances: Vec<f64> = bin.measured_moments_by_seed.iter().map(|v| v[0]).collect();
        EstimateWithError::mean(&variances)
            .scaled(1.0 / (frequency_bin_lower_edge_rad_s(i + 1) - frequency_bin_lower_edge_rad_s(i)))
            .x_value_error((frequency_bin_lower_edge_rad_s(i) * frequency_bin_lower_edge_rad_s(i + 1)).sqrt())
    };
    sea.wave_bins.iter().enumerate().filter(|(i, b)| is_held(*i) && b.expected_moments[0] > 0.0).map(point).collect()
}

fn spectrum_figure(name: &str, sea: &MeasuredSea) -> Figure {
    let x = Axis::log("angular frequency ω, rad/s", OMEGA_RANGE_RAD_S.0, OMEGA_RANGE_RAD_S.1);
    let theory = sample_curve(&x, 400, |w| sea.plan.density(w));
    let figure = Figure::new(name, x, Axis::log("S(ω), m² s", 1e-9, 20.0), LegendCorner::UpperRight)
        .with_series(FigureSeries::new("theory", 0, SeriesData::Line(theory)));
    if sea.measured.is_none() {
        return figure;
    }
    figure.with_series(FigureSeries::new("measured on the GPU", 1, SeriesData::Points(measured_density_points(sea))))
}

/// Adds part 1 to the validation page: the frequency spectra.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    let mut seas = Vec::new();
    for name in choice_parameter_values("spectrum") {
        seas.push((
            name,
            lab.measure_binned_sea(&format!("spectrum={name}&{SEA_STATE_STRING}"), FREQUENCY_BINS, &frequency_bin)?,
        ));
    }
    page.heading(2, "1. Frequency spectra");
    page.paragraph(
        "Wind 10 m/s over 100 km, from 240°, deep water, the default spreading (`donelan-banner`). The measured \
         density is the variance of all waves whose frequency lies in a bin, divided by the bin's width. Bins that the \
         cascades hold only in part are left out. The periods and the mean square slope include the waves that the \
         cascades hold.",
    );
    let figures: Vec<_> =
        seas.iter().map(|(name, sea)| (format!("spectrum-{name}"), spectrum_figure(name, sea))).collect();
    page.figures(
        &figures,
        "Spectral density of the elevation against angular frequency: theory, and band averages measured on the GPU. \
         Sources: Phillips 1958; Tessendorf 2001; Pierson and Moskowitz 1964; Hasselmann et al. 1973; Bouws et al. \
         1985; Trusca 2007; Karaev and Balandina 2000; Elfouhaily et al. 1997; Donelan et al. 1985; Ochi and Hubble \
         1976; Torsethaugen and Haver 2004.",
    )?;
    for (title, digits, quantity) in TABULATED_STATISTICS {
        page.heading(3, title);
        let row = |(name, sea): &(&str, MeasuredSea)| {
            let (theory, resolved, estimate) = quantity(sea);
            vec![
                (*name).to_owned(),
                format_number(theory, digits),
                format_number(resolved, digits),
                format_estimate(estimate, digits),
                relative_deviation(estimate, resolved),
            ]
        };
        let rows: Vec<_> = seas.iter().map(row).collect();
        page.table("spectrum | theory | resolved | measured | deviation", &rows);
    }
    page.heading(3, "Direction, peak and share");
    page.paragraph(
        "The table lists the mean direction that the waves come from, degrees; the period of the highest density; the \
         end of the cascades; and the share of m0 that the cascades hold. `tessendorf` has its own cos² spreading, \
         with equal energy in opposite directions, and so no mean direction.",
    );
    let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| format_number(d, 2));
    let row = |(name, sea): &(&str, MeasuredSea)| {
        let (t, r) = (&sea.theory, &sea.resolved);
        let none = |text: String| if r.mean_from_deg.is_none() { "none".to_owned() } else { text };
        vec![
            (*name).to_owned(),
            degrees(t.mean_from_deg),
            degrees(r.mean_from_deg),
            none(format_estimate(sea.direction_deg(), 2)),
            none(angle_deviation(sea.direction_deg(), r.mean_from_deg.unwrap_or_default())),
            format_number(t.tp_s, 3),
            format_number(t.k_max, 1),
            format!("{} %", format_number(100.0 * r.m0_fraction, 2)),
        ]
    };
    let rows: Vec<_> = seas.iter().map(row).collect();
    page.table("spectrum | theory | resolved | measured | deviation | Tp, s | k_max, rad/m | share of m0", &rows);
    Ok(())
}
