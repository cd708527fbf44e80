//! Search for the water particle that the waves have displaced to a given point (inverse of the displacement).

use super::StrongestWaves;
use super::sums::{MAX_PATCHES, PatchCopyBlends, PatchCopySums, WaveSums};
use crate::coast::transfer::CoastalSums;
use crate::waves::tiling::PatchCopy;

/// Largest distance, m, between displaced particle and requested point at which the search has converged.
pub(super) const CONVERGED_DISTANCE_M: f64 = 1e-8;
/// Largest number of evaluations of the waves in one search for a water particle. At chop 1 it takes three to five.
const MAX_EVALUATIONS: usize = 64;
/// Lower limit of the curvatures (second derivatives) of the function that the search for a water particle minimises by
/// Newton steps. It keeps a step finite at the edge of a folded crest, where the curvature is 0.
const MIN_HESSIAN_EIGENVALUE: f64 = 1e-3;
/// Armijo rule: a Newton step of the search is accepted if the minimised function decreases at least by this fraction
/// of the decrease that the gradient predicts.
const ARMIJO_DECREASE_FRACTION: f64 = 1e-4;
/// Distance, m, between displaced particle and requested point below which the search also accepts a step that halves
/// the gradient: so near to the solution, rounding hides the decrease of the minimised function.
const ROUNDING_DOMINATED_DISTANCE_M: f64 = 1e-3;

impl StrongestWaves {
    /// Finds the water particle that lies at the world position x = `point` (x, z), m, at `time` (2^32 per period of
    /// the sea): its offset d = lambda D(x - d), with the chop factor lambda and the displacement D. Returns d (m), the
    /// wave sums at x - d, and whether the search converged.
    ///
    /// D is the gradient of a potential. So with d = sqrt(lambda) e the solutions are the stationary points of the
    /// function |e|^2 / 2 + potential(x - sqrt(lambda) e), and the determinant of its Hessian is the Jacobian. The
    /// function grows without bound, so it has a minimum even in a folded sea, and at a minimum the surface is not
    /// overturned. Newton steps with positive curvatures find a minimum; a step is halved until the function decreases.
    ///
    /// A blend of patch copies is a gradient only for fixed weights. So each step uses the weights at its start, and
    /// the weights are updated after the step. Over the length of a displacement they change by a few thousandths.
    ///
    /// The search begins at the offset `start_m` (m), and ends when the displaced particle is within `tolerance_m` (m)
    /// of the point.
    pub(super) fn find_particle_offset(
        &self,
        point: [f64; 2],
        time: u32,
        start_m: [f64; 2],
        tolerance_m: f64,
    ) -> ([f64; 2], WaveSums, bool) {
        let sqrt_chop = self.sqrt_chop;
        let offset = |e: [f64; 2]| [sqrt_chop[0] * e[0], sqrt_chop[1] * e[1]];
        let gradient = |e: [f64; 2], at: &WaveSums| {
            [e[0] - sqrt_chop[0] * at.displacement_m[0], e[1] - sqrt_chop[1] * at.displacement_m[1]]
        };
        let value = |e: [f64; 2], at: &WaveSums| 0.5 * dot(e, e) + at.displacement_potential_m2;
        let mut e = [0, 1].map(|i| if sqrt_chop[i] > 0.0 { start_m[i] / sqrt_chop[i] } else { 0.0 });
        let mut blends = self.patch_copy_blends(point, offset(e));
        let mut at = self.wave_sums_at(point, offset(e), time, &blends);
        let mut g = gradient(e, &at);
        let mut step = self.newton_step(g, at.strain);
        let mut scale = 1.0;
        for _ in 1..MAX_EVALUATIONS {
            let error = offset(g);
            if error[0].hypot(error[1]) <= tolerance_m {
                return (offset(e), at, true);
            }
            let next_e = [e[0] + scale * step[0], e[1] + scale * step[1]];
            let copy_sums = self.copy_sums(point, offset(next_e), time, &blends);
            let (next, _) = copy_sums.blended(&blends, &self.patches, self.elevation_gain);
            let next_g = gradient(next_e, &next);
            let falls = value(next_e, &next) <= value(e, &at) + ARMIJO_DECREASE_FRACTION * scale * dot(g, step);
            let closes =
                error[0].hypot(error[1]) < ROUNDING_DOMINATED_DISTANCE_M && dot(next_g, next_g) < 0.25 * dot(g, g);
            if falls || closes {
                (e, scale) = (next_e, 1.0);
                blends = self.patch_copy_blends(point, offset(e));
                at = match copy_sums.blended(&blends, &self.patches, self.elevation_gain) {
                    (sums, true) => sums,
                    _ => self.wave_sums_at(point, offset(e), time, &blends),
                };
                g = gradient(e, &at);
                step = self.newton_step(g, at.strain);
            } else {
                scale *= 0.5;
            }
        }
        let error = offset(g);
        (offset(e), at, error[0].hypot(error[1]) <= tolerance_m)
    }

