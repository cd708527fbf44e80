//! Part 6 of the validation page: the probability distribution of the surface's elevation.

use super::cells::{absolute_deviation, format_estimate, format_number};
use super::measurement::{MeasurementSetup, parse_params, visit_expected_waves};
use crate::lab::ensemble::visit_surface_points;
use crate::lab::estimate::EstimateWithError;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::waves::Plan;
use crate::waves::second_order::expected_skewness;
use crate::waves::statistics::mean_sd_skewness_kurtosis;
use std::f64::consts::TAU;

const SEA_STATE_STRING: &str = "wind=15&fetch=300&n=128";
/// Number of wave numbers in the double sum over all pairs of waves, from which the skewness follows.
const WAVE_NUMBERS_OF_DOUBLE_SUM: usize = 40;
/// Upper end of the elevation's histogram, which is symmetric about 0, in standard deviations of the elevation.
const HISTOGRAM_HALF_RANGE_SIGMAS: f64 = 5.0;
/// Number of equally wide bins of the elevation's histogram.
const ELEVATION_BINS: usize = 50;

/// Exact probability density phi(u) E[J | u] of the elevation over the horizontal plane, for a Gaussian sea whose
/// points also move sideways. u is the elevation divided by its standard deviation sigma, phi the standard normal
/// density and J the Jacobian: area of a displaced surface element over its area at rest.
///
/// E[J | u] = 1 - s1 u + s2 (u^2 - 1), with s1 = lambda (a + b) / sigma, s2 = lambda^2 (a b - c^2) / sigma^2 and the
/// choppiness lambda. With bound waves of the second order the density is a Gram-Charlier series with the skewness of
/// the exact double sum, the mean level 0 and the standard deviation of the linear sea. a, b and c sum kx^2/k, kz^2/k and kx kz/k over the waves (wave vector (kx, kz) of length k),
/// times each wave's variance and coth(k h) for water of depth h.
struct ElevationDistribution {
    sigma: f64,
    skew_term: f64,
    area_term: f64,
    /// Skewness of second order; 0 for a sea of first order.
    skewness: f64,
}

impl ElevationDistribution {
    fn new(plan: &Plan, chop: f64) -> Self {
        let (mut m0, mut a, mut b, mut c) = (0.0, 0.0, 0.0, 0.0);
        visit_expected_waves(plan, &mut |wave| {
            let strain = wave.variance_m2 * wave.k * plan.dispersion.orbit_width_over_height(wave.k);
            m0 += wave.variance_m2;
            a += strain * wave.travel_direction[0] * wave.travel_direction[0];
            b += strain * wave.travel_direction[1] * wave.travel_direction[1];
            c += strain * wave.travel_direction[0] * wave.travel_direction[1];
        });
        let skewness = if plan.sea.wave_order == 2 { expected_skewness(plan, WAVE_NUMBERS_OF_DOUBLE_SUM) } else { 0.0 };
        Self {
            sigma: m0.sqrt(),
            skew_term: chop * (a + b) / m0.sqrt(),
            area_term: chop * chop * (a * b - c * c) / m0,
            skewness,
        }
    }

    fn density(&self, u: f64) -> f64 {
        let gauss = |u: f64| (-0.5 * u * u).exp() / TAU.sqrt();
        if self.skewness != 0.0 {
            let [_, sd, skewness, _] = self.mean_sd_skewness_kurtosis();
            let v = u / sd;
            return gauss(v) / sd * (1.0 + skewness / 6.0 * (v.powi(3) - 3.0 * v));
        }
        gauss(u) * (1.0 - self.skew_term * u + self.area_term * (u * u - 1.0))
    }

    /// Mean and standard deviation (both divided by sigma), skewness and kurtosis (3 for a Gaussian) of an elevation
    /// with this density.
    fn mean_sd_skewness_kurtosis(&self) -> [f64; 4] {
        let [mean, sd, skewness, kurtosis] = mean_sd_skewness_kurtosis([
            1.0,
            -self.skew_term,
            1.0 + 2.0 * self.area_term,
            -3.0 * self.skew_term,
            3.0 + 12.0 * self.area_term,
        ]);
        if self.skewness == 0.0 { [mean, sd, skewness, kurtosis] } else { [0.0, sd, self.skewness, kurtosis] }
    }
}

/// Histogram of u, the elevation over its theoretical standard deviation, for one seed: the sum of the weights
/// (Jacobians) of the points in each bin, and the weighted sums of u^0 to u^4.
type ElevationHistogram = ([f64; ELEVATION_BINS], [f64; 5]);

fn measure_elevation_histograms(
    lab: &MeasurementSetup<'_>,
    state: &str,
    sigma: f64,
) -> Result<Option<Vec<ElevationHistogram>>, String> {
    let mut all = Vec::new();
    for seed in 1..=2 * lab.seed_count {
        let plan = Plan::new(&parse_params(&format!("{state}&seed={seed}"))?);
        let Some(maps) = lab.read_maps(&plan, &[0.0])? else { return Ok(None) };
        let (mut bins, mut sums) = ([0.0; ELEVATION_BINS], [0.0; 5]);
        visit_surface_points(&plan, &maps[0], &mut |eta, weight| {
            let u = eta / sigma;
            sums.iter_mut().zip(0..).for_each(|(sum, power)| *sum += weight * u.powi(power));
            let place = (u / HISTOGRAM_HALF_RANGE_SIGMAS + 1.0) * 0.5 * ELEVATION_BINS as f64;
            if place >= 0.0 && place < ELEVATION_BINS as f64 {
                bins[place as usize] += weight;
            }
        });
        all.push((bins, sums));
    }
    Ok(Some(all))
}

