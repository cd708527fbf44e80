//! Tiling without visible repetition: the sea surface is a blend of shifted copies of each patch (after Heitz and
//! Neyret, "High-Performance By-Example Noise using a Histogram-Preserving Blending Operator", 2018; a Gaussian surface
//! needs no histogram). shaders/common/tiles.wgsl does the same on the GPU. Foam and the heights on the CPU use the
//! same blend.
//!
//! The plane of undisplaced points is divided into equilateral triangles with sides as long as the patch; the triangle
//! lattice of each patch has another rotation. Each vertex has a copy f(x + shift) of the patch's fields; a hash of the
//! vertex gives the shift. A point sees the copies of the three vertices of its triangle,
//!
//! ```text
//! sum_i W_i(x) f(x + shift_i),  W_i = w_i / sqrt(sum_j w_j^2),  w_i = max(b_i - 1/4, 0)^2
//! ```
//!
//! with the barycentric coordinates b. Copies are uncorrelated and the sum of W^2 is 1, so the blend is Gaussian with
//! the variances of the patch. One copy is visible on 45 % of the plane, two on 41 %; the mean is 1.69. Points one
//! patch apart have a correlation of 5 % through common copies, points 1.3 patches apart or more none.
//!
//! - **Derivatives** are those of the blended surface. They include the gradients of the weights (rms 5.3 divided by
//!   the patch size) times heights and displacements. For the longest waves of a band, of which 7.5 fit across the
//!   patch, these terms are 11 % of the slope, or 1 % of the slope variance. They are smaller for shorter waves.
//! - **Shifts** are multiples of 1/64 of the patch, which are whole texels for every FFT size. So all copies have the
//!   same interpolation weights, a blend at a texel needs no interpolation, and the FFT size does not change the sea.

use super::noise::pcg4d;

/// Barycentric coordinate of a point for a vertex of its triangle at and below which the patch copy of this vertex has
/// the weight 0 at the point.
const MIN_WEIGHTED_BARYCENTRIC: f64 = 0.25;
/// Mean number of copies of one cascade's patch that are blended at a point of the plane.
pub const MEAN_BLENDED_COPIES: f64 = 1.69;
/// Number of possible shifts of a patch copy along each axis: a shift is a multiple of 1/64 of the patch's side.
pub const SHIFT_STEPS_PER_PATCH_SIDE: f64 = 64.0;
/// Hash input that makes the random shifts of the copies of a patch independent of the random numbers of the waves.
const TILE_SHIFT_HASH_SALT: u32 = 0x7469_6c65;
/// Rotation of a patch's triangle lattice per unit of its noise key, rad: the golden angle, so that no lattices align.
const LATTICE_ROTATION_PER_NOISE_KEY_RAD: f64 = 2.399_963_229_728_653;
/// 1 / sqrt(3), for the geometry of equilateral triangles.
const INV_SQRT_3: f64 = 0.577_350_269_189_625_8;

/// Tiling of the plane with one patch: a lattice of triangles, with a shifted copy of the patch at each vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tiling {
    /// Side of the square patch, m.
    pub patch_m: f64,
    /// Cosine and sine of the triangle lattice's rotation, divided by the side of the triangles, 1/m.
    pub rotation_cos_sin_per_m: [f64; 2],
    /// Key of the hash that gives the random shift of each copy.
    pub shift_hash_key: u32,
    /// Whether shifted copies are blended; if false, the patch simply repeats.
    pub blends_copies: bool,
}

/// Position of a point in the triangle lattice of a [`Tiling`]. A shader starts from it to find the shifted copies of
/// the patch that are blended near that point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleLatticePosition {
    /// Tiling to which the position belongs.
    pub tiling: Tiling,
    /// Fractional parts (0 to 1) of the point's coordinates in the triangle lattice, whose unit is a triangle's side.
    pub cell_fraction: [f64; 2],
    /// Integer parts of the point's two coordinates in the triangle lattice (its lattice cell), wrapped to 32 bits.
    pub cell: [i32; 2],
}

/// One of the shifted copies of a cascade's patch whose blend is the sea at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PatchCopy {
    /// Weight W of the copy in the blend, 0 to 1. The squares of the three weights at a point add to 1.
    pub weight: f64,
    /// Gradient (dW/dx, dW/dz) of the copy's weight W, 1/m.
    pub weight_gradient_per_m: [f64; 2],
    /// Integer coordinates, in the triangle lattice, of the vertex to which the copy belongs.
    pub lattice_vertex: [i32; 2],
    /// Shift (x, z) added to a position before the patch is read there, as a fraction of the patch's side, 0 to 1.
    pub shift_in_patches: [f64; 2],
}

