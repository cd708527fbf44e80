//! From parameters to what is computed: a pure, total function that clamps, derives and chooses the cascades.

use super::dispersion;
use super::params::{Params, Sea};
use super::spectra::FrequencySpectrum;
use super::spreading::Spreading;
use std::f64::consts::TAU;

/// Ratio of neighbouring rungs of the ladder of patch sizes: irrational, so that no two patches share a period.
const GOLDEN: f64 = 1.618_033_988_749_895;
/// Waves that a patch holds at the low edge of its band; fewer would show as a repeated pattern. Where exactly the edge
/// lies matters: a circle of this radius, sqrt(177 / pi), holds just as many lattice points (177) as its area says, while
/// one of radius 7 runs through four points and gives each band 1 % too much.
const WAVES_AT_LOW_EDGE: f64 = 7.506_054_213;
/// Rungs between neighbouring cascades. The first step keeps the energetic band inside a 64-point lattice, the later
/// ones use what 128 points and more resolve.
const STEPS: [i32; 3] = [3, 5, 5];
/// n for which the number of cascades is chosen; the choice must not depend on the actual n.
const NOMINAL_N: f64 = 256.0;
/// Waves as short as this (rad/m) are wanted; the number of cascades follows.
const WANTED_K: f64 = 30.0;
/// Where gravity waves end: the phase-speed minimum between gravity and capillarity, about 1.7 cm (rad/m).
const SHORTEST_K: f64 = 370.0;
/// Share of m0 below the low edge of the first cascade.
const LOW_TAIL: f64 = 5e-4;
/// Significant height over depth beyond which waves break (SEA.md).
const DEPTH_LIMIT: f64 = 0.6;
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

/// One patch: n x n waves on a lattice of 2 pi / patch_m, of which those with k_low <= |k| < k_high are used.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// Side of the square patch, m.
    pub patch_m: f64,
    /// Low edge of the band, rad/m, included.
    pub k_low: f64,
    /// High edge of the band, rad/m, excluded.
    pub k_high: f64,
    /// What the noise is drawn with: the rung of the ladder.
    pub key: u32,
}

impl Cascade {
    /// Lattice spacing, rad/m.
    pub fn dk(&self) -> f64 {
        TAU / self.patch_m
    }
}

