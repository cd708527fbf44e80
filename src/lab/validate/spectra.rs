//! Part 1 of the validation page: the twelve frequency spectra.

use super::cells::{angle_deviation, deviation, measured, number};
use super::measurement::{MeasuredSea, Measurement, WaveBin};
use super::words;
use crate::lab::ensemble::TravellingWave;
use crate::lab::estimate::Estimate;
use crate::lab::figure::{Axis, Figure, Legend, Mark, Series, curve};
use crate::lab::page::Page;
use crate::waves::quadrature::integrate_panels;
use std::f64::consts::TAU;

/// State string of all seas in this part, to which `spectrum=` is added.
const STATE: &str = "wind=10&fetch=100&dir=240&n=256";
/// Range of angular frequency in the figures and of the frequency bins, rad/s.
const RANGE: (f64, f64) = (0.3, 100.0);
/// Number of frequency bins, equally wide in the logarithm of the frequency.
const BINS: usize = 72;

/// Lower edge of frequency bin `i`, rad/s.
fn edge(i: usize) -> f64 {
    RANGE.0 * (RANGE.1 / RANGE.0).powf(i as f64 / BINS as f64)
}

/// Index of the frequency bin that contains a wave; `None` if the wave is out of range.
fn bin(wave: &TravellingWave) -> Option<usize> {
    let place = (wave.omega / RANGE.0).ln() / (RANGE.1 / RANGE.0).ln() * BINS as f64;
    (place >= 0.0 && place < BINS as f64).then_some(place as usize)
}

/// A statistic with a table on the page: title, digits after the point, theoretical, resolved and measured value.
type Quantity = (&'static str, usize, fn(&MeasuredSea) -> (f64, f64, Option<Estimate>));

const QUANTITIES: [Quantity; 6] = [
    ("Significant wave height Hs, m", 3, |s| (s.theory.hs_m, s.resolved.hs_m, s.get(|m| m.hs_m))),
    ("Peak period by Young 1995, 2π ∫S⁴dω / ∫ωS⁴dω over the figures' bins, s", 3, |s| {
        (peak_period(&densities(s)), peak_period(&expected(s)), s.get(|_| measured_peak_period(s)))
    }),
    ("Mean period Tm01, s", 3, |s| (s.theory.tm01_s, s.resolved.tm01_s, s.get(|m| m.tm01_s))),
    ("Zero-crossing period Tm02, s", 3, |s| (s.theory.tm02_s, s.resolved.tm02_s, s.get(|m| m.tm02_s))),
    ("Mean square slope up to k_max", 5, |s| (s.theory.mss, s.resolved.mss, s.get(|m| m.mss))),
    ("Directional spread, degrees", 2, |s| (s.theory.spread_deg, s.resolved.spread_deg, s.get(|m| m.spread_deg))),
];

/// Theoretical spectral density S(omega), averaged over each frequency bin, m^2 s.
fn densities(sea: &MeasuredSea) -> Vec<f64> {
    let mean = |i| integrate_panels(|w| sea.plan.density(w), &[edge(i), edge(i + 1)], 2) / (edge(i + 1) - edge(i));
    (0..BINS).map(mean).collect()
}

/// Expected spectral density of the resolved waves, averaged over each frequency bin, m^2 s.
fn expected(sea: &MeasuredSea) -> Vec<f64> {
    sea.bins.iter().enumerate().map(|(i, b)| b.expected[0] / (edge(i + 1) - edge(i))).collect()
}

/// Peak period of a spectrum given by its frequency bins, by the formula of Young 1995, s.
fn peak_period(density: &[f64]) -> f64 {
    let sum = |power: i32| {
        let term =
            |(i, s): (usize, &f64)| s.powi(4) * (edge(i) * edge(i + 1)).sqrt().powi(power) * (edge(i + 1) - edge(i));
        density.iter().enumerate().map(term).sum::<f64>()
    };
    TAU * sum(0) / sum(1)
}

/// Peak period of the measured spectrum, averaged over the seeds, s.
fn measured_peak_period(sea: &MeasuredSea) -> Estimate {
    Estimate::jackknife(sea.bins[0].measured.len(), |left_out| {
        let sum = |bin: &WaveBin| -> f64 {
            bin.measured.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, v)| v[0]).sum()
        };
        let density = |(i, bin): (usize, &WaveBin)| sum(bin) / (edge(i + 1) - edge(i));
        peak_period(&sea.bins.iter().enumerate().map(density).collect::<Vec<_>>())
    })
}

