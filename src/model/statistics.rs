//! What is known of a sea without simulating it: integrals of the spectrum, and sums over the waves of the lattices.

use super::plan::Plan;
use super::quadrature::adaptive;
use super::table;
use super::{dispersion, noise};
use std::f64::consts::{PI, TAU};

/// Integrals of the spectrum by adaptive quadrature, independent of the plan's sums.
#[derive(Clone, Debug, PartialEq)]
pub struct Theory {
    /// Variance of the elevation, m^2.
    pub m0_m2: f64,
    /// Significant wave height 4 sqrt(m0), m.
    pub hs_m: f64,
    /// Peak period, s.
    pub tp_s: f64,
    /// Mean zero-crossing period 2 pi sqrt(m0 / m2), s, of the spectrum up to `k_max`.
    pub tm02_s: f64,
    /// Wavelength of the peak, m.
    pub lambda_p_m: f64,
    /// Mean square slope up to `k_max`.
    pub mss: f64,
    /// Wave number at which `mss` and `tm02_s` end, rad/m.
    pub k_max: f64,
    /// Mean direction that the waves come from, degrees clockwise from north; None where there is none.
    pub mean_from_deg: Option<f64>,
    /// Energy-weighted directional spread sqrt(2 (1 - r1)), degrees.
    pub spread_deg: f64,
}

/// Sums over the waves that the cascades hold: expectations, no randomness.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Variance of the elevation, m^2.
    pub m0_m2: f64,
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Mean square slope.
    pub mss: f64,
    /// Share of the theory's m0.
    pub m0_fraction: f64,
    /// Mean direction that the waves come from, degrees; None where there is none.
    pub mean_from_deg: Option<f64>,
    /// Energy-weighted directional spread, degrees.
    pub spread_deg: f64,
}

const TOLERANCE: f64 = 1e-7;
/// Below this first directional moment a mean direction means nothing.
const NO_DIRECTION: f64 = 0.01;

impl Theory {
    /// Integrates the spectrum of a plan.
    pub fn new(plan: &Plan) -> Self {
        let k_max = plan.k_max();
        if plan.spectrum.is_calm() {
            return Self {
                m0_m2: 0.0,
                hs_m: 0.0,
                tp_s: 0.0,
                tm02_s: 0.0,
                lambda_p_m: 0.0,
                mss: 0.0,
                k_max,
                mean_from_deg: None,
                spread_deg: 0.0,
            };
        }
        let (h, g) = (plan.sea.depth_m, plan.sea.gravity_m_s2);
        let s = |w: f64| plan.spectrum.density(w);
        let (low, high) = plan.spectrum.support();
        let mut knots: Vec<f64> = plan.spectrum.breakpoints().into_iter().chain(plan.spreading.breakpoints()).collect();
        knots.sort_by(f64::total_cmp);
        let span = |end: f64| {
            let inner = knots.iter().copied().filter(|&w| w > low && w < end);
            std::iter::once(low).chain(inner).chain([(low * end).sqrt(), end]).collect::<Vec<f64>>()
        };
        let sorted = |end: f64| {
            let mut v = span(end);
            v.sort_by(f64::total_cmp);
            v
        };
        let m0 = adaptive(s, &sorted(high), TOLERANCE);
        let end = dispersion::omega(k_max, h, g).clamp(low * 1.001, high);
        let m2 = adaptive(|w| w * w * s(w), &sorted(end), TOLERANCE);
        let mss = adaptive(|w| s(w) * dispersion::wave_number(w, h, g).powi(2), &sorted(end), TOLERANCE);
        let toward = adaptive(|w| s(w) * first_moment(plan, w), &sorted(high), 1e-6) / m0;
        let omega_peak = peak(s, plan.spectrum.omega_p);
        Self {
            m0_m2: m0,
            hs_m: 4.0 * m0.sqrt(),
            tp_s: TAU / omega_peak,
            tm02_s: TAU * (m0 / m2).sqrt(),
            lambda_p_m: TAU / dispersion::wave_number(omega_peak, h, g),
            mss,
            k_max,
            mean_from_deg: (toward > NO_DIRECTION).then_some(plan.sea.from_deg),
            spread_deg: spread_deg(toward),
        }
    }
}

