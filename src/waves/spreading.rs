//! Directional spreading D(omega, theta) of wave energy, per rad: its integral over all directions is 1. Theta is the
//! angle from the main direction of travel of the wave system.
//!
//! D is an isotropic part plus a sum of lobes. Every lobe has the form norm x sech^2(beta theta) x cos^{2s}(theta/2) x
//! cosine factor, so the shader needs only a weight, beta and s for each lobe. The swell parameter xi adds
//! s_xi = 16 tanh(omega_p/omega) xi^2 to s (Horvath 2015); lobes without a cos^{2s} factor get one with s = s_xi.

use super::dispersion::Dispersion;
use super::quadrature::integrate_panels;
use super::spectra::{FrequencySpectrum, elfouhaily_delta};
use crate::state::params::{Sea, SpreadKind, WaveSystemParams};
use std::f64::consts::PI;

/// Largest number of lobes of one wave system: two for Elfouhaily's spreading, blended with one of another family.
pub(super) const MAX_LOBES: usize = 3;
/// Largest exponent s of a lobe cos^{2s}(theta/2). A lobe with a larger s has a standard deviation below 7 degrees,
/// which the lattice of wave vectors cannot resolve at the low edge of a cascade's wave-number band.
const MAX_COSINE_EXPONENT: f64 = 150.0;

/// Directional spreading of one wave system: how its energy at each frequency is distributed over directions.
#[derive(Clone, Debug)]
pub struct Spreading {
    /// Families of directional spreading, each with its fraction of the energy; they add to 1 with `isotropic`.
    families: Vec<(SpreadKind, f64)>,
    /// Fraction of the energy that is spread evenly over all directions.
    isotropic: f64,
    /// Swell parameter xi of Horvath 2015, 0 to 1, which narrows the spreading of long waves.
    swell: f64,
    /// Angular frequency at the peak of the wave system's spectrum, rad/s.
    omega_p: f64,
    wind_m_s: f64,
    /// Inverse wave age U omega_p / g for the wind speed U at 10 m height.
    inverse_age: f64,
    dispersion: Dispersion,
    /// Number of 15-point Kronrod panels in each piece of the integral that normalises a lobe without a closed form.
    pub spreading_norm_panels: u32,
}

/// Factor 1 or cos^2(theta) of a directional spreading lobe; theta is the angle from the main direction of travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CosineFactor {
    /// The constant 1: no cosine factor.
    One,
    /// cos^2(theta) over the whole circle: as much energy against the main direction of travel as along it.
    Squared,
    /// cos^2(theta) within 90 degrees of the main direction of travel, 0 beyond.
    SquaredForward,
}

/// One lobe of the directional spreading at one frequency: sech^2(beta theta) x cos^{2s}(theta/2) x cosine factor,
/// where theta is the angle from the main direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Rate beta of the lobe's factor sech^2(beta theta), per rad; 0 if the lobe has no such factor.
    pub sech_rate_per_rad: f64,
    /// Exponent s of the lobe's factor cos^{2s}(theta/2); 0 if the lobe has no such factor.
    pub cosine_exponent: f64,
    /// Additional factor of the lobe: 1, or cos^2(theta) over the whole circle or its forward half.
    pub cosine_factor: CosineFactor,
}

/// Directional spreading at one frequency, as an isotropic part and lobes whose fractions of the energy add to 1.
pub struct SpreadingAtFrequency {
    /// Fraction of the energy that is spread evenly over all directions.
    pub isotropic_fraction: f64,
    /// Lobes, as pairs of the lobe's fraction of the energy and its shape.
    pub lobes: Vec<(f64, Lobe)>,
}

