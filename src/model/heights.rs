//! Height of the sea at a point, on the CPU: for boats, buoys, cameras and sound, without reading anything back.
//!
//! A plan's seed draws some ten thousand travelling waves. [`Heights`] takes the strongest, the very ones that the GPU
//! draws, and sums them where it is asked: a thousand carry nine tenths of the variance, five thousand 99 %.
//!
//! ```
//! use seastate::model::{Heights, Plan, query};
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

use super::params::MAX_CASCADES;
use super::plan::{self, Cascade, Plan};
use super::statistics::drawn;
use super::table::{Table, index};
use super::tiling::{Copy, Tiling};
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

/// Waves that are summed side by side: wide enough for the vector units, narrow enough for few empty places.
const LANES: usize = 4;
/// Distance (m) from the point asked for at which the search ends.
const TOLERANCE_M: f64 = 1e-8;
/// Evaluations after which it is given up; at chop 1 it takes three to five.
const MOST_EVALUATIONS: usize = 64;
/// Curvatures of the potential are kept from 0 by this, so that a step stays finite at the edge of a fold.
const LEAST_CURVATURE: f64 = 1e-3;
/// Decrease of the potential, as a share of what its slope promises, with which a step is taken (Armijo).
const ARMIJO: f64 = 1e-4;
/// Residual (m) below which the potential's decrease drowns in rounding and the residual itself is the judge.
const NEAR_M: f64 = 1e-3;

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

/// The kept waves of one cascade.
#[derive(Clone, Debug, PartialEq)]
struct Patch {
    side_m: f64,
    tiling: Tiling,
    dk: f64,
    blocks: Vec<Block>,
}

/// Some travelling waves, eta = Re[h e^{i (k.x - omega t)}] with h = 2 h0. Empty places have h = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Block {
    /// Wave vector in units of dk: whole numbers.
    ix: [f64; LANES],
    iz: [f64; LANES],
    /// h, m.
    re: [f64; LANES],
    im: [f64; LANES],
    /// coth(k h) / |(ix, iz)|: times (ix, iz) the factor of D.
    orbit: [f64; LANES],
    /// rad/s.
    omega: [f64; LANES],
    /// omega as a multiple of 2 pi / period.
    turns: [u32; LANES],
}

/// A wave that may be kept.
struct Candidate {
    cascade: usize,
    ix: i32,
    iz: i32,
    h0: [f64; 2],
}

impl Candidate {
    /// |h0|^2, m^2.
    fn strength(&self) -> f64 {
        self.h0[0] * self.h0[0] + self.h0[1] * self.h0[1]
    }

    /// Strongest first; of equals the one with the lower index.
    fn order(&self, other: &Self) -> Ordering {
        let place = |c: &Self| (c.cascade, c.iz, c.ix);
        other.strength().total_cmp(&self.strength()).then_with(|| place(self).cmp(&place(other)))
    }
}

/// The copies of every patch that a point sees.
type Blends = [[Copy; 3]; MAX_CASCADES];

/// The waves at a point, copy by copy: as many as were summed.
struct Copies {
    blends: Blends,
    sums: [[Option<Sums>; 3]; MAX_CASCADES],
}

/// Sums over the waves at one undisplaced point.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    eta: f64,
    slope: [f64; 2],
    /// D, without chop.
    d: [f64; 2],
    /// dDx/dx, dDz/dz, dDx/dz.
    strain: [f64; 3],
    /// d eta/dt and dD/dt.
    rise: f64,
    drift: [f64; 2],
    /// What D is the gradient of, m^2.
    potential: f64,
    /// What the gradients of the copies' weights add to the slope, and to dDx/dx, dDz/dz, dDx/dz, dDz/dx.
    lift: [f64; 2],
    bend: [f64; 4],
}

impl Sums {
    /// Adds a copy with its weight.
    fn add(&mut self, of: &Self, copy: &Copy) {
        let (w, [wx, wz]) = (copy.weight, copy.gradient);
        let add2 = |a: [f64; 2], b: [f64; 2]| [a[0] + w * b[0], a[1] + w * b[1]];
        self.eta += w * of.eta;
        self.slope = add2(self.slope, of.slope);
        self.d = add2(self.d, of.d);
        self.strain = [0, 1, 2].map(|i| self.strain[i] + w * of.strain[i]);
        self.rise += w * of.rise;
        self.drift = add2(self.drift, of.drift);
        self.potential += w * of.potential;
        self.lift = [self.lift[0] + wx * of.eta, self.lift[1] + wz * of.eta];
        let bend = [wx * of.d[0], wz * of.d[1], wz * of.d[0], wx * of.d[1]];
        self.bend = [0, 1, 2, 3].map(|i| self.bend[i] + bend[i]);
    }
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
        let time = plan::phase_time(self.period_s, t_s);
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
        let sums = self.sums([x0_m, z0_m], [0.0; 2], plan::phase_time(self.period_s, t_s), &blends);
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

