//! Bound waves: the second-order part of the sea, by which crests are sharp and troughs are flat.
//!
//! Second-order theory adds to the linear waves a wave for each pair of them, bound to the pair, with the sum or the
//! difference of their wave vectors and frequencies (Longuet-Higgins 1963; Sharma and Dean 1981 for finite depth).
//! [`InteractionKernels`] are their exact amplitudes.
//!
//! Moving the water sideways by D, as Seastate draws the sea, has an effect of second order of its own (docs/sea.md,
//! "Second order"). In deep water with waves of one direction it equals the exact sum waves, but its difference waves
//! are too low by a_i a_j min(k_i, k_j) / 2 for each pair: the water sinks under groups of high waves, which takes away
//! all skewness. The correction is a height that depends only on the elevation eta and on D of the cascades at a point:
//!
//! C = sum over cascades c of eta_c (p_c eta_c / 2 + sum over longer cascades l of P_l eta_l)
//!                         +  D_c . (q_c D_c / 2 + sum over longer cascades l of Q_l D_l) + gain eta_c + level_c
//!
//! A term p eta^2 / 2 adds p (cos(a) + cos(b)) / 4 for each pair of waves, with the difference a and the sum b of their
//! phases, and q D^2 / 2 adds q o_i o_j cos(angle between them) (cos(a) - cos(b)) / 4, with the ratios o of horizontal
//! to vertical orbit axis. The coefficients are a least-squares fit to the exact kernels, weighted by the energy of both
//! waves. p is then the mean of what the kernels of sum and difference need together, so the skewness is exact. The level
//! and the small gain keep the mean level and the significant wave height of the displaced surface.

use super::dispersion::Dispersion;
use super::plan::{Cascade, Plan};
use std::f64::consts::{PI, TAU};

/// Number of wave numbers that represent a cascade in the fit, each with the same variance.
const WAVE_NUMBERS_PER_CASCADE: usize = 8;
/// Number of directions that represent the directional distribution at a wave number.
const DIRECTIONS: usize = 36;
/// Relative difference of two wave numbers below which the kernels are evaluated at this difference, because they are
/// 0/0 for equal waves.
const LEAST_RELATIVE_DIFFERENCE: f64 = 1e-3;
/// Largest rms height of the bound waves relative to that of the linear ones. In very shallow water the second order
/// exceeds the first and means nothing; the coefficients are reduced to this.
const MAX_BOUND_TO_LINEAR_RMS: f64 = 0.25;

/// Amplitudes of the bound waves of a pair of waves with the amplitudes a_i and a_j, divided by a_i a_j / 4, 1/m, by
/// Sharma and Dean 1981. Both orders of a pair count, so the pair adds twice as much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InteractionKernels {
    /// Kernel B- of the wave with the difference of both phases.
    pub difference: f64,
    /// Kernel B+ of the wave with the sum of both phases.
    pub sum: f64,
}

impl InteractionKernels {
    /// Kernels of two waves with the wave numbers `k` (rad/m), between whose directions the cosine of the angle is
    /// `cos`. Surface tension is neglected.
    pub fn new(dispersion: &Dispersion, k: [f64; 2], cos: f64) -> Self {
        let tanh = |k: f64| if k > 0.0 { 1.0 / dispersion.orbit_width_over_height(k) } else { 0.0 };
        let [k1, mut k2] = k;
        if (k2 / k1 - 1.0).abs() < LEAST_RELATIVE_DIFFERENCE {
            k2 = k1 * (1.0 + LEAST_RELATIVE_DIFFERENCE);
        }
        let (r1, r2) = (k1 * tanh(k1), k2 * tanh(k2));
        let (s1, s2) = (r1.sqrt(), r2.sqrt());
        let dot = k1 * k2 * cos;
        let apart = (k1 * k1 + k2 * k2 - 2.0 * dot).max(0.0).sqrt();
        let together = (k1 * k1 + k2 * k2 + 2.0 * dot).max(0.0).sqrt();
        let (fast1, fast2) = (k1 * k1 - r1 * r1, k2 * k2 - r2 * r2);
        let (low, high) = ((s1 - s2).powi(2), (s1 + s2).powi(2));
        let minus = ((s1 - s2) * (s2 * fast1 - s1 * fast2) + 2.0 * low * (dot + r1 * r2)) / (low - apart * tanh(apart));
        let plus =
            ((s1 + s2) * (s2 * fast1 + s1 * fast2) + 2.0 * high * (dot - r1 * r2)) / (high - together * tanh(together));
        Self {
            difference: (minus - (dot + r1 * r2)) / (s1 * s2) + r1 + r2,
            sum: (plus - (dot - r1 * r2)) / (s1 * s2) + r1 + r2,
        }
    }
}

