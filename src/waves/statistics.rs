//! Expected wave statistics, computed without a simulation: from integrals of the spectrum ([`SpectrumStatistics`]) and
//! from sums over the waves of all cascades ([`LatticeStatistics`]).

use super::noise;
use super::plan::{Cascade, Plan};
use super::quadrature::integrate_adaptive;
use super::system::WaveSystem;
use super::table::{SpectrumTable, entry_index};
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Expected statistics of a planned sea from integrals of its spectrum by adaptive quadrature, which do not use the
/// coarser integrals in [`Plan::spectrum_integrals`].
///
/// ```
/// use seastate::state::query;
/// use seastate::waves::{Plan, statistics::SpectrumStatistics};
///
/// let (params, notices) = query::parse("spectrum=jonswap&wind=10&fetch=100");
/// assert!(notices.is_empty());
/// let theory = SpectrumStatistics::new(&Plan::new(&params));
/// assert!((theory.hs_m - 2.139).abs() < 0.002);
/// assert!((theory.tp_s - 6.23).abs() < 0.01);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpectrumStatistics {
    /// Elevation variance m0 of the whole spectrum, m^2.
    pub variance_m2: f64,
    /// Significant wave height 4 sqrt(m0) of the whole spectrum, m.
    pub hs_m: f64,
    /// Peak period, s: period of the waves at the peak of the spectrum.
    pub tp_s: f64,
    /// Mean period Tm01 = 2 pi m0 / m1, s, with the moments m0 and m1 of the waves that the cascades resolve.
    pub tm01_s: f64,
    /// Mean zero-crossing period Tm02 = 2 pi sqrt(m0 / m2), s, of the waves that the cascades resolve.
    pub tm02_s: f64,
    /// Wavelength at the peak frequency of the spectrum, m.
    pub lambda_p_m: f64,
    /// Wavelength of a wave with the mean period `tm01_s`, m.
    pub lambda_mean_m: f64,
    /// Significant steepness: significant wave height divided by the wavelength at the peak frequency.
    pub steepness: f64,
    /// Mean of (d eta/dx)^2 + (d eta/dz)^2 for the waves that the cascades resolve: their mean square slope.
    pub mss: f64,
    /// Largest wave number of the cascades, rad/m: upper limit of the integrals for `mss` and the mean periods.
    pub k_max: f64,
    /// Mean direction that the waves come from, degrees clockwise from north; `None` if no direction dominates.
    pub mean_from_deg: Option<f64>,
    /// Directional spread sqrt(2 (1 - r1)), degrees, where the first directional moment r1 is the length of the
    /// energy-weighted mean of the unit vectors of travel.
    pub spread_deg: f64,
    /// Benjamin-Feir index for deep water, k_p sqrt(m0) Q_p sqrt(2 pi), with the peak wave number k_p and Goda's
    /// peakedness Q_p = 2 / m0^2 times the integral of omega S(omega)^2, S the spectrum (Janssen and Bidlot 2009).
    /// Near 1, freak waves become likely.
    pub benjamin_feir: f64,
    /// Fraction of the surface that whitecaps cover at the local wind speed, see [`monahan_coverage`].
    pub whitecap_fraction: f64,
}

/// Expected statistics of the waves that the cascades of a plan hold, as sums over their lattices of wave vectors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LatticeStatistics {
    /// Elevation variance m0 of the waves in the cascades, m^2.
    pub variance_m2: f64,
    /// Significant wave height 4 sqrt(m0) of the waves in the cascades, m.
    pub hs_m: f64,
    /// Mean period 2 pi m0 / m1 of the waves in the cascades, s.
    pub tm01_s: f64,
    /// Mean zero-crossing period 2 pi sqrt(m0 / m2) of the waves in the cascades, s.
    pub tm02_s: f64,
    /// Mean square slope of the waves: mean of (d eta/dx)^2 + (d eta/dz)^2 with the elevation eta.
    pub mss: f64,
    /// Elevation variance of the waves in the cascades as a fraction of that of the whole spectrum.
    pub m0_fraction: f64,
    /// First directional moment r1, 0 to 1: length of the energy-weighted mean of the unit vectors of travel.
    pub first_directional_moment: f64,
    /// Mean direction that the waves come from, degrees clockwise from north; `None` if no direction dominates.
    pub mean_from_deg: Option<f64>,
    /// Directional spread sqrt(2 (1 - r1)) of the waves, converted to degrees, with the first directional moment `r1`.
    pub spread_deg: f64,
}