/// Everything that the simulation needs to know of a sea.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// FFT size.
    pub n: u32,
    /// Patches, longest waves first.
    pub cascades: Vec<Cascade>,
    /// All frequencies are multiples of 2 pi / period_s.
    pub period_s: f64,
    /// The sea that it is made for.
    pub sea: Sea,
    /// Frequency spectrum with height scale and depth cap.
    pub spectrum: FrequencySpectrum,
    /// Directional spreading.
    pub spreading: Spreading,
    /// Unit vector (x, z) of the waves' travel: where the wind blows to.
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
        let mut notices = Vec::new();
        let mut spectrum = FrequencySpectrum::new(&sea).scaled(sea.height * sea.height);
        let mut energy = Energy::new(&spectrum, &sea);
        let hs = 4.0 * energy.m0().sqrt();
        let limit = DEPTH_LIMIT * sea.depth_m;
        if hs > limit {
            notices
                .push(format!("waves of {hs:.1} m cannot stand in {} m of water: capped at {limit:.1} m", sea.depth_m));
            spectrum = spectrum.scaled((limit / hs).powi(2));
            energy = Energy::new(&spectrum, &sea);
        }
        let period_s = if sea.loop_s > 0.0 { sea.loop_s.max(1.0) } else { DAY_S };
        if sea.loop_s > 0.0 && period_s * spectrum.omega_p < 30.0 * TAU {
            notices.push(
                "the loop is shorter than thirty waves of the peak: the rounded frequencies change the sea".into(),
            );
        }
        let n = params.grid.n;
        let cascades = choose_cascades(&energy, &spectrum, &sea, n, params.grid.cascades);
        let spreading = Spreading::new(&sea, spectrum.omega_p);
        let from = sea.from_deg.to_radians();
        let downwind = [-from.sin(), from.cos()];
        let mut plan = Self { n, cascades, period_s, sea, spectrum, spreading, downwind, notices, energy };
        let captured = plan.captured();
        if captured < 0.99 && !plan.spectrum.is_calm() {
            plan.notices.push(format!(
                "{n} x {n} points in {} cascade(s) hold {:.1} % of the sea's energy",
                plan.cascades.len(),
                100.0 * captured
            ));
        }
        plan
    }

    /// Share of m0 inside the bands and below each lattice's Nyquist wave number.
    pub fn captured(&self) -> f64 {
        let total = self.energy.m0();
        if total <= 0.0 {
            return 1.0;
        }
        self.bands().map(|(low, high)| self.energy.between(&self.energy.m0, low, high)).sum::<f64>() / total
    }

    /// Mean square slope of the waves that the lattices hold with wave numbers below `k_limit` (rad/m).
    pub fn slope_variance(&self, k_limit: f64) -> f64 {
        self.bands().map(|(low, high)| self.slope_variance_between(low, high.min(k_limit))).sum()
    }

    /// Mean square slope of the waves between two wave numbers (rad/m).
    pub fn slope_variance_between(&self, low: f64, high: f64) -> f64 {
        self.energy.between(&self.energy.mss, low, high)
    }

    /// Variance of dDx/dx + dDz/dz, the linear part of the Jacobian at chop 1, as read from the maps' mips on a grid of
    /// `texel_m`. In shallow water it exceeds the mean square slope: orbits are flatter.
    pub fn strain_variance(&self, texel_m: f64) -> f64 {
        let band = |(cascade, (low, high)): (&Cascade, (f64, f64))| {
            let map_texel_m = cascade.patch_m / f64::from(self.n);
            let boxed = texel_m > map_texel_m;
            let width = texel_m.max(map_texel_m);
            self.energy.filtered_strain(low, high, |k| sampling_response(k * width, boxed))
        };
        self.cascades.iter().zip(self.bands()).map(band).sum()
    }

    /// Highest wave number of the finest cascade, rad/m.
    pub fn k_max(&self) -> f64 {
        self.bands().map(|(_, high)| high).fold(0.0, f64::max)
    }

    /// Significant wave height 4 sqrt(m0) of the spectrum, m, from the plan's own sums.
    pub fn hs_m(&self) -> f64 {
        4.0 * self.energy.m0().sqrt()
    }

    /// The wave at squared lattice distance `i2` = ix^2 + iz^2 (not 0) of a cascade.
    pub fn wave(&self, cascade: &Cascade, i2: u32) -> Wave {
        let k = cascade.dk() * f64::from(i2).sqrt();
        let omega = dispersion::omega(k, self.sea.depth_m, self.sea.gravity_m_s2);
        let turns = (omega * self.period_s / TAU).round().clamp(1.0, f64::from(u32::MAX)) as u32;
        let omega = f64::from(turns) * TAU / self.period_s;
        Wave { k, turns, omega, orbit: dispersion::orbit(k, self.sea.depth_m) }
    }

    /// S(k) dk^2 without the directional factor: the variance of a lattice cell per radian of direction, m^2.
    ///
    /// Where a cell is a sizeable part of the peak's width, S is averaged over the cell's extent in |k|: sampling it at
    /// the lattice points alone misses or doubles the narrow peak of a JONSWAP sea (2 % of m0).
    pub fn radial_variance(&self, cascade: &Cascade, wave: &Wave) -> f64 {
        let dk = cascade.dk();
        let density = |k: f64, omega: f64| {
            let group = dispersion::group_velocity(k, self.sea.depth_m, self.sea.gravity_m_s2);
            self.spectrum.density(omega) * group / k * dk * dk
        };
        if wave.k > COARSE_CELLS * dk {
            return density(wave.k, wave.omega);
        }
        CELL_RULE
            .iter()
            .map(|&(x, w)| {
                let k = wave.k + x * dk;
                w * density(k, dispersion::omega(k, self.sea.depth_m, self.sea.gravity_m_s2))
            })
            .sum()
    }

    /// The phase of all waves at time `t_s`: t / period in units of 2^-32, wrapped. A wave's phase in turns is its
    /// `turns` times this, in wrapping 32-bit arithmetic: exact after hours, and a loop closes bit for bit.
    pub fn phase_time(&self, t_s: f64) -> u32 {
        let turn = (t_s / self.period_s).rem_euclid(1.0);
        (turn * 4_294_967_296.0).round() as u64 as u32
    }

    /// Bands as the lattices hold them: cut at the Nyquist wave number.
    fn bands(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let half = f64::from(self.n / 2);
        self.cascades.iter().map(move |c| (c.k_low, c.k_high.min(half * c.dk())))
    }
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

