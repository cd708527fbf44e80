//! The water that has been carried to a point of the world: the displacement is inverted.

use super::Heights;
use super::waves::{Blends, Copies, Sums};
use crate::state::params::MAX_CASCADES;
use crate::waves::tiling::PatchCopy;

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

impl Heights {
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
    pub(super) fn invert(&self, point: [f64; 2], time: u32) -> ([f64; 2], Sums, bool) {
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
    pub(super) fn step(&self, g: [f64; 2], [xx, zz, xz]: [f64; 3]) -> [f64; 2] {
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
    pub(super) fn blends(&self, point: [f64; 2], offset: [f64; 2]) -> Blends {
        let mut out = Blends::default();
        for (out, patch) in out.iter_mut().zip(&self.patches) {
            *out = patch.tiling.blend([point[0] - offset[0], point[1] - offset[1]]);
        }
        out
    }

    /// The waves at the undisplaced point `point - offset`, with these weights.
    pub(super) fn sums(&self, point: [f64; 2], offset: [f64; 2], time: u32, blends: &Blends) -> Sums {
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
                let counts = |c: &PatchCopy| c.cell == copy.cell && c.weight > 0.0;
                if copy.weight > 0.0 || own[i].iter().any(counts) {
                    *sums = Some(patch.sums(at[0] + copy.shift[0], at[1] + copy.shift[1], time));
                }
            }
        }
        Copies { blends: *blends, sums }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
