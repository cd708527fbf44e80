//! Measurements for the validation page: statistics over seeds, the variance of waves in bins, foam and wave maps.

use crate::gpu::Gpu;
use crate::lab::ensemble::{self, MeasuredStatistics, TravellingWave};
use crate::lab::estimate::EstimateWithError;
use crate::shaders::Shaders;
use crate::sim::{MapsF32, Simulation};
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::plan::Cascade;
use crate::waves::statistics::{self, LatticeStatistics, SpectrumStatistics};
use crate::waves::table::{SpectrumTable, entry_index};

/// How the validation page measures its seas: on which GPU, and over how many random seeds.
pub struct MeasurementSetup<'a> {
    /// The GPU to measure on; with `None` the page gets no measured numbers.
    pub gpu: Option<&'a Gpu>,
    /// Number of random seeds over which each sea is measured.
    pub seed_count: u32,
}

/// A sea with its statistics by theory, of the resolved waves (those on the FFT grids), and as measured on the GPU.
pub struct MeasuredSea {
    /// The plan of the sea: its wave systems, and its waves divided among cascades.
    pub plan: Plan,
    /// Statistics by theory, from integrals of the spectrum.
    pub theory: SpectrumStatistics,
    /// Statistics of the resolved waves, from sums over the FFT grids of the cascades.
    pub resolved: LatticeStatistics,
    /// Statistics measured on the GPU, averaged over the seeds; `None` without a GPU.
    pub measured: Option<MeasuredStatistics>,
    /// Variance of the waves in each bin of frequency or direction; empty if the waves were not sorted into bins.
    pub wave_bins: Vec<WaveBin>,
}

/// Variance and direction of travel of all waves in a bin of frequency or direction.
#[derive(Clone, Debug, Default)]
pub struct WaveBin {
    /// Expected variance of the bin's waves on the FFT grids, m^2; then the sums over these waves of variance times x
    /// and of variance times z, m^2, where (x, z) is the unit vector in which a wave travels.
    pub expected_moments: [f64; 3],
    /// For each seed, the same three sums with the measured variance of the bin's waves in place of the expected one,
    /// m^2; zeros without a GPU.
    pub measured_moments_by_seed: Vec<[f64; 3]>,
}

/// Parses a state string. A notice of the parser, such as one about an unknown key, is an error here.
///
/// # Errors
/// If the parser gives a notice about the state string.
pub fn parse_params(state: &str) -> Result<Params, String> {
    let (params, notices) = query::parse(state);
    if notices.is_empty() { Ok(params) } else { Err(format!("{state}: {}", notices.join("; "))) }
}

/// Computes the statistics of the sea that a state string describes, by theory: from integrals of its spectrum.
///
/// # Errors
/// If the parser gives a notice about the state string.
pub fn theoretical_statistics(state: &str) -> Result<SpectrumStatistics, String> {
    Ok(SpectrumStatistics::new(&Plan::new(&parse_params(state)?)))
}

