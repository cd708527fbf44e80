//! Energy that waves lose near a shore: by depth-limited breaking, and by friction at the bed.

use std::f64::consts::TAU;

/// How waves lose energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Ratio gamma of the largest wave height to the depth in shallow water (Battjes and Janssen 1978 and later
    /// calibrations: 0.73); 0 switches breaking off.
    pub breaker_ratio: f64,
    /// Factor alpha of the dissipation in a breaking wave (Battjes and Janssen 1978: 1).
    pub breaker_strength: f64,
    /// Friction coefficient of the bed, m^2/s^3 (JONSWAP, Hasselmann et al. 1973: 0.038 for swell); 0 switches
    /// friction off.
    pub friction_m2_s3: f64,
}

impl Default for Losses {
    fn default() -> Self {
        Self { breaker_ratio: 0.73, breaker_strength: 1.0, friction_m2_s3: 0.038 }
    }
}

impl Losses {
    /// Waves that lose no energy.
    pub const NONE: Self = Self { breaker_ratio: 0.0, breaker_strength: 1.0, friction_m2_s3: 0.0 };

    /// Rate (1/s) at which friction takes the energy of a wave with the angular frequency `omega_rad_s` and the wave
    /// number `k` (rad/m): C omega^2 / (g sinh(k h))^2.
    pub fn friction_rate_per_s(&self, omega_rad_s: f64, k: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
        // Beyond k h = 20 the rate is below 1e-16 of that at k h = 1; sinh would overflow above 710.
        let sinh = (k * depth_m).min(20.0).sinh();
        self.friction_m2_s3 * (omega_rad_s / (gravity_m_s2 * sinh)).powi(2)
    }

    /// Largest height (m) of a wave that does not break: 0.88 / k tanh(gamma k h / 0.88) (Battjes and Janssen 1978,
    /// after Miche).
    pub fn largest_height_m(&self, k: f64, depth_m: f64) -> f64 {
        0.88 / k * (self.breaker_ratio * k * depth_m / 0.88).tanh()
    }

    /// Fraction of the waves that break, and the rate (m^2/s) at which breaking takes variance `m0_m2` of the elevation
    /// from a sea with the mean angular frequency `omega_rad_s` and its wave number `k` (rad/m):
    /// alpha f Q Hm^2 / 4 (Battjes and Janssen 1978, in units in which the energy is the variance).
    pub fn breaking(&self, m0_m2: f64, omega_rad_s: f64, k: f64, depth_m: f64) -> (f64, f64) {
        if self.breaker_ratio <= 0.0 || m0_m2 <= 0.0 {
            return (0.0, 0.0);
        }
        let largest_m = self.largest_height_m(k, depth_m);
        let fraction = breaking_fraction((8.0 * m0_m2).sqrt() / largest_m);
        (fraction, 0.25 * self.breaker_strength * omega_rad_s / TAU * fraction * largest_m * largest_m)
    }
}

/// Fraction Q of waves that break, for the ratio of the root mean square height to the largest height: the solution of
/// (1 - Q) / ln Q = -ratio^2 (Battjes and Janssen 1978). It is 1 from a ratio of 1.
pub fn breaking_fraction(ratio: f64) -> f64 {
    let b = ratio * ratio;
    if b >= 1.0 {
        return 1.0;
    }
    // Below, Q = e^(-1/b) is under 4e-9.
    if ratio < 0.23 {
        return 0.0;
    }
    // Q = e^((Q - 1) / b) has the solutions 1 and the one sought, at which the right side is convex with a slope below
    // 1: Newton's method rises to it from below without passing it.
    let mut q = (-1.0 / b).exp();
    for _ in 0..40 {
        let right = ((q - 1.0) / b).exp();
        let step = (right - q) / (1.0 - right / b);
        if step <= 1e-14 * q || step.is_nan() {
            break;
        }
        q += step;
    }
    q.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_solves_its_equation() {
        for i in 25..100 {
            let ratio = f64::from(i) / 100.0;
            let q = breaking_fraction(ratio);
            assert!(q > 0.0 && q < 1.0, "ratio {ratio} gives {q}");
            assert!(((1.0 - q) / q.ln() + ratio * ratio).abs() < 1e-6, "ratio {ratio} gives {q}");
        }
        assert_eq!(breaking_fraction(1.2), 1.0);
        assert_eq!(breaking_fraction(0.0), 0.0);
    }

    #[test]
    fn losses_of_known_seas() {
        // Shallow water: the largest height is gamma times the depth. Saturated waves lose alpha f Hm^2 / 4.
        let losses = Losses::default();
        let (k, depth_m) = (0.01, 1.0);
        assert!((losses.largest_height_m(k, depth_m) / 0.73 - 1.0).abs() < 1e-4);
        let (fraction, loss) = losses.breaking(0.73 * 0.73 / 8.0, TAU * 0.1, k, depth_m);
        assert!(fraction > 0.98 && (loss / (0.25 * 0.1 * 0.73 * 0.73 * fraction) - 1.0).abs() < 1e-3);
        assert_eq!(Losses::NONE.breaking(1.0, 1.0, k, depth_m), (0.0, 0.0));
        // Swell of 10 s in 10 m of water: k h = 0.6797 and sinh = 0.7334, so 0.038 x 0.6283^2 / (9.81 x 0.7334)^2.
        let rate = losses.friction_rate_per_s(0.628_318_5, 0.067_97, 10.0, 9.81);
        assert!((rate / 2.898e-4 - 1.0).abs() < 0.01, "{rate}");
    }
}