    /// Newton step (x, z), m, of the search for e = offset / `sqrt_chop`, from the gradient `g` of the minimised
    /// function and the strain (dDx/dx, dDz/dz, dDx/dz). Negative eigenvalues of the Hessian count with their
    /// magnitude. The length is limited to `longest_step_m`.
    pub(super) fn newton_step(&self, g: [f64; 2], [xx, zz, xz]: [f64; 3]) -> [f64; 2] {
        let [rx, rz] = self.sqrt_chop;
        // The Hessian is mean I + [half, cross; cross, -half], with the eigenvalues mean +- radius.
        let (a, b, cross) = (1.0 + rx * rx * xx, 1.0 + rz * rz * zz, rx * rz * xz);
        let (mean, half) = (0.5 * (a + b), 0.5 * (a - b));
        let radius = half.hypot(cross);
        let [high, low] = [mean + radius, mean - radius].map(|c| 1.0 / c.abs().max(MIN_HESSIAN_EIGENVALUE));
        let (even, odd) = (0.5 * (high + low), if radius > 0.0 { 0.5 * (high - low) / radius } else { 0.0 });
        let step =
            [-(even * g[0] + odd * (half * g[0] + cross * g[1])), -(even * g[1] + odd * (cross * g[0] - half * g[1]))];
        let length = step[0].hypot(step[1]);
        if length > self.longest_step_m { step.map(|s| s * self.longest_step_m / length) } else { step }
    }

    /// Copies of each cascade's patch, with weights, that are blended at the undisplaced position `point - offset` (x,
    /// z), m, and the gains of a coast there.
    pub(super) fn patch_copy_blends(&self, point: [f64; 2], offset: [f64; 2]) -> PatchCopyBlends {
        let at = [point[0] - offset[0], point[1] - offset[1]];
        let mut out = PatchCopyBlends::default();
        for (out, patch) in out.copies.iter_mut().zip(&self.patches) {
            *out = patch.tiling.patch_copies_at(at);
        }
        out.gains = self.coast.as_ref().map(|coast| coast.transfer().gains(at));
        out
    }

    /// Wave sums at the undisplaced position `point - offset` (x, z), m, with the copies and weights in `blends`, at
    /// `time` (2^32 per period of the sea).
    pub(super) fn wave_sums_at(
        &self,
        point: [f64; 2],
        offset: [f64; 2],
        time: u32,
        blends: &PatchCopyBlends,
    ) -> WaveSums {
        self.copy_sums(point, offset, time, blends).blended(blends, &self.patches, self.elevation_gain).0
    }

    /// Wave sums of each patch copy that has a weight above 0 in `blends` or in the blend at the undisplaced position
    /// `point - offset` (x, z), m, evaluated at this position.
    fn copy_sums(&self, point: [f64; 2], offset: [f64; 2], time: u32, blends: &PatchCopyBlends) -> PatchCopySums {
        let own = self.patch_copy_blends(point, offset);
        let mut sums = [[None; 3]; MAX_PATCHES];
        for (i, patch) in self.patches.iter().enumerate() {
            // The remainder is exact, so the phases keep their precision far from the origin.
            let at = [0, 1].map(|axis| (point[axis] % patch.side_m - offset[axis]) / patch.side_m);
            for (copy, sums) in blends.copies[i].iter().zip(&mut sums[i]) {
                let same = |c: &PatchCopy| c.lattice_vertex == copy.lattice_vertex && c.weight > 0.0;
                if copy.weight > 0.0 || own.copies[i].iter().any(same) {
                    *sums = Some(patch.wave_sums_in_patch(
                        at[0] + copy.shift_in_patches[0],
                        at[1] + copy.shift_in_patches[1],
                        time,
                    ));
                }
            }
        }
        let at = [point[0] - offset[0], point[1] - offset[1]];
        let coast = self.coast.as_ref().map_or_else(CoastalSums::default, |coast| coast.sums(at, time));
        PatchCopySums { copy_blends: *blends, sums, coast }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