/// Factors p on the products of elevations and q on those of horizontal displacements in the height of the bound waves,
/// 1/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProductFactors {
    /// Factor p on a product of elevations.
    pub elevation: f64,
    /// Factor q on a product of horizontal displacements.
    pub displacement: f64,
}

/// Bound waves of one cascade with itself and with the shorter waves of all finer cascades.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CascadeBoundWaves {
    /// Factors on products of two waves of this cascade.
    pub own: ProductFactors,
    /// Factors on products of a wave of this cascade with one of a finer cascade.
    pub with_shorter: ProductFactors,
    /// Height, m, that is added so that the mean level of the displaced surface is that of still water.
    pub level_m: f64,
}

/// Bound waves of a planned sea, for its choppiness.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundWaves {
    /// One entry for each cascade, in the order of the plan.
    pub cascades: Vec<CascadeBoundWaves>,
    /// All cascades together.
    pub totals: BoundWaveTotals,
}

/// Bound waves of all cascades together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundWaveTotals {
    /// Fraction by which the elevation of the linear waves is increased, so that the bound waves leave the significant
    /// wave height of the displaced surface as it is.
    pub elevation_gain: f64,
    /// The best single factors for the whole sea: those with which the gradient of the bound waves' height follows from
    /// the sums of elevation, displacement and their gradients over all cascades. 1/m.
    pub mean: ProductFactors,
}

/// Coefficients of the bound waves of a sea, whatever its choppiness; part of its plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundWaveFit {
    cascades: Vec<CascadeFit>,
    /// Whether the water is so shallow, or the waves so steep, that the coefficients had to be reduced.
    pub is_limited: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct CascadeFit {
    own: ProductFactors,
    with_shorter: ProductFactors,
    /// Variance of the elevation, m^2.
    elevation_m2: f64,
    /// Variances of Dx and Dz and their covariance, m^2.
    displacement_m2: [f64; 3],
    /// Minus the means of eta dDx/dx and of eta dDz/dz, m.
    sinking_m: [f64; 2],
}

impl CascadeFit {
    fn mean_height_m(&self) -> f64 {
        let [xx, zz, _] = self.displacement_m2;
        0.5 * (self.own.elevation * self.elevation_m2 + self.own.displacement * (xx + zz))
    }

    /// Variance of the bound waves' height, m^2: of this cascade with itself, and with the cascade `shorter`.
    fn variance_m2(&self) -> f64 {
        0.5 * product_variance_m2(self.own, self, self)
    }

    fn variance_with_m2(&self, shorter: &Self) -> f64 {
        product_variance_m2(self.with_shorter, self, shorter)
    }
}

/// Variance, m^2, of the products of the waves of two independent cascades times `factors`.
fn product_variance_m2(factors: ProductFactors, a: &CascadeFit, b: &CascadeFit) -> f64 {
    let ([ax, az, axz], [bx, bz, bxz]) = (a.displacement_m2, b.displacement_m2);
    factors.elevation.powi(2) * a.elevation_m2 * b.elevation_m2
        + factors.displacement.powi(2) * (ax * bx + az * bz + 2.0 * axz * bxz)
}

/// Waves of one wave number in all directions.
struct Node {
    k: f64,
    variance_m2: f64,
    orbit_width_over_height: f64,
    /// Fractions of the variance in each of [`DIRECTIONS`] directions.
    fractions: [f64; DIRECTIONS],
}

impl BoundWaveFit {
    /// Fits the coefficients for the spectrum and the cascades of `plan`.
    pub fn new(plan: &Plan) -> Self {
        let nodes: Vec<Vec<Node>> = plan.cascades.iter().map(|c| nodes(plan, c)).collect();
        let mut cascades = Vec::with_capacity(nodes.len());
        for (i, own) in nodes.iter().enumerate() {
            let mut fit = CascadeFit {
                own: fit(&plan.dispersion, own, || own.iter()),
                with_shorter: fit(&plan.dispersion, own, || nodes[i + 1..].iter().flatten()),
                ..CascadeFit::default()
            };
            for node in own {
                let width = node.orbit_width_over_height;
                fit.elevation_m2 += node.variance_m2;
                for (fraction, [x, z]) in node.fractions.iter().zip(directions()) {
                    let (squared, sinking) = (width * width, node.k * width);
                    let part = |factor: f64| node.variance_m2 * fraction * factor;
                    let [xx, zz, xz] = [x * x, z * z, x * z];
                    fit.displacement_m2[0] += part(squared * xx);
                    fit.displacement_m2[1] += part(squared * zz);
                    fit.displacement_m2[2] += part(squared * xz);
                    fit.sinking_m[0] += part(sinking * xx);
                    fit.sinking_m[1] += part(sinking * zz);
                }
            }
            cascades.push(fit);
        }
        let mut out = Self { cascades, is_limited: false };
        let linear_m2: f64 = out.cascades.iter().map(|c| c.elevation_m2).sum();
        let ratio = (out.bound_variance_m2() / linear_m2.max(f64::MIN_POSITIVE)).sqrt();
        if ratio > MAX_BOUND_TO_LINEAR_RMS {
            out.is_limited = true;
            out.scale(MAX_BOUND_TO_LINEAR_RMS / ratio);
        }
        out
    }

