//! Long records of the height at a fixed point of the world, as a wave staff measures it.

use super::{StrongestWaves, period_fraction_u32};
use crate::state::Params;
use crate::waves::Plan;
use crate::waves::statistics::SpectrumStatistics;

/// Distance, m, between the displaced particle and the point below which a search of a record ends. The search's last
/// step makes the distance much smaller.
const TOLERANCE_M: f64 = 1e-3;
/// Number of samples in a mean zero-crossing period in [`WaveStaff::new`].
const SAMPLES_PER_PERIOD: f64 = 16.0;
/// Rms height of the waves that [`WaveStaff::new`] leaves out, as a fraction of the significant wave height. They are
/// short; without them the significant wave height is lower by 0.3 %.
const LEFT_OUT_RMS_OVER_HS: f64 = 0.02;
/// Largest FFT size of the seas in [`WaveStaff::new`]: fewer waves, with the same spectrum, are enough for a record.
const MAX_FFT_SIZE: u32 = 128;

impl StrongestWaves {
    /// Heights above the still water (m) at the point `place` (x, z; m) of the world, at `count` times from `start_s`
    /// (s) in steps of `step_s` (s).
    ///
    /// They are those of [`Self::sample`], computed twice as fast: the search for a water particle begins where the last
    /// two samples point to. Where the surface is folded, the record stays with one particle as long as it can.
    pub fn height_record(&self, place: [f64; 2], start_s: f64, step_s: f64, count: usize) -> Vec<f64> {
        let (mut before, mut last) = ([0.0; 2], [0.0; 2]);
        (0..count)
            .map(|i| {
                let time = period_fraction_u32(self.period_s, start_s + step_s * i as f64);
                let guess = if i > 1 { [0, 1].map(|axis| 2.0 * last[axis] - before[axis]) } else { [0.0; 2] };
                let (offset, sums, _) = self.find_particle_offset(place, time, guess, TOLERANCE_M);
                (before, last) = (last, offset);
                self.surface_sample(place, offset, &sums, true).height_m - self.still_water_level_m
            })
            .collect()
    }
}

/// A fixed point where heights are recorded over many hours and for several seeds of a sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveStaff {
    /// Time between two samples, s.
    pub step_s: f64,
    /// Length of a record, s.
    pub duration_s: f64,
    /// Rms height of the waves that are left out, m.
    pub left_out_rms_m: f64,
}

impl WaveStaff {
    /// A staff for records of `hours` h of the sea with the statistics `theory`.
    pub fn new(theory: &SpectrumStatistics, hours: f64) -> Self {
        Self {
            step_s: theory.tm02_s.max(0.1) / SAMPLES_PER_PERIOD,
            duration_s: 3600.0 * hours,
            left_out_rms_m: LEFT_OUT_RMS_OVER_HS * theory.hs_m,
        }
    }

    /// Heights (m) at the origin in the sea of `params` with its seed increased by `seed_offset`.
    pub fn record(&self, params: &Params, seed_offset: u32) -> Vec<f64> {
        let mut params = params.clone();
        params.sea.seed = params.sea.seed.wrapping_add(seed_offset);
        params.grid.n = params.grid.n.min(MAX_FFT_SIZE);
        let sea = StrongestWaves::for_height_error(&Plan::new(&params), self.left_out_rms_m);
        sea.height_record([0.0; 2], 0.0, self.step_s, (self.duration_s / self.step_s) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    #[test]
    fn a_record_is_what_single_samples_say() {
        for state in ["wind=14&fetch=300&n=64&level=2", "wind=8&n=64&chop=0", "wind=14&n=64&chopz=0.5&order=1"] {
            let plan = Plan::new(&query::parse(state).0);
            let sea = StrongestWaves::new(&plan, 500);
            let record = sea.height_record([30.0, -7.0], 500.0, 0.4, 400);
            for (i, height) in record.iter().enumerate() {
                let sample = sea.sample(30.0, -7.0, 500.0 + 0.4 * i as f64);
                let wanted = sample.height_m - plan.sea.still_water_level_m;
                assert!((height - wanted).abs() < 1e-3, "{state} {i}: {height} {wanted}");
            }
        }
    }
}