impl Spreading {
    /// Makes the directional spreading of a wave system from its parameters and its frequency spectrum.
    pub fn new(sea: &Sea, system: &WaveSystemParams, spectrum: &FrequencySpectrum) -> Self {
        let omega_p = spectrum.omega_p;
        let (first, second, blend, mut isotropic) = if spectrum.has_own_spreading {
            (SpreadKind::Cos2, SpreadKind::Cos2, 0.0, 0.0)
        } else {
            (system.spread, system.blend_to, system.blend_weight, system.isotropic_fraction)
        };
        let directed = 1.0 - isotropic;
        let mut families = Vec::new();
        // A blend of a spreading with itself is that spreading.
        let blend = if first == second { 0.0 } else { blend };
        for (kind, share) in [(first, (1.0 - blend) * directed), (second, blend * directed)] {
            if kind == SpreadKind::Isotropic && system.swell == 0.0 {
                isotropic += share;
            } else if share > 0.0 {
                families.push((kind, share));
            }
        }
        Self {
            families,
            isotropic,
            swell: system.swell,
            omega_p,
            wind_m_s: system.wind_m_s,
            inverse_age: system.wind_m_s * omega_p / sea.gravity_m_s2,
            dispersion: Dispersion::new(sea),
            spreading_norm_panels: sea.spreading_norm_panels,
        }
    }

    /// Directional spreading at the angular frequency `omega` (rad/s, positive), as an isotropic part and lobes. The
    /// number of lobes and their cosine factors are the same at every frequency.
    pub fn lobes(&self, omega: f64) -> SpreadingAtFrequency {
        let r = omega / self.omega_p;
        let swell_s = 16.0 * (1.0 / r).tanh() * self.swell * self.swell;
        let lobe = |beta, s: f64, cosine| Lobe {
            sech_rate_per_rad: beta,
            cosine_exponent: (s + swell_s).min(MAX_COSINE_EXPONENT),
            cosine_factor: cosine,
        };
        let mut lobes = Vec::with_capacity(MAX_LOBES);
        for &(kind, share) in &self.families {
            let lobe = match kind {
                SpreadKind::Isotropic => lobe(0.0, 0.0, CosineFactor::One),
                SpreadKind::Cos2 => lobe(0.0, 0.0, CosineFactor::Squared),
                SpreadKind::Cos2Positive => lobe(0.0, 0.0, CosineFactor::SquaredForward),
                SpreadKind::Mitsuyasu => lobe(0.0, mitsuyasu_s(r, self.inverse_age), CosineFactor::One),
                SpreadKind::Hasselmann => lobe(0.0, hasselmann_s(r, self.inverse_age), CosineFactor::One),
                SpreadKind::DonelanBanner => lobe(donelan_banner_beta(r), 0.0, CosineFactor::One),
                SpreadKind::Elfouhaily => {
                    // (1 + Delta cos 2 theta) / 2 pi = ((1 - Delta) + 2 Delta cos^2 theta) / 2 pi, both terms times the
                    // swell factor. Normalisation of the product keeps their proportion.
                    let speed = |omega: f64| omega / self.dispersion.wave_number(omega);
                    let delta = elfouhaily_delta(speed(omega), speed(self.omega_p), self.wind_m_s);
                    let terms = [CosineFactor::One, CosineFactor::Squared].map(|c| lobe(0.0, 0.0, c));
                    let [even, squared] = terms.map(|lobe| lobe.normalising_factor(self.spreading_norm_panels));
                    let parts = [(1.0 - delta) / even, 2.0 * delta / squared];
                    lobes.extend([0, 1].map(|i| (share * parts[i] / (parts[0] + parts[1]), terms[i])));
                    continue;
                }
            };
            lobes.push((share, lobe));
        }
        SpreadingAtFrequency { isotropic_fraction: self.isotropic, lobes }
    }

    /// Directional spreading D, per rad, at angular frequency `omega` (rad/s) and angle `theta` (rad, from the main
    /// direction of travel to the direction of travel of the waves). Its integral over all directions is 1.
    pub fn density(&self, omega: f64, theta: f64) -> f64 {
        let at = self.lobes(omega);
        let sum: f64 = at
            .lobes
            .iter()
            .map(|(share, lobe)| {
                share * lobe.normalising_factor(self.spreading_norm_panels) * lobe.unnormalised_density(theta)
            })
            .sum();
        sum + at.isotropic_fraction / (2.0 * PI)
    }