    /// Pairs of a cascade and one with shorter waves.
    fn pairs(&self) -> impl Iterator<Item = (&CascadeFit, &CascadeFit)> {
        self.cascades.iter().enumerate().flat_map(|(i, a)| self.cascades[i + 1..].iter().map(move |b| (a, b)))
    }

    /// Variance of the height of all bound waves, m^2.
    fn bound_variance_m2(&self) -> f64 {
        self.cascades.iter().map(CascadeFit::variance_m2).sum::<f64>()
            + self.pairs().map(|(a, b)| a.variance_with_m2(b)).sum::<f64>()
    }

    fn scale(&mut self, factor: f64) {
        let scaled = |f: ProductFactors| ProductFactors {
            elevation: factor * f.elevation,
            displacement: factor * f.displacement,
        };
        for fit in &mut self.cascades {
            (fit.own, fit.with_shorter) = (scaled(fit.own), scaled(fit.with_shorter));
        }
    }

    /// The bound waves of a sea whose horizontal displacements are multiplied by `choppiness` along x and z. The heights
    /// of bound waves do not depend on it, but the level does.
    pub fn with_choppiness(&self, choppiness: [f64; 2]) -> BoundWaves {
        let sinking_m = |fit: &CascadeFit| fit.sinking_m[0] * choppiness[0] + fit.sinking_m[1] * choppiness[1];
        let cascade = |fit: &CascadeFit| CascadeBoundWaves {
            own: fit.own,
            with_shorter: fit.with_shorter,
            level_m: sinking_m(fit) - fit.mean_height_m(),
        };
        let mut mean = ProductFactors::default();
        let mut sums = [0.0; 2];
        for (i, fit) in self.cascades.iter().enumerate() {
            let factors = if i + 1 < self.cascades.len() { fit.with_shorter } else { fit.own };
            let displacement_m2 = fit.displacement_m2[0] + fit.displacement_m2[1];
            mean.elevation += factors.elevation * fit.elevation_m2;
            mean.displacement += factors.displacement * displacement_m2;
            sums = [sums[0] + fit.elevation_m2, sums[1] + displacement_m2];
        }
        mean.elevation /= sums[0].max(f64::MIN_POSITIVE);
        mean.displacement /= sums[1].max(f64::MIN_POSITIVE);
        // Change of the variance by bound waves C: <C^2> + 2 <eta C div D>, by Gaussian moments, and the square of the
        // mean level, which they restore.
        let of_own = |fit: &CascadeFit| fit.own.elevation * fit.elevation_m2 * sinking_m(fit);
        let of_pair = |(a, b): (&CascadeFit, &CascadeFit)| {
            a.with_shorter.elevation * (a.elevation_m2 * sinking_m(b) + b.elevation_m2 * sinking_m(a))
        };
        let strained = self.cascades.iter().map(of_own).sum::<f64>() + self.pairs().map(of_pair).sum::<f64>();
        let elevation_gain = (strained - 0.5 * self.bound_variance_m2()) / sums[0].max(f64::MIN_POSITIVE);
        let cascades = self.cascades.iter().map(cascade).collect();
        BoundWaves { cascades, totals: BoundWaveTotals { elevation_gain, mean } }
    }
}

/// Skewness of the elevation of `plan`'s sea at a fixed point by exact second-order theory, 3 <eta_1^2 eta_2> /
/// m0^(3/2), from the double sum over all its waves in `bins` wave numbers of equal variance and 36 directions.
pub fn expected_skewness(plan: &Plan, bins: usize) -> f64 {
    let all = nodes_between(plan, 0.0, f64::INFINITY, bins, |_| 1.0);
    let m0: f64 = all.iter().map(|n| n.variance_m2).sum();
    let mut sum = 0.0;
    for a in &all {
        for b in &all {
            let mean = angle_weights(a, b).fold(0.0, |mean, (cos, weight)| {
                let kernels = InteractionKernels::new(&plan.dispersion, [a.k, b.k], cos);
                mean + 0.5 * weight * (kernels.difference + kernels.sum)
            });
            sum += a.variance_m2 * b.variance_m2 * mean;
        }
    }
    if m0 > 0.0 { 3.0 * sum / m0.powf(1.5) } else { 0.0 }
}

