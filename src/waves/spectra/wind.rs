//! Spectra with one peak and one tail.

use super::Source;
use crate::state::params::DepthFactor;
use crate::waves::dispersion::Dispersion;
use std::f64::consts::PI;

/// Phillips' constant of a fully developed sea (Pierson and Moskowitz 1964).
const ALPHA: f64 = 8.1e-3;
/// The exponent's factor of Pierson-Moskowitz, for the wind at 19.5 m.
const PM_BETA: f64 = 0.74;
/// U(19.5 m) / U(10 m) over a neutral sea.
const U19_OVER_U10: f64 = 1.026;

/// alpha g^2 omega^-5 from the peak up (Phillips 1958); per rad/s, hence without a factor 2 pi.
#[derive(Clone, Debug, PartialEq)]
pub struct Phillips {
    a: f64,
    pub omega_p: f64,
}

impl Phillips {
    pub fn new(source: &Source<'_>) -> Self {
        let full = Ab::pierson_moskowitz(source);
        Self { a: full.a, omega_p: full.omega_p() }
    }

    pub fn density(&self, omega: f64) -> f64 {
        if omega < self.omega_p { 0.0 } else { self.a / omega.powi(5) }
    }
}

/// A omega^-5 exp(-B omega^-4).
#[derive(Clone, Debug, PartialEq)]
pub struct Ab {
    a: f64,
    b: f64,
}

impl Ab {
    /// A and B as given, else those of Pierson-Moskowitz.
    pub fn generalised(source: &Source<'_>) -> Self {
        let full = Self::pierson_moskowitz(source);
        let or = |own: f64, other: f64| if own > 0.0 { own } else { other };
        Self { a: or(source.system.coefficient_a, full.a), b: or(source.system.coefficient_b, full.b) }
    }

    /// B = beta (g / U19.5)^4 = 0.6678 (g / U10)^4 (Pierson and Moskowitz 1964).
    pub fn pierson_moskowitz(source: &Source<'_>) -> Self {
        let g = source.gravity();
        let b = match source.omega_p {
            Some(omega_p) => 1.25 * omega_p.powi(4),
            None => PM_BETA * (g / (U19_OVER_U10 * source.wind_m_s)).powi(4),
        };
        Self { a: ALPHA * g * g, b }
    }

    /// B = 5/4 omega_p^4.
    pub fn omega_p(&self) -> f64 {
        (0.8 * self.b).powf(0.25)
    }

    pub fn density(&self, omega: f64) -> f64 {
        self.a / omega.powi(5) * (-self.b / omega.powi(4)).exp()
    }
}

/// A exp(-1/(kL)^2) / k^4 |k.w|^2 over the wave-number plane, L = V^2/g (Tessendorf 2001). Integrated over directions it
/// is pi A exp(-1/(kL)^2) / k^3 over k; the factor cos^2 / pi that is left is the spreading.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessendorf {
    a: f64,
    length_m: f64,
}

impl Tessendorf {
    /// A = alpha / (2 pi) unless given: the equilibrium range is then Phillips'.
    pub fn new(source: &Source<'_>) -> Self {
        let g = source.gravity();
        let a = source.system.coefficient_a;
        let length_m = match source.omega_p {
            Some(omega_p) => {
                // The period is given: the length whose peak in deep or shallow water has it.
                0.8f64.sqrt() / Dispersion::new(source.sea).wave_number(omega_p)
            }
            None => source.wind_m_s * source.wind_m_s / g,
        };
        Self { a: if a > 0.0 { a } else { ALPHA / (2.0 * PI) }, length_m }
    }

    /// The peak of S(omega) in deep water lies at (k L)^2 = 4/5.
    pub fn k_p(&self) -> f64 {
        0.8f64.sqrt() / self.length_m
    }

    pub fn density_k(&self, k: f64) -> f64 {
        PI * self.a * (-1.0 / (k * self.length_m).powi(2)).exp() / k.powi(3)
    }
}

/// JONSWAP (Hasselmann et al. 1973), and TMA as its product with a depth factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Jonswap {
    /// alpha g^2.
    pub a: f64,
    pub omega_p: f64,
    gamma: f64,
    depth: Option<Depth>,
}

#[derive(Clone, Debug, PartialEq)]
struct Depth {
    form: DepthFactor,
    dispersion: Dispersion,
    gravity: f64,
    depth_m: f64,
}

/// Dimensionless fetch at which JONSWAP is as high as a fully developed sea, and at which it exceeds that by a quarter.
const FULL_FETCH: (f64, f64) = (1.1e4, 1.6e4);

/// What to say of a fetch that the wind cannot use: the fits of JONSWAP know no full development.
pub fn beyond_full_development(source: &Source<'_>) -> Option<String> {
    let given = source.system.hs_m > 0.0 || source.omega_p.is_some();
    (source.fetch() > FULL_FETCH.1 && !given).then(|| {
        let fetch_km = FULL_FETCH.0 * source.wind_m_s * source.wind_m_s / source.gravity() / 1000.0;
        format!(
            "a sea is fully developed after {fetch_km:.0} km of this wind (spectrum=pm); jonswap and tma go on growing"
        )
    })
}

impl Jonswap {
    /// Fetch in metres, cube root in omega_p.
    pub fn grown(source: &Source<'_>) -> Self {
        let (g, x) = (source.gravity(), source.fetch());
        let alpha = 0.076 * x.powf(-0.22);
        Self { a: alpha * g * g, omega_p: 22.0 * g / source.wind_m_s / x.cbrt(), gamma: 3.3, depth: None }
    }