impl Tiling {
    /// Makes the tiling of a patch with the side `patch_m` (m). The random shifts of its copies depend on the cascade's
    /// noise key `key` and on the `seed` of the sea. If `blends_copies` is false, the patch repeats.
    pub fn new(patch_m: f64, key: u32, seed: u32, blends_copies: bool) -> Self {
        let (sin, cos) = (LATTICE_ROTATION_PER_NOISE_KEY_RAD * f64::from(key)).sin_cos();
        Self {
            patch_m,
            rotation_cos_sin_per_m: [cos / patch_m, sin / patch_m],
            shift_hash_key: pcg4d([key, seed, TILE_SHIFT_HASH_SALT, 0])[0],
            blends_copies,
        }
    }

    /// Tiling for the same patch with its side divided by `ratio`, and with other random shifts. The shading of the
    /// water adds such smaller copies as ripples, waves too short for the cascades.
    #[must_use]
    pub fn with_smaller_patch(&self, ratio: f64) -> Self {
        Self {
            blends_copies: self.blends_copies,
            ..Self::new(self.patch_m / ratio, self.shift_hash_key, TILE_SHIFT_HASH_SALT, true)
        }
    }

    /// Position in the triangle lattice of the point `at` (x, z), m, a point before displacement by the waves.
    pub fn lattice_position(&self, at: [f64; 2]) -> TriangleLatticePosition {
        let [u, v] = self.lattice_coordinate_gradients_per_m();
        let q = [u, v].map(|axis| axis[0] * at[0] + axis[1] * at[1]);
        let whole = q.map(f64::floor);
        TriangleLatticePosition {
            tiling: *self,
            cell_fraction: [q[0] - whole[0], q[1] - whole[1]],
            // The cast through 64 bits wraps; a direct cast would saturate.
            cell: whole.map(|w| w as i64 as i32),
        }
    }

    /// The three shifted copies of the patch that are blended at the point `at` (x, z), m, a point before displacement
    /// by the waves. A copy can have the weight 0.
    pub fn patch_copies_at(&self, at: [f64; 2]) -> [PatchCopy; 3] {
        let mut out = [[0, 0], [1, 0], [0, 1]].map(|cell| PatchCopy { lattice_vertex: cell, ..PatchCopy::default() });
        if !self.blends_copies {
            out[0].weight = 1.0;
            return out;
        }
        let TriangleLatticePosition { cell_fraction: fraction, cell, .. } = self.lattice_position(at);
        let [u, v] = self.lattice_coordinate_gradients_per_m();
        // A cell has two triangles. Coordinates in the upper triangle are measured from the cell's last vertex.
        let upper = fraction[0] + fraction[1] > 1.0;
        let (sign, [fu, fv]) = if upper { (-1.0, fraction.map(|f| 1.0 - f)) } else { (1.0, fraction) };
        let b = [1.0 - fu - fv, fu, fv];
        let slopes = [[-u[0] - v[0], -u[1] - v[1]], u, v].map(|s| s.map(|s| sign * s));
        let raw = b.map(|b| (b - MIN_WEIGHTED_BARYCENTRIC).max(0.0));
        let norm = 1.0 / raw.iter().map(|r| r.powi(4)).sum::<f64>().sqrt();
        // Sum of w dw divided by the sum of w^2: relative change of the norm along each axis.
        let pull = [0, 1].map(|axis| (0..3).map(|i| 2.0 * raw[i].powi(3) * slopes[i][axis]).sum::<f64>() * norm * norm);
        for (i, copy) in out.iter_mut().enumerate() {
            let corner = copy.lattice_vertex;
            copy.weight = raw[i] * raw[i] * norm;
            copy.weight_gradient_per_m =
                [0, 1].map(|axis| 2.0 * raw[i] * slopes[i][axis] * norm - copy.weight * pull[axis]);
            copy.lattice_vertex =
                [0, 1].map(|axis| cell[axis].wrapping_add(if upper { 1 - corner[axis] } else { corner[axis] }));
            let hash = pcg4d([copy.lattice_vertex[0] as u32, copy.lattice_vertex[1] as u32, self.shift_hash_key, 0]);
            copy.shift_in_patches = [0, 1].map(|axis| f64::from(hash[axis] >> 26) / SHIFT_STEPS_PER_PATCH_SIDE);
        }
        out
    }