impl Resolved {
    /// Sums over the lattices of a plan; `theory_m0` is what the fraction refers to.
    pub fn new(plan: &Plan, theory_m0: f64) -> Self {
        let (mut m0, mut mss, mut x, mut z) = (0.0, 0.0, 0.0, 0.0);
        for (wave, [kx, kz], variance) in waves(plan) {
            m0 += variance;
            mss += variance * wave * wave;
            x += variance * kx / wave;
            z += variance * kz / wave;
        }
        let r1 = x.hypot(z) / m0.max(f64::MIN_POSITIVE);
        Self {
            m0_m2: m0,
            hs_m: 4.0 * m0.sqrt(),
            mss,
            m0_fraction: if theory_m0 > 0.0 { m0 / theory_m0 } else { 1.0 },
            mean_from_deg: (r1 > NO_DIRECTION).then(|| from_deg([x, z])),
            spread_deg: spread_deg(r1),
        }
    }
}

/// Direction that waves travelling along (x, z) come from, degrees clockwise from north in [0, 360).
pub fn from_deg([x, z]: [f64; 2]) -> f64 {
    (-x).atan2(z).to_degrees().rem_euclid(360.0)
}

/// Whitecap coverage by wind speed, W = 3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980), at most 1.
pub fn monahan_coverage(wind_m_s: f64) -> f64 {
    (3.84e-6 * wind_m_s.powf(3.41)).min(1.0)
}

/// Mean square slope of the sea surface, 0.003 + 0.00512 U (Cox and Munk 1954).
pub fn cox_munk_mss(wind_m_s: f64) -> f64 {
    0.003 + 0.00512 * wind_m_s
}

/// Variance of the sea of a plan's seed at `t_s`, m^2, as the sum of the squared amplitudes that were drawn (Parseval).
pub fn drawn_variance(plan: &Plan, t_s: f64) -> f64 {
    let phase_time = plan.phase_time(t_s);
    let mut total = 0.0;
    for cascade in &plan.cascades {
        let rows = table::rows(plan, cascade);
        let half = plan.n as i32 / 2;
        let draw = |ix: i32, iz: i32, row: &table::Row| {
            let angle = angle(plan.downwind, [f64::from(ix), f64::from(iz)]);
            let amplitude = row.amplitude * row.lobe.shape(angle).sqrt();
            noise::gaussian(noise::words(plan.sea.seed, cascade.key, ix, iz)).map(|x| x * amplitude)
        };
        // A wave and its opposite make one pair: half of the lattice stands for all.
        for iz in 0..half {
            for ix in 1 - half..half {
                let row = &rows[table::index(ix, iz)];
                if row.amplitude == 0.0 || (iz == 0 && ix <= 0) {
                    continue;
                }
                let (a, b) = (draw(ix, iz, row), draw(-ix, -iz, row));
                let phase = TAU * f64::from(row.wave.turns.wrapping_mul(phase_time)) / 4_294_967_296.0;
                let (s, c) = phase.sin_cos();
                // h(k) = a e^{-i phase} + conj(b) e^{i phase}; h(-k) is its conjugate.
                let re = (a[0] + b[0]) * c + (a[1] + b[1]) * s;
                let im = (a[1] - b[1]) * c + (b[0] - a[0]) * s;
                total += 2.0 * (re * re + im * im);
            }
        }
    }
    total
}

