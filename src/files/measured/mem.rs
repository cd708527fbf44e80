//! The maximum entropy method (MEM) for directional distributions (Lygre and Krogstad 1986, J. Phys. Oceanogr. 16,
//! 2052-2060). Complex numbers are vectors (re, im), which `rotate` multiplies.

use glam::{DVec2, dvec2};
use std::f64::consts::TAU;

/// Largest magnitude of the first directional moment c1 and of the coefficient phi2 in [`MaximumEntropyDistribution`];
/// larger ones are reduced to it, because at 1 the directional distribution has no width.
const MAX_COEFFICIENT_MAGNITUDE: f64 = 0.995;

/// The directional distribution D(theta) of wave energy, per rad, that has the largest (Burg) entropy for given moments
/// c_n = integral of D e^{i n theta}, n = 1, 2: D = normalisation / |1 - phi1 e^{-i theta} - phi2 e^{-2 i theta}|^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaximumEntropyDistribution {
    /// First autoregressive coefficient (re, im): phi1 in the directional distribution D(theta) = normalisation / |1 -
    /// phi1 e^{-i theta} - phi2 e^{-2 i theta}|^2.
    pub phi1: DVec2,
    /// Second autoregressive coefficient (re, im): phi2 in the same formula as [`Self::phi1`].
    pub phi2: DVec2,
    /// Numerator in the formula at [`Self::phi1`], per rad; it makes the integral of D over all directions 1.
    pub normalisation: f64,
}

impl MaximumEntropyDistribution {
    /// Makes the distribution with moments (re c1, im c1, re c2, im c2), c_n = integral of D(theta) e^{i n theta}.
    ///
    /// The distribution has exactly these moments if |c1| <= 0.995 and |c2 - c1^2| <= 0.995 (1 - |c1|^2). Otherwise c1
    /// is shortened and c2 moved towards c1^2 until both conditions hold. With 1 in place of 0.995 they hold for any
    /// distribution. Moments that are not finite give an isotropic distribution.
    pub fn new(moments: [f64; 4]) -> Self {
        let known = moments.iter().all(|m| m.is_finite());
        let [a, b, c, d] = if known { moments.map(|m| m.clamp(-1e6, 1e6)) } else { [0.0; 4] };
        let c1 = with_limited_magnitude(dvec2(a, b));
        let free = 1.0 - c1.length_squared();
        // Levinson's recursion gives phi2 = (c2 - c1^2) / (1 - |c1|^2) and phi1 = c1 - phi2 c1*.
        let phi2 = with_limited_magnitude((dvec2(c, d) - c1.rotate(c1)) / free);
        let phi1 = c1 - phi2.rotate(conjugate(c1));
        Self { phi1, phi2, normalisation: free * (1.0 - phi2.length_squared()) / TAU }
    }

    /// First moment [re, im], the integral of D e^{i theta}, of the distribution; [`Self::new`] may have shortened it.
    pub fn first_moment(&self) -> [f64; 2] {
        // The equation phi1 = c1 - phi2 c1*, solved for c1.
        let c1 = (self.phi1 + self.phi2.rotate(conjugate(self.phi1))) / (1.0 - self.phi2.length_squared());
        c1.to_array()
    }

    /// Density of this directional distribution, per rad, at the angle `theta`, rad, counted from the same axis and in
    /// the same sense as in the moments that were given to [`Self::new`].
    pub fn density(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let first = self.phi1.rotate(dvec2(cos, -sin));
        let second = self.phi2.rotate(dvec2(cos * cos - sin * sin, -2.0 * sin * cos));
        self.normalisation / (DVec2::X - first - second).length_squared()
    }
}

fn conjugate(a: DVec2) -> DVec2 {
    dvec2(a.x, -a.y)
}

