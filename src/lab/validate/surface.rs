//! Part 6: the distribution of the surface's elevation.

use super::figure::{Axis, Figure, Legend, Mark, Series, curve};
use super::lab::{Lab, expected_waves, params};
use super::page::{PENDING, Page, number};
use crate::lab::stats::{Estimate, estimate, points};
use crate::waves::Plan;
use std::f64::consts::TAU;

const STATE: &str = "wind=15&fetch=300&n=128";
/// Range of the histogram in standard deviations, and its bins.
const REACH: f64 = 5.0;
const BINS: usize = 50;

/// Exact distribution of a Gaussian sea displaced sideways: phi(u) E[J | u], u the elevation over its deviation.
///
/// Elevation and strain are jointly Gaussian, so that E[J | u] = 1 - s1 u + s2 (u^2 - 1), with s1 = lambda (a + b) / sigma
/// and s2 = lambda^2 (a b - c^2) / m0, where a, b, c are the sums of kx^2/k, kz^2/k and kx kz/k (times the orbit) over the
/// variance. (The covariances of the strains among themselves cancel in the determinant.)
struct Displaced {
    sigma: f64,
    s1: f64,
    s2: f64,
}

impl Displaced {
    fn new(plan: &Plan, chop: f64) -> Self {
        let (mut m0, mut a, mut b, mut c) = (0.0, 0.0, 0.0, 0.0);
        expected_waves(plan, &mut |wave| {
            let strain = wave.variance * wave.k * plan.dispersion.orbit(wave.k);
            m0 += wave.variance;
            a += strain * wave.unit[0] * wave.unit[0];
            b += strain * wave.unit[1] * wave.unit[1];
            c += strain * wave.unit[0] * wave.unit[1];
        });
        Self { sigma: m0.sqrt(), s1: chop * (a + b) / m0.sqrt(), s2: chop * chop * (a * b - c * c) / m0 }
    }

    fn density(&self, u: f64) -> f64 {
        (-0.5 * u * u).exp() / TAU.sqrt() * (1.0 - self.s1 * u + self.s2 * (u * u - 1.0))
    }

    /// Mean, deviation, skewness and kurtosis, lengths in sigma.
    fn shape(&self) -> [f64; 4] {
        shape([1.0, -self.s1, 1.0 + 2.0 * self.s2, -3.0 * self.s1, 3.0 + 12.0 * self.s2])
    }
}

/// Mean, deviation, skewness and kurtosis from sums of powers 0 to 4.
fn shape(sums: [f64; 5]) -> [f64; 4] {
    let [m1, m2, m3, m4] = [1, 2, 3, 4].map(|p| sums[p] / sums[0]);
    let variance = m2 - m1 * m1;
    let third = m3 - 3.0 * m1 * m2 + 2.0 * m1.powi(3);
    let fourth = m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * m1.powi(4);
    [m1, variance.sqrt(), third / variance.powf(1.5), fourth / (variance * variance)]
}

/// Weights of the bins and sums of powers of one seed.
type Sample = ([f64; BINS], [f64; 5]);

fn samples(lab: &Lab<'_>, state: &str, sigma: f64) -> Result<Option<Vec<Sample>>, String> {
    let mut all = Vec::new();
    for seed in 1..=2 * lab.seeds {
        let plan = Plan::new(&params(&format!("{state}&seed={seed}"))?);
        let Some(maps) = lab.maps(&plan, &[0.0])? else { return Ok(None) };
        let (mut bins, mut sums) = ([0.0; BINS], [0.0; 5]);
        points(&plan, &maps[0], &mut |eta, weight| {
            let u = eta / sigma;
            sums.iter_mut().zip(0..).for_each(|(sum, power)| *sum += weight * u.powi(power));
            let place = (u / REACH + 1.0) * 0.5 * BINS as f64;
            if place >= 0.0 && place < BINS as f64 {
                bins[place as usize] += weight;
            }
        });
        all.push((bins, sums));
    }
    Ok(Some(all))
}

