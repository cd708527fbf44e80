//! From parameters to what is computed: a pure, total function that clamps, derives and chooses the cascades.

use super::cascades;
use super::dispersion::Dispersion;
use super::energy::Energy;
use super::system::{self, WaveSystem};
use super::tiling::Tiling;
use crate::state::params::{Params, Sea, SpreadKind};
use std::f64::consts::TAU;

pub use super::cascades::Cascade;

/// Significant height over depth beyond which waves break (docs/sea.md).
const DEPTH_LIMIT: f64 = 0.6;
/// Variance of the strain beyond which the numbers leave the range of half floats.
const MOST_STRAIN: f64 = 25.0;
/// Variance below which there are no waves, m^2: a hundredth of a millimetre.
const LEAST_M2: f64 = 1e-12;
/// Cells from the origin within which S is averaged over a cell.
const COARSE_CELLS: f64 = 40.0;
/// Four-point Gauss-Legendre rule over [-1/2, 1/2].
const CELL_RULE: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
    (-0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.169_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.430_568_155_797_026_3, 0.173_927_422_568_726_93),
];
/// Period without a loop: a day.
const DAY_S: f64 = 86_400.0;

/// Everything that the simulation needs to know of a sea.
///
/// ```
/// let (params, _) = seastate::state::query::parse("wind=10&fetch=100");
/// let plan = seastate::waves::Plan::new(&params);
/// assert!((plan.hs_m() - 2.14).abs() < 0.01);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// FFT size.
    pub n: u32,
    /// Patches, longest waves first.
    pub cascades: Vec<Cascade>,
    /// Whether they are blended from shifted copies instead of repeated.
    pub untile: bool,
    /// All frequencies are multiples of 2 pi / period_s.
    pub period_s: f64,
    /// The sea that it is made for.
    pub sea: Sea,
    /// The systems that have waves, with height scales and depth cap.
    pub systems: Vec<WaveSystem>,
    /// Dispersion relation.
    pub dispersion: Dispersion,
    /// Where the whole spectrum is largest, rad/s.
    pub omega_p: f64,
    /// Unit vector (x, z) towards which the local wind blows.
    pub downwind: [f64; 2],
    /// What the user should know.
    pub notices: Vec<String>,
    energy: Energy,
}

/// Wave quantities that depend on |k| alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wave number, rad/m.
    pub k: f64,
    /// Frequency as a multiple of 2 pi / period.
    pub turns: u32,
    /// Angular frequency turns x 2 pi / period, rad/s.
    pub omega: f64,
    /// Horizontal over vertical orbit axis, coth(k h).
    pub orbit: f64,
}

