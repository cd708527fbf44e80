//! What the GPU is asked: ensembles over seeds with the variance of their waves sorted into bins, foam, and maps.

use crate::gpu::Gpu;
use crate::lab::stats::{self, Estimate, Measured, Travelling};
use crate::shaders::Shaders;
use crate::sim::{MapsF32, Simulation};
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::plan::Cascade;
use crate::waves::statistics::{Resolved, Theory};
use crate::waves::table::{Table, index};

/// The GPU, if there is one, and how many seeds to measure over.
pub struct Lab<'a> {
    /// None leaves all measurements out.
    pub gpu: Option<&'a Gpu>,
    /// Seeds of an ensemble.
    pub seeds: u32,
}

/// A sea: what is known of it, and what was measured.
pub struct Sea {
    /// The plan.
    pub plan: Plan,
    /// Integrals.
    pub theory: Theory,
    /// Sums over the lattices.
    pub resolved: Resolved,
    /// Means over the seeds.
    pub measured: Option<Measured>,
    /// One per bin.
    pub bins: Vec<Bin>,
}

/// Variance, and variance times the unit vector of travel (x, z), of the waves in a bin, m^2.
#[derive(Clone, Debug, Default)]
pub struct Bin {
    /// Expected from the lattices.
    pub expected: [f64; 3],
    /// One per seed.
    pub seen: Vec<[f64; 3]>,
}

/// Parses a state of this page.
///
/// # Errors
/// If it is not taken as written.
pub fn params(state: &str) -> Result<Params, String> {
    let (params, notices) = query::parse(state);
    if notices.is_empty() { Ok(params) } else { Err(format!("{state}: {}", notices.join("; "))) }
}

impl Lab<'_> {
    /// Theory and measurement of a state; `sort` gives the bin of a wave, if it has one.
    ///
    /// # Errors
    /// If the state is wrong, or the GPU does not give its memory back.
    pub fn sea(&self, state: &str, bins: usize, sort: &dyn Fn(&Travelling) -> Option<usize>) -> Result<Sea, String> {
        let params = params(state)?;
        let plan = Plan::new(&params);
        let theory = Theory::new(&plan);
        let resolved = Resolved::new(&plan, theory.m0_m2);
        let mut sorted = vec![Bin { seen: vec![[0.0; 3]; self.seeds as usize], ..Bin::default() }; bins];
        let add = |sum: &mut [f64; 3], wave: &Travelling| {
            let parts = [wave.variance, wave.variance * wave.unit[0], wave.variance * wave.unit[1]];
            sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
        };
        if bins > 0 {
            expected_waves(&plan, &mut |wave| {
                if let Some(bin) = sort(wave) {
                    add(&mut sorted[bin].expected, wave);
                }
            });
        }
        let measured = match self.gpu {
            None => None,
            Some(gpu) => {
                let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
                let mut visit = |seed: usize, wave: &Travelling| {
                    if let Some(bin) = sort(wave) {
                        add(&mut sorted[bin].seen[seed], wave);
                    }
                };
                let samples = stats::ensemble(gpu, &mut sim, &params, self.seeds, &mut visit);
                Some(stats::summary(&pollster::block_on(samples)?))
            }
        };
        Ok(Sea { plan, theory, resolved, measured, bins: sorted })
    }

    /// Mean foam over all levels after a cold start, over the seeds.
    ///
    /// # Errors
    /// If the state is wrong, or the GPU does not give its memory back.
    pub fn foam(&self, state: &str, seeds: u32) -> Result<Option<Estimate>, String> {
        let Some(gpu) = self.gpu else { return Ok(None) };
        let mut means = Vec::new();
        for seed in 1..=seeds {
            let params = params(&format!("{state}&seed={seed}"))?;
            let mut sim = Simulation::new(gpu, Plan::new(&params), &Shaders::default());
            let levels = pollster::block_on(stats::foam_levels(gpu, &mut sim, params.clock.t_s, [0.0; 2]))?;
            let count: usize = levels.iter().map(Vec::len).sum();
            means.push(levels.iter().flatten().map(|&f| f64::from(f)).sum::<f64>() / count as f64);
        }
        Ok(Some(stats::estimate(&means)))
    }

    /// The maps of a plan at some times.
    ///
    /// # Errors
    /// If the GPU does not give its memory back.
    pub fn maps(&self, plan: &Plan, times: &[f64]) -> Result<Option<Vec<MapsF32>>, String> {
        let Some(gpu) = self.gpu else { return Ok(None) };
        let mut sim = Simulation::new(gpu, plan.clone(), &Shaders::default());
        let mut read = |t_s: &f64| pollster::block_on(sim.read_f32(gpu, *t_s));
        times.iter().map(&mut read).collect::<Result<_, _>>().map(Some)
    }
}

impl Sea {
    /// A measured quantity, where there is a GPU.
    pub fn get(&self, of: impl Fn(&Measured) -> Estimate) -> Option<Estimate> {
        self.measured.as_ref().map(of)
    }
}

/// Every wave of a plan with the variance that is expected of it.
pub fn expected_waves(plan: &Plan, visit: &mut dyn FnMut(&Travelling)) {
    for cascade in &plan.cascades {
        let table = Table::new(plan, cascade);
        for (ix, iz, k) in lattice(plan, cascade) {
            let unit = [ix, iz].map(|i| f64::from(i) * cascade.dk() / k);
            let omega = table.waves[index(ix, iz)].omega;
            visit(&Travelling { variance: 4.0 * table.variance(ix, iz), k, omega, unit });
        }
    }
}

/// Signed indices and wave numbers of the waves of a cascade.
pub fn lattice<'a>(plan: &Plan, cascade: &'a Cascade) -> impl Iterator<Item = (i32, i32, f64)> + 'a {
    let half = plan.n as i32 / 2;
    let all = (1 - half..half).flat_map(move |iz| (1 - half..half).map(move |ix| (ix, iz)));
    let wave = |(ix, iz): (i32, i32)| (ix, iz, cascade.dk() * f64::from(ix * ix + iz * iz).sqrt());
    all.map(wave).filter(|&(ix, iz, k)| (ix, iz) != (0, 0) && cascade.holds(k))
}