/// Mean and standard deviation (both divided by the theoretical one), skewness and kurtosis (3 for a Gaussian) of the
/// measured elevation over all seeds, with jackknife errors.
fn pooled_mean_sd_skewness_kurtosis(all: &[ElevationHistogram]) -> [EstimateWithError; 4] {
    std::array::from_fn(|q| {
        EstimateWithError::jackknife(all.len(), |left_out| {
            let kept = all.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
            mean_sd_skewness_kurtosis(kept.fold([0.0; 5], |sum, (_, s)| std::array::from_fn(|p| sum[p] + s.1[p])))[q]
        })
    })
}

/// Adds part 6 to the validation page: the probability distribution of the surface's elevation.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    page.heading(2, "6. The surface");
    page.paragraph(
        "Elevations at random points, wind 15 m/s over 300 km. Without chop the surface is Gaussian. With chop, points \
         move sideways towards the crests. The distribution over the horizontal plane then weights each point by the \
         Jacobian J: its density is the Gaussian times the mean of J at that elevation, φ(u) (1 - s₁ u + s₂ (u² - 1)). \
         This is exact for the linear Lagrangian sea (the choppy wave model of Nouguier et al. 2009), order 1. With the \
         bound waves of order 2, theory is a Gram-Charlier series with the skewness of the exact double sum over all \
         pairs of waves (Sharma and Dean 1981), without change of the mean level and the deviation. No parameter is \
         fitted to a measurement.",
    );
    let x = Axis::linear(
        "elevation over its standard deviation σ without chop",
        -HISTOGRAM_HALF_RANGE_SIGMAS,
        HISTOGRAM_HALF_RANGE_SIGMAS,
    );
    let gauss = ElevationDistribution { sigma: 1.0, skew_term: 0.0, area_term: 0.0, skewness: 0.0 };
    let (mut rows, mut figures) = (Vec::new(), Vec::new());
    for (chop, order) in [(0.0, 1), (1.0, 1), (1.0, 2)] {
        let state = format!("{SEA_STATE_STRING}&chop={chop}&order={order}");
        let theory = ElevationDistribution::new(&Plan::new(&parse_params(&state)?), chop);
        let y = Axis::log("probability density", 1e-5, 1.0);
        let mut figure = Figure::new(&format!("Chop {chop}, order {order}"), x.clone(), y, LegendCorner::UpperRight);
        let histograms = measure_elevation_histograms(lab, &state, theory.sigma)?;
        if let Some(all) = &histograms {
            figure =
                figure.with_series(FigureSeries::new("measured on the GPU", 5, SeriesData::Bars(histogram_bars(all))));
        }
        figure = figure
            .with_series(FigureSeries::new(
                "Gaussian",
                6,
                SeriesData::Dashes(sample_curve(&x, 200, |u| gauss.density(u))),
            ))
            .with_series(FigureSeries::new(
                "theory",
                1,
                SeriesData::Line(sample_curve(&x, 200, |u| theory.density(u))),
            ));
        figures.push((format!("surface-chop{chop}-order{order}"), figure));
        let shape = histograms.as_deref().map(pooled_mean_sd_skewness_kurtosis);
        let names = ["mean, σ", "deviation, σ", "skewness", "kurtosis"];
        for (q, (name, expected)) in names.into_iter().zip(theory.mean_sd_skewness_kurtosis()).enumerate() {
            let estimate = shape.map(|s| s[q]);
            rows.push(vec![
                format_number(chop, 0),
                order.to_string(),
                name.to_owned(),
                format_number(expected, 4),
                format_estimate(estimate, 4),
                absolute_deviation(estimate, expected),
            ]);
        }
    }
    page.figures(
        &figures,
        "Probability density of the elevation over all seeds: measured on the GPU (bars), theory (line) and the \
         Gaussian (dashed).",
    )?;
    page.table("chop | order | quantity | theory | measured | deviation", &rows);
    page.paragraph(
        "At order 1 the displaced crests are sharp and the troughs flat, but the skewness of the elevation is near 0; \
         real seas have 0.1 to 0.2 (Longuet-Higgins 1963). The sideways motion alone lowers the level under a group of \
         high waves by as much as it raises the crests. The bound waves of order 2 compensate for this.",
    );
    Ok(())
}

/// Bars of the histogram of elevations over all seeds: lower and upper edge, and probability density, with the
/// theoretical standard deviation of the elevation as unit.
fn histogram_bars(all: &[ElevationHistogram]) -> Vec<[f64; 3]> {
    let width = 2.0 * HISTOGRAM_HALF_RANGE_SIGMAS / ELEVATION_BINS as f64;
    let total: f64 = all.iter().map(|s| s.1[0]).sum();
    let bar = |i: usize| {
        let low = -HISTOGRAM_HALF_RANGE_SIGMAS + i as f64 * width;
        [low, low + width, all.iter().map(|s| s.0[i]).sum::<f64>() / (total * width)]
    };
    (0..ELEVATION_BINS).map(bar).filter(|bar| bar[2] > 1e-5).collect()
}