    pub fn new(source: &Source<'_>) -> Self {
        let grown = Self::grown(source);
        Self { omega_p: source.omega_p.unwrap_or(grown.omega_p), gamma: source.system.gamma, ..grown }
    }

    /// The depth factor of Kitaigorodskii et al. 1975; alpha and gamma of Bouws et al. 1985 on request.
    pub fn tma(source: &Source<'_>) -> Self {
        let (g, sea) = (source.gravity(), source.sea);
        let mut out = Self::new(source).with_depth_factor(source);
        if sea.bouws {
            let k_p = Dispersion::finite(g, sea.depth_m).wave_number(out.omega_p);
            let kappa = source.wind_m_s * source.wind_m_s * k_p / g;
            out.a = 0.0078 * kappa.powf(0.49) * g * g;
            out.gamma = 2.47 * kappa.powf(0.39);
        }
        out
    }

    pub fn with_depth_factor(self, source: &Source<'_>) -> Self {
        let (gravity, depth_m) = (source.gravity(), source.sea.depth_m);
        let dispersion = Dispersion::finite(gravity, depth_m);
        Self { depth: Some(Depth { form: source.sea.depth_factor, dispersion, gravity, depth_m }), ..self }
    }

    pub fn density(&self, omega: f64) -> f64 {
        let r = omega / self.omega_p;
        let sigma = if r <= 1.0 { 0.07 } else { 0.09 };
        let bump = (-(r - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
        let deep = self.a / omega.powi(5) * (-1.25 / r.powi(4)).exp() * self.gamma.powf(bump);
        deep * self.depth.as_ref().map_or(1.0, |d| d.factor(omega))
    }

    /// Where the depth factor has kinks.
    pub fn joints(&self) -> Vec<f64> {
        let joint = |d: &Depth| [1.0, 2.0].map(|x| x / (d.depth_m / d.gravity).sqrt()).to_vec();
        self.depth.as_ref().filter(|d| d.form == DepthFactor::Branches).map_or(vec![], joint)
    }
}

impl Depth {
    fn factor(&self, omega: f64) -> f64 {
        match self.form {
            DepthFactor::Exact => {
                let kh = self.depth_m * self.dispersion.wave_number(omega);
                let curve = if kh > 300.0 { 0.0 } else { 2.0 * kh / (2.0 * kh).sinh() };
                kh.tanh().powi(2) / (1.0 + curve)
            }
            DepthFactor::Branches => match omega * (self.depth_m / self.gravity).sqrt() {
                x if x <= 1.0 => 0.5 * x * x,
                x if x < 2.0 => 1.0 - 0.5 * (2.0 - x).powi(2),
                _ => 1.0,
            },
        }
    }
}

/// MarNeRo (Trusca 2007): E = H_rms^2 / 8 = m0, and 2.302 instead of the 2.202 in print, which does not integrate to E.
#[derive(Clone, Debug, PartialEq)]
pub struct Marnero {
    m0: f64,
    mean_omega: f64,
}

impl Marnero {
    const POWER: f64 = 5.9285;
    const RATE: f64 = 0.3883;

    /// Peak over mean frequency: where the derivative of x^-(n+1) exp(-c x^-n) vanishes.
    fn peak() -> f64 {
        (Self::POWER * Self::RATE / (Self::POWER + 1.0)).powf(1.0 / Self::POWER)
    }

    pub fn new(source: &Source<'_>) -> Self {
        let (hs_m, omega_p) = source.height_and_peak();
        Self { m0: hs_m * hs_m / 16.0, mean_omega: omega_p / Self::peak() }
    }

    pub fn omega_p(&self) -> f64 {
        self.mean_omega * Self::peak()
    }

    pub fn density(&self, omega: f64) -> f64 {
        let x = self.mean_omega / omega;
        let norm = Self::POWER * Self::RATE;
        norm * self.m0 / self.mean_omega * x.powf(Self::POWER + 1.0) * (-Self::RATE * x.powf(Self::POWER)).exp()
    }
}

/// Donelan, Hamilton and Hui 1985: an omega^-4 range above the peak. Fitted for U/c_p of 0.83 (full development) to 5 and
/// up to about 3.5 omega_p; further up it holds more slope than the sea does.
#[derive(Clone, Debug, PartialEq)]
pub struct Donelan {
    /// alpha g^2 / omega_p.
    a: f64,
    pub omega_p: f64,
    gamma: f64,
    sigma: f64,
}

impl Donelan {
    pub fn new(source: &Source<'_>) -> Self {
        let (g, u) = (source.gravity(), source.wind_m_s);
        let grown = (11.6 * source.fetch().powf(-0.23)).clamp(0.83, 5.0);
        let omega_p = source.omega_p.unwrap_or(grown * g / u);
        let age = (u * omega_p / g).clamp(0.83, 5.0);
        let alpha = 0.006 * age.powf(0.55);
        let gamma = 1.7 + 6.0 * age.max(1.0).log10();
        Self { a: alpha * g * g / omega_p, omega_p, gamma, sigma: 0.08 * (1.0 + 4.0 / age.powi(3)) }
    }

    pub fn density(&self, omega: f64) -> f64 {
        let r = omega / self.omega_p;
        let bump = (-(r - 1.0).powi(2) / (2.0 * self.sigma * self.sigma)).exp();
        self.a / omega.powi(4) * (-1.0 / r.powi(4)).exp() * self.gamma.powf(bump)
    }
}