/// The shape of all seeds together, with errors by leaving one out at a time.
fn pooled(all: &[Sample]) -> [Estimate; 4] {
    let without = |left_out: Option<usize>| {
        let kept = all.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
        shape(kept.fold([0.0; 5], |sum, (_, s)| std::array::from_fn(|p| sum[p] + s.1[p])))
    };
    let knives: Vec<[f64; 4]> = (0..all.len()).map(|i| without(Some(i))).collect();
    let whole = without(None);
    std::array::from_fn(|q| {
        let rest = estimate(&knives.iter().map(|k| k[q]).collect::<Vec<_>>());
        Estimate { value: whole[q], error: rest.error.map(|e| e * (all.len() as f64 - 1.0)) }
    })
}

/// Writes the part.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    page.heading(2, "6. The surface");
    page.prose(
        "Elevations at random points, wind 15 m/s over 300 km. Without chop the surface is Gaussian. With it, points move \
         sideways towards the crests, and the sea as one meets it weights each point by the Jacobian J: its density is the \
         Gaussian times the mean of J at that elevation, φ(u) (1 - s₁ u + s₂ (u² - 1)), exactly, for the linear Lagrangian \
         sea (the choppy wave model of Nouguier et al. 2009). No parameter is fitted.",
    );
    let x = Axis::linear("elevation over its standard deviation σ without chop", -REACH, REACH);
    let gauss = Displaced { sigma: 1.0, s1: 0.0, s2: 0.0 };
    let (mut rows, mut figures) = (Vec::new(), Vec::new());
    for chop in [0.0, 1.0] {
        let state = format!("{STATE}&chop={chop}");
        let theory = Displaced::new(&Plan::new(&params(&state)?), chop);
        let mut figure =
            Figure::new(&format!("Chop {chop}"), x.clone(), Axis::log("probability density", 1e-5, 1.0), Legend::Right);
        let seen = samples(lab, &state, theory.sigma)?;
        if let Some(all) = &seen {
            figure = figure.with(Series::new("measured on the GPU", 5, Mark::Bars(histogram(all))));
        }
        figure = figure
            .with(Series::new("Gaussian", 6, Mark::Dashes(curve(&x, 200, |u| gauss.density(u)))))
            .with(Series::new("theory", 1, Mark::Line(curve(&x, 200, |u| theory.density(u)))));
        figures.push((format!("surface-chop{chop}"), figure));
        let seen = seen.as_deref().map(pooled);
        let names = ["mean, σ", "deviation, σ", "skewness", "kurtosis"];
        for (q, (name, expected)) in names.into_iter().zip(theory.shape()).enumerate() {
            let e = seen.as_ref().map(|s| s[q]);
            rows.push(vec![
                number(chop, 0),
                name.to_owned(),
                number(expected, 4),
                super::page::measured(e.as_ref(), 4),
                e.map_or(PENDING.to_owned(), |e| apart(&e, expected)),
            ]);
        }
    }
    page.gallery(
        &figures,
        "Density of the elevation, all seeds together: bars measured on the GPU, line theory, dashed the Gaussian.",
    )?;
    page.table(&["chop", "quantity", "theory", "measured", "deviation"], &rows);
    page.prose(
        "The displaced crests are sharp and the troughs flat, yet the skewness of the elevation is near 0, where real seas have \
         0.1 to 0.2 (Longuet-Higgins 1963): the sideways motion alone lowers the level under a group of high waves by as much \
         as it raises the crests, and the second-order waves that would undo that are not in a linear model.",
    );
    Ok(())
}

fn apart(e: &Estimate, expected: f64) -> String {
    let by = e.value - expected;
    e.error.filter(|&se| se > 0.0).map_or(format!("{by:+.4}"), |se| format!("{by:+.4} ({:+.1} σ)", by / se))
}

fn histogram(all: &[Sample]) -> Vec<[f64; 3]> {
    let width = 2.0 * REACH / BINS as f64;
    let total: f64 = all.iter().map(|s| s.1[0]).sum();
    let bar = |i: usize| {
        let low = -REACH + i as f64 * width;
        [low, low + width, all.iter().map(|s| s.0[i]).sum::<f64>() / (total * width)]
    };
    (0..BINS).map(bar).filter(|bar| bar[2] > 1e-5).collect()
}