    /// First directional moment, 0 to 1, at the angular frequency `omega` (rad/s): the mean of cos(theta) weighted by
    /// the directional spreading, where theta is the angle from the main direction of travel.
    pub fn first_moment(&self, omega: f64) -> f64 {
        self.lobes(omega).lobes.iter().map(|(share, lobe)| share * lobe.first_moment(self.spreading_norm_panels)).sum()
    }

    /// Angular frequencies (rad/s) at which the shape of a lobe changes with a kink or jump; integrals are split there.
    pub fn breakpoints(&self) -> Vec<f64> {
        let relative = |kind: SpreadKind| -> &[f64] {
            match kind {
                SpreadKind::Mitsuyasu | SpreadKind::Hasselmann => &[1.0],
                SpreadKind::DonelanBanner => &[0.95, 1.6],
                _ => &[],
            }
        };
        self.families.iter().flat_map(|&(kind, _)| relative(kind)).map(|r| r * self.omega_p).collect()
    }
}

/// Exponent s of the spreading cos^{2s}(theta/2) by Mitsuyasu et al. 1975: s_p r^5 below and s_p r^-2.5 above the
/// spectral peak, with `r` = omega / omega_p, s_p = 11.5 `inverse_age`^-2.5 and the inverse wave age `inverse_age` =
/// U omega_p / g for the wind speed U.
fn mitsuyasu_s(r: f64, inverse_age: f64) -> f64 {
    let peak = 11.5 * inverse_age.max(1e-3).powf(-2.5);
    (peak * r.powf(if r <= 1.0 { 5.0 } else { -2.5 })).min(MAX_COSINE_EXPONENT)
}

/// Exponent s of the spreading cos^{2s}(theta/2) by Hasselmann, Dunckel and Ewing 1980: 6.97 r^4.06 below and
/// 9.77 r^(-2.33 - 1.45 (a - 1.17)) above the spectral peak, with `r` = omega / omega_p and the inverse wave age a =
/// `inverse_age` = U omega_p / g for the wind speed U.
fn hasselmann_s(r: f64, inverse_age: f64) -> f64 {
    if r <= 1.0 { 6.97 * r.powf(4.06) } else { 9.77 * r.powf(-2.33 - 1.45 * (inverse_age - 1.17)) }
        .min(MAX_COSINE_EXPONENT)
}

/// Rate beta (per rad) of the directional spreading sech^2(beta theta) at `r` = omega / omega_p (frequency over peak
/// frequency), by Donelan et al. 1985 and, for r above 1.6, by Banner 1990.
fn donelan_banner_beta(r: f64) -> f64 {
    if r < 0.95 {
        2.61 * r.powf(1.3)
    } else if r < 1.6 {
        2.28 * r.powf(-1.3)
    } else {
        10f64.powf(-0.4 + 0.8393 * (-0.567 * (r * r).ln()).exp())
    }
}

impl Lobe {
    /// Value of the lobe (1 at theta = 0) at the angle `theta` (rad) from the main direction of travel, not normalised.
    pub fn unnormalised_density(&self, theta: f64) -> f64 {
        let sech = 1.0 / (self.sech_rate_per_rad * theta).cosh();
        let cosine = match self.cosine_factor {
            CosineFactor::One => 1.0,
            CosineFactor::Squared => theta.cos().powi(2),
            CosineFactor::SquaredForward => theta.cos().max(0.0).powi(2),
        };
        sech * sech * (0.5 + 0.5 * theta.cos()).max(0.0).powf(self.cosine_exponent) * cosine
    }