    /// Gradients (d/dx, d/dz), 1/m, of a point's first and second coordinate in the triangle lattice.
    pub fn lattice_coordinate_gradients_per_m(&self) -> [[f64; 2]; 2] {
        let [cos, sin] = self.rotation_cos_sin_per_m;
        [[cos + INV_SQRT_3 * sin, sin - INV_SQRT_3 * cos], [-2.0 * INV_SQRT_3 * sin, 2.0 * INV_SQRT_3 * cos]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tiling() -> Tiling {
        Tiling::new(100.0, 70, 1, true)
    }

    /// Pseudo-random points (x, z), m, spread over many cells of the triangle lattice.
    fn points(count: u32) -> impl Iterator<Item = [f64; 2]> {
        (0..count).map(|i| {
            let h = pcg4d([i, 5, 6, 7]);
            [h[0], h[1]].map(|h| (f64::from(h) / 4_294_967_296.0 - 0.5) * 1e5)
        })
    }

    #[test]
    fn variance_is_kept_with_few_copies() {
        let mut copies = 0;
        for at in points(20_000) {
            let blend = tiling().patch_copies_at(at);
            let square: f64 = blend.iter().map(|c| c.weight * c.weight).sum();
            assert!((square - 1.0).abs() < 1e-12);
            copies += blend.iter().filter(|c| c.weight > 0.0).count();
        }
        assert!((f64::from(copies as u32) / 20_000.0 - MEAN_BLENDED_COPIES).abs() < 0.02, "{copies}");
    }

    #[test]
    fn weights_are_smooth_and_their_gradients_are_theirs() {
        let h = 1e-4;
        let mut square = 0.0;
        for at in points(5000) {
            let blend = tiling().patch_copies_at(at);
            for axis in 0..2 {
                let beside = |step: f64| {
                    let mut at = at;
                    at[axis] += step;
                    tiling().patch_copies_at(at)
                };
                let [before, after] = [beside(-h), beside(h)];
                for copy in &blend {
                    // The copy of the same vertex, whichever triangle the neighbour lies in.
                    let of = |b: &[PatchCopy; 3]| {
                        b.iter().find(|c| c.lattice_vertex == copy.lattice_vertex).map_or(0.0, |c| c.weight)
                    };
                    let slope = (of(&after) - of(&before)) / (2.0 * h);
                    assert!((slope - copy.weight_gradient_per_m[axis]).abs() < 2e-4, "{at:?}: {slope} {copy:?}");
                    square += copy.weight_gradient_per_m[axis].powi(2);
                }
            }
        }
        // 5.3 / patch, as stated at the top of this file.
        assert!(((square / 5000.0).sqrt() * 100.0 - 5.3).abs() < 0.1, "{}", (square / 5000.0).sqrt());
    }

    #[test]
    fn copies_have_nothing_in_common_a_patch_away() {
        let common = |distance: f64, angle: f64| {
            let sum: f64 = points(20_000)
                .map(|at| {
                    let there = [at[0] + distance * angle.cos(), at[1] + distance * angle.sin()];
                    let [a, b] = [at, there].map(|p| tiling().patch_copies_at(p));
                    let shared = |c: &PatchCopy| {
                        b.iter().find(|d| d.lattice_vertex == c.lattice_vertex).map_or(0.0, |d| d.weight * c.weight)
                    };
                    a.iter().map(shared).sum::<f64>()
                })
                .sum();
            sum / 20_000.0
        };
        for i in 0..12 {
            let angle = f64::from(i) * 0.262;
            assert!(common(100.0, angle) < 0.06, "{}", common(100.0, angle));
            assert!(common(130.0, angle) < 0.005 && common(3.0, angle) > 0.9);
        }
    }

    #[test]
    fn shifts_are_spread_evenly_and_differ() {
        let mut mean = [0.0; 2];
        let mut seen = std::collections::BTreeSet::new();
        for at in points(4000) {
            for copy in tiling().patch_copies_at(at).iter().filter(|c| c.weight > 0.0) {
                assert!(
                    copy.shift_in_patches
                        .iter()
                        .all(|s| (0.0..1.0).contains(s) && (s * SHIFT_STEPS_PER_PATCH_SIDE).fract() == 0.0)
                );
                if seen.insert(copy.lattice_vertex) {
                    mean = [mean[0] + copy.shift_in_patches[0], mean[1] + copy.shift_in_patches[1]];
                }
            }
        }
        let count = seen.len() as f64;
        assert!(
            count > 3000.0 && mean.iter().all(|m| (m / count - 0.5 + 0.5 / SHIFT_STEPS_PER_PATCH_SIDE).abs() < 0.02),
            "{mean:?} {count}"
        );
        let other = Tiling::new(100.0, 70, 2, true);
        let same = points(4000).filter(|&at| tiling().patch_copies_at(at) == other.patch_copies_at(at)).count();
        assert!(same < 10, "another seed, other shifts: {same}");
        assert_ne!(tiling().with_smaller_patch(13.1).shift_hash_key, tiling().shift_hash_key);
    }

    #[test]
    fn far_away_and_off() {
        for at in [[1e300, -1e300], [f64::MAX, 0.0], [1e9, 3.0]] {
            assert!(
                tiling()
                    .patch_copies_at(at)
                    .iter()
                    .all(|c| c.weight.is_finite() && c.weight_gradient_per_m.iter().all(|g| g.is_finite()))
            );
        }
        let off = Tiling::new(100.0, 70, 1, false).patch_copies_at([123.0, 4.0]);
        assert_eq!((off[0].weight, off[0].shift_in_patches, off[1].weight), (1.0, [0.0; 2], 0.0));
    }
}
