//! Linear dispersion of waves over a flat bottom, its derivative and its inverse. docs/sea.md, "Dispersion".
//!
//! All three relations are one, omega^2 = (g k + sigma/rho k^3) tanh(k h): deep water has an infinite h, gravity waves no
//! sigma.

use crate::state::params::{DispersionKind, Sea};

/// A dispersion relation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersion {
    gravity: f64,
    /// Infinite for deep water.
    depth_m: f64,
    /// sigma / rho, m^3/s^2.
    tension: f64,
}

impl Dispersion {
    /// The relation of a sea.
    pub fn new(sea: &Sea) -> Self {
        let finite = Self::finite(sea.gravity_m_s2, sea.depth_m);
        match sea.dispersion {
            DispersionKind::Deep => Self { depth_m: f64::INFINITY, ..finite },
            DispersionKind::Finite => finite,
            DispersionKind::Capillary => Self { tension: sea.tension_n_m / sea.density_kg_m3, ..finite },
        }
    }

    /// Gravity waves in water of a depth (m).
    pub fn finite(gravity: f64, depth_m: f64) -> Self {
        Self { gravity, depth_m, tension: 0.0 }
    }

    /// Whether short waves are held by surface tension.
    pub fn is_capillary(&self) -> bool {
        self.tension > 0.0
    }

    /// Angular frequency (rad/s) of wave number `k` (rad/m).
    pub fn omega(&self, k: f64) -> f64 {
        ((self.gravity + self.tension * k * k) * k * (k * self.depth_m).tanh()).sqrt()
    }

    /// Group velocity d omega / dk (m/s) of wave number `k` (rad/m, positive).
    pub fn group_velocity(&self, k: f64) -> f64 {
        let kh = k * self.depth_m;
        // k h / cosh^2(k h) vanishes long before cosh overflows.
        let curve = if kh > 300.0 { 0.0 } else { kh / (kh.cosh() * kh.cosh()) };
        let stiff = self.tension * k * k;
        ((self.gravity + 3.0 * stiff) * kh.tanh() + (self.gravity + stiff) * curve) / (2.0 * self.omega(k))
    }

    /// Wave number (rad/m) of angular frequency `omega_rad_s` (positive).
    ///
    /// Newton in the logarithms of both, where the relation is nearly straight (its slope lies between 1/2 and 3/2), from
    /// the start of Guo 2002 for gravity waves or that of pure capillary waves.
    pub fn wave_number(&self, omega_rad_s: f64) -> f64 {
        let deep = omega_rad_s * omega_rad_s / self.gravity;
        let x = omega_rad_s * (self.depth_m / self.gravity).sqrt();
        let mut k = if x > 8.0 { deep } else { deep * (1.0 - (-x.powf(2.4908)).exp()).powf(-1.0 / 2.4908) };
        if self.tension > 0.0 {
            k = k.min((omega_rad_s * omega_rad_s / self.tension).cbrt());
        }
        for _ in 0..if self.tension > 0.0 { 7 } else { 4 } {
            let omega = self.omega(k);
            k *= ((omega_rad_s / omega).ln() * omega / (k * self.group_velocity(k))).exp();
        }
        k
    }

    /// Horizontal over vertical axis of the particle orbits at the surface: coth(k h).
    pub fn orbit(&self, k: f64) -> f64 {
        1.0 / (k * self.depth_m).tanh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relations() -> Vec<Dispersion> {
        let mut all = Vec::new();
        for dispersion in [DispersionKind::Deep, DispersionKind::Finite, DispersionKind::Capillary] {
            for depth_m in [0.5, 1.0, 3.0, 20.0, 200.0, 11000.0] {
                for tension_n_m in [0.001, 0.074, 0.5] {
                    all.push(Dispersion::new(&Sea { dispersion, depth_m, tension_n_m, ..Sea::default() }));
                }
            }
        }
        all
    }

    #[test]
    fn group_velocity_is_the_derivative() {
        for d in relations() {
            for k in [0.003, 0.05, 1.0, 40.0, 370.0, 4000.0] {
                let dk = k * 1e-5;
                let numeric = (d.omega(k + dk) - d.omega(k - dk)) / (2.0 * dk);
                assert!((d.group_velocity(k) / numeric - 1.0).abs() < 1e-7, "{d:?} k {k}");
            }
        }
    }

    #[test]
    fn wave_number_inverts_omega() {
        for d in relations() {
            for i in 0..230 {
                let k = 1e-4 * 1.08f64.powi(i);
                let back = d.wave_number(d.omega(k));
                assert!((back / k - 1.0).abs() < 1e-9, "{d:?} k {k} back {back}");
            }
        }
    }

    #[test]
    fn known_speeds() {
        // The slowest wave on water: 0.23 m/s at 370 rad/m (Elfouhaily et al. 1997); 2 m of water under a long wave.
        let capillary = Dispersion::new(&Sea { dispersion: DispersionKind::Capillary, ..Sea::default() });
        let slowest =
            (100..1000).map(f64::from).min_by(|a, b| (capillary.omega(*a) / a).total_cmp(&(capillary.omega(*b) / b)));
        assert!((slowest.unwrap() - 365.0).abs() < 6.0 && (capillary.omega(370.0) / 370.0 - 0.231).abs() < 0.002);
        let shallow = Dispersion::finite(9.81, 2.0);
        assert!((shallow.omega(0.05) - 0.221).abs() < 0.001);
    }
}