/// Returns a complex number, shortened to the magnitude [`MAX_COEFFICIENT_MAGNITUDE`] if its magnitude is larger.
fn with_limited_magnitude(a: DVec2) -> DVec2 {
    let size = a.x.hypot(a.y);
    if size > MAX_COEFFICIENT_MAGNITUDE { MAX_COEFFICIENT_MAGNITUDE * (a / size) } else { a }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Lcg;
    use super::*;

    /// Returns [integral, re c1, im c1, re c2, im c2] of a distribution by the periodic trapezium rule, and its
    /// smallest density. With n samples and poles at radius 1 - d the error is e^{-n d}.
    fn integrals(mem: &MaximumEntropyDistribution) -> ([f64; 5], f64) {
        // Poles of the density: the roots of z^2 - phi1 z - phi2.
        let square = 0.25 * mem.phi1.rotate(mem.phi1) + mem.phi2;
        let root = square.length().sqrt() * DVec2::from_angle(0.5 * square.to_angle());
        let gap = 1.0 - (0.5 * mem.phi1 + root).length().max((0.5 * mem.phi1 - root).length());
        assert!(gap > 0.0);
        let n = (24.0 / gap).ceil().max(64.0) as u32;
        let (mut sums, mut least) = ([0.0; 5], f64::MAX);
        for i in 0..n {
            let theta = TAU * f64::from(i) / f64::from(n);
            let d = mem.density(theta);
            least = least.min(d);
            let parts = [1.0, theta.cos(), theta.sin(), (2.0 * theta).cos(), (2.0 * theta).sin()];
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum += part * d * TAU / f64::from(n);
            }
        }
        (sums, least)
    }

    #[test]
    fn admissible_moments_are_reproduced() {
        let mut random = Lcg(7);
        for i in 0..200 {
            let c1 = 0.99 * random.unit().sqrt() * DVec2::from_angle(TAU * random.unit());
            let free = 1.0 - c1.length_squared();
            let gain = if i % 4 == 0 { 0.9 } else { 0.99 * random.unit() };
            let c2 = c1.rotate(c1) + gain * free * DVec2::from_angle(TAU * random.unit());
            let mem = MaximumEntropyDistribution::new([c1.x, c1.y, c2.x, c2.y]);
            let (got, least) = integrals(&mem);
            assert!(least > 0.0);
            for (g, w) in got.iter().zip([1.0, c1.x, c1.y, c2.x, c2.y]) {
                assert!((g - w).abs() < 1e-9, "{c1:?} {c2:?}: {got:?}");
            }
            // The coefficients phi1 and phi2 by Lygre and Krogstad's definitions.
            let phi1 = (c1 - c2.rotate(conjugate(c1))) / free;
            let phi2 = c2 - c1.rotate(phi1);
            let norm = (1.0 - phi1.rotate(conjugate(c1)).x - phi2.rotate(conjugate(c2)).x) / TAU;
            assert!(mem.phi1.abs_diff_eq(phi1, 1e-9) && mem.phi2.abs_diff_eq(phi2, 1e-9), "{phi1} {phi2} {mem:?}");
            assert!((mem.normalisation - norm).abs() < 1e-9, "{norm} {mem:?}");
        }
    }

    #[test]
    fn any_moments_give_a_distribution() {
        let mut random = Lcg(11);
        for _ in 0..60 {
            let scale = 10f64.powf(4.0 * random.unit() - 1.0);
            let moments: [f64; 4] = std::array::from_fn(|_| scale * (2.0 * random.unit() - 1.0));
            let (got, least) = integrals(&MaximumEntropyDistribution::new(moments));
            assert!(least > 0.0 && (got[0] - 1.0).abs() < 1e-8, "{moments:?}: {got:?}");
        }
        for moments in [[1e308; 4], [-1e308, 1e308, 1e308, -1e308], [1.0, 0.0, 1.0, 0.0], [0.0, 1.0, -1.0, 0.0]] {
            let mem = MaximumEntropyDistribution::new(moments);
            let densities = (0..100).map(|i| mem.density(0.1 * f64::from(i)));
            assert!(densities.into_iter().all(|d| d > 0.0 && d.is_finite()), "{moments:?}");
        }
        let isotropic = MaximumEntropyDistribution::new([0.0; 4]);
        assert_eq!(isotropic, MaximumEntropyDistribution::new([f64::NAN, 0.0, f64::INFINITY, 0.0]));
        assert!((isotropic.density(1.0) - 1.0 / TAU).abs() < 1e-15);
    }
}