    /// Integral of `f`(theta) times the lobe from 0 to pi rad, in up to six pieces of up to `steps` 15-point Kronrod
    /// panels. The pieces are short inside the lobe and near pi, where cos^{2s}(theta/2) with a small s is not smooth.
    fn half_circle_integral(&self, f: impl Fn(f64) -> f64, steps: u32) -> f64 {
        let width = (3.0
            / (self.sech_rate_per_rad * self.sech_rate_per_rad + 0.25 * self.cosine_exponent).sqrt().max(1e-3))
        .min(0.4 * PI);
        let ends = [0.0, 0.4 * width, width, 0.5 * PI, PI - 0.1, PI - 0.005, PI];
        let pieces = if self.cosine_factor == CosineFactor::SquaredForward { &ends[..4] } else { &ends };
        integrate_panels(|theta| f(theta) * self.unnormalised_density(theta), pieces, steps)
    }

    /// Norm of the lobe, the factor that makes its integral over all directions 1: in closed form if there is one,
    /// otherwise by quadrature with up to `steps` 15-point Kronrod panels in each of up to six pieces of the half
    /// circle.
    pub fn normalising_factor(&self, steps: u32) -> f64 {
        self.closed_form_normalising_factor().unwrap_or_else(|| 1.0 / (2.0 * self.half_circle_integral(|_| 1.0, steps)))
    }

    /// Norm of the lobe (the inverse of its integral over all directions) in closed form; `None` without such a form.
    pub fn closed_form_normalising_factor(&self) -> Option<f64> {
        Some(match self.cosine_factor {
            // beta / (2 tanh(beta pi)); its limit for beta = 0 is 1 / (2 pi).
            CosineFactor::One if self.cosine_exponent == 0.0 && self.sech_rate_per_rad < 1e-6 => 1.0 / (2.0 * PI),
            CosineFactor::One if self.cosine_exponent == 0.0 => {
                self.sech_rate_per_rad / (2.0 * (self.sech_rate_per_rad * PI).tanh())
            }
            CosineFactor::One if self.sech_rate_per_rad == 0.0 => cosine_power_normalising_factor(self.cosine_exponent),
            // cos^2 = (1 + cos 2 theta) / 2; the second moment of cos^{2s}(theta/2) is s (s - 1) / ((s + 1)(s + 2)).
            CosineFactor::Squared if self.sech_rate_per_rad == 0.0 => {
                let second = self.cosine_exponent * (self.cosine_exponent - 1.0)
                    / ((self.cosine_exponent + 1.0) * (self.cosine_exponent + 2.0));
                2.0 * cosine_power_normalising_factor(self.cosine_exponent) / (1.0 + second)
            }
            CosineFactor::SquaredForward if self.cosine_exponent == 0.0 && self.sech_rate_per_rad == 0.0 => 2.0 / PI,
            _ => return None,
        })
    }

    /// First directional moment, 0 to 1, of the lobe: the mean of cos(theta) weighted by the lobe, where theta is the
    /// angle from the main direction of travel. `steps` is as in
    /// [`Self::normalising_factor`]; the integral of cos(theta) takes 2.
    pub fn first_moment(&self, steps: u32) -> f64 {
        if self.cosine_factor == CosineFactor::One && self.sech_rate_per_rad == 0.0 {
            return self.cosine_exponent / (self.cosine_exponent + 1.0);
        }
        if self.cosine_factor == CosineFactor::Squared && self.cosine_exponent == 0.0 && self.sech_rate_per_rad == 0.0 {
            return 0.0;
        }
        2.0 * self.normalising_factor(steps) * self.half_circle_integral(f64::cos, 2)
    }
}

