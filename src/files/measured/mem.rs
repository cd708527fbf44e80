//! The maximum entropy method (MEM) for directional distributions (Lygre and Krogstad 1986, J. Phys. Oceanogr. 16,
//! 2052-2060). Complex numbers are (re, im).

use std::f64::consts::TAU;

/// Largest magnitude of c1 and phi2: at 1 a lobe has no width.
const LIMIT: f64 = 0.995;

/// The directional distribution of the largest (Burg) entropy for given moments c1 and c2:
/// D(theta) = norm / |1 - phi1 e^{-i theta} - phi2 e^{-2 i theta}|^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mem {
    /// (c1 - c2 c1*) / (1 - |c1|^2).
    pub phi1: [f64; 2],
    /// c2 - c1 phi1.
    pub phi2: [f64; 2],
    /// (1 - phi1 c1* - phi2 c2*) / (2 pi), per rad.
    pub norm: f64,
}

impl Mem {
    /// The distribution with the moments (re c1, im c1, re c2, im c2), c_n = integral of D e^{i n theta}.
    ///
    /// Its moments are exact if |c1| <= 0.995 and |c2 - c1^2| <= 0.995 (1 - |c1|^2). Otherwise c1 is shortened and c2 moved
    /// towards c1^2 until both hold. With 1 in place of 0.995 these are the bounds of any distribution. Moments that are not
    /// finite give an isotropic distribution.
    pub fn new(moments: [f64; 4]) -> Self {
        let known = moments.iter().all(|m| m.is_finite());
        let [a, b, c, d] = if known { moments.map(|m| m.clamp(-1e6, 1e6)) } else { [0.0; 4] };
        let c1 = shortened([a, b], LIMIT);
        let free = 1.0 - abs2(c1);
        // phi2 = (c2 - c1^2) / (1 - |c1|^2), the second step of Levinson's recursion; phi1 = c1 - phi2 c1*.
        let square = times(c1, c1);
        let phi2 = shortened([(c - square[0]) / free, (d - square[1]) / free], LIMIT);
        let turned = times(phi2, [c1[0], -c1[1]]);
        let phi1 = [c1[0] - turned[0], c1[1] - turned[1]];
        Self { phi1, phi2, norm: free * (1.0 - abs2(phi2)) / TAU }
    }

    /// The moment c1 of the distribution.
    pub fn first_moment(&self) -> [f64; 2] {
        // phi1 = c1 - phi2 c1*, solved for c1.
        let turned = times(self.phi2, [self.phi1[0], -self.phi1[1]]);
        let rest = 1.0 - abs2(self.phi2);
        [(self.phi1[0] + turned[0]) / rest, (self.phi1[1] + turned[1]) / rest]
    }

    /// D(theta), per rad.
    pub fn density(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let first = times(self.phi1, [cos, -sin]);
        let second = times(self.phi2, [cos * cos - sin * sin, -2.0 * sin * cos]);
        self.norm / abs2([1.0 - first[0] - second[0], first[1] + second[1]])
    }
}

/// Product of two complex numbers.
fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Squared magnitude of a complex number.
fn abs2(a: [f64; 2]) -> f64 {
    a[0] * a[0] + a[1] * a[1]
}

/// A complex number with its magnitude limited.
fn shortened(a: [f64; 2], limit: f64) -> [f64; 2] {
    let size = a[0].hypot(a[1]);
    if size > limit { a.map(|v| limit * (v / size)) } else { a }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Lcg;
    use super::*;

    /// Integral, first and second moments by the periodic trapezium rule, and the smallest density. With poles at radius
    /// 1 - d the error is e^{-n d}.
    fn integrals(mem: &Mem) -> ([f64; 5], f64) {
        // Poles of z^2 - phi1 z - phi2.
        let [re, im] = times(mem.phi1, mem.phi1);
        let (re, im) = (0.25 * re + mem.phi2[0], 0.25 * im + mem.phi2[1]);
        let (size, half) = (re.hypot(im).sqrt(), 0.5 * im.atan2(re));
        let root = [size * half.cos(), size * half.sin()];
        let radius = [1.0, -1.0].map(|s| (0.5 * mem.phi1[0] + s * root[0]).hypot(0.5 * mem.phi1[1] + s * root[1]));
        let gap = 1.0 - radius[0].max(radius[1]);
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
            let (size, turn) = (0.99 * random.unit().sqrt(), TAU * random.unit());
            let c1 = [size * turn.cos(), size * turn.sin()];
            let (gain, turn) = (if i % 4 == 0 { 0.9 } else { 0.99 * random.unit() }, TAU * random.unit());
            let square = times(c1, c1);
            let reach = gain * (1.0 - abs2(c1));
            let c2 = [square[0] + reach * turn.cos(), square[1] + reach * turn.sin()];
            let mem = Mem::new([c1[0], c1[1], c2[0], c2[1]]);
            let (got, least) = integrals(&mem);
            assert!(least > 0.0);
            for (g, w) in got.iter().zip([1.0, c1[0], c1[1], c2[0], c2[1]]) {
                assert!((g - w).abs() < 1e-9, "{c1:?} {c2:?}: {got:?}");
            }
            // The definitions of Lygre and Krogstad.
            let [r, s] = times(c2, [c1[0], -c1[1]]);
            let phi1 = [(c1[0] - r) / (1.0 - abs2(c1)), (c1[1] - s) / (1.0 - abs2(c1))];
            let phi2 = [c2[0] - times(c1, phi1)[0], c2[1] - times(c1, phi1)[1]];
            let norm = (1.0 - times(phi1, [c1[0], -c1[1]])[0] - times(phi2, [c2[0], -c2[1]])[0]) / TAU;
            let want = [phi1[0], phi1[1], phi2[0], phi2[1], norm];
            let have = [mem.phi1[0], mem.phi1[1], mem.phi2[0], mem.phi2[1], mem.norm];
            assert!(want.iter().zip(have).all(|(w, h)| (w - h).abs() < 1e-9), "{want:?} {have:?}");
        }
    }

    #[test]
    fn any_moments_give_a_distribution() {
        let mut random = Lcg(11);
        for _ in 0..60 {
            let scale = 10f64.powf(4.0 * random.unit() - 1.0);
            let moments: [f64; 4] = std::array::from_fn(|_| scale * (2.0 * random.unit() - 1.0));
            let (got, least) = integrals(&Mem::new(moments));
            assert!(least > 0.0 && (got[0] - 1.0).abs() < 1e-8, "{moments:?}: {got:?}");
        }
        for moments in [[1e308; 4], [-1e308, 1e308, 1e308, -1e308], [1.0, 0.0, 1.0, 0.0], [0.0, 1.0, -1.0, 0.0]] {
            let mem = Mem::new(moments);
            let densities = (0..100).map(|i| mem.density(0.1 * f64::from(i)));
            assert!(densities.into_iter().all(|d| d > 0.0 && d.is_finite()), "{moments:?}");
        }
        let isotropic = Mem::new([0.0; 4]);
        assert_eq!(isotropic, Mem::new([f64::NAN, 0.0, f64::INFINITY, 0.0]));
        assert!((isotropic.density(1.0) - 1.0 / TAU).abs() < 1e-15);
    }
}
