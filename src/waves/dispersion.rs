//! Linear dispersion relation over a flat bottom, its derivative and its inverse (docs/sea.md, "Dispersion").
//!
//! One formula covers deep water, finite depth and capillary waves, omega^2 = (g k + sigma/rho k^3) tanh(k h): in deep
//! water the depth h is infinite, for gravity waves the surface tension sigma is 0.

use crate::state::params::{DispersionKind, Sea};

/// Dispersion relation of a sea: the angular frequency omega (rad/s) of a wave with wave number k (rad/m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dispersion {
    gravity_m_s2: f64,
    /// Water depth, m; infinite for deep water.
    depth_m: f64,
    /// Surface tension divided by density, sigma / rho, m^3/s^2; 0 for gravity waves.
    tension_m3_s2: f64,
}

impl Dispersion {
    /// Makes the dispersion relation that is selected in the sea's parameters: deep, finite depth or capillary.
    pub fn new(sea: &Sea) -> Self {
        let finite_depth = Self::finite_depth(sea.gravity_m_s2, sea.depth_m);
        match sea.dispersion {
            DispersionKind::Deep => Self { depth_m: f64::INFINITY, ..finite_depth },
            DispersionKind::Finite => finite_depth,
            DispersionKind::Capillary => Self { tension_m3_s2: sea.tension_n_m / sea.density_kg_m3, ..finite_depth },
        }
    }

    /// Water depth, m; infinite for deep water.
    pub fn depth_m(&self) -> f64 {
        self.depth_m
    }

    /// Makes the dispersion relation of gravity waves in water of finite depth, without surface tension.
    pub fn finite_depth(gravity_m_s2: f64, depth_m: f64) -> Self {
        Self { gravity_m_s2, depth_m, tension_m3_s2: 0.0 }
    }

    /// Whether the dispersion relation includes surface tension.
    pub fn includes_surface_tension(&self) -> bool {
        self.tension_m3_s2 > 0.0
    }

    /// Angular frequency (rad/s) of a wave with the wave number `k` (rad/m).
    pub fn omega(&self, k: f64) -> f64 {
        ((self.gravity_m_s2 + self.tension_m3_s2 * k * k) * k * (k * self.depth_m).tanh()).sqrt()
    }

    /// Group velocity d omega / dk (m/s) of a wave with the wave number `k` (rad/m, positive).
    pub fn group_velocity(&self, k: f64) -> f64 {
        let kh = k * self.depth_m;
        // k h / cosh^2(k h) is negligible above k h = 300; cosh would overflow above 710.
        let shallow = if kh > 300.0 { 0.0 } else { kh / (kh.cosh() * kh.cosh()) };
        let (g, capillary) = (self.gravity_m_s2, self.tension_m3_s2 * k * k);
        ((g + 3.0 * capillary) * kh.tanh() + (g + capillary) * shallow) / (2.0 * self.omega(k))
    }

    /// Variance density over angular frequency, S(omega) = S(k) dk / d omega (m^2 s), at `omega` (rad/s), from the
    /// density over wave number S(k) (m^3), which the function `density_over_k` returns.
    pub fn density_over_omega(&self, density_over_k: impl Fn(f64) -> f64, omega: f64) -> f64 {
        let k = self.wave_number(omega);
        density_over_k(k) / self.group_velocity(k)
    }

    /// Wave number (rad/m) of a wave with the angular frequency `omega_rad_s` (rad/s, positive).
    ///
    /// It is found by Newton's method for ln(omega) as a function of ln(k), whose slope is always between 1/2 and 3/2.
    /// The start value is the approximation of Guo 2002 for gravity waves or the solution for pure capillary waves.
    pub fn wave_number(&self, omega_rad_s: f64) -> f64 {
        let deep = omega_rad_s * omega_rad_s / self.gravity_m_s2;
        let x = omega_rad_s * (self.depth_m / self.gravity_m_s2).sqrt();
        let mut k = if x > 8.0 { deep } else { deep * (1.0 - (-x.powf(2.4908)).exp()).powf(-1.0 / 2.4908) };
        if self.includes_surface_tension() {
            k = k.min((omega_rad_s * omega_rad_s / self.tension_m3_s2).cbrt());
        }
        for _ in 0..if self.includes_surface_tension() { 7 } else { 4 } {
            let omega = self.omega(k);
            k *= ((omega_rad_s / omega).ln() * omega / (k * self.group_velocity(k))).exp();
        }
        k
    }

    /// Ratio of the horizontal to the vertical axis of the water particle orbits at the surface, coth(k depth), for the
    /// wave number `k` (rad/m).
    pub fn orbit_width_over_height(&self, k: f64) -> f64 {
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
        // The lowest phase speed on water: 0.23 m/s at 370 rad/m (Elfouhaily et al. 1997).
        let capillary = Dispersion::new(&Sea { dispersion: DispersionKind::Capillary, ..Sea::default() });
        let slowest =
            (100..1000).map(f64::from).min_by(|a, b| (capillary.omega(*a) / a).total_cmp(&(capillary.omega(*b) / b)));
        assert!((slowest.unwrap() - 365.0).abs() < 6.0 && (capillary.omega(370.0) / 370.0 - 0.231).abs() < 0.002);
        // A long wave over 2 m of water.
        let shallow = Dispersion::finite_depth(9.81, 2.0);
        assert!((shallow.omega(0.05) - 0.221).abs() < 0.001);
    }
}
