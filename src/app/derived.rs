//! Quantities derived from the parameters. They are computed when the parameters change, not in every frame.

use super::plots::polar::DirectionalSpectrumSamples;
use crate::coast::Transfer;
use crate::point::StrongestWaves;
use crate::point::floating::HullWaves;
use crate::state::Params;
use crate::waves::crest_theory::CrestTheory;
use crate::waves::statistics::{LatticeStatistics, SpectrumStatistics};
use crate::waves::system::WaveSystem;
use crate::waves::{Plan, SeaChange};
use std::cell::OnceCell;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Plan, statistics and plot data of one sea, computed from its parameters. The expensive parts are computed at their
/// first use.
pub struct DerivedSeaData {
    /// Parameters from which the other fields were computed.
    pub params: Params,
    /// Plan (the waves of the sea, divided among cascades) for the FFT size that the user requested; adaptive quality
    /// may draw the sea with a smaller one.
    pub plan: Plan,
    /// Statistics of the sea (wave height, periods, slope, direction) by theory, from integrals of the continuous
    /// spectrum.
    pub theoretical_statistics: SpectrumStatistics,
    /// Height and length of the waves of each wave system by theory; empty if there is only one: the whole sea.
    pub systems: Vec<SystemSize>,
    /// Statistics of the resolved waves (those on the FFT grids), as sums over these waves; empty until first used.
    resolved: OnceCell<LatticeStatistics>,
    /// The strongest waves of the sea, selected as for the motion of floating hulls; here they only give the height of
    /// the sea at a point (see [`Self::strongest_waves`]). Empty until first used.
    hull_waves: OnceCell<HullWaves>,
    /// Transfer functions of the coast that is shown; `None` in the open sea, and until the coast is solved.
    transfer: Option<Arc<Transfer>>,
    /// Directional spectrum, sampled for the panel's polar plot; empty until first used.
    directional_spectrum: OnceCell<DirectionalSpectrumSamples>,
    /// Expected distributions of crests and heights; empty until first used.
    crest_theory: OnceCell<CrestTheory>,
}

/// How high and how long the waves of one wave system are.
pub struct SystemSize {
    /// Number of the system: 1 is the wind sea.
    pub number: usize,
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Wavelength at the peak of the system's spectrum, m.
    pub length_m: f64,
    /// Period at the peak of the system's spectrum, s.
    pub period_s: f64,
}

impl SystemSize {
    fn new(system: &WaveSystem, plan: &Plan) -> Self {
        Self {
            number: system.number,
            hs_m: 4.0 * system.spectrum.variance_m2().sqrt(),
            length_m: TAU / plan.dispersion.wave_number(system.spectrum.omega_p),
            period_s: TAU / system.spectrum.omega_p,
        }
    }
}

impl DerivedSeaData {
    /// Computes the plan of a sea and its statistics by theory; the other quantities follow when they are first used.
    pub fn new(params: &Params) -> Self {
        let plan = Plan::new(params);
        let theory = SpectrumStatistics::new(&plan);
        let systems = match plan.systems.as_slice() {
            [] | [_] => Vec::new(),
            several => several.iter().map(|system| SystemSize::new(system, &plan)).collect(),
        };
        Self {
            systems,
            params: params.clone(),
            plan,
            theoretical_statistics: theory,
            resolved: OnceCell::new(),
            hull_waves: OnceCell::new(),
            transfer: None,
            directional_spectrum: OnceCell::new(),
            crest_theory: OnceCell::new(),
        }
    }

    /// Updates the derived quantities to new parameters, and recomputes only what depends on the change. Returns the
    /// greatest change: of the waves, else of the surface (choppiness, water level), else of the foam; `None` if
    /// neither sea nor FFT grid changed.
    pub fn update(&mut self, params: &Params) -> Option<SeaChange> {
        let change = SeaChange::between(&self.params, params);
        match change {
            None => return None,
            Some(SeaChange::Waves) => *self = Self::new(params),
            Some(SeaChange::Surface) => {
                self.plan = self.plan.with_surface_and_foam_of(&params.sea);
                self.hull_waves = OnceCell::new();
            }
            Some(SeaChange::Foam) => self.plan = self.plan.with_surface_and_foam_of(&params.sea),
        }
        self.params = params.clone();
        change
    }

    /// Takes the transfer functions of the coast of the shown sea. Those of another sea change nothing.
    pub fn set_transfer(&mut self, transfer: Option<&Arc<Transfer>>) {
        if self.transfer.as_ref().map(Arc::as_ptr) != transfer.map(Arc::as_ptr) {
            self.transfer = transfer.cloned();
            self.hull_waves = OnceCell::new();
        }
    }

    /// Statistics of the resolved waves (those on the FFT grids); computed at the first call.
    pub fn lattice_statistics(&self) -> &LatticeStatistics {
        self.resolved.get_or_init(|| LatticeStatistics::new(&self.plan, self.theoretical_statistics.variance_m2))
    }

    /// The waves of the sea with the largest variance, at a coast with what that makes of them. Their sum, computed
    /// on the CPU, approximates the height of the sea, m, at any point and time.
    pub fn strongest_waves(&self) -> &StrongestWaves {
        let select = || {
            let waves = HullWaves::new(&self.plan);
            match &self.transfer {
                Some(transfer) => waves.with_coast(&self.plan, transfer),
                None => waves,
            }
        };
        self.hull_waves.get_or_init(select).heave_waves()
    }

    /// Directional spectrum, sampled for the panel's polar plot; computed at the first call.
    pub fn directional_spectrum(&self) -> &DirectionalSpectrumSamples {
        self.directional_spectrum.get_or_init(|| DirectionalSpectrumSamples::new(&self.plan))
    }

    /// Expected distributions of crests and heights; computed at the first call.
    pub fn crest_theory(&self) -> &CrestTheory {
        self.crest_theory.get_or_init(|| CrestTheory::new(&self.plan, &self.theoretical_statistics))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foam_leaves_theory_and_heights_as_they_are() {
        let mut params = Params::default();
        params.grid.n = 64;
        let mut derived = DerivedSeaData::new(&params);
        let first = derived.plan.clone();
        derived.strongest_waves();
        params.sea.foam.decay_s = 9.0;
        assert_eq!(derived.update(&params), Some(SeaChange::Foam));
        assert_eq!(derived.update(&params), None);
        assert!(
            Arc::ptr_eq(&derived.plan.spectrum_integrals, &first.spectrum_integrals)
                && derived.hull_waves.get().is_some()
        );
        assert_eq!(derived.plan, Plan::new(&params));
        params.sea.chop = 0.5;
        assert_eq!(derived.update(&params), Some(SeaChange::Surface));
        assert!(
            Arc::ptr_eq(&derived.plan.spectrum_integrals, &first.spectrum_integrals)
                && derived.hull_waves.get().is_none()
        );
        assert_eq!(derived.plan, Plan::new(&params));
        params.sea.depth_m = 10.0;
        assert_eq!(derived.update(&params), Some(SeaChange::Waves));
        assert!(!Arc::ptr_eq(&derived.plan.spectrum_integrals, &first.spectrum_integrals));
    }
}
