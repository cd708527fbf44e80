//! The waves of a plan and their sums at a point.

use crate::state::params::MAX_CASCADES;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::statistics::{initial_amplitude, lattice};
use crate::waves::table::{Table, index};
use crate::waves::tiling::{Copy, Tiling};
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

/// Waves in a [`WaveBlock`], for the vector units of the CPU.
pub(super) const LANES: usize = 4;

/// The kept waves of one cascade.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PatchWaves {
    pub(super) side_m: f64,
    pub(super) tiling: Tiling,
    pub(super) dk: f64,
    pub(super) blocks: Vec<WaveBlock>,
}

/// Travelling waves eta = Re[h e^{i (k.x - omega t)}] with h = 2 h0. Unused lanes have h = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct WaveBlock {
    /// Wave vector as whole multiples of dk.
    ix: [f64; LANES],
    iz: [f64; LANES],
    /// Real and imaginary part of h, m.
    pub(super) re: [f64; LANES],
    pub(super) im: [f64; LANES],
    /// coth(k h) / |(ix, iz)|: factor from h (ix, iz) to the amplitude of D.
    orbit: [f64; LANES],
    omega_rad_s: [f64; LANES],
    /// Frequency as a multiple of 2 pi / period.
    turns: [u32; LANES],
}

/// A wave that the seed generates.
pub(super) struct Candidate {
    /// Index of the cascade.
    pub(super) cascade: usize,
    ix: i32,
    iz: i32,
    h0: [f64; 2],
}

impl Candidate {
    /// Variance of the elevation 2 |h0|^2, m^2.
    pub(super) fn variance(&self) -> f64 {
        2.0 * (self.h0[0] * self.h0[0] + self.h0[1] * self.h0[1])
    }

    /// Squared lattice distance ix^2 + iz^2.
    pub(super) fn i2(&self) -> u32 {
        (self.ix * self.ix + self.iz * self.iz) as u32
    }

    /// Strongest wave first; waves of equal strength in the order of their indices.
    pub(super) fn order(&self, other: &Self) -> Ordering {
        let place = |c: &Self| (c.cascade, c.iz, c.ix);
        other.variance().total_cmp(&self.variance()).then_with(|| place(self).cmp(&place(other)))
    }
}

/// The copies of every patch at one point.
pub(super) type Blends = [[Copy; 3]; MAX_CASCADES];

/// Wave sums at a point for each copy of every patch; `None` where a copy was not evaluated.
pub(super) struct CopySums {
    pub(super) blends: Blends,
    pub(super) sums: [[Option<WaveSums>; 3]; MAX_CASCADES],
}

/// Sums over waves at one undisplaced position; D is without the chop factor.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct WaveSums {
    /// Elevation, m.
    pub(super) eta: f64,
    /// d eta/dx, d eta/dz.
    pub(super) slope: [f64; 2],
    /// Dx, Dz, m.
    pub(super) d: [f64; 2],
    /// dDx/dx, dDz/dz, dDx/dz.
    pub(super) strain: [f64; 3],
    /// dDx/dt, d eta/dt, dDz/dt, m/s.
    pub(super) velocity: [f64; 3],
    /// Potential whose gradient is D, m^2.
    pub(super) potential: f64,
    /// Terms of the slope from the gradients of the tiling weights.
    pub(super) tile_slope: [f64; 2],
    /// Terms of dDx/dx, dDz/dz, dDx/dz and dDz/dx from the gradients of the tiling weights.
    pub(super) tile_strain: [f64; 4],
}

impl WaveSums {
    /// Adds the sums of a copy with its weight.
    fn add(&mut self, of: &Self, copy: &Copy) {
        let (w, [wx, wz], [dx, dz]) = (copy.weight, copy.gradient, of.d);
        self.eta += w * of.eta;
        add_scaled(&mut self.slope, w, of.slope);
        add_scaled(&mut self.d, w, of.d);
        add_scaled(&mut self.strain, w, of.strain);
        add_scaled(&mut self.velocity, w, of.velocity);
        self.potential += w * of.potential;
        add_scaled(&mut self.tile_slope, of.eta, copy.gradient);
        add_scaled(&mut self.tile_strain, 1.0, [wx * dx, wz * dz, wz * dx, wx * dz]);
    }
}

fn add_scaled<const N: usize>(sum: &mut [f64; N], factor: f64, term: [f64; N]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += factor * term);
}

