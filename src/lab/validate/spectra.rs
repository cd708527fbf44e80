//! Part 1: the twelve frequency spectra.

use super::figure::{Axis, Figure, Legend, Mark, Series, curve};
use super::lab::{Lab, Sea};
use super::page::{Page, deviation, measured, number, turned};
use super::words;
use crate::lab::stats::{Estimate, Travelling, estimate};
use crate::waves::quadrature::panels;
use std::f64::consts::TAU;

/// The sea of this part.
const STATE: &str = "wind=10&fetch=100&dir=240&n=256";
/// Range of the figures and of the bins, rad/s.
const RANGE: (f64, f64) = (0.3, 100.0);
/// Bins over the logarithm of omega.
const BINS: usize = 72;

fn edge(i: usize) -> f64 {
    RANGE.0 * (RANGE.1 / RANGE.0).powf(i as f64 / BINS as f64)
}

fn bin(wave: &Travelling) -> Option<usize> {
    let place = (wave.omega / RANGE.0).ln() / (RANGE.1 / RANGE.0).ln() * BINS as f64;
    (place >= 0.0 && place < BINS as f64).then_some(place as usize)
}

/// One quantity of the tables.
struct Quantity {
    title: &'static str,
    digits: usize,
    theory: fn(&Sea) -> f64,
    resolved: fn(&Sea) -> f64,
    measured: fn(&Sea) -> Option<Estimate>,
}

const QUANTITIES: [Quantity; 6] = [
    Quantity {
        title: "Significant wave height Hs, m",
        digits: 3,
        theory: |s| s.theory.hs_m,
        resolved: |s| s.resolved.hs_m,
        measured: |s| s.get(|m| m.hs_m),
    },
    Quantity {
        title: "Peak period by Young 1995, 2π ∫S⁴dω / ∫ωS⁴dω over the figures' bins, s",
        digits: 3,
        theory: |s| young(&densities(s)),
        resolved: |s| young(&expected(s)),
        measured: |s| s.measured.as_ref().map(|_| young_measured(s)),
    },
    Quantity {
        title: "Mean period Tm01, s",
        digits: 3,
        theory: |s| s.theory.tm01_s,
        resolved: |s| s.resolved.tm01_s,
        measured: |s| s.get(|m| m.tm01_s),
    },
    Quantity {
        title: "Zero-crossing period Tm02, s",
        digits: 3,
        theory: |s| s.theory.tm02_s,
        resolved: |s| s.resolved.tm02_s,
        measured: |s| s.get(|m| m.tm02_s),
    },
    Quantity {
        title: "Mean square slope up to k_max",
        digits: 5,
        theory: |s| s.theory.mss,
        resolved: |s| s.resolved.mss,
        measured: |s| s.get(|m| m.mss),
    },
    Quantity {
        title: "Directional spread, degrees",
        digits: 2,
        theory: |s| s.theory.spread_deg,
        resolved: |s| s.resolved.spread_deg,
        measured: |s| s.get(|m| m.spread_deg),
    },
];

/// Mean of S over each bin, m^2 s.
fn densities(sea: &Sea) -> Vec<f64> {
    let mean = |i| panels(|w| sea.plan.density(w), &[edge(i), edge(i + 1)], 2) / (edge(i + 1) - edge(i));
    (0..BINS).map(mean).collect()
}

fn expected(sea: &Sea) -> Vec<f64> {
    sea.bins.iter().enumerate().map(|(i, b)| b.expected[0] / (edge(i + 1) - edge(i))).collect()
}

/// Peak period of binned densities.
fn young(density: &[f64]) -> f64 {
    let sum = |power: i32| {
        let term =
            |(i, s): (usize, &f64)| s.powi(4) * (edge(i) * edge(i + 1)).sqrt().powi(power) * (edge(i + 1) - edge(i));
        density.iter().enumerate().map(term).sum::<f64>()
    };
    TAU * sum(0) / sum(1)
}

/// The same from the means over the seeds; the error by leaving one seed out at a time.
fn young_measured(sea: &Sea) -> Estimate {
    let seeds = sea.bins[0].seen.len();
    let without = |left_out: Option<usize>| {
        let kept = |bin: &[[f64; 3]]| -> f64 {
            bin.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, v)| v[0]).sum()
        };
        let mean = |(i, b): (usize, &super::lab::Bin)| kept(&b.seen) / (edge(i + 1) - edge(i));
        young(&sea.bins.iter().enumerate().map(mean).collect::<Vec<_>>())
    };
    let knives: Vec<f64> = (0..seeds).map(|i| without(Some(i))).collect();
    let rest = estimate(&knives);
    Estimate { value: without(None), error: rest.error.map(|e| e * (seeds as f64 - 1.0)) }
}

