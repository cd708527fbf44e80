//! Spectra that describe the short waves down to ripples.

use super::Source;
use super::wind::Jonswap;

/// Karaev and Balandina 2000, Karaev et al. 2008: JONSWAP up to 1.2 omega_m, then omega^-4, -5, -2.7, -5, continuous.
#[derive(Clone, Debug, PartialEq)]
pub struct Karaev {
    pub jonswap: Jonswap,
    /// Lower end, density there and falling power of each branch above the first.
    branches: [Branch; 4],
    pub notice: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Branch {
    from: f64,
    density: f64,
    power: f64,
}

impl Karaev {
    /// The dimensionless fetches g F / U^2 that the fit of the peak was made for.
    const FETCH: (f64, f64) = (1430.0, 20170.0);
    /// Where gravity-capillary and capillary waves begin, rad/s.
    const RIPPLES: (f64, f64) = (64.0, 298.0);

    pub fn new(source: &Source<'_>) -> Self {
        let (g, u) = (source.gravity(), source.wind_m_s);
        let x = source.fetch().clamp(Self::FETCH.0, Self::FETCH.1);
        let peak = 0.61826 + 3.529e-7 * x - 0.001_975_08 * x.sqrt() + 62.554 / x.sqrt() - 290.2 / x;
        let notice = (x != source.fetch()).then(|| {
            let fetch_km = x * u * u / g / 1000.0;
            format!("karaev is fitted to g F / U^2 from 1430 to 20170: a fetch of {fetch_km:.0} km was used")
        });
        let mut jonswap = Jonswap::new(source);
        jonswap.a = 0.076 * x.powf(-0.22) * g * g;
        jonswap.omega_p = source.omega_p.unwrap_or(peak * g / u);
        if source.sea.karaev_tma {
            jonswap = jonswap.with_depth_factor(source);
        }
        let omega_m = jonswap.omega_p;
        let reach = (0.3713 + 0.29024 * u + 0.2902 / u).max(1.2);
        let first = 1.2 * omega_m;
        let second = reach * omega_m;
        let third = second.max(Self::RIPPLES.0);
        let fourth = third.max(Self::RIPPLES.1);
        let mut density = jonswap.density(first);
        let mut branches = [Branch { from: first, density, power: 4.0 }; 4];
        for (i, (from, power)) in [(second, 5.0), (third, 2.7), (fourth, 5.0)].into_iter().enumerate() {
            let before = branches[i];
            density *= (before.from / from).powf(before.power);
            branches[i + 1] = Branch { from, density, power };
        }
        Self { jonswap, branches, notice }
    }

    pub fn density(&self, omega: f64) -> f64 {
        match self.branches.iter().rev().find(|b| omega > b.from) {
            None => self.jonswap.density(omega),
            Some(b) => b.density * (b.from / omega).powf(b.power),
        }
    }

    /// Where the branches meet, rad/s.
    pub fn joints(&self) -> [f64; 4] {
        self.branches.map(|b| b.from)
    }
}

/// Elfouhaily, Chapron, Katsaros and Vandemark 1997, as a density over k.
#[derive(Clone, Debug, PartialEq)]
pub struct Elfouhaily {
    pub k_p: f64,
    gravity: f64,
    /// Inverse wave age U / c_p.
    age: f64,
    alpha_p: f64,
    alpha_m: f64,
    gamma: f64,
    sigma: f64,
}

/// Wave number (rad/m) and phase speed (m/s) of the slowest waves.
pub const SLOWEST: (f64, f64) = (370.0, 0.23);

/// Friction velocity of the wind, m/s: drag coefficient of Wu 1982.
pub fn friction_velocity(wind_m_s: f64) -> f64 {
    wind_m_s * (1e-3 * (0.8 + 0.065 * wind_m_s)).sqrt()
}

impl Elfouhaily {
    pub fn new(source: &Source<'_>) -> Self {
        let (g, u) = (source.gravity(), source.wind_m_s);
        let grown = 0.84 * ((source.fetch() / 2.2e4).powf(0.4)).tanh().powf(-0.75);
        let omega_p = source.omega_p.unwrap_or(grown.clamp(0.84, 5.0) * g / u);
        let age = (u * omega_p / g).clamp(0.84, 5.0);
        let friction = friction_velocity(u) / SLOWEST.1;
        let growth = 1.0 + if friction < 1.0 { friction.ln() } else { 3.0 * friction.ln() };
        Self {
            k_p: omega_p * omega_p / g,
            gravity: g,
            age,
            alpha_p: 6e-3 * age.sqrt(),
            alpha_m: (0.01 * growth).max(0.0),
            gamma: 1.7 + 6.0 * age.max(1.0).log10(),
            sigma: 0.08 * (1.0 + 4.0 / age.powi(3)),
        }
    }

    /// S(k) = k^-3 (B_low + B_high), m^3.
    pub fn density_k(&self, k: f64) -> f64 {
        let (k_m, c_m) = SLOWEST;
        // Phase speed as in the paper, with its own surface tension.
        let speed = |k: f64| (self.gravity / k * (1.0 + (k / k_m).powi(2))).sqrt();
        let c = speed(k);
        let ratio = (k / self.k_p).sqrt();
        let pierson_moskowitz = (-1.25 / ratio.powi(4)).exp();
        let bump = (-(ratio - 1.0).powi(2) / (2.0 * self.sigma * self.sigma)).exp();
        let long = pierson_moskowitz * self.gamma.powf(bump) * (-self.age / 10f64.sqrt() * (ratio - 1.0)).exp();
        // The factor of Pierson-Moskowitz keeps the ripples' part out of the long waves.
        let short = pierson_moskowitz * (-0.25 * (k / k_m - 1.0).powi(2)).exp();
        let curvature = 0.5 * (self.alpha_p * speed(self.k_p) * long + self.alpha_m * c_m * short) / c;
        curvature / k.powi(3)
    }
}

/// Delta of Elfouhaily's spreading (1 + Delta cos 2 theta) / (2 pi) at phase speed `c`, peak speed `c_p` (m/s).
pub fn elfouhaily_delta(c: f64, c_p: f64, wind_m_s: f64) -> f64 {
    let ripples = 0.13 * friction_velocity(wind_m_s) / SLOWEST.1;
    let (a_0, a_p) = (2f64.ln() / 4.0, 4.0);
    (a_0 + a_p * (c / c_p).powf(2.5) + ripples * (SLOWEST.1 / c).powf(2.5)).tanh()
}
