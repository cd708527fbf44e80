//! The plan of a sea: wave systems, cascades and all else that the simulation derives from the parameters. Planning is
//! a pure function that never fails. It clamps values that are out of range and collects notices for the user.

use super::cascades;
use super::dispersion::Dispersion;
use super::energy::SpectrumIntegrals;
use super::second_order::{BoundWaveFit, BoundWaves, CascadeBoundWaves};
use super::system::{self, WaveSystem};
use super::tiling::Tiling;
use crate::state::params::{Params, Sea, SpreadKind, WAVE_SYSTEM_NAMES};
use std::f64::consts::TAU;
use std::sync::Arc;

pub use super::cascades::Cascade;

/// Largest ratio of significant wave height to water depth. Higher waves would break; plans reduce them (docs/sea.md).
const MAX_HS_TO_DEPTH: f64 = 0.6;
/// Largest variance of the strain dDx/dx + dDz/dz of the displacement D. Plans lower the waves of a steeper sea, which
/// half-float maps cannot store.
const MAX_STRAIN_VARIANCE: f64 = 25.0;
/// Elevation variance, m^2, below which a sea counts as one without waves (significant wave height 4 micrometres).
const MIN_M0_M2: f64 = 1e-12;
/// Period after which a sea repeats if the user has set no loop, s: one day.
const DEFAULT_REPEAT_PERIOD_S: f64 = 86_400.0;

/// Everything that the simulation derives from the parameters of a sea: its wave systems (wind sea, swell), the
/// cascades (square patches of waves, one FFT each), the period after which it repeats, and notices for the user.
///
/// ```
/// let (params, _) = seastate::state::query::parse("wind=10&fetch=100");
/// let plan = seastate::waves::Plan::new(&params);
/// assert!((plan.hs_m() - 2.14).abs() < 0.01);
/// ```
#[derive(Clone, Debug)]
pub struct Plan {
    /// FFT size n: number of points along one side of the n x n maps of each cascade.
    pub n: u32,
    /// Cascades (patches of different sizes) whose sum is the sea, longest waves first.
    pub cascades: Vec<Cascade>,
    /// Whether each patch is drawn as a blend of shifted copies, which hides its repetition.
    pub blends_copies: bool,
    /// Whether the sea runs up to a coast. The patch of the first cascade then repeats, so that its waves are plane waves
    /// everywhere, which the coast can refract.
    pub has_coast: bool,
    /// Period after which the sea repeats, s: all angular frequencies are multiples of 2 pi over this period.
    pub repeat_period_s: f64,
    /// Sea parameters from which the plan was made.
    pub sea: Sea,
    /// Wave systems (wind sea, swell) that have waves, with the user's height factors and the depth limit applied.
    pub systems: Vec<WaveSystem>,
    /// Dispersion relation of the waves.
    pub dispersion: Dispersion,
    /// Angular frequency at the peak of the total spectrum of all wave systems, rad/s.
    pub omega_p: f64,
    /// Unit vector (x, z) towards which the local wind blows.
    pub downwind: [f64; 2],
    /// Notices for the user, for example that the height was limited by the water depth.
    pub notices: Vec<String>,
    /// What the grid leaves out, if it holds less than 99 % of the energy. It is no fault, so it is not among the
    /// notices.
    pub resolution_note: Option<String>,
    /// Integrals of the total spectrum of all wave systems, from which the variance between two wave numbers follows.
    pub spectrum_integrals: Arc<SpectrumIntegrals>,
    /// Fitted coefficients of the waves of second order. [`Plan::bound_waves`] applies the parameters `order` and
    /// `chop` to them.
    pub bound_wave_fit: BoundWaveFit,
}

impl PartialEq for Plan {
    /// Compares only the fields from which all others follow: FFT size, tiling, coast, cascades and sea parameters.
    fn eq(&self, other: &Self) -> bool {
        (self.n, self.blends_copies, self.has_coast) == (other.n, other.blends_copies, other.has_coast)
            && self.cascades == other.cascades
            && self.sea == other.sea
    }
}