/// Relative tolerance of the integrals of the spectrum for m0, mean periods and mean square slope.
const SPECTRUM_INTEGRAL_TOLERANCE: f64 = 1e-7;
/// First directional moment r1 (length of the mean unit vector of travel) above which a mean direction is reported.
pub const MIN_R1_FOR_DIRECTION: f64 = 0.01;

impl SpectrumStatistics {
    /// Computes the statistics of a planned sea by integrating its total spectrum.
    pub fn new(plan: &Plan) -> Self {
        let k_max = plan.k_max();
        if plan.is_calm() {
            return Self { k_max, ..Self::default() };
        }
        let dispersion = plan.dispersion;
        let s = |w: f64| plan.density(w);
        let (low, high) = plan.frequency_range();
        let mut knots: Vec<f64> = plan
            .systems
            .iter()
            .flat_map(|s| [s.spectrum.integration_breakpoints_rad_s.clone(), s.spreading.breakpoints()].concat())
            .collect();
        knots.extend(plan.systems.iter().map(|s| s.spectrum.frequency_range().0));
        knots.extend((1..8).map(|i| low * (high / low).powf(f64::from(i) / 8.0)));
        knots.sort_by(f64::total_cmp);
        let integral = |f: &dyn Fn(f64) -> f64, low: f64, high: f64, tolerance: f64| {
            let inner = knots.iter().copied().filter(|&w| w > low && w < high);
            integrate_adaptive(f, &std::iter::once(low).chain(inner).chain([high]).collect::<Vec<_>>(), tolerance)
        };
        let bands: Vec<(f64, f64)> = (plan.resolved_bands().into_iter())
            .map(|(a, b)| (if a > 0.0 { dispersion.omega(a) } else { 0.0 }, dispersion.omega(b)))
            .map(|(a, b)| (a.clamp(low, high), b.clamp(low, high)))
            .filter(|(a, b)| a < b)
            .collect();
        let resolved = |f: &dyn Fn(f64) -> f64| {
            bands.iter().map(|&(a, b)| integral(f, a, b, SPECTRUM_INTEGRAL_TOLERANCE)).sum::<f64>()
        };
        let m0 = integral(&s, low, high, SPECTRUM_INTEGRAL_TOLERANCE);
        let [m0_resolved, m1, m2] = [0, 1, 2].map(|power| resolved(&|w| w.powi(power) * s(w)));
        let mss = resolved(&|w| s(w) * dispersion.wave_number(w).powi(2));
        // Both integrals ask for the moments at the same frequencies, and a moment is an integral, too.
        let moments = RefCell::new(HashMap::new());
        let moments_at = |w: f64| {
            let compute = || {
                let of_system = |s: &WaveSystem| s.first_moment(w).map(|m| s.spectrum.density(w) * m);
                plan.systems.iter().map(of_system).fold([0.0; 2], |[x, z], [dx, dz]| [x + dx, z + dz])
            };
            *moments.borrow_mut().entry(w.to_bits()).or_insert_with(compute)
        };
        let first_moment = [0, 1].map(|axis| {
            // The density is added to the moment, so that the error is relative to m0: where all waves travel along the
            // other axis, an error relative to the moment itself could never be reached.
            integral(&|w| s(w) + moments_at(w)[axis], low, high, 1e-5) / m0 - 1.0
        });
        let r1 = first_moment[0].hypot(first_moment[1]);
        let omega_p = refined_peak(s, plan.omega_p);
        let k_p = dispersion.wave_number(omega_p);
        let peakedness = 2.0 / (m0 * m0) * integral(&|w| w * s(w).powi(2), low, high, 1e-6);
        // Cascades whose bands the user has set may hold no waves at all.
        let tm01_s = if m1 > 0.0 { TAU * m0_resolved / m1 } else { 0.0 };
        let hs_m = 4.0 * m0.sqrt();
        Self {
            variance_m2: m0,
            hs_m,
            tp_s: TAU / omega_p,
            tm01_s,
            tm02_s: if m2 > 0.0 { TAU * (m0_resolved / m2).sqrt() } else { 0.0 },
            lambda_p_m: TAU / k_p,
            lambda_mean_m: if tm01_s > 0.0 { TAU / dispersion.wave_number(TAU / tm01_s) } else { 0.0 },
            steepness: hs_m * k_p / TAU,
            mss: mss.max(0.0),
            k_max,
            mean_from_deg: (r1 > MIN_R1_FOR_DIRECTION).then(|| bearing_waves_come_from_deg(first_moment)),
            spread_deg: spread_deg(r1),
            benjamin_feir: k_p * m0.sqrt() * peakedness * TAU.sqrt(),
            whitecap_fraction: monahan_coverage(plan.sea.first_system().wind_m_s),
        }
    }
}