    /// Finds the offset d with d = lambda D(x - d): the waves there, and whether it was found.
    ///
    /// D is a gradient, so with d = sqrt(lambda) e the offset is where 1/2 |e|^2 + potential(x - sqrt(lambda) e) is
    /// stationary: its gradient is the residual and the determinant of its Hessian the Jacobian. The function grows without
    /// bound, so it has a minimum however folded the sea is, and a minimum is upright water. Newton's steps, with the
    /// curvatures made positive inside folds and halved until the function falls, lead down to one.
    ///
    /// A blend of copies is a gradient only while its weights are held: a step goes down with the weights of the place that
    /// it leaves, then they are taken anew. They change by a few thousandths over a displacement, and so does the residual
    /// that is left, from step to step.
    fn invert(&self, point: [f64; 2], time: u32) -> ([f64; 2], Sums, bool) {
        let root = self.root;
        let offset = |e: [f64; 2]| [root[0] * e[0], root[1] * e[1]];
        let gradient = |e: [f64; 2], at: &Sums| [e[0] - root[0] * at.d[0], e[1] - root[1] * at.d[1]];
        let value = |e: [f64; 2], at: &Sums| 0.5 * dot(e, e) + at.potential;
        let mut e = [0.0; 2];
        let mut blends = self.blends(point, offset(e));
        let mut at = self.sums(point, offset(e), time, &blends);
        let mut g = gradient(e, &at);
        let mut step = self.step(g, at.strain);
        let mut scale = 1.0;
        for _ in 1..MOST_EVALUATIONS {
            let error = offset(g);
            if error[0].hypot(error[1]) <= TOLERANCE_M {
                return (offset(e), at, true);
            }
            let next_e = [e[0] + scale * step[0], e[1] + scale * step[1]];
            let copies = self.copies(point, offset(next_e), time, &blends);
            let (next, _) = copies.blended(&blends);
            let next_g = gradient(next_e, &next);
            let falls = value(next_e, &next) <= value(e, &at) + ARMIJO * scale * dot(g, step);
            let closes = error[0].hypot(error[1]) < NEAR_M && dot(next_g, next_g) < 0.25 * dot(g, g);
            if falls || closes {
                (e, scale) = (next_e, 1.0);
                blends = self.blends(point, offset(e));
                at = match copies.blended(&blends) {
                    (sums, true) => sums,
                    _ => self.sums(point, offset(e), time, &blends),
                };
                g = gradient(e, &at);
                step = self.step(g, at.strain);
            } else {
                scale *= 0.5;
            }
        }
        let error = offset(g);
        (offset(e), at, error[0].hypot(error[1]) <= TOLERANCE_M)
    }

    /// Newton's step against a gradient, with the absolute curvatures.
    fn step(&self, g: [f64; 2], [xx, zz, xz]: [f64; 3]) -> [f64; 2] {
        let [rx, rz] = self.root;
        // Hessian mean +- [half, cross; cross, -half], eigenvalues mean +- radius.
        let (a, b, cross) = (1.0 + rx * rx * xx, 1.0 + rz * rz * zz, rx * rz * xz);
        let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
        let radius = half.hypot(cross);
        let [high, low] = [mean + radius, mean - radius].map(|c| 1.0 / c.abs().max(LEAST_CURVATURE));
        let (even, odd) = (0.5 * (high + low), if radius > 0.0 { 0.5 * (high - low) / radius } else { 0.0 });
        let step =
            [-(even * g[0] + odd * (half * g[0] + cross * g[1])), -(even * g[1] + odd * (cross * g[0] - half * g[1]))];
        let length = step[0].hypot(step[1]);
        if length > self.longest_step_m { step.map(|s| s * self.longest_step_m / length) } else { step }
    }