/// Patch sizes and bands. The edges depend on the sea alone, so that raising n only adds waves.
fn choose_cascades(energy: &Energy, spectrum: &FrequencySpectrum, sea: &Sea, n: u32, wanted: u32) -> Vec<Cascade> {
    let k_low = if spectrum.is_calm() {
        TAU / 10.0
    } else {
        dispersion::wave_number(energy.quantile(LOW_TAIL), sea.depth_m, sea.gravity_m_s2)
    };
    let rung = ((WAVES_AT_LOW_EDGE * TAU / k_low).ln() / GOLDEN.ln()).ceil() as i32;
    let rungs = |count: usize| {
        STEPS[..count - 1].iter().scan(rung, |r, step| {
            *r -= step;
            Some(*r)
        })
    };
    let patch = |rung: i32| GOLDEN.powi(rung);
    let finest = |count: usize| {
        let last = rungs(count).last().unwrap_or(rung);
        0.5 * NOMINAL_N * TAU / patch(last)
    };
    let count = match wanted {
        0 if spectrum.is_calm() => 1,
        0 => (2..=3).find(|&c| finest(c) >= WANTED_K).unwrap_or(4),
        some => (some as usize).clamp(1, 4),
    };
    let all: Vec<i32> = std::iter::once(rung).chain(rungs(count)).collect();
    let low_edge = |rung: i32| WAVES_AT_LOW_EDGE * TAU / patch(rung);
    all.iter()
        .enumerate()
        .map(|(i, &rung)| {
            let patch_m = patch(rung);
            let nyquist = f64::from(n / 2) * TAU / patch_m;
            // A patch of a few centimetres can have its whole lattice beyond the shortest wave: keep the band ordered.
            let k_low = if i == 0 { 0.0 } else { low_edge(rung).min(SHORTEST_K) };
            let k_high = all.get(i + 1).map_or(nyquist, |&next| low_edge(next)).min(SHORTEST_K);
            Cascade { patch_m, k_low, k_high, key: (rung + 64) as u32 }
        })
        .collect()
}

/// Running integrals of the spectrum over a logarithmic grid, for the plan's own choices. The theory that is printed
/// comes from an independent quadrature (`statistics`).
#[derive(Clone, Debug, PartialEq)]
struct Energy {
    omega: Vec<f64>,
    k: Vec<f64>,
    m0: Vec<f64>,
    mss: Vec<f64>,
    strain: Vec<f64>,
}

impl Energy {
    const STEPS: usize = 1200;

    fn new(spectrum: &FrequencySpectrum, sea: &Sea) -> Self {
        let (low, high) = spectrum.support();
        let step = (high / low).ln() / Self::STEPS as f64;
        let mut out = Self { omega: vec![], k: vec![], m0: vec![], mss: vec![], strain: vec![] };
        let mut sums = [0.0; 3];
        let mut before = [0.0; 3];
        for i in 0..=Self::STEPS {
            let omega = low * (step * i as f64).exp();
            let k = dispersion::wave_number(omega, sea.depth_m, sea.gravity_m_s2);
            let density = spectrum.density(omega) * omega * step;
            let now = [density, density * k * k, density * (k * dispersion::orbit(k, sea.depth_m)).powi(2)];
            for ((sum, a), b) in sums.iter_mut().zip(before).zip(now) {
                *sum += 0.5 * (a + b);
            }
            before = now;
            out.omega.push(omega);
            out.k.push(k);
            out.m0.push(sums[0]);
            out.mss.push(sums[1]);
            out.strain.push(sums[2]);
        }
        out
    }

    fn m0(&self) -> f64 {
        self.m0[Self::STEPS]
    }

    /// Frequency below which the share `q` of m0 lies.
    fn quantile(&self, q: f64) -> f64 {
        let i = self.m0.partition_point(|&m| m < q * self.m0()).min(Self::STEPS);
        self.omega[i]
    }

    fn between(&self, sums: &[f64], low: f64, high: f64) -> f64 {
        (self.at(sums, high) - self.at(sums, low)).max(0.0)
    }

    /// The strain of the waves between two wave numbers, each weighted by `response` of its wave number.
    fn filtered_strain(&self, low: f64, high: f64, response: impl Fn(f64) -> f64) -> f64 {
        let piece = |i: usize| {
            let (a, b) = (self.k[i - 1].max(low), self.k[i].min(high));
            if a < b { self.between(&self.strain, a, b) * response(0.5 * (a + b)) } else { 0.0 }
        };
        (1..self.k.len()).map(piece).sum()
    }

    /// A running integral at wave number `k`, linear between the grid's points.
    fn at(&self, sums: &[f64], k: f64) -> f64 {
        let i = self.k.partition_point(|&x| x < k);
        if i == 0 {
            return 0.0;
        }
        if i > Self::STEPS {
            return sums[Self::STEPS];
        }
        let f = (k - self.k[i - 1]) / (self.k[i] - self.k[i - 1]);
        sums[i - 1] + f * (sums[i] - sums[i - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::query;

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