impl Plan {
    /// Plans the sea of `params`. Never fails: a calm gives one empty cascade.
    pub fn new(params: &Params) -> Self {
        let sea = params.sea.clone();
        let dispersion = Dispersion::new(&sea);
        let mut notices = Vec::new();
        let mut systems: Vec<WaveSystem> = sea.systems.iter().map(|s| WaveSystem::new(&sea, s)).collect();
        for (system, waves) in sea.systems.iter().zip(&systems) {
            notices.extend(waves.spectrum.notice.clone());
            let fixed = system.spread != SpreadKind::DonelanBanner && system.spread != SpreadKind::Cos2;
            if waves.spectrum.has_own_direction() && fixed {
                notices.push("tessendorf carries its own cos^2 in directions: spread is not used".into());
            }
            if waves.has_measured_directions() {
                notices.push("the directions are the buoy's: dir and spread are not used".into());
            }
        }
        for (system, usual) in sea.systems.iter().zip(&Sea::default().systems) {
            let windy = (system.wind_m_s, system.fetch_km) != (usual.wind_m_s, usual.fetch_km);
            if system.scale > 0.0 && system.hs_m > 0.0 && system.tp_s > 0.0 && windy {
                notices.push("height and period are given (hs, tp): wind and fetch matter little to them".into());
            }
        }
        let off = &sea.systems[1];
        if off.scale == 0.0 && *off != Sea::default().systems[1] {
            notices.push("the second system is switched off: set scale2".into());
        }
        systems.retain(|s| !s.spectrum.is_calm());
        let mut energy = integrate(&systems, &dispersion);
        if energy.m0() < LEAST_M2 && !systems.is_empty() {
            notices.push("nothing is left of the waves: their short-wave fade is longer than they are".into());
            systems.clear();
            energy = integrate(&systems, &dispersion);
        }
        let hs = 4.0 * energy.m0().sqrt();
        let limit = DEPTH_LIMIT * sea.depth_m;
        if hs > limit {
            notices
                .push(format!("waves of {hs:.1} m cannot stand in {} m of water: capped at {limit:.1} m", sea.depth_m));
            scale_all(&mut systems, (limit / hs).powi(2));
            energy = integrate(&systems, &dispersion);
        }
        // Far beyond what breaks, but half floats must hold the slopes.
        let strain = energy.filtered_strain(0.0, cascades::shortest(&dispersion), |_| 1.0);
        if strain > MOST_STRAIN {
            notices.push(format!("waves with slopes of {:.0} cannot stand: lowered", strain.sqrt()));
            scale_all(&mut systems, MOST_STRAIN / strain);
            energy = integrate(&systems, &dispersion);
        }
        let period_s = if sea.loop_s > 0.0 { sea.loop_s.max(1.0) } else { DAY_S };
        let omega_p = energy.omega_p();
        if sea.loop_s > 0.0 && period_s * omega_p < 30.0 * TAU {
            notices.push(
                "the loop is shorter than thirty waves of the peak: the rounded frequencies change the sea".into(),
            );
        }
        let n = params.grid.n;
        let cascades = cascades::choose(&energy, &dispersion, &params.grid);
        let downwind = system::travel(sea.local().from_deg);
        let untile = params.grid.untile;
        let mut plan =
            Self { n, cascades, untile, period_s, sea, systems, dispersion, omega_p, downwind, notices, energy };
        let captured = plan.captured();
        if captured < 0.99 && !plan.is_calm() {
            plan.notices.push(format!(
                "{n} x {n} points in {} cascade(s) hold {:.1} % of the sea's energy",
                plan.cascades.len(),
                100.0 * captured
            ));
        }
        plan
    }

    /// The same sea on a lattice of at most `n` points a side: without the shortest waves, all others as they are.
    #[must_use]
    pub fn coarser(&self, n: u32) -> Self {
        let mut plan = self.clone();
        plan.n = plan.n.min(n);
        for cascade in &mut plan.cascades {
            let nyquist = f64::from(plan.n / 2) * cascade.dk();
            cascade.k_high = cascade.k_high.min(nyquist).max(cascade.k_low);
        }
        plan
    }

    /// Whether there are no waves at all.
    pub fn is_calm(&self) -> bool {
        self.systems.is_empty()
    }

    /// Whether another plan's sea is made of the same waves, with other amplitudes: only they differ at any time.
    pub fn has_same_waves(&self, other: &Self) -> bool {
        let waves = |p: &Self| (p.n, p.untile, p.period_s, p.sea.seed, p.dispersion);
        waves(self) == waves(other) && self.cascades == other.cascades
    }

    /// S(omega) of all systems, m^2 s.
    pub fn density(&self, omega: f64) -> f64 {
        self.systems.iter().map(|s| s.spectrum.density(omega)).sum()
    }

    /// Range of omega (rad/s) below which S is negligible and above which m0 is.
    pub fn support(&self) -> (f64, f64) {
        support(&self.systems)
    }

    /// Share of m0 that the cascades hold.
    pub fn captured(&self) -> f64 {
        let total = self.energy.m0();
        if total <= 0.0 {
            return 1.0;
        }
        self.held().iter().map(|&(low, high)| self.energy.m0_between(low, high)).sum::<f64>() / total
    }

    /// The wave numbers that the cascades hold, rad/m, as ascending intervals.
    pub fn held(&self) -> Vec<(f64, f64)> {
        cascades::held(&self.cascades)
    }

    /// Mean square slope of the waves that the lattices hold with wave numbers below `k_limit` (rad/m).
    pub fn slope_variance(&self, k_limit: f64) -> f64 {
        self.held().iter().map(|&(low, high)| self.energy.mss_between(low, high.min(k_limit))).sum()
    }

    /// Mean square slope of the waves between two wave numbers (rad/m).
    pub fn slope_variance_between(&self, low: f64, high: f64) -> f64 {
        self.energy.mss_between(low, high)
    }

    /// Variance of the elevation by the waves between two wave numbers (rad/m), m^2.
    pub fn variance_between(&self, low: f64, high: f64) -> f64 {
        self.energy.m0_between(low, high)
    }