/// Norm of cos^{2s}(theta/2), the inverse of its integral over the circle: 2^{2s-1}/pi Gamma(s+1)^2 / Gamma(2s+1). It
/// uses ln Gamma, because Gamma would overflow and Stirling's approximation is 8 % off at s = 0.
fn cosine_power_normalising_factor(s: f64) -> f64 {
    ((2.0 * s - 1.0) * std::f64::consts::LN_2 - PI.ln() + 2.0 * libm::lgamma(s + 1.0) - libm::lgamma(2.0 * s + 1.0))
        .exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::quadrature::integrate_adaptive;
    use crate::waves::spectra;

    const KINDS: [SpreadKind; 7] = [
        SpreadKind::Isotropic,
        SpreadKind::Cos2,
        SpreadKind::Cos2Positive,
        SpreadKind::Mitsuyasu,
        SpreadKind::Hasselmann,
        SpreadKind::DonelanBanner,
        SpreadKind::Elfouhaily,
    ];

    fn spreading(system: &WaveSystemParams) -> Spreading {
        let sea = Sea::default();
        let spectrum = spectra::spectrum_of_system(&sea, system);
        Spreading::new(&sea, system, &spectrum)
    }

    fn assert_unit(system: &WaveSystemParams) {
        let d = spreading(system);
        for i in 0..60 {
            let omega = d.omega_p * 0.1 * 200f64.powf(f64::from(i) / 59.0);
            let knots = [-PI, -0.5 * PI, -0.5, 0.0, 0.5, 0.5 * PI, PI];
            let total = integrate_adaptive(|theta| d.density(omega, theta), &knots, 1e-8);
            assert!((total - 1.0).abs() < 1e-5, "{system:?} omega {omega}: {total}");
        }
    }

    #[test]
    fn every_family_integrates_to_one() {
        for spread in KINDS {
            for swell in [0.0, 0.01, 0.3, 1.0] {
                assert_unit(&WaveSystemParams { spread, swell, ..Sea::default().systems[0].clone() });
            }
        }
    }

    #[test]
    fn every_blend_integrates_to_one() {
        for spread in KINDS {
            for blend_to in KINDS {
                let local = Sea::default().systems[0].clone();
                assert_unit(&WaveSystemParams {
                    spread,
                    blend_to,
                    blend_weight: 0.3,
                    isotropic_fraction: 0.2,
                    swell: 0.5,
                    ..local
                });
            }
        }
    }

    #[test]
    fn a_blend_ends_on_its_families() {
        let local = Sea::default().systems[0].clone();
        let at = |blend: f64, isotropic: f64| {
            let d = spreading(&WaveSystemParams {
                blend_to: SpreadKind::Cos2Positive,
                blend_weight: blend,
                isotropic_fraction: isotropic,
                ..local.clone()
            });
            [0.0, 1.0, 2.0].map(|theta| d.density(1.3 * d.omega_p, theta))
        };
        assert_eq!(at(1.0, 0.0)[0], 2.0 / PI);
        assert_eq!(at(0.4, 1.0), [1.0 / (2.0 * PI); 3]);
        let (a, b, half) = (at(0.0, 0.0), at(1.0, 0.0), at(0.5, 0.0));
        for i in 0..3 {
            assert!((half[i] - 0.5 * (a[i] + b[i])).abs() < 1e-12);
        }
    }

    #[test]
    fn known_exponents() {
        // The inverse wave age is 1.028 at U = 10 m/s and F = 100 km.
        assert!((hasselmann_s(3.0, 1.028) - 0.948).abs() < 0.005, "{}", hasselmann_s(3.0, 1.028));
        assert!((mitsuyasu_s(1.0, 1.028) - 10.74).abs() < 0.03);
        assert!((donelan_banner_beta(1.6) - 1.24).abs() < 0.01);
    }

    #[test]
    fn few_steps_are_felt() {
        let lobe = Lobe { sech_rate_per_rad: 2.0, cosine_exponent: 0.02, cosine_factor: CosineFactor::One };
        let exact = lobe.normalising_factor(64);
        let errors = [1, 2, 4].map(|steps| (lobe.normalising_factor(steps) / exact - 1.0).abs());
        assert!(errors[1] < 1e-7 && errors[0] > errors[1], "the number of steps counts: {errors:?}");
    }
}