    /// What the undisplaced point `point - offset` sees of every patch.
    fn blends(&self, point: [f64; 2], offset: [f64; 2]) -> Blends {
        let mut out = Blends::default();
        for (out, patch) in out.iter_mut().zip(&self.patches) {
            *out = patch.tiling.blend([point[0] - offset[0], point[1] - offset[1]]);
        }
        out
    }

    /// The waves at the undisplaced point `point - offset`, with these weights.
    fn sums(&self, point: [f64; 2], offset: [f64; 2], time: u32, blends: &Blends) -> Sums {
        self.copies(point, offset, time, blends).blended(blends).0
    }

    /// The copies there that count by these weights, and those of them that count by the point's own.
    fn copies(&self, point: [f64; 2], offset: [f64; 2], time: u32, blends: &Blends) -> Copies {
        let own = self.blends(point, offset);
        let mut sums = [[None; 3]; MAX_CASCADES];
        for (i, patch) in self.patches.iter().enumerate() {
            // The remainder is exact: far away the phases are as good as here.
            let at = [0, 1].map(|axis| (point[axis] % patch.side_m - offset[axis]) / patch.side_m);
            for (copy, sums) in blends[i].iter().zip(&mut sums[i]) {
                let counts = |c: &Copy| c.cell == copy.cell && c.weight > 0.0;
                if copy.weight > 0.0 || own[i].iter().any(counts) {
                    *sums = Some(patch.sums(at[0] + copy.shift[0], at[1] + copy.shift[1], time));
                }
            }
        }
        Copies { blends: *blends, sums }
    }
}

impl Copies {
    /// Their sum with weights; and whether all were summed that it takes.
    fn blended(&self, blends: &Blends) -> (Sums, bool) {
        let (mut all, mut complete) = (Sums::default(), true);
        for ((blend, known), sums) in blends.iter().zip(&self.blends).zip(&self.sums) {
            for copy in blend.iter().filter(|c| c.weight > 0.0) {
                match known.iter().zip(sums).find_map(|(k, sums)| sums.as_ref().filter(|_| k.cell == copy.cell)) {
                    Some(sums) => all.add(sums, copy),
                    None => complete = false,
                }
            }
        }
        (all, complete)
    }
}

impl Patch {
    fn new<'a>(plan: &Plan, cascade: &Cascade, waves: impl Iterator<Item = &'a Candidate>) -> Self {
        let mut blocks = Vec::new();
        for (i, candidate) in waves.enumerate() {
            if i % LANES == 0 {
                blocks.push(Block::default());
            }
            let Some(block) = blocks.last_mut() else { continue };
            let lane = i % LANES;
            let i2 = (candidate.ix * candidate.ix + candidate.iz * candidate.iz) as u32;
            let wave = plan.wave(cascade, i2);
            block.ix[lane] = f64::from(candidate.ix);
            block.iz[lane] = f64::from(candidate.iz);
            block.re[lane] = 2.0 * candidate.h0[0];
            block.im[lane] = 2.0 * candidate.h0[1];
            block.orbit[lane] = wave.orbit / f64::from(i2).sqrt();
            block.omega[lane] = wave.omega;
            block.turns[lane] = wave.turns;
        }
        Self { side_m: cascade.patch_m, tiling: plan.tiling(cascade), dk: cascade.dk(), blocks }
    }

    /// The waves at (`x`, `z`), in units of the side.
    fn sums(&self, x: f64, z: f64, time: u32) -> Sums {
        // Per lane: eta, its slopes, D, strain xx, zz, xz, rise, drift, potential; factors that all share come after.
        let mut sums = [[0.0; LANES]; 12];
        for block in &self.blocks {
            let Block { ix, iz, re, im, orbit, omega, turns } = block;
            // Loops over the lanes of one kind of operation each: these are what the compiler turns into vector code.
            let mut phase = [0.0; LANES];
            for l in 0..LANES {
                // Signed, as there are conversions in bulk for that; whole turns do not matter.
                let turned = f64::from(turns[l].wrapping_mul(time) as i32) * (1.0 / 4_294_967_296.0);
                phase[l] = ix[l] * x + iz[l] * z - turned;
            }
            let (sin, cos) = sin_cos_turns(phase);
            // h e^{i (k.x - omega t)}
            let h_re: [f64; LANES] = std::array::from_fn(|l| re[l] * cos[l] - im[l] * sin[l]);
            let h_im: [f64; LANES] = std::array::from_fn(|l| re[l] * sin[l] + im[l] * cos[l]);
            let d_re: [f64; LANES] = std::array::from_fn(|l| orbit[l] * h_re[l]);
            let d_im: [f64; LANES] = std::array::from_fn(|l| orbit[l] * h_im[l]);
            let fast: [f64; LANES] = std::array::from_fn(|l| omega[l] * d_re[l]);
            let mut add = |which: usize, term: [f64; LANES]| {
                for l in 0..LANES {
                    sums[which][l] += term[l];
                }
            };
            let times = |a: &[f64; LANES], b: &[f64; LANES]| -> [f64; LANES] { std::array::from_fn(|l| a[l] * b[l]) };
            add(0, h_re);
            add(1, times(ix, &h_im));
            add(2, times(iz, &h_im));
            add(3, times(ix, &d_im));
            add(4, times(iz, &d_im));
            let (along_x, along_z) = (times(ix, &d_re), times(iz, &d_re));
            add(5, times(ix, &along_x));
            add(6, times(iz, &along_z));
            add(7, times(iz, &along_x));
            add(8, times(omega, &h_im));
            add(9, times(ix, &fast));
            add(10, times(iz, &fast));
            add(11, d_re);
        }
        let [eta, sx, sz, dx, dz, xx, zz, xz, rise, ux, uz, potential] = sums.map(|lanes| lanes.iter().sum::<f64>());
        Sums {
            eta,
            slope: [-self.dk * sx, -self.dk * sz],
            d: [-dx, -dz],
            strain: [-self.dk * xx, -self.dk * zz, -self.dk * xz],
            rise,
            drift: [ux, uz],
            potential: potential / self.dk,
            ..Sums::default()
        }
    }
}