    /// Variance of dDx/dx + dDz/dz, the linear part of the Jacobian at chop 1, as read from the maps' mips on a grid of
    /// `texel_m`. In shallow water it exceeds the mean square slope: orbits are flatter.
    pub fn strain_variance(&self, texel_m: f64) -> f64 {
        let band = |cascade: &Cascade| {
            let map_texel_m = cascade.patch_m / f64::from(self.n);
            let boxed = texel_m > map_texel_m;
            let width = texel_m.max(map_texel_m);
            let response = |k: f64| sampling_response(k * width, boxed) * self.share(k);
            self.energy.filtered_strain(cascade.k_low, cascade.k_high, response)
        };
        self.cascades.iter().map(band).sum()
    }

    /// Highest wave number of the finest cascade, rad/m.
    pub fn k_max(&self) -> f64 {
        self.cascades.iter().map(|c| c.k_high).fold(0.0, f64::max)
    }

    /// Significant wave height 4 sqrt(m0) of the spectrum, m, from the plan's own sums.
    pub fn hs_m(&self) -> f64 {
        4.0 * self.energy.m0().sqrt()
    }

    /// How a cascade's patch covers the plane.
    pub fn tiling(&self, cascade: &Cascade) -> Tiling {
        Tiling::new(cascade.patch_m, cascade.key, self.sea.seed, self.untile)
    }

    /// The wave at squared lattice distance `i2` = ix^2 + iz^2 (not 0) of a cascade.
    pub fn wave(&self, cascade: &Cascade, i2: u32) -> Wave {
        let k = cascade.dk() * f64::from(i2).sqrt();
        let turns = (self.dispersion.omega(k) * self.period_s / TAU).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        let omega = f64::from(turns) * TAU / self.period_s;
        Wave { k, turns, omega, orbit: self.dispersion.orbit(k) }
    }

    /// Share of the variance at a wave number that each cascade holding it gets: overlapping cascades are independent, so
    /// that it is their variances that add (amplitudes go with 1 / sqrt(n)).
    pub fn share(&self, k: f64) -> f64 {
        let count = self.cascades.iter().filter(|c| c.holds(k)).count();
        1.0 / count.max(1) as f64
    }

    /// S(k) dk^2 of a system without the directional factor: the variance of a lattice cell per radian of direction, m^2.
    ///
    /// Where a cell is a sizeable part of the peak's width, S is averaged over the cell's extent in |k|: sampling it at
    /// the lattice points alone misses or doubles the narrow peak of a JONSWAP sea (2 % of m0).
    pub fn radial_variance(&self, system: &WaveSystem, cascade: &Cascade, wave: &Wave) -> f64 {
        let dk = cascade.dk();
        let density =
            |k: f64, omega: f64| system.spectrum.density(omega) * self.dispersion.group_velocity(k) / k * dk * dk;
        let variance = if wave.k > COARSE_CELLS * dk {
            density(wave.k, wave.omega)
        } else {
            let mean = |low: f64, high: f64| -> f64 {
                let at = |&(x, w): &(f64, f64)| {
                    let k = 0.5 * (low + high) + x * (high - low);
                    w * density(k, self.dispersion.omega(k))
                };
                (high - low) / dk * CELL_RULE.iter().map(at).sum::<f64>()
            };
            let (low, high) = (wave.k - 0.5 * dk, wave.k + 0.5 * dk);
            match system.spectrum.jump().map(|omega| self.dispersion.wave_number(omega)) {
                Some(k) if k > low && k < high => mean(low, k) + mean(k, high),
                _ => mean(low, high),
            }
        };
        variance * self.share(wave.k)
    }

    /// The phase of all waves at time `t_s`: t / period in units of 2^-32, wrapped. A wave's phase in turns is its
    /// `turns` times this, in wrapping 32-bit arithmetic: exact after hours, and a loop closes bit for bit.
    pub fn phase_time(&self, t_s: f64) -> u32 {
        phase_time(self.period_s, t_s)
    }
}

/// Multiplies the variance of all systems.
fn scale_all(systems: &mut [WaveSystem], factor: f64) {
    for system in systems {
        system.spectrum = system.spectrum.clone().scaled(factor);
    }
}

/// [`Plan::phase_time`] for a period in s.
pub fn phase_time(period_s: f64, t_s: f64) -> u32 {
    let turn = (t_s / period_s).rem_euclid(1.0);
    (turn * 4_294_967_296.0).round() as u64 as u32
}