/// Measured spectral density, as points of the figure, in those frequency bins that the cascades cover completely.
fn points(sea: &MeasuredSea) -> Vec<[f64; 3]> {
    let held = sea.plan.resolved_bands();
    let waves = sea.plan.dispersion;
    let is_held = |i: usize| {
        let (a, b) = (waves.wave_number(edge(i)), waves.wave_number(edge(i + 1)));
        held.iter().any(|&(low, high)| a >= low && b <= high)
    };
    let point = |(i, bin): (usize, &WaveBin)| {
        let variances: Vec<f64> = bin.measured.iter().map(|v| v[0]).collect();
        Estimate::mean(&variances).scaled(1.0 / (edge(i + 1) - edge(i))).at((edge(i) * edge(i + 1)).sqrt())
    };
    sea.bins.iter().enumerate().filter(|(i, b)| is_held(*i) && b.expected[0] > 0.0).map(point).collect()
}

fn figure(name: &str, sea: &MeasuredSea) -> Figure {
    let x = Axis::log("angular frequency ω, rad/s", RANGE.0, RANGE.1);
    let theory = curve(&x, 400, |w| sea.plan.density(w));
    let figure = Figure::new(name, x, Axis::log("S(ω), m² s", 1e-9, 20.0), Legend::Right).with(Series::new(
        "theory",
        0,
        Mark::Line(theory),
    ));
    if sea.measured.is_none() {
        return figure;
    }
    figure.with(Series::new("measured on the GPU", 1, Mark::Points(points(sea))))
}

/// Writes part 1 of the validation page.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Measurement<'_>) -> Result<(), String> {
    let mut seas = Vec::new();
    for name in words("spectrum") {
        seas.push((name, lab.binned_sea(&format!("spectrum={name}&{STATE}"), BINS, &bin)?));
    }
    page.heading(2, "1. Frequency spectra");
    page.prose(
        "Wind 10 m/s over 100 km, from 240°, deep water, the default spreading (`donelan-banner`). The measured \
         density is the variance of all waves whose frequency lies in a bin, divided by the bin's width. Bins that the \
         cascades hold only in part are left out. The periods and the mean square slope include the waves that the \
         cascades hold.",
    );
    let figures: Vec<_> = seas.iter().map(|(name, sea)| (format!("spectrum-{name}"), figure(name, sea))).collect();
    page.figures(
        &figures,
        "Spectral density of the elevation against angular frequency: theory, and band averages measured on the GPU. \
         Sources: Phillips 1958; Tessendorf 2001; Pierson and Moskowitz 1964; Hasselmann et al. 1973; Bouws et al. \
         1985; Trusca 2007; Karaev and Balandina 2000; Elfouhaily et al. 1997; Donelan et al. 1985; Ochi and Hubble \
         1976; Torsethaugen and Haver 2004.",
    )?;
    for (title, digits, quantity) in QUANTITIES {
        page.heading(3, title);
        let row = |(name, sea): &(&str, MeasuredSea)| {
            let (theory, resolved, estimate) = quantity(sea);
            vec![
                (*name).to_owned(),
                number(theory, digits),
                number(resolved, digits),
                measured(estimate, digits),
                deviation(estimate, resolved),
            ]
        };
        let rows: Vec<_> = seas.iter().map(row).collect();
        page.table("spectrum | theory | resolved | measured | deviation", &rows);
    }
    page.heading(3, "Direction, peak and share");
    page.prose(
        "The table lists the mean direction that the waves come from, degrees; the period of the highest density; the \
         end of the cascades; and the share of m0 that the cascades hold. `tessendorf` has its own cos² spreading, \
         with equal energy in opposite directions, and so no mean direction.",
    );
    let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| number(d, 2));
    let row = |(name, sea): &(&str, MeasuredSea)| {
        let (t, r) = (&sea.theory, &sea.resolved);
        let none = |text: String| if r.mean_from_deg.is_none() { "none".to_owned() } else { text };
        vec![
            (*name).to_owned(),
            degrees(t.mean_from_deg),
            degrees(r.mean_from_deg),
            none(measured(sea.direction_deg(), 2)),
            none(angle_deviation(sea.direction_deg(), r.mean_from_deg.unwrap_or_default())),
            number(t.tp_s, 3),
            number(t.k_max, 1),
            format!("{} %", number(100.0 * r.m0_fraction, 2)),
        ]
    };
    let rows: Vec<_> = seas.iter().map(row).collect();
    page.table("spectrum | theory | resolved | measured | deviation | Tp, s | k_max, rad/m | share of m0", &rows);
    Ok(())
}