impl Plan {
    /// Plans the sea described by `params`. A sea without waves has one cascade without waves.
    pub fn new(params: &Params) -> Self {
        let (sea, n) = (params.sea.clone(), params.grid.n);
        let dispersion = Dispersion::new(&sea);
        let mut systems: Vec<WaveSystem> = (0..sea.systems.len()).map(|i| WaveSystem::new(&sea, i)).collect();
        let mut notices = system_notices(&sea, &systems);
        systems.retain(|s| !s.spectrum.is_calm);
        let mut energy = integrate_spectrum(&systems, &dispersion);
        if energy.m0() < MIN_M0_M2 && !systems.is_empty() {
            notices.push("the short-wave fade removes all waves: it is longer than they are".into());
            systems.clear();
            energy = integrate_spectrum(&systems, &dispersion);
        }
        let (hs, limit) = (4.0 * energy.m0().sqrt(), MAX_HS_TO_DEPTH * sea.depth_m);
        if hs > limit {
            notices.push(format!(
                "a significant wave height of {hs:.1} m is too high for {} m of water: capped at {limit:.1} m",
                sea.depth_m
            ));
            energy = scale_system_variances(&mut systems, (limit / hs).powi(2), &dispersion);
        }
        let strain = energy.filtered_strain_variance(0.0, cascades::max_wave_number(&dispersion), |_| 1.0);
        if strain > MAX_STRAIN_VARIANCE {
            notices.push(format!(
                "waves with an rms slope of {:.0} are too steep: their height is reduced",
                strain.sqrt()
            ));
            energy = scale_system_variances(&mut systems, MAX_STRAIN_VARIANCE / strain, &dispersion);
        }
        let period_s = if sea.repeat_period_s > 0.0 { sea.repeat_period_s.max(1.0) } else { DEFAULT_REPEAT_PERIOD_S };
        let omega_p = energy.omega_p;
        if sea.repeat_period_s > 0.0 && period_s * omega_p < 30.0 * TAU {
            notices.push(
                "the loop is shorter than 30 peak periods: rounding the frequencies to it changes the sea".into(),
            );
        }
        let cascades = cascades::choose_cascades(&energy, &dispersion, &params.grid);
        let downwind = system::travel_direction(sea.first_system().from_deg);
        let blends_copies = params.grid.hide_tiling;
        let energy = Arc::new(energy);
        let mut plan = Self {
            n,
            cascades,
            blends_copies,
            has_coast: params.coast.is_on(),
            repeat_period_s: period_s,
            sea,
            systems,
            dispersion,
            omega_p,
            downwind,
            notices,
            resolution_note: None,
            spectrum_integrals: energy,
            bound_wave_fit: BoundWaveFit::default(),
        };
        plan.bound_wave_fit = BoundWaveFit::new(&plan);
        if plan.sea.wave_order == 2 && plan.bound_wave_fit.is_limited {
            plan.notices.push(
                "the waves are too high for second-order theory in this depth: their bound waves are reduced".into(),
            );
        }
        let captured_fraction = plan.resolved_variance_fraction();
        if captured_fraction < 0.99 && !plan.is_calm() {
            plan.resolution_note = Some(format!(
                "Cascades: {} of {n} x {n} points, which hold {:.1} % of the wave energy.",
                plan.cascades.len(),
                100.0 * captured_fraction
            ));
        }
        plan
    }

    /// Returns a plan of the same sea with the smaller of `n` and the FFT size of this plan. Only the waves too short
    /// for the smaller FFT are missing; all others are the same.
    #[must_use]
    pub fn with_fft_size_at_most(&self, n: u32) -> Self {
        let mut plan = self.clone();
        plan.n = plan.n.min(n);
        for cascade in &mut plan.cascades {
            let nyquist = f64::from(plan.n / 2) * cascade.dk();
            cascade.k_high = cascade.k_high.min(nyquist).max(cascade.k_low);
        }
        plan
    }

    /// Returns a copy of this plan for `sea`, which may differ from the sea of this plan only in chop, water level and
    /// foam, the parameters that do not change the waves; see [`SeaChange`](super::SeaChange).
    #[must_use]
    pub fn with_surface_and_foam_of(&self, sea: &Sea) -> Self {
        Self { sea: sea.clone(), ..self.clone() }
    }

    /// Whether the sea has no waves at all.
    pub fn is_calm(&self) -> bool {
        self.systems.is_empty()
    }

    /// Whether two plans have the same wave numbers, frequencies, random numbers and tiling; amplitudes may differ.
    pub fn has_same_waves(&self, other: &Self) -> bool {
        let waves = |p: &Self| (p.n, p.blends_copies, p.has_coast, p.repeat_period_s, p.sea.seed, p.dispersion);
        waves(self) == waves(other) && self.cascades == other.cascades
    }