/// Unit vectors (x, z) of the directions of [`Node::fractions`].
fn directions() -> [[f64; 2]; DIRECTIONS] {
    std::array::from_fn(|i| {
        let (sin, cos) = (TAU * i as f64 / DIRECTIONS as f64).sin_cos();
        [cos, sin]
    })
}

fn nodes(plan: &Plan, cascade: &Cascade) -> Vec<Node> {
    let share = |k| plan.variance_share_per_cascade(k);
    nodes_between(plan, cascade.k_low, cascade.k_high, WAVE_NUMBERS_PER_CASCADE, share)
}

/// Waves of `plan` with wave numbers from `low` to `high` (rad/m) in `count` bins of equal variance; `share` is the
/// fraction of the variance at a wave number that counts.
fn nodes_between(plan: &Plan, low: f64, high: f64, count: usize, share: impl Fn(f64) -> f64) -> Vec<Node> {
    let bins = plan.spectrum_integrals.bins_of_equal_variance(low, high, count);
    bins.into_iter()
        .map(|(k, variance_m2)| Node {
            k,
            variance_m2: variance_m2 * share(k),
            orbit_width_over_height: plan.dispersion.orbit_width_over_height(k),
            fractions: direction_fractions(plan, plan.dispersion.omega(k)),
        })
        .collect()
}

/// Fractions of the variance at the angular frequency `omega` (rad/s) in each of [`DIRECTIONS`] directions.
fn direction_fractions(plan: &Plan, omega: f64) -> [f64; DIRECTIONS] {
    let mut out = [0.0; DIRECTIONS];
    for system in &plan.systems {
        let densities = system.relative_direction_densities(omega, &directions());
        let sum: f64 = densities.iter().sum();
        let scale = system.spectrum.density(omega) / sum.max(f64::MIN_POSITIVE);
        out.iter_mut().zip(&densities).for_each(|(out, density)| *out += scale * density);
    }
    let sum: f64 = out.iter().sum();
    if sum > 0.0 { out.map(|x| x / sum) } else { [1.0 / DIRECTIONS as f64; DIRECTIONS] }
}

/// Cosines of the angles between waves of two wave numbers, from 0 to pi, with the fraction of all pairs at that angle.
fn angle_weights<'a>(a: &'a Node, b: &'a Node) -> impl Iterator<Item = (f64, f64)> + 'a {
    (0..=DIRECTIONS / 2).map(|step| {
        let turned =
            |by: usize| (0..DIRECTIONS).map(|i| a.fractions[i] * b.fractions[(i + by) % DIRECTIONS]).sum::<f64>();
        let both_ways = step > 0 && 2 * step < DIRECTIONS;
        let weight = turned(step) + if both_ways { turned(DIRECTIONS - step) } else { 0.0 };
        ((2.0 * PI * step as f64 / DIRECTIONS as f64).cos(), weight)
    })
}

/// Factors that fit products of waves in `first` with those in `second` to the exact kernels, weighted by their
/// energies; 0 if there are no such waves.
fn fit<'a, I: Iterator<Item = &'a Node>>(
    dispersion: &Dispersion,
    first: &[Node],
    second: impl Fn() -> I,
) -> ProductFactors {
    let (mut energy, mut both, mut opposite, mut square) = (0.0, 0.0, 0.0, 0.0);
    for a in first {
        for b in second() {
            let pair = a.variance_m2 * b.variance_m2;
            if pair <= 0.0 {
                continue;
            }
            let (wide_a, wide_b) = (a.orbit_width_over_height, b.orbit_width_over_height);
            for (cos, weight) in angle_weights(a, b) {
                if weight < 1e-6 {
                    continue;
                }
                let kernels = InteractionKernels::new(dispersion, [a.k, b.k], cos);
                // The horizontal displacement alone has the kernels -moved (difference) and +moved (sum).
                let moved = cos * (wide_a * b.k + wide_b * a.k);
                let (difference, sum) = (kernels.difference + moved, kernels.sum - moved);
                let (weight, tilt) = (pair * weight, wide_a * wide_b * cos);
                energy += weight;
                both += weight * 0.5 * (difference + sum);
                opposite += weight * 0.5 * (difference - sum) * tilt;
                square += weight * tilt * tilt;
            }
        }
    }
    let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
    ProductFactors { elevation: ratio(both, energy), displacement: ratio(opposite, square) }
}
