//! Height of the sea at a point, on the CPU: for boats, buoys, cameras and sound, without reading anything back.
//!
//! A plan's seed draws some ten thousand travelling waves. [`Heights`] takes the strongest, the very ones that the GPU
//! draws, and sums them where it is asked: a thousand carry nine tenths of the variance, five thousand 99 %.
//!
//! ```
//! use seastate::point::Heights;
//! use seastate::state::query;
//! use seastate::waves::Plan;
//!
//! let (params, notices) = query::parse("wind=14&fetch=300&seed=7&n=128");
//! assert!(notices.is_empty());
//! let plan = Plan::new(&params);
//! let sea = Heights::new(&plan, 1000);
//! // 120 m east and 45 m north of the origin, an hour after the start.
//! let here = sea.sample(120.0, -45.0, 3600.0);
//! assert!(here.converged && here.height_m.abs() < plan.hs_m());
//! println!("{:.2} m high, rising at {:.2} m/s", here.height_m, here.velocity_m_s[1]);
//! // What the waves left out come to, against a sea whose rms height is Hs / 4.
//! assert!(sea.residual_rms_m() < 0.1 * plan.hs_m());
//! // As many waves as it takes for 10 cm.
//! assert!(Heights::for_error(&plan, 0.1).residual_rms_m() <= 0.1);
//! ```
//!
//! - **Axes**: right-handed world, +x east, +y up, -z north, metres and seconds. Heights are those of the world: the level
//!   of the still water (`level_m`) is in them.
//! - **World and water**: the surface is drawn at x = x0 + lambda D(x0) (docs/sea.md, "Synthesis"). [`Heights::sample`] inverts
//!   that for a point of the world; [`Heights::undisplaced`] follows the water that belongs to x0.
//! - **Copies**: the drawn sea is a blend of shifted copies of each patch (`tiling`), and so is this one: its derivatives are
//!   those of the blend.
//! - **Cost**: one sine and cosine per wave, copy and evaluation, about 11 ns with the vector units that every x86-64 has. A
//!   point sees 1.7 copies on average, and a sample takes four to six evaluations (one without chop): COST_HERE. Making it draws
//!   all waves of the plan, a few milliseconds at n = 128. More points of the FFT only add short waves: a plan with a small
//!   `n` has nearly the same strongest ones.
//! - **Accuracy**: the height of a particle is off by [`Heights::residual_rms_m`], known beforehand and Gaussian. In a gale
//!   (20 m/s over 500 km, Hs 9.7 m) that is 16 % of Hs with 200 waves, 7.5 % with 1000, 2.1 % with 5000. At a point of the
//!   world it is up to a tenth more, as the waves left out also displace the water sideways. Slopes live in shorter waves
//!   than heights: [`Heights::residual_slope_rms`] says how much of the normal is lost, which is most of it.
//! - **Exactness**: phases are those of the GPU, in wrapping integers of time and reduced by the patch in space: as good
//!   after a week, 10 000 km away, as here and now. Time is resolved to 2^-32 of the period, 20 microseconds of a day.
//! - **Sameness**: a sample depends on the sea, the point and the time alone, not on what was asked before or by which
//!   thread. Nothing is allocated, nothing locked.

use crate::waves::Plan;
use crate::waves::lattice::phase_time;
use waves::{Candidate, Patch, Sums, candidates};

mod search;
#[cfg(test)]
mod tests;
mod waves;

/// The strongest waves of a sea.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    patches: Vec<Patch>,
    modes: usize,
    /// Roots of the horizontal displacement's factors along x and z.
    root: [f64; 2],
    level_m: f64,
    period_s: f64,
    /// Longest step of the search, in its own coordinates, m.
    longest_step_m: f64,
    kept_m2: f64,
    left_out_m2: f64,
    left_out_mss: f64,
}