impl LatticeStatistics {
    /// Computes the expected statistics of all waves of the cascades of a plan. `theory_m0` is the elevation variance
    /// of the whole spectrum (m^2), of which `m0_fraction` is the part in the cascades.
    pub fn new(plan: &Plan, theory_m0: f64) -> Self {
        let mut moments = SpectralMoments::default();
        for (cascade, table) in plan.cascades.iter().zip(SpectrumTable::for_all_cascades(plan)) {
            for (ix, iz) in lattice_indices(plan.n) {
                let wave = &table.waves[entry_index(ix, iz)];
                if wave.k > 0.0 {
                    let unit = [f64::from(ix), f64::from(iz)].map(|i| i * cascade.dk() / wave.k);
                    moments.add(4.0 * table.variance(ix, iz), wave.k, wave.omega, unit);
                }
            }
        }
        moments.to_statistics(theory_m0)
    }
}

/// Signed indices (ix, iz) of the wave vectors of an n x n lattice, row by row, with (0, 0) but without the Nyquist
/// index -n/2. Each index lies in (-n/2, n/2).
pub fn lattice_indices(n: u32) -> impl Iterator<Item = (i32, i32)> {
    let half = n as i32 / 2;
    (1 - half..half).flat_map(move |iz| (1 - half..half).map(move |ix| (ix, iz)))
}

/// Spectral and directional moments, summed wave by wave, from which the [`LatticeStatistics`] follow.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpectralMoments {
    /// Spectral moments m0, m1 and m2: sums of variance times omega^i, m^2 (rad/s)^i.
    pub moments: [f64; 3],
    mss: f64,
    /// Sum over the waves of variance times unit vector of travel (x, z), m^2.
    pub first_moment: [f64; 2],
}

impl SpectralMoments {
    /// Adds to the moments a wave with its variance (m^2), wave number `k` (rad/m), angular frequency `omega` (rad/s)
    /// and unit vector of travel `unit` (x, z).
    pub fn add(&mut self, variance: f64, k: f64, omega: f64, unit: [f64; 2]) {
        for (power, m) in (0..).zip(&mut self.moments) {
            *m += variance * omega.powi(power);
        }
        self.mss += variance * k * k;
        for (sum, u) in self.first_moment.iter_mut().zip(unit) {
            *sum += variance * u;
        }
    }

    /// Returns the statistics of all waves that were added so far. `theory_m0` is the elevation variance (m^2) of the
    /// whole spectrum; the result's `m0_fraction` is the variance of the added waves divided by it.
    pub fn to_statistics(&self, theory_m0: f64) -> LatticeStatistics {
        let [m0, m1, m2] = self.moments;
        if m0 <= 0.0 {
            return LatticeStatistics {
                m0_fraction: if theory_m0 > 0.0 { 0.0 } else { 1.0 },
                ..LatticeStatistics::default()
            };
        }
        let r1 = self.first_moment[0].hypot(self.first_moment[1]) / m0;
        LatticeStatistics {
            variance_m2: m0,
            hs_m: 4.0 * m0.sqrt(),
            tm01_s: TAU * m0 / m1,
            tm02_s: TAU * (m0 / m2).sqrt(),
            mss: self.mss,
            m0_fraction: if theory_m0 > 0.0 { m0 / theory_m0 } else { 1.0 },
            first_directional_moment: r1,
            mean_from_deg: (r1 > MIN_R1_FOR_DIRECTION).then(|| bearing_waves_come_from_deg(self.first_moment)),
            spread_deg: spread_deg(r1),
        }
    }
}

/// Direction from which waves come that travel along the vector (x, z): degrees clockwise from north in [0, 360).
pub fn bearing_waves_come_from_deg([x, z]: [f64; 2]) -> f64 {
    (-x).atan2(z).to_degrees().rem_euclid(360.0)
}

/// Fraction (0 to 1) of the sea under whitecaps at wind U (m/s): 3.84e-6 U^3.41 (Monahan and O'Muircheartaigh 1980).
pub fn monahan_coverage(wind_m_s: f64) -> f64 {
    (3.84e-6 * wind_m_s.powf(3.41)).min(1.0)
}

/// Mean square slope of a clean sea surface at the wind speed U (m/s): 0.003 + 0.00512 U (Cox and Munk 1954).
pub fn cox_munk_mss(wind_m_s: f64) -> f64 {
    0.003 + 0.00512 * wind_m_s
}