/// |k|, k and the expected variance S(k) dk^2 of every wave of every lattice.
fn waves(plan: &Plan) -> impl Iterator<Item = (f64, [f64; 2], f64)> + '_ {
    plan.cascades.iter().flat_map(move |cascade| {
        let rows = table::rows(plan, cascade);
        let half = plan.n as i32 / 2;
        let lattice = (1 - half..half).flat_map(move |iz| (1 - half..half).map(move |ix| (ix, iz)));
        lattice.filter_map(move |(ix, iz)| {
            let row = &rows[table::index(ix, iz)];
            if row.amplitude == 0.0 {
                return None;
            }
            let k = [f64::from(ix) * cascade.dk(), f64::from(iz) * cascade.dk()];
            let variance = 4.0 * row.amplitude * row.amplitude * row.lobe.shape(angle(plan.downwind, k));
            Some((row.wave.k, k, variance))
        })
    })
}

/// Angle between a wave vector and the direction of travel, rad in [0, pi].
pub fn angle(downwind: [f64; 2], k: [f64; 2]) -> f64 {
    let dot = downwind[0] * k[0] + downwind[1] * k[1];
    let cross = downwind[0] * k[1] - downwind[1] * k[0];
    cross.abs().atan2(dot)
}

/// Integral of D cos(theta) over the circle.
fn first_moment(plan: &Plan, omega: f64) -> f64 {
    let lobe = plan.spreading.lobe(omega);
    let norm = lobe.norm();
    2.0 * norm * adaptive(|theta| theta.cos() * lobe.shape(theta), &[0.0, 0.5, 0.5 * PI, PI], TOLERANCE)
}

fn spread_deg(r1: f64) -> f64 {
    (2.0 * (1.0 - r1).max(0.0)).sqrt().to_degrees()
}

/// Where `s` is largest: a coarse scan around `near`, then golden-section search.
fn peak(s: impl Fn(f64) -> f64, near: f64) -> f64 {
    let scan = |i: i32| near * 0.4 * 20f64.powf(f64::from(i) / 400.0);
    let best = (0..=400).max_by(|&a, &b| s(scan(a)).total_cmp(&s(scan(b)))).unwrap_or(0);
    let (mut a, mut b) = (scan(best - 1), scan(best + 1));
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if s(c) > s(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::query;

    fn theory(state: &str) -> (Plan, Theory) {
        let plan = Plan::new(&query::parse(state).0);
        let theory = Theory::new(&plan);
        (plan, theory)
    }

    #[test]
    fn published_heights_and_periods() {
        let (_, j) = theory("wind=10&fetch=100");
        assert!((j.hs_m / 2.139 - 1.0).abs() < 5e-4 && (j.tp_s / 6.23 - 1.0).abs() < 5e-4, "{j:?}");
        let (_, pm) = theory("spectrum=pm&wind=10");
        assert!((pm.hs_m / 2.245 - 1.0).abs() < 1e-3, "{pm:?}");
    }

    #[test]
    fn the_lattices_hold_the_sea() {
        for state in ["wind=10&fetch=100", "wind=5&fetch=20", "wind=20&fetch=500", "spectrum=tma&depth=5", "swell=1"] {
            let (plan, t) = theory(state);
            let r = Resolved::new(&plan, t.m0_m2);
            assert!(r.m0_fraction > 0.99, "{state} {r:?}");
            assert!((r.hs_m / t.hs_m - 1.0).abs() < 0.01, "{state} {r:?} {t:?}");
            assert!((r.mss / t.mss - 1.0).abs() < 0.02, "{state} {r:?} {t:?}");
            assert!((r.spread_deg / t.spread_deg - 1.0).abs() < 0.05, "{state} {r:?} {t:?}");
            let from = r.mean_from_deg.unwrap_or(f64::NAN);
            assert!((from - plan.sea.from_deg).abs() < 2.0, "{state} {r:?}");
        }
    }

    #[test]
    fn directions_are_compass_bearings() {
        assert_eq!(from_deg([0.0, 1.0]), 0.0, "a wave running south comes from north");
        assert_eq!(from_deg([-1.0, 0.0]), 90.0, "a wave running west comes from east");
    }
}