/// Measured densities of the bins that the cascades hold wholly.
fn points(sea: &Sea) -> Vec<[f64; 3]> {
    let held = sea.plan.resolved_bands();
    let waves = sea.plan.dispersion;
    let whole = |i: usize| {
        let (a, b) = (waves.wave_number(edge(i)), waves.wave_number(edge(i + 1)));
        held.iter().any(|&(low, high)| a >= low && b <= high)
    };
    let point = |(i, bin): (usize, &super::lab::Bin)| {
        let e = estimate(&bin.seen.iter().map(|v| v[0]).collect::<Vec<_>>()).scaled(1.0 / (edge(i + 1) - edge(i)));
        [(edge(i) * edge(i + 1)).sqrt(), e.value, e.error.unwrap_or(0.0)]
    };
    sea.bins.iter().enumerate().filter(|(i, b)| whole(*i) && b.expected[0] > 0.0).map(point).collect()
}

fn figure(name: &str, sea: &Sea) -> Figure {
    let x = Axis::log("angular frequency ω, rad/s", RANGE.0, RANGE.1);
    let theory = curve(&x, 400, |w| sea.plan.density(w));
    let mut figure = Figure::new(name, x, Axis::log("S(ω), m² s", 1e-9, 20.0), Legend::Right).with(Series::new(
        "theory",
        0,
        Mark::Line(theory),
    ));
    if sea.measured.is_some() {
        figure = figure.with(Series::new("measured on the GPU", 1, Mark::Points(points(sea))));
    }
    figure
}

/// Writes the part.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    let names = words("spectrum");
    let mut seas = Vec::new();
    for name in &names {
        seas.push(lab.sea(&format!("spectrum={name}&{STATE}"), BINS, &bin)?);
    }
    page.heading(2, "1. Frequency spectra");
    page.prose(
        "Wind 10 m/s over 100 km, from 240°, deep water, the default spreading (`donelan-banner`). The measured density is \
         the variance of all waves whose frequency lies in a bin, over the bin's width; a bin that the cascades do not hold \
         wholly is left out. The periods and the mean square slope are those of the waves that the cascades hold.",
    );
    let figures: Vec<_> =
        names.iter().zip(&seas).map(|(name, sea)| (format!("spectrum-{name}"), figure(name, sea))).collect();
    page.gallery(
        &figures,
        "Spectral density of the elevation against angular frequency: theory, and band averages measured on the GPU. \
         Sources: Phillips 1958; Tessendorf 2001; Pierson and Moskowitz 1964; Hasselmann et al. 1973; Bouws et al. 1985; \
         Trusca 2007; Karaev and Balandina 2000; Elfouhaily et al. 1997; Donelan et al. 1985; Ochi and Hubble 1976; \
         Torsethaugen and Haver 2004.",
    )?;
    for q in &QUANTITIES {
        page.heading(3, q.title);
        let row = |(name, sea): (&&str, &Sea)| {
            let (theory, resolved, seen) = ((q.theory)(sea), (q.resolved)(sea), (q.measured)(sea));
            vec![
                (*name).to_owned(),
                number(theory, q.digits),
                number(resolved, q.digits),
                measured(seen.as_ref(), q.digits),
                deviation(seen.as_ref(), resolved),
            ]
        };
        let rows: Vec<_> = names.iter().zip(&seas).map(row).collect();
        page.table(&["spectrum", "theory", "resolved", "measured", "deviation"], &rows);
    }
    page.heading(3, "Direction, peak and share");
    page.prose(
        "The direction that the waves come from, degrees; the peak of S itself; the end of the cascades; and the share of m0 \
         that they hold. `tessendorf` carries its own cos², as many waves one way as the other: it has no direction.",
    );
    let degrees = |d: Option<f64>| d.map_or("none".to_owned(), |d| number(d, 2));
    let row = |(name, sea): (&&str, &Sea)| {
        let (t, r) = (&sea.theory, &sea.resolved);
        let from = sea.measured.as_ref().and_then(|m| m.from_deg);
        let none = |text: String| if r.mean_from_deg.is_none() { "none".to_owned() } else { text };
        vec![
            (*name).to_owned(),
            degrees(t.mean_from_deg),
            degrees(r.mean_from_deg),
            none(measured(from.as_ref(), 2)),
            none(turned(from.as_ref(), r.mean_from_deg.unwrap_or_default())),
            number(t.tp_s, 3),
            number(t.k_max, 1),
            format!("{} %", number(100.0 * r.m0_fraction, 2)),
        ]
    };
    let rows: Vec<_> = names.iter().zip(&seas).map(row).collect();
    let head = ["spectrum", "theory", "resolved", "measured", "deviation", "Tp, s", "k_max, rad/m", "share of m0"];
    page.table(&head, &rows);
    Ok(())
}