/// The sea at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Height of the surface in the world, m.
    pub height_m: f64,
    /// Unit normal of the drawn surface. It points up, except inside a fold (negative `jacobian`).
    pub normal: [f64; 3],
    /// Orbital velocity (x, y, z) of the water at the surface in linear theory, m/s: (dD/dt, d eta/dt) of the particle that
    /// is here, with coth(k h) along the horizontal. Chop does not scale it: that is a matter of the picture.
    pub velocity_m_s: [f64; 3],
    /// Where the water that is here would lie in a still sea, (x, z), m.
    pub undisplaced_xz: [f64; 2],
    /// Where the surface that is described lies, (x, z), m: the point asked for, if `converged`.
    pub world_xz: [f64; 2],
    /// Area of the drawn surface, seen from above, over the area at rest: below 1 at crests, negative inside a fold.
    pub jacobian: f64,
    /// Whether `world_xz` is the point asked for within 1e-8 m.
    pub converged: bool,
}

impl Heights {
    /// The `modes` strongest waves of all cascades, or all if there are fewer.
    pub fn new(plan: &Plan, modes: usize) -> Self {
        let mut waves = candidates(plan);
        let count = modes.min(waves.len());
        if count > 0 && count < waves.len() {
            waves.select_nth_unstable_by(count - 1, Candidate::order);
        }
        Self::of(plan, waves, count)
    }

    /// As many of the strongest waves as it takes for `residual_rms_m` to be at most `rms_m` (m). All of them for 0 or what
    /// is no number.
    pub fn for_error(plan: &Plan, rms_m: f64) -> Self {
        let mut waves = candidates(plan);
        waves.sort_unstable_by(Candidate::order);
        let allowed_m2 = if rms_m > 0.0 { rms_m * rms_m } else { 0.0 };
        let mut left_out_m2 = 0.0;
        let dropped = waves.iter().rev().take_while(|wave| {
            left_out_m2 += 2.0 * wave.strength();
            left_out_m2 <= allowed_m2
        });
        let count = waves.len() - dropped.count();
        Self::of(plan, waves, count)
    }

    /// Keeps the first `count` of the waves.
    fn of(plan: &Plan, mut waves: Vec<Candidate>, count: usize) -> Self {
        let left_out = waves.split_off(count);
        waves.sort_unstable_by(Candidate::order);
        let variance = |waves: &[Candidate]| waves.iter().fold(0.0, |sum, w| sum + 2.0 * w.strength());
        let slope = |w: &Candidate| {
            let i2 = f64::from(w.ix * w.ix + w.iz * w.iz);
            2.0 * w.strength() * i2 * plan.cascades[w.cascade].dk().powi(2)
        };
        let patches: Vec<Patch> = (plan.cascades.iter().enumerate())
            .map(|(i, cascade)| Patch::new(plan, cascade, waves.iter().filter(|w| w.cascade == i)))
            .filter(|patch| !patch.blocks.is_empty())
            .collect();
        let displacement_m2 = waves.iter().map(|w| {
            let wave = plan.wave(&plan.cascades[w.cascade], (w.ix * w.ix + w.iz * w.iz) as u32);
            2.0 * w.strength() * wave.orbit * wave.orbit
        });
        let root = plan.sea.lambda().map(|l| l.max(0.0).sqrt());
        Self {
            longest_step_m: 2.0 * root[0].max(root[1]) * displacement_m2.sum::<f64>().sqrt(),
            patches,
            modes: count,
            root,
            level_m: plan.sea.level_m,
            period_s: plan.period_s,
            kept_m2: variance(&waves),
            left_out_m2: variance(&left_out),
            left_out_mss: left_out.iter().map(slope).fold(0.0, |sum, s| sum + s),
        }
    }

    /// Number of waves.
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Root mean square, over the plane and time, of the height of the plan's waves that are left out, m.
    pub fn residual_rms_m(&self) -> f64 {
        self.left_out_m2.sqrt()
    }

    /// Root mean square of their slope, the length of the gradient of the height.
    pub fn residual_slope_rms(&self) -> f64 {
        self.left_out_mss.sqrt()
    }