/// Complex amplitude h0(k) at time 0 as (re, im), m, of the wave with the signed lattice indices (ix, iz) in a cascade,
/// for the seed of the plan. `table` is the spectrum table of this cascade. The Nyquist indices -n/2 and n/2 are not
/// allowed.
pub fn initial_amplitude(plan: &Plan, cascade: &Cascade, table: &SpectrumTable, ix: i32, iz: i32) -> [f64; 2] {
    let deviation = table.variance(ix, iz).sqrt();
    noise::complex_gaussian(noise::noise_words(plan.sea.seed, cascade.noise_key, ix, iz)).map(|x| x * deviation)
}

/// Elevation variance (m^2) at time `t_s` (s) of the one sea that the plan's seed generates, in contrast to the
/// expected variance: the sum of |h(k, t)|^2 over all wave vectors (Parseval's theorem).
pub fn realised_variance(plan: &Plan, t_s: f64) -> f64 {
    let phase_time = plan.period_fraction_u32(t_s);
    let mut total = 0.0;
    for (cascade, table) in plan.cascades.iter().zip(SpectrumTable::for_all_cascades(plan)) {
        // h(-k) is the conjugate of h(k), so half of the lattice is enough.
        for (ix, iz) in lattice_indices(plan.n).filter(|&(ix, iz)| iz > 0 || (iz == 0 && ix > 0)) {
            let wave = &table.waves[entry_index(ix, iz)];
            if wave.k == 0.0 {
                continue;
            }
            let [a, b] = [1, -1].map(|sign| initial_amplitude(plan, cascade, &table, sign * ix, sign * iz));
            let phase = TAU * f64::from(wave.cycles_per_period.wrapping_mul(phase_time)) / 4_294_967_296.0;
            let (s, c) = phase.sin_cos();
            // h(k, t) = a e^{-i phase} + conj(b) e^{+i phase}.
            let re = (a[0] + b[0]) * c + (a[1] + b[1]) * s;
            let im = (a[1] - b[1]) * c + (b[0] - a[0]) * s;
            total += 2.0 * (re * re + im * im);
        }
    }
    total
}

/// Directional spread sqrt(2 (1 - r1)), degrees, for the first directional moment `r1`.
pub fn spread_deg(r1: f64) -> f64 {
    (2.0 * (1.0 - r1).max(0.0)).sqrt().to_degrees()
}

/// Angular frequency (rad/s) at which the spectrum `s`(omega) is largest, searched from 0.9 to 1.125 times `near`.
fn refined_peak(s: impl Fn(f64) -> f64, near: f64) -> f64 {
    let scan = |i: i32| near * 0.9 * 1.25f64.powf(f64::from(i) / 400.0);
    let best = (0..=400).max_by(|&a, &b| s(scan(a)).total_cmp(&s(scan(b)))).unwrap_or(0);
    let (mut a, mut b) = (scan(best - 1), scan(best + 1));
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if s(c) > s(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}

/// Mean, standard deviation, skewness and kurtosis (3 for a Gaussian) of a distribution. `sums` holds the weighted sums
/// of the powers 0 to 4 of its values. Without variance all results but the mean are 0.
pub fn mean_sd_skewness_kurtosis(sums: [f64; 5]) -> [f64; 4] {
    let [m1, m2, m3, m4] = [1, 2, 3, 4].map(|p| sums[p] / sums[0]);
    let variance = m2 - m1 * m1;
    if variance <= 0.0 {
        return [m1, 0.0, 0.0, 0.0];
    }
    let third = m3 - 3.0 * m1 * m2 + 2.0 * m1.powi(3);
    let fourth = m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * m1.powi(4);
    [m1, variance.sqrt(), third / variance.powf(1.5), fourth / (variance * variance)]
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::state::query;

    fn theory(state: &str) -> (Plan, SpectrumStatistics) {
        let plan = Plan::new(&query::parse(state).0);
        let theory = SpectrumStatistics::new(&plan);
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
            let r = LatticeStatistics::new(&plan, t.variance_m2);
            assert!(r.m0_fraction > 0.99, "{state} {r:?}");
            assert!((r.hs_m / t.hs_m - 1.0).abs() < 0.01, "{state} {r:?} {t:?}");
            assert!((r.mss / t.mss - 1.0).abs() < 0.02, "{state} {r:?} {t:?}");
            assert!((r.spread_deg / t.spread_deg - 1.0).abs() < 0.05, "{state} {r:?} {t:?}");
            let from = r.mean_from_deg.unwrap_or(f64::NAN);
            assert!((from - plan.sea.first_system().from_deg).abs() < 2.0, "{state} {r:?}");
        }
    }

    #[test]
    fn directions_are_compass_bearings() {
        assert_eq!(bearing_waves_come_from_deg([0.0, 1.0]), 0.0, "a wave running south comes from north");
        assert_eq!(bearing_waves_come_from_deg([-1.0, 0.0]), 90.0, "a wave running west comes from east");
    }
}