impl CopySums {
    /// The sum of the copies with the weights of `blends`, and whether all copies that it needs were evaluated.
    pub(super) fn blended(&self, blends: &Blends) -> (WaveSums, bool) {
        let (mut all, mut complete) = (WaveSums::default(), true);
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

impl PatchWaves {
    pub(super) fn new<'a>(plan: &Plan, cascade: &Cascade, waves: impl Iterator<Item = &'a Candidate>) -> Self {
        let mut blocks: Vec<WaveBlock> = Vec::new();
        for (i, candidate) in waves.enumerate() {
            let lane = i % LANES;
            if lane == 0 {
                blocks.push(WaveBlock::default());
            }
            let block = &mut blocks[i / LANES];
            let wave = plan.wave(cascade, candidate.i2());
            block.ix[lane] = f64::from(candidate.ix);
            block.iz[lane] = f64::from(candidate.iz);
            block.re[lane] = 2.0 * candidate.h0[0];
            block.im[lane] = 2.0 * candidate.h0[1];
            block.orbit[lane] = wave.orbit / f64::from(candidate.i2()).sqrt();
            block.omega_rad_s[lane] = wave.omega;
            block.turns[lane] = wave.turns;
        }
        Self { side_m: cascade.patch_m, tiling: plan.tiling(cascade), dk: cascade.dk(), blocks }
    }

    /// The sums at the position (`x`, `z`), in units of the patch's side; `time` is that of [`Plan::phase_time`].
    pub(super) fn sums(&self, x: f64, z: f64, time: u32) -> WaveSums {
        type Lanes = [f64; LANES];
        let times = |a: &Lanes, b: &Lanes| -> Lanes { std::array::from_fn(|l| a[l] * b[l]) };
        // Per lane and without common factors: eta, its slopes, D, strain xx, zz, xz, velocity, potential.
        let mut sums = [[0.0; LANES]; 12];
        for WaveBlock { ix, iz, re, im, orbit, omega_rad_s, turns } in &self.blocks {
            // Each loop over the lanes has one kind of operation, so that the compiler vectorises it.
            let mut phase = [0.0; LANES];
            for l in 0..LANES {
                // Signed integers convert with vector instructions, and whole turns do not matter.
                let turned = f64::from(turns[l].wrapping_mul(time) as i32) * (1.0 / 4_294_967_296.0);
                phase[l] = ix[l] * x + iz[l] * z - turned;
            }
            let (sin, cos) = sin_cos_turns(phase);
            // h e^{i (k.x - omega t)}
            let h_re: Lanes = std::array::from_fn(|l| re[l] * cos[l] - im[l] * sin[l]);
            let h_im: Lanes = std::array::from_fn(|l| re[l] * sin[l] + im[l] * cos[l]);
            let (d_re, d_im) = (times(orbit, &h_re), times(orbit, &h_im));
            let velocity = times(omega_rad_s, &d_re);
            let (along_x, along_z) = (times(ix, &d_re), times(iz, &d_re));
            let terms = [
                h_re,
                times(ix, &h_im),
                times(iz, &h_im),
                times(ix, &d_im),
                times(iz, &d_im),
                times(ix, &along_x),
                times(iz, &along_z),
                times(iz, &along_x),
                times(ix, &velocity),
                times(omega_rad_s, &h_im),
                times(iz, &velocity),
                d_re,
            ];
            for (sum, term) in sums.iter_mut().zip(&terms) {
                for l in 0..LANES {
                    sum[l] += term[l];
                }
            }
        }
        let [eta, sx, sz, dx, dz, xx, zz, xz, ux, uy, uz, potential] = sums.map(|lanes| lanes.iter().sum::<f64>());
        WaveSums {
            eta,
            slope: [-self.dk * sx, -self.dk * sz],
            d: [-dx, -dz],
            strain: [-self.dk * xx, -self.dk * zz, -self.dk * xz],
            velocity: [ux, uy, uz],
            potential: potential / self.dk,
            ..WaveSums::default()
        }
    }
}

/// All waves that the plan's seed generates.
pub(super) fn candidates(plan: &Plan) -> Vec<Candidate> {
    let mut waves = Vec::new();
    for (i, cascade) in plan.cascades.iter().enumerate() {
        let table = Table::new(plan, cascade);
        let filled = lattice(plan.n).filter(|&(ix, iz)| table.waves[index(ix, iz)].k > 0.0);
        let candidate =
            |(ix, iz)| Candidate { cascade: i, ix, iz, h0: initial_amplitude(plan, cascade, &table, ix, iz) };
        waves.extend(filled.map(candidate).filter(|wave| wave.variance() > 0.0));
    }
    waves
}

/// Sine and cosine of 2 pi `turns`, with an error below 2e-15, for |turns| below 2^50.
///
/// Without branches and calls, so that the compiler vectorises it: Taylor series at a quarter of the angle (at most pi
/// / 4), followed by two doublings of the angle.
#[inline]
pub(super) fn sin_cos_turns(turns: [f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    // Adding and subtracting 1.5 x 2^52 rounds to a whole number.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    // Factorials 3!, 5! ... 15! and 2!, 4! ... 16!; the truncated terms are below 5e-17.
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
