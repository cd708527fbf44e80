//! Directional spreading D(omega, theta): integral over the circle = 1, theta measured from the waves' mean direction.
//!
//! Every family is written in one form, norm x sech^2(beta theta) x cos^{2s}(theta/2), so that the shader needs two
//! numbers per frequency: isotropic has beta = s = 0, the cosine families beta = 0, Donelan-Banner s = 0. Swell adds
//! s_xi = 16 tanh(omega_p/omega) xi^2 to s (Horvath 2015): the sum for the cosine families, the product for the others.

use super::params::{Sea, SpreadKind};
use super::quadrature::gauss_legendre;
use std::f64::consts::PI;

/// The spreading of one sea state.
#[derive(Clone, Debug, PartialEq)]
pub struct Spreading {
    kind: SpreadKind,
    swell: f64,
    omega_p: f64,
    /// Inverse wave age U omega_p / g.
    inverse_age: f64,
}

/// The spreading at one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Rate of sech^2(beta theta), per rad.
    pub beta: f64,
    /// Exponent of cos^{2s}(theta/2).
    pub s: f64,
}

impl Spreading {
    /// The spreading of a sea whose peak is at `omega_p` rad/s.
    pub fn new(sea: &Sea, omega_p: f64) -> Self {
        let inverse_age = sea.wind_m_s * omega_p / sea.gravity_m_s2;
        Self { kind: sea.spread, swell: sea.swell, omega_p, inverse_age }
    }

    /// Exponent and rate at a frequency (rad/s, positive).
    pub fn lobe(&self, omega: f64) -> Lobe {
        let r = omega / self.omega_p;
        let (beta, s) = match self.kind {
            SpreadKind::Isotropic => (0.0, 0.0),
            SpreadKind::Mitsuyasu => (0.0, mitsuyasu_s(r, self.inverse_age)),
            SpreadKind::Hasselmann => (0.0, hasselmann_s(r, self.inverse_age)),
            SpreadKind::DonelanBanner => (donelan_banner_beta(r), 0.0),
        };
        Lobe { beta, s: s + 16.0 * (1.0 / r).tanh() * self.swell * self.swell }
    }

    /// Frequencies at which the lobe has a kink or a jump.
    pub fn breakpoints(&self) -> Vec<f64> {
        let relative: &[f64] = match self.kind {
            SpreadKind::Isotropic => &[],
            SpreadKind::Mitsuyasu | SpreadKind::Hasselmann => &[1.0],
            SpreadKind::DonelanBanner => &[0.95, 1.6],
        };
        relative.iter().map(|r| r * self.omega_p).collect()
    }
}

/// s_p (w/wp)^5 below and ^-2.5 above the peak, s_p = 11.5 (wp U/g)^-2.5 (Mitsuyasu et al. 1975).
fn mitsuyasu_s(r: f64, inverse_age: f64) -> f64 {
    let peak = 11.5 * inverse_age.max(1e-3).powf(-2.5);
    (peak * r.powf(if r <= 1.0 { 5.0 } else { -2.5 })).min(MAX_S)
}

/// 6.97 (w/wp)^4.06 below, 9.77 (w/wp)^mu above the peak (Hasselmann, Dunckel and Ewing 1980).
fn hasselmann_s(r: f64, inverse_age: f64) -> f64 {
    if r <= 1.0 { 6.97 * r.powf(4.06) } else { 9.77 * r.powf(-2.33 - 1.45 * (inverse_age - 1.17)) }.min(MAX_S)
}

/// Donelan et al. 1985 with Banner's 1990 tail.
fn donelan_banner_beta(r: f64) -> f64 {
    if r < 0.95 {
        2.61 * r.powf(1.3)
    } else if r < 1.6 {
        2.28 * r.powf(-1.3)
    } else {
        10f64.powf(-0.4 + 0.8393 * (-0.567 * (r * r).ln()).exp())
    }
}

/// Above this the lobe is narrower than two degrees and no lattice resolves it.
const MAX_S: f64 = 400.0;

impl Lobe {
    /// sech^2(beta theta) cos^{2s}(theta/2), not normalised; theta in rad, any sign, |theta| <= pi.
    pub fn shape(&self, theta: f64) -> f64 {
        let sech = 1.0 / (self.beta * theta).cosh();
        sech * sech * (0.5 + 0.5 * theta.cos()).max(0.0).powf(self.s)
    }

    /// The factor that makes the integral over the circle 1: closed forms where one factor is absent, quadrature else.
    pub fn norm(&self) -> f64 {
        if self.s == 0.0 {
            // beta / (2 tanh(beta pi)), with its limit 1 / (2 pi).
            return if self.beta < 1e-6 { 1.0 / (2.0 * PI) } else { self.beta / (2.0 * (self.beta * PI).tanh()) };
        }
        if self.beta == 0.0 {
            return cosine_norm(self.s);
        }
        // The last knot grades towards theta = pi, where cos^{2s} with a small s has no derivative.
        let width = self.width().min(0.9 * PI);
        1.0 / (2.0 * gauss_legendre(|theta| self.shape(theta), &[0.0, 0.4 * width, width, PI - 0.1, PI - 0.005, PI]))
    }

    /// D(theta), per rad.
    pub fn density(&self, theta: f64) -> f64 {
        self.norm() * self.shape(theta)
    }

    /// An angle that holds nearly all of the lobe, rad.
    fn width(&self) -> f64 {
        3.0 / (self.beta * self.beta + 0.25 * self.s).sqrt().max(1e-3)
    }
}

/// 2^{2s-1}/pi Gamma(s+1)^2 / Gamma(2s+1), through lgamma: the direct form overflows and Stirling is 8 % off at s = 0.
fn cosine_norm(s: f64) -> f64 {
    ((2.0 * s - 1.0) * std::f64::consts::LN_2 - PI.ln() + 2.0 * libm::lgamma(s + 1.0) - libm::lgamma(2.0 * s + 1.0))
        .exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::quadrature::adaptive;

    #[test]
    fn every_lobe_integrates_to_one() {
        for kind in [SpreadKind::Isotropic, SpreadKind::Mitsuyasu, SpreadKind::Hasselmann, SpreadKind::DonelanBanner] {
            for swell in [0.0, 0.3, 1.0] {
                let sea = Sea { spread: kind, swell, ..Sea::default() };
                let spreading = Spreading::new(&sea, 0.8);
                for i in 0..60 {
                    let omega = 0.8 * 0.1 * 200f64.powf(f64::from(i) / 59.0);
                    let lobe = spreading.lobe(omega);
                    let norm = lobe.norm();
                    let total = adaptive(|theta| norm * lobe.shape(theta), &[-PI, -0.5, 0.0, 0.5, PI], 1e-10);
                    assert!((total - 1.0).abs() < 1e-7, "{kind:?} swell {swell} omega {omega}: {total}");
                }
            }
        }
    }
}
