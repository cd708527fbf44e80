//! Reference implementation in f64 of the blend of shifted patch copies in shaders/water/surface.wgsl and
//! shaders/foam/foam.wgsl.

use super::Texel;
use crate::waves::second_order::{BoundWaves, ProductFactors};
use crate::waves::tiling::Tiling;

/// Displacement, slope and strain of the surface at an undisplaced point, before multiplication by the chop factors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaveFields {
    /// Horizontal displacement Dx, Dz and elevation eta, in the order (Dx, eta, Dz), m.
    pub displacement: [f64; 3],
    /// Slopes d eta/dx and d eta/dz of the elevation eta (m/m).
    pub slope: [f64; 2],
    /// Derivatives (strain) of the horizontal displacement D = (Dx, Dz): dDx/dx, dDz/dz, dDx/dz, dDz/dx.
    pub strain: [f64; 4],
}

impl WaveFields {
    /// Returns the sum of these wave fields and those of `other`, for example of another cascade at the same point.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            displacement: std::array::from_fn(|i| self.displacement[i] + other.displacement[i]),
            slope: std::array::from_fn(|i| self.slope[i] + other.slope[i]),
            strain: std::array::from_fn(|i| self.strain[i] + other.strain[i]),
        }
    }
}

/// Wave fields of one cascade at the undisplaced point `at` (x, z), m: the blend of the shifted copies of its patch.
/// `read` returns the displacement and gradient texels of the patch at a position (x, z) in units of its side.
pub fn blend_patch_copies(tiling: &Tiling, at: [f64; 2], read: impl Fn([f64; 2]) -> [Texel; 2]) -> WaveFields {
    let mut out = WaveFields::default();
    for copy in tiling.patch_copies_at(at).iter().filter(|c| c.weight > 0.0) {
        let place = [0, 1].map(|i| (at[i] / tiling.patch_m).rem_euclid(1.0) + copy.shift_in_patches[i]);
        let [[dx, eta, dz, shear], [sx, sz, xx, zz]] = read(place);
        let (w, [wx, wz]) = (copy.weight, copy.weight_gradient_per_m);
        out = out.plus(&WaveFields {
            displacement: [w * dx, w * eta, w * dz],
            slope: [w * sx + wx * eta, w * sz + wz * eta],
            strain: [w * xx + wx * dx, w * zz + wz * dz, w * shear + wz * dx, w * shear + wx * dz],
        });
    }
    out
}

/// Height, m, of the bound waves of the second order at a point, from the displacements (Dx, eta, Dz) of all cascades
/// there, longest waves first: the double sum over pairs of cascades (src/waves/second_order.rs).
pub fn bound_height_m(displacements: &[[f64; 3]], bound: &BoundWaves) -> f64 {
    let product = |factors: ProductFactors, a: [f64; 3], b: [f64; 3]| {
        factors.elevation * a[1] * b[1] + factors.displacement * (a[0] * b[0] + a[2] * b[2])
    };
    let mut sum = 0.0;
    for (i, (a, waves)) in displacements.iter().zip(&bound.cascades).enumerate() {
        sum += waves.level_m + bound.totals.elevation_gain * a[1] + 0.5 * product(waves.own, *a, *a);
        for b in &displacements[i + 1..] {
            sum += product(waves.with_shorter, *a, *b);
        }
    }
    sum
}