    /// Total spectrum S(omega) of all wave systems at the angular frequency `omega` (rad/s), m^2 s.
    pub fn density(&self, omega: f64) -> f64 {
        self.systems.iter().map(|s| s.spectrum.density(omega)).sum()
    }

    /// Lowest and highest angular frequency, rad/s, between which nearly all variance of the total spectrum lies.
    pub fn frequency_range(&self) -> (f64, f64) {
        frequency_range(&self.systems)
    }

    /// Fraction (0 to 1) of the elevation variance m0 that lies in the bands of the cascades; 1 for a calm sea.
    pub fn resolved_variance_fraction(&self) -> f64 {
        let total = self.spectrum_integrals.m0();
        if total <= 0.0 {
            return 1.0;
        }
        self.resolved_bands()
            .iter()
            .map(|&(low, high)| self.spectrum_integrals.m0_between_wave_numbers(low, high))
            .sum::<f64>()
            / total
    }

    /// Union of the bands of all cascades: (lowest, highest) wave number, rad/m, ascending and without overlap.
    pub fn resolved_bands(&self) -> Vec<(f64, f64)> {
        cascades::resolved_bands(&self.cascades)
    }

    /// Mean square slope (dimensionless) of those waves of the cascades whose wave numbers are below `k_limit` (rad/m).
    pub fn resolved_slope_variance_below(&self, k_limit: f64) -> f64 {
        self.resolved_bands()
            .iter()
            .map(|&(low, high)| self.spectrum_integrals.mss_between_wave_numbers(low, high.min(k_limit)))
            .sum()
    }

    /// Variance of the strain dDx/dx + dDz/dz (the linear part of the Jacobian at chop 1) of the horizontal
    /// displacement D that remains when the maps are sampled at the mip level with texels of `texel_m` (m; 0: full
    /// resolution). In shallow water it exceeds the mean square slope, because the particle orbits are flatter.
    pub fn strain_variance(&self, texel_m: f64) -> f64 {
        let band = |cascade: &Cascade| {
            let map_texel_m = cascade.patch_m / f64::from(self.n);
            let boxed = texel_m > map_texel_m;
            let width = texel_m.max(map_texel_m);
            let response = |k: f64| bilinear_variance_response(k * width, boxed) * self.variance_share_per_cascade(k);
            self.spectrum_integrals.filtered_strain_variance(cascade.k_low, cascade.k_high, response)
        };
        self.cascades.iter().map(band).sum()
    }

    /// Largest wave number, rad/m, up to which the cascades carry waves: the highest upper end of their bands.
    pub fn k_max(&self) -> f64 {
        self.cascades.iter().map(|c| c.k_high).fold(0.0, f64::max)
    }

    /// Significant wave height 4 sqrt(m0) of the total spectrum, m, including waves outside the cascades.
    pub fn hs_m(&self) -> f64 {
        4.0 * self.spectrum_integrals.m0().sqrt()
    }

    /// Bound waves of the second order for the choppiness of the sea; all zero for a sea of first order.
    pub fn bound_waves(&self) -> BoundWaves {
        if self.sea.wave_order < 2 {
            return BoundWaves {
                cascades: vec![CascadeBoundWaves::default(); self.cascades.len()],
                ..BoundWaves::default()
            };
        }
        self.bound_wave_fit.with_choppiness(self.sea.choppiness_xz())
    }

    /// Tiling with which the patch of `cascade` covers the plane: a blend of shifted copies, or plain repetition.
    pub fn tiling(&self, cascade: &Cascade) -> Tiling {
        let is_coastal = self.has_coast && self.cascades.first() == Some(cascade);
        Tiling::new(cascade.patch_m, cascade.noise_key, self.sea.seed, self.blends_copies && !is_coastal)
    }
}