impl MeasurementSetup<'_> {
    /// Statistics of the sea of a state string: by theory, of the waves on the FFT grids, and (with a GPU) as measured.
    ///
    /// # Errors
    /// If the state string is wrong, or reading back from the GPU fails.
    pub fn measure_sea(&self, state: &str) -> Result<MeasuredSea, String> {
        self.measure_binned_sea(state, 0, &|_| None)
    }

    /// Like [`Self::measure_sea`]; also sorts the waves into `bins` bins, and adds up their variance in each. `bin_of`
    /// returns the bin of a wave, or `None` for a wave outside of all bins.
    ///
    /// # Errors
    /// If the state string is wrong, or reading back from the GPU fails.
    pub fn measure_binned_sea(
        &self,
        state: &str,
        bins: usize,
        bin_of: &dyn Fn(&TravellingWave) -> Option<usize>,
    ) -> Result<MeasuredSea, String> {
        let params = parse_params(state)?;
        let plan = Plan::new(&params);
        let theory = SpectrumStatistics::new(&plan);
        let resolved = LatticeStatistics::new(&plan, theory.variance_m2);
        let mut bins =
            vec![
                WaveBin { measured_moments_by_seed: vec![[0.0; 3]; self.seed_count as usize], ..WaveBin::default() };
                bins
            ];
        let add = |sum: &mut [f64; 3], wave: &TravellingWave| {
            let parts = [
                wave.variance_m2,
                wave.variance_m2 * wave.travel_direction[0],
                wave.variance_m2 * wave.travel_direction[1],
            ];
            sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
        };
        if !bins.is_empty() {
            visit_expected_waves(&plan, &mut |wave| {
                if let Some(bin) = bin_of(wave) {
                    add(&mut bins[bin].expected_moments, wave);
                }
            });
        }
        let measured = match self.gpu {
            None => None,
            Some(gpu) => {
                let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
                let mut visit = |seed: usize, wave: &TravellingWave| {
                    if let Some(bin) = bin_of(wave) {
                        add(&mut bins[bin].measured_moments_by_seed[seed], wave);
                    }
                };
                Some(pollster::block_on(ensemble::measure(gpu, &mut sim, &params, self.seed_count, &mut visit))?)
            }
        };
        Ok(MeasuredSea { plan, theory, resolved, measured, wave_bins: bins })
    }

    /// Measures the mean foam coverage (0 to 1) over all foam levels and over `seeds` seeds; `None` without a GPU.
    ///
    /// # Errors
    /// If the state string is wrong, or reading back from the GPU fails.
    pub fn measure_foam_coverage(&self, state: &str, seeds: u32) -> Result<Option<EstimateWithError>, String> {
        let Some(gpu) = self.gpu else { return Ok(None) };
        let mut means = Vec::new();
        for seed in 1..=seeds {
            let params = parse_params(&format!("{state}&seed={seed}"))?;
            let mut sim = Simulation::new(gpu, Plan::new(&params), &Shaders::default());
            means.push(pollster::block_on(ensemble::mean_foam(gpu, &mut sim, params.clock.t_s))?);
        }
        Ok(Some(EstimateWithError::mean(&means)))
    }

    /// Computes the wave maps of a plan on the GPU at each of `times` (s), and reads them back; `None` without a GPU.
    ///
    /// # Errors
    /// If reading back from the GPU fails.
    pub fn read_maps(&self, plan: &Plan, times: &[f64]) -> Result<Option<Vec<MapsF32>>, String> {
        let Some(gpu) = self.gpu else { return Ok(None) };
        let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
        let mut read = |t_s: &f64| pollster::block_on(sim.read_maps_f32(gpu, *t_s));
        times.iter().map(&mut read).collect::<Result<_, _>>().map(Some)
    }
}

impl MeasuredSea {
    /// The statistic that `quantity` picks, such as the wave height, as measured on the GPU; `None` without a GPU.
    pub fn measured_statistic(
        &self,
        quantity: impl Fn(&MeasuredStatistics) -> EstimateWithError,
    ) -> Option<EstimateWithError> {
        self.measured.as_ref().map(quantity)
    }

    /// Measured mean direction that the waves come from, degrees clockwise from north; `None` without a GPU or without
    /// a mean direction.
    pub fn direction_deg(&self) -> Option<EstimateWithError> {
        self.measured.as_ref().and_then(|m| m.mean_from_deg)
    }
}

/// Calls `visit` for every wave on the FFT grids of a plan, with its expected variance (m^2): the mean over all seeds.
pub fn visit_expected_waves(plan: &Plan, visit: &mut dyn FnMut(&TravellingWave)) {
    for cascade in &plan.cascades {
        let table = SpectrumTable::new(plan, cascade);
        for (ix, iz, k) in lattice_waves(plan, cascade) {
            let unit = [ix, iz].map(|i| f64::from(i) * cascade.dk() / k);
            let omega = table.waves[entry_index(ix, iz)].omega;
            visit(&TravellingWave { variance_m2: 4.0 * table.variance(ix, iz), k, omega, travel_direction: unit });
        }
    }
}

/// Iterates over the waves of a cascade on its FFT grid: x and z component of the wave vector as multiples of the
/// cascade's wave-number step, and wave number, rad/m.
pub fn lattice_waves<'a>(plan: &Plan, cascade: &'a Cascade) -> impl Iterator<Item = (i32, i32, f64)> + 'a {
    let wave = |(ix, iz): (i32, i32)| (ix, iz, cascade.dk() * f64::from(ix * ix + iz * iz).sqrt());
    statistics::lattice_indices(plan.n)
        .map(wave)
        .filter(|&(ix, iz, k)| (ix, iz) != (0, 0) && cascade.contains_wave_number(k))
}