/// All waves that a plan's seed draws.
fn candidates(plan: &Plan) -> Vec<Candidate> {
    let half = plan.n as i32 / 2;
    let mut waves = Vec::new();
    for (i, cascade) in plan.cascades.iter().enumerate() {
        let table = Table::new(plan, cascade);
        for iz in 1 - half..half {
            for ix in 1 - half..half {
                if table.waves[index(ix, iz)].k == 0.0 {
                    continue;
                }
                let wave = Candidate { cascade: i, ix, iz, h0: drawn(plan, cascade, &table, ix, iz) };
                if wave.strength() > 0.0 {
                    waves.push(wave);
                }
            }
        }
    }
    waves
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Sines and cosines of 2 pi `turns`, within 2e-15 of the turns given; |turns| below 2^50.
///
/// Without branches or calls, so that several waves go through one instruction: Taylor's series at a quarter of the angle,
/// at most pi / 4, doubled twice.
#[inline]
fn sin_cos_turns(turns: [f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    // Adding and taking away 1.5 x 2^52 rounds to whole numbers.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    // 1 / 3!, 1 / 5! ... 1 / 15!, and 1 / 2!, 1 / 4! ... 1 / 16!: what follows is below 5e-17.
    const SIN: [f64; 7] = [6.0, 120.0, 5_040.0, 362_880.0, 39_916_800.0, 6_227_020_800.0, 1_307_674_368_000.0];
    const COS: [f64; 8] =
        [2.0, 24.0, 720.0, 40_320.0, 3_628_800.0, 479_001_600.0, 87_178_291_200.0, 20_922_789_888_000.0];
    let angle: [f64; LANES] = turns.map(|t| (t - ((t + WHOLE) - WHOLE)) * FRAC_PI_2);
    let square = angle.map(|a| a * a);
    let (mut sin, mut cos) = ([1.0 / SIN[6]; LANES], [1.0 / COS[7]; LANES]);
    for factorial in SIN[..6].iter().rev() {
        for l in 0..LANES {
            sin[l] = 1.0 / factorial - square[l] * sin[l];
        }
    }
    for factorial in COS[..7].iter().rev() {
        for l in 0..LANES {
            cos[l] = 1.0 / factorial - square[l] * cos[l];
        }
    }
    for l in 0..LANES {
        sin[l] = angle[l] - angle[l] * square[l] * sin[l];
        cos[l] = 1.0 - square[l] * cos[l];
    }
    for _ in 0..2 {
        for l in 0..LANES {
            (sin[l], cos[l]) = (2.0 * sin[l] * cos[l], 1.0 - 2.0 * sin[l] * sin[l]);
        }
    }
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::query;
    use std::f64::consts::TAU;

    fn plan(state: &str) -> Plan {
        Plan::new(&query::parse(state).0)
    }

    #[test]
    fn sines_are_those_of_the_library() {
        let mut worst = 0.0f64;
        for i in -40_000..40_000 {
            let turns = f64::from(i) * 0.000_137;
            let ([sin, ..], [cos, ..]) = sin_cos_turns([turns; LANES]);
            let want = (TAU * (turns - turns.round())).sin_cos();
            worst = worst.max((sin - want.0).abs()).max((cos - want.1).abs());
        }
        assert!(worst < 2e-15, "{worst}");
        for (turns, want) in [(0.0, (0.0, 1.0)), (0.25, (1.0, 0.0)), (-0.5, (0.0, -1.0)), (1e9 + 0.75, (-1.0, 0.0))] {
            let ([.., sin], [.., cos]) = sin_cos_turns([turns; LANES]);
            assert!((sin - want.0).abs() < 1e-15 && (cos - want.1).abs() < 1e-15, "{turns}: {sin} {cos}");
        }
    }

    #[test]
    fn the_strongest_come_first() {
        let plan = plan("wind=12&n=64");
        let all = Heights::new(&plan, usize::MAX);
        let total = all.kept_m2;
        assert_eq!((all.residual_rms_m(), all.residual_slope_rms(), all.share()), (0.0, 0.0, 1.0));
        let mut waves = candidates(&plan);
        waves.sort_by(|a, b| b.strength().total_cmp(&a.strength()));
        for modes in [1, 7, 200, 3000] {
            let some = Heights::new(&plan, modes);
            assert_eq!(some.modes(), modes);
            let kept: f64 = waves[..modes].iter().map(|w| 2.0 * w.strength()).sum();
            assert!((some.kept_m2 / kept - 1.0).abs() < 1e-12);
            assert!(((some.kept_m2 + some.left_out_m2) / total - 1.0).abs() < 1e-12);
            let lanes = some.patches.iter().flat_map(|p| &p.blocks).flat_map(|b| b.re.iter().zip(&b.im));
            let weakest = lanes.map(|(re, im)| re * re + im * im).filter(|&s| s > 0.0).fold(f64::INFINITY, f64::min);
            assert!((0.25 * weakest / waves[modes - 1].strength() - 1.0).abs() < 1e-12);
        }
        assert_eq!(all.modes(), waves.len());
    }

    #[test]
    fn as_many_as_an_error_wants() {
        let plan = plan("wind=12&n=64");
        for rms_m in [0.5, 0.1, 0.02] {
            let enough = Heights::for_error(&plan, rms_m);
            let fewer = Heights::new(&plan, enough.modes() - 1);
            assert!(enough.residual_rms_m() <= rms_m && fewer.residual_rms_m() > rms_m);
            let same = Heights::new(&plan, enough.modes());
            assert_eq!(enough.patches, same.patches);
            assert!((same.residual_rms_m() / enough.residual_rms_m() - 1.0).abs() < 1e-12);
        }
        let all = Heights::new(&plan, usize::MAX).modes();
        for rms_m in [0.0, -1.0, f64::NAN] {
            assert_eq!(Heights::for_error(&plan, rms_m).modes(), all);
        }
        assert_eq!(Heights::for_error(&plan, f64::INFINITY).modes(), 0);
    }

    #[test]
    fn a_step_is_newtons_where_the_water_is_upright() {
        let sea = Heights::new(&plan("wind=12&n=64&chopx=1.5&chopz=0.5"), 50);
        let (g, strain) = ([0.01, -0.02], [-0.3, 0.1, 0.2]);
        let p = sea.step(g, strain);
        let [rx, rz] = sea.root;
        let h = [1.0 + rx * rx * strain[0], 1.0 + rz * rz * strain[1], rx * rz * strain[2]];
        assert!((h[0] * p[0] + h[2] * p[1] + g[0]).abs() < 1e-15);
        assert!((h[2] * p[0] + h[1] * p[1] + g[1]).abs() < 1e-15);
        // Inside a fold it still leads down.
        for strain in [[-1.7, 0.3, 0.0], [-2.0, -3.0, 0.5], [-2.0 / 3.0, 0.0, 0.0], [0.0, 0.0, 4.0]] {
            assert!(dot(sea.step(g, strain), g) < 0.0);
        }
    }
}
