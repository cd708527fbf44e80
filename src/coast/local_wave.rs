//! Wave number and group velocity of a wave in water of the local depth, from a table: solvers need millions of them.

use crate::waves::dispersion::Dispersion;
use std::sync::OnceLock;

/// Intervals of the table for each unit of omega sqrt(depth / g).
const PER_UNIT: usize = 1024;
/// Largest omega sqrt(depth / g) of the table. Beyond it tanh(k depth) is 1 to 14 digits: the water is deep.
const LARGEST: usize = 4;

/// A wave of the linear theory in water of a certain depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalWave {
    /// Wave number k, rad/m.
    pub k: f64,
    /// Group velocity, m/s.
    pub group_velocity_m_s: f64,
    /// Product of phase and group velocity C Cg, m^2/s^2, the coefficient of the mild-slope equation.
    pub c_cg: f64,
}

impl LocalWave {
    /// The wave of angular frequency `omega_rad_s` (positive) in water of `depth_m` (positive) under gravity
    /// `gravity_m_s2`. The wave number has a relative error below 1e-6.
    pub fn new(omega_rad_s: f64, depth_m: f64, gravity_m_s2: f64) -> Self {
        let s = omega_rad_s * (depth_m / gravity_m_s2).sqrt();
        let (kh, n) = relative_depth_and_ratio(s);
        let k = kh / depth_m;
        let c = omega_rad_s / k;
        Self { k, group_velocity_m_s: n * c, c_cg: n * c * c }
    }
}

/// Returns k depth and the ratio n of group velocity to phase velocity for s = omega sqrt(depth / g).
fn relative_depth_and_ratio(s: f64) -> (f64, f64) {
    let at = s * PER_UNIT as f64;
    if at >= (LARGEST * PER_UNIT) as f64 {
        return (s * s, 0.5);
    }
    let table = table();
    let index = at as usize;
    let fraction = at - index as f64;
    let (low, high) = (table[index], table[index + 1]);
    (s * (low[0] + fraction * (high[0] - low[0])), low[1] + fraction * (high[1] - low[1]))
}

/// For s = index / `PER_UNIT`: k depth / s, and the ratio of group velocity to phase velocity. Both are smooth at s =
/// 0.
fn table() -> &'static [[f64; 2]] {
    static TABLE: OnceLock<Vec<[f64; 2]>> = OnceLock::new();
    TABLE.get_or_init(|| {
        // In units in which depth and gravity are 1, s is the frequency and k the wave number.
        let dispersion = Dispersion::finite_depth(1.0, 1.0);
        let entry = |index: usize| {
            let s = index as f64 / PER_UNIT as f64;
            if index == 0 {
                return [1.0, 1.0];
            }
            let k = dispersion.wave_number(s);
            [k / s, dispersion.group_velocity(k) * k / s]
        };
        (0..=LARGEST * PER_UNIT).map(entry).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_follows_the_dispersion_relation() {
        for depth_m in [0.02, 0.3, 2.0, 11.0, 90.0, 4000.0] {
            let dispersion = Dispersion::finite_depth(9.81, depth_m);
            for omega in [0.21, 0.5, 0.77, 1.3, 2.9] {
                let wave = LocalWave::new(omega, depth_m, 9.81);
                let k = dispersion.wave_number(omega);
                assert!((wave.k / k - 1.0).abs() < 1e-6, "depth {depth_m} omega {omega}");
                let cg = dispersion.group_velocity(k);
                assert!((wave.group_velocity_m_s / cg - 1.0).abs() < 2e-6, "depth {depth_m} omega {omega}");
                assert!((wave.c_cg / (cg * omega / k) - 1.0).abs() < 2e-6);
            }
        }
    }
}