fn support(systems: &[WaveSystem]) -> (f64, f64) {
    let ends = systems.iter().map(|s| s.spectrum.support());
    let whole = ends.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), (a, b)| (low.min(a), high.max(b)));
    if whole.0.is_finite() { whole } else { (0.1, 100.0) }
}

fn integrate(systems: &[WaveSystem], dispersion: &Dispersion) -> Energy {
    let density = |omega: f64| systems.iter().map(|s| s.spectrum.density(omega)).sum();
    Energy::new(density, support(systems), dispersion)
}

/// Share of a wave's variance that is left when a map is read off between its texels: the mean over a box of one texel
/// (unless it is level 0, where texels are points) and linear interpolation, averaged over directions and positions.
/// `kw` is the wave number times the texel.
fn sampling_response(kw: f64, boxed: bool) -> f64 {
    const DIRECTIONS: u32 = 6;
    let axis = |x: f64| {
        let sinc = if boxed && x.abs() > 1e-6 { (0.5 * x).sin() / (0.5 * x) } else { 1.0 };
        sinc * sinc * (2.0 + x.cos()) / 3.0
    };
    let direction = |i| {
        let (sin, cos) = (std::f64::consts::FRAC_PI_4 * (f64::from(i) + 0.5) / f64::from(DIRECTIONS)).sin_cos();
        axis(kw * cos) * axis(kw * sin)
    };
    (0..DIRECTIONS).map(direction).sum::<f64>() / f64::from(DIRECTIONS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    fn plan(state: &str) -> Plan {
        Plan::new(&query::parse(state).0)
    }

    #[test]
    fn every_sea_is_captured() {
        for wind in [0.5, 2.0, 5.0, 10.0, 20.0, 35.0, 60.0] {
            for fetch in [0.5, 5.0, 50.0, 500.0, 2000.0] {
                for spectrum in ["pm", "jonswap", "tma"] {
                    for depth in [3.0, 20.0, 4000.0] {
                        let state = format!("wind={wind}&fetch={fetch}&spectrum={spectrum}&depth={depth}");
                        let p = plan(&state);
                        assert!(p.captured() > 0.99, "{state}: {}", p.captured());
                    }
                }
            }
        }
    }

    #[test]
    fn raising_n_only_adds_waves() {
        for state in ["wind=4&fetch=10", "wind=12", "wind=30&fetch=1000", "spectrum=tma&depth=5"] {
            let plans: Vec<_> = [64, 128, 256, 512, 1024].iter().map(|n| plan(&format!("{state}&n={n}"))).collect();
            for pair in plans.windows(2) {
                assert_eq!(pair[0].cascades.len(), pair[1].cascades.len());
                for (a, b) in pair[0].cascades.iter().zip(&pair[1].cascades) {
                    assert_eq!((a.patch_m, a.k_low, a.key), (b.patch_m, b.k_low, b.key));
                    assert!(a.k_high <= b.k_high);
                }
            }
        }
    }

    #[test]
    fn a_coarser_plan_is_that_of_fewer_points() {
        for state in ["wind=12", "wind=4&fetch=10", "spectrum=tma&depth=5&overlap=1", "scale2=1"] {
            let (fine, coarse) = (plan(&format!("{state}&n=512")).coarser(128), plan(&format!("{state}&n=128")));
            assert_eq!((fine.n, &fine.cascades), (coarse.n, &coarse.cascades), "{state}");
        }
    }

    #[test]
    fn bands_are_disjoint_and_ordered() {
        for cascades in 1..=4 {
            let p = plan(&format!("wind=9&cascades={cascades}"));
            assert_eq!(p.cascades.len(), cascades);
            for pair in p.cascades.windows(2) {
                assert_eq!(pair[0].k_high, pair[1].k_low);
                assert!(pair[1].k_low / pair[1].dk() > 6.0);
            }
        }
    }

    #[test]
    fn shallow_water_caps_the_sea() {
        let p = plan("wind=30&fetch=1000&depth=4");
        assert!((p.hs_m() - 2.4).abs() < 1e-3, "{}", p.hs_m());
        assert!(p.notices.iter().any(|n| n.contains("capped")));
    }

    #[test]
    fn a_loop_closes_exactly() {
        let p = plan("loop=37");
        assert_eq!(p.phase_time(5.0), p.phase_time(5.0 + 37.0 * 1000.0));
        assert_eq!(p.phase_time(37.0), 0);
    }
}