/// Notices for the user about parameters of the wave systems that are set but have no or little effect, and the notices
/// of the spectra in `systems`.
fn system_notices(sea: &Sea, systems: &[WaveSystem]) -> Vec<String> {
    let defaults = Sea::default().systems;
    let mut notices = Vec::new();
    for (system, waves) in sea.systems.iter().zip(systems) {
        notices.extend(waves.spectrum.notice.clone());
        let sets_spread = system.spread != SpreadKind::DonelanBanner && system.spread != SpreadKind::Cos2;
        if waves.spectrum.has_own_spreading && sets_spread {
            notices.push("tessendorf has its own cos^2 directional spreading: spread is ignored".into());
        }
        if waves.has_measured_directions() {
            notices.push("the directions come from the measured spectrum: dir and spread are ignored".into());
        }
    }
    for (system, default) in sea.systems.iter().zip(&defaults) {
        let sets_wind = (system.wind_m_s, system.fetch_km) != (default.wind_m_s, default.fetch_km);
        if system.height_factor > 0.0 && system.hs_m > 0.0 && system.tp_s > 0.0 && sets_wind {
            notices.push("height and period are set (hs, tp): wind and fetch have little effect on them".into());
        }
    }
    for (i, (system, default)) in sea.systems.iter().zip(&defaults).enumerate().skip(1) {
        if !system.is_on() && system != default {
            let (name, number) = (WAVE_SYSTEM_NAMES[i], i + 1);
            notices.push(format!("the {name} wave system is off: set scale{number} to switch it on"));
        }
    }
    // Systems with the same fault share a notice.
    let mut seen = Vec::new();
    notices.retain(|notice| {
        let is_new = !seen.contains(notice);
        seen.push(notice.clone());
        is_new
    });
    notices
}

/// Multiplies the variance of all wave systems by `factor` and returns the integrals of their new total spectrum.
fn scale_system_variances(systems: &mut [WaveSystem], factor: f64, dispersion: &Dispersion) -> SpectrumIntegrals {
    for system in &mut *systems {
        system.spectrum = system.spectrum.clone().scaled(factor);
    }
    integrate_spectrum(systems, dispersion)
}

fn frequency_range(systems: &[WaveSystem]) -> (f64, f64) {
    let ranges = systems.iter().map(|s| s.spectrum.frequency_range());
    ranges.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((0.1, 100.0))
}

fn integrate_spectrum(systems: &[WaveSystem], dispersion: &Dispersion) -> SpectrumIntegrals {
    let density = |omega: f64| systems.iter().map(|s| s.spectrum.density(omega)).sum();
    SpectrumIntegrals::new(density, frequency_range(systems), dispersion)
}

/// Fraction of a wave's variance that remains when a map is sampled with bilinear filtering, averaged over wave
/// directions and positions. `kw`: wave number times texel size. `boxed`: whether texels are means (coarser mip
/// levels).
fn bilinear_variance_response(kw: f64, boxed: bool) -> f64 {
    const SAMPLED_DIRECTION_COUNT: u32 = 6;
    let axis = |x: f64| {
        let sinc = if boxed && x.abs() > 1e-6 { (0.5 * x).sin() / (0.5 * x) } else { 1.0 };
        sinc * sinc * (2.0 + x.cos()) / 3.0
    };
    let direction = |i| {
        let (sin, cos) =
            (std::f64::consts::FRAC_PI_4 * (f64::from(i) + 0.5) / f64::from(SAMPLED_DIRECTION_COUNT)).sin_cos();
        axis(kw * cos) * axis(kw * sin)
    };
    (0..SAMPLED_DIRECTION_COUNT).map(direction).sum::<f64>() / f64::from(SAMPLED_DIRECTION_COUNT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    fn plan(state: &str) -> Plan {
        Plan::new(&query::parse(state).0)
    }

    #[test]
    fn raising_n_only_adds_waves() {
        for state in ["wind=4&fetch=10", "wind=12", "wind=30&fetch=1000", "spectrum=tma&depth=5"] {
            let plans: Vec<_> = [64, 128, 256, 512, 1024].iter().map(|n| plan(&format!("{state}&n={n}"))).collect();
            for pair in plans.windows(2) {
                assert_eq!(pair[0].cascades.len(), pair[1].cascades.len());
                for (a, b) in pair[0].cascades.iter().zip(&pair[1].cascades) {
                    assert_eq!((a.patch_m, a.k_low, a.noise_key), (b.patch_m, b.k_low, b.noise_key));
                    assert!(a.k_high <= b.k_high);
                }
            }
        }
    }

    #[test]
    fn a_coarser_plan_is_that_of_fewer_points() {
        for state in ["wind=12", "wind=4&fetch=10", "spectrum=tma&depth=5&overlap=1", "scale2=1"] {
            let (fine, coarse) =
                (plan(&format!("{state}&n=512")).with_fft_size_at_most(128), plan(&format!("{state}&n=128")));
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
        assert_eq!(p.period_fraction_u32(5.0), p.period_fraction_u32(5.0 + 37.0 * 1000.0));
        assert_eq!(p.period_fraction_u32(37.0), 0);
    }
}