    /// Share of the variance of the plan's waves that is kept; 1 for a calm.
    pub fn share(&self) -> f64 {
        let all = self.kept_m2 + self.left_out_m2;
        if all > 0.0 { self.kept_m2 / all } else { 1.0 }
    }

    /// The sea at the point (`x_m`, `z_m`) of the world at `t_s`.
    ///
    /// Where the surface is folded, several pieces of water lie over one point; an upright one is described, always the same
    /// for the same question, but the next point's can be another. Where none is found, `converged` is false and the sample
    /// describes the water at its `world_xz`, near the point. What is not finite (a coordinate or the time) gives still
    /// water that has not converged. All numbers are finite in every case.
    pub fn sample(&self, x_m: f64, z_m: f64, t_s: f64) -> Sample {
        if ![x_m, z_m, t_s].iter().all(|v| v.is_finite()) {
            return self.still();
        }
        let time = phase_time(self.period_s, t_s);
        let (offset, sums, converged) = self.invert([x_m, z_m], time);
        self.describe([x_m, z_m], offset, &sums, converged)
    }

    /// The samples of many points (x, z) of the world at one time.
    pub fn sample_many(&self, points: &[[f64; 2]], t_s: f64) -> Vec<Sample> {
        points.iter().map(|&[x_m, z_m]| self.sample(x_m, z_m, t_s)).collect()
    }

    /// The water that would lie at (`x0_m`, `z0_m`) in a still sea, wherever the waves have carried it: one evaluation,
    /// nothing to invert. What is not finite is answered as by `sample`.
    pub fn undisplaced(&self, x0_m: f64, z0_m: f64, t_s: f64) -> Sample {
        if ![x0_m, z0_m, t_s].iter().all(|v| v.is_finite()) {
            return self.still();
        }
        let blends = self.blends([x0_m, z0_m], [0.0; 2]);
        let sums = self.sums([x0_m, z0_m], [0.0; 2], phase_time(self.period_s, t_s), &blends);
        self.describe([x0_m, z0_m], [0.0; 2], &sums, true)
    }

    fn still(&self) -> Sample {
        Sample {
            height_m: self.level_m,
            normal: [0.0, 1.0, 0.0],
            velocity_m_s: [0.0; 3],
            undisplaced_xz: [0.0; 2],
            world_xz: [0.0; 2],
            jacobian: 1.0,
            converged: false,
        }
    }

    /// The sample of the water at `point - offset`.
    fn describe(&self, point: [f64; 2], offset: [f64; 2], sums: &Sums, converged: bool) -> Sample {
        let [lx, lz] = self.root.map(|r| r * r);
        let [xx, zz, cross] = sums.strain;
        let [xx, zz, xz, zx] = [xx + sums.bend[0], zz + sums.bend[1], cross + sums.bend[2], cross + sums.bend[3]];
        let [sx, sz] = [sums.slope[0] + sums.lift[0], sums.slope[1] + sums.lift[1]];
        let jacobian = (1.0 + lx * xx) * (1.0 + lz * zz) - lx * lz * xz * zx;
        // docs/sea.md, "Synthesis".
        let normal = [-(sx * (1.0 + lz * zz) - sz * lz * zx), jacobian, -(sz * (1.0 + lx * xx) - sx * lx * xz)];
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        Sample {
            height_m: self.level_m + sums.eta,
            normal: if length > 0.0 { normal.map(|c| c / length) } else { [0.0, 1.0, 0.0] },
            velocity_m_s: [sums.drift[0], sums.rise, sums.drift[1]],
            undisplaced_xz: [point[0] - offset[0], point[1] - offset[1]],
            // The offset and the displacement nearly cancel: far from the origin the point keeps its digits.
            world_xz: [point[0] + (lx * sums.d[0] - offset[0]), point[1] + (lz * sums.d[1] - offset[1])],
            jacobian,
            converged,
        }
    }
}
