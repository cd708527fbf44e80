//! Virtual buoys on the GPU's maps: Welch's estimate of the spectrum from their time series is the requested spectrum.
//! The maps belong to the undisplaced grid, so chop has no effect.

mod common;

use common::{gpu, params, read};
use seastate::oracle::transform;
use seastate::shaders::Shaders;
use seastate::sim::Simulation;
use seastate::waves::{Plan, noise};
use std::f64::consts::{PI, TAU};

const SEEDS: u32 = 8;
const BUOYS: u32 = 32;
/// Sampling interval, s. Waves above its Nyquist frequency of 7.9 rad/s hold less than 1e-4 of the variance.
const STEP_S: f64 = 0.4;
const SAMPLES: usize = 512;
const SEGMENT: usize = 256;

/// Width of a frequency bin, rad/s.
fn bin() -> f64 {
    TAU / (SEGMENT as f64 * STEP_S)
}

/// One-sided variance density at the frequencies i x bin, m^2 s, with Hann windows that overlap by half.
fn welch(series: &[f64]) -> Vec<f64> {
    let window = |i: usize| 0.5 - 0.5 * (TAU * i as f64 / SEGMENT as f64).cos();
    let power: f64 = (0..SEGMENT).map(|i| window(i).powi(2)).sum();
    let mut out = vec![0.0; SEGMENT / 2];
    let starts: Vec<usize> = (0..=series.len() - SEGMENT).step_by(SEGMENT / 2).collect();
    for start in &starts {
        let line: Vec<[f64; 2]> = (0..SEGMENT).map(|i| [window(i) * series[start + i], 0.0]).collect();
        for (sum, x) in out.iter_mut().zip(transform::inverse_dft(&line)) {
            *sum += (x[0] * x[0] + x[1] * x[1]) * STEP_S / (PI * power * starts.len() as f64);
        }
    }
    out
}

/// The plan of a state, and the estimated spectrum of every seed.
fn estimates(state: &str) -> (Plan, Vec<Vec<f64>>) {
    let gpu = gpu();
    let plan = Plan::new(&params(state));
    let mut sim = Simulation::new(&gpu, plan.clone(), &Shaders::default());
    let n = plan.n;
    let spectra = (1..=SEEDS)
        .map(|seed| {
            sim.set_plan(&gpu, Plan::new(&params(&format!("{state}&seed={seed}"))), &Shaders::default());
            let mut series = vec![Vec::with_capacity(SAMPLES); BUOYS as usize];
            for i in 0..SAMPLES {
                let maps = read(&gpu, &mut sim, STEP_S * i as f64);
                for (buoy, series) in (0..).zip(&mut series) {
                    // The cascades are independent and homogeneous, so a buoy may use any texel of each.
                    let height = |c: usize| {
                        let at = noise::pcg4d([buoy, c as u32, seed, 5]);
                        f64::from(maps.displacement(c)[(at[0] % n * n + at[1] % n) as usize][1])
                    };
                    series.push((0..maps.cascade_count()).map(height).sum::<f64>());
                }
            }
            let each: Vec<Vec<f64>> = series.iter().map(|s| welch(s)).collect();
            (0..SEGMENT / 2).map(|i| each.iter().map(|e| e[i]).sum::<f64>() / f64::from(BUOYS)).collect()
        })
        .collect();
    (plan, spectra)
}

fn mean(spectra: &[Vec<f64>], i: usize) -> f64 {
    spectra.iter().map(|s| s[i]).sum::<f64>() / spectra.len() as f64
}

#[test]
fn the_spectrum_of_a_buoy_is_the_one_that_was_asked_for() {
    // Patches set by hand, so that 64 x 64 points hold all waves without a gap.
    let (plan, spectra) =
        estimates("wind=10&fetch=100&n=64&chop=0&cascades=4&patch1=1364&patch2=322&patch3=76&patch4=18");
    let peak = (1..SEGMENT / 2).max_by(|&a, &b| mean(&spectra, a).total_cmp(&mean(&spectra, b))).expect("bins");
    assert!((peak as f64 * bin() - plan.omega_p).abs() < bin(), "peak at {} rad/s", peak as f64 * bin());
    // Bands of several bins, because the window spreads a wave over three.
    for band in [10..14, 14..17, 17..20, 20..25, 25..32, 32..45, 45..64] {
        let energies: Vec<f64> = spectra.iter().map(|s| band.clone().map(|i| s[i] * bin()).sum()).collect();
        let value = energies.iter().sum::<f64>() / f64::from(SEEDS);
        let spread = energies.iter().map(|e| (e - value).powi(2)).sum::<f64>();
        let error = (spread / f64::from(SEEDS - 1) / f64::from(SEEDS)).sqrt();
        // The window smooths S: its kernel is (-1/2, 1, -1/2) in amplitudes, hence 1/6, 2/3, 1/6 in variance.
        let steps = 400;
        let theory: f64 = band
            .clone()
            .flat_map(|i| (0..steps).map(move |j| (i as f64 - 0.5 + (f64::from(j) + 0.5) / f64::from(steps)) * bin()))
            .map(|w| (4.0 * plan.density(w) + plan.density(w - bin()) + plan.density(w + bin())) / 6.0 * bin())
            .sum::<f64>()
            / f64::from(steps);
        eprintln!("{band:?}: {value:.5} ± {error:.5}, theory {theory:.5}");
        assert!((value - theory).abs() < 4.0 * error + 0.01 * theory, "{band:?}: {value} ± {error}, theory {theory}");
    }
}

#[test]
fn two_systems_give_two_peaks() {
    let (_, spectra) = estimates(
        "wind=9&fetch=40&n=64&chop=0&scale2=1&hs2=1.2&tp2=12&dir2=330\
         &cascades=4&patch1=2500&patch2=590&patch3=139&patch4=33",
    );
    let s = |i: usize| mean(&spectra, i);
    let highest = |bins: std::ops::Range<usize>| bins.max_by(|&a, &b| s(a).total_cmp(&s(b))).expect("bins");
    // The swell peaks at 0.52 rad/s, the wind sea of 9 m/s over 40 km at 1.4 rad/s.
    let (swell, wind) = (highest(5..15), highest(16..40));
    let plan = Plan::new(&params("wind=9&fetch=40"));
    assert!((swell as f64 * bin() - TAU / 12.0).abs() < bin(), "swell at bin {swell}");
    assert!((wind as f64 * bin() - plan.omega_p).abs() < 1.5 * bin(), "wind sea at bin {wind}");
    let between = (swell..wind).map(s).fold(f64::INFINITY, f64::min);
    assert!(
        between < 0.3 * s(swell) && between < 0.3 * s(wind),
        "a gap between {} and {}: {between}",
        s(swell),
        s(wind)
    );
}
