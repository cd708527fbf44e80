//! The waves of a plan, and their sums at a point.

use crate::state::params::MAX_CASCADES;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::statistics::drawn;
use crate::waves::table::{Table, index};
use crate::waves::tiling::{PatchCopy, Tiling};
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

/// Waves that are summed side by side: wide enough for the vector units, narrow enough for few empty places.
pub(super) const LANES: usize = 4;

/// The kept waves of one cascade.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Patch {
    pub(super) side_m: f64,
    pub(super) tiling: Tiling,
    pub(super) dk: f64,
    pub(super) blocks: Vec<Block>,
}

/// Some travelling waves, eta = Re[h e^{i (k.x - omega t)}] with h = 2 h0. Empty places have h = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Block {
    /// Wave vector in units of dk: whole numbers.
    ix: [f64; LANES],
    iz: [f64; LANES],
    /// h, m.
    pub(super) re: [f64; LANES],
    pub(super) im: [f64; LANES],
    /// coth(k h) / |(ix, iz)|: times (ix, iz) the factor of D.
    orbit: [f64; LANES],
    /// rad/s.
    omega: [f64; LANES],
    /// omega as a multiple of 2 pi / period.
    turns: [u32; LANES],
}

/// A wave that may be kept.
pub(super) struct Candidate {
    pub(super) cascade: usize,
    pub(super) ix: i32,
    pub(super) iz: i32,
    pub(super) h0: [f64; 2],
}

impl Candidate {
    /// |h0|^2, m^2.
    pub(super) fn strength(&self) -> f64 {
        self.h0[0] * self.h0[0] + self.h0[1] * self.h0[1]
    }

    /// Strongest first; of equals the one with the lower index.
    pub(super) fn order(&self, other: &Self) -> Ordering {
        let place = |c: &Self| (c.cascade, c.iz, c.ix);
        other.strength().total_cmp(&self.strength()).then_with(|| place(self).cmp(&place(other)))
    }
}

/// The copies of every patch that a point sees.
pub(super) type Blends = [[PatchCopy; 3]; MAX_CASCADES];

/// The waves at a point, copy by copy: as many as were summed.
pub(super) struct Copies {
    pub(super) blends: Blends,
    pub(super) sums: [[Option<Sums>; 3]; MAX_CASCADES],
}

/// Sums over the waves at one undisplaced point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) eta: f64,
    pub(super) slope: [f64; 2],
    /// D, without chop.
    pub(super) d: [f64; 2],
    /// dDx/dx, dDz/dz, dDx/dz.
    pub(super) strain: [f64; 3],
    /// d eta/dt and dD/dt.
    pub(super) rise: f64,
    pub(super) drift: [f64; 2],
    /// What D is the gradient of, m^2.
    pub(super) potential: f64,
    /// What the gradients of the copies' weights add to the slope, and to dDx/dx, dDz/dz, dDx/dz, dDz/dx.
    pub(super) lift: [f64; 2],
    pub(super) bend: [f64; 4],
}

impl Sums {
    /// Adds a copy with its weight.
    fn add(&mut self, of: &Self, copy: &PatchCopy) {
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

impl Copies {
    /// Their sum with weights; and whether all were summed that it takes.
    pub(super) fn blended(&self, blends: &Blends) -> (Sums, bool) {
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
    pub(super) fn new<'a>(plan: &Plan, cascade: &Cascade, waves: impl Iterator<Item = &'a Candidate>) -> Self {
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
    pub(super) fn sums(&self, x: f64, z: f64, time: u32) -> Sums {
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
pub(super) fn candidates(plan: &Plan) -> Vec<Candidate> {
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

/// Sines and cosines of 2 pi `turns`, within 2e-15 of the turns given; |turns| below 2^50.
///
/// Without branches or calls, so that several waves go through one instruction: Taylor's series at a quarter of the angle,
/// at most pi / 4, doubled twice.
#[inline]
pub(super) fn sin_cos_turns(turns: [f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
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
