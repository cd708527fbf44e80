//! Twin of what shaders/water/surface.wgsl and foam.wgsl make of the maps: the blend of shifted copies.

use super::Texel;
use crate::waves::tiling::Tiling;

/// The fields of one cascade at a point, before chop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Dx, eta, Dz.
    pub moved: [f64; 3],
    /// d eta/dx and d eta/dz.
    pub slope: [f64; 2],
    /// dDx/dx, dDz/dz, dDx/dz, dDz/dx.
    pub strain: [f64; 4],
}

impl Point {
    /// The sum of two cascades.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            moved: std::array::from_fn(|i| self.moved[i] + other.moved[i]),
            slope: std::array::from_fn(|i| self.slope[i] + other.slope[i]),
            strain: std::array::from_fn(|i| self.strain[i] + other.strain[i]),
        }
    }
}

/// The blend at an undisplaced point (x, z) in m. `read` gives the displacement and gradient texels of a copy: of the patch
/// at a place (x, z) in units of its side.
pub fn blend(tiling: &Tiling, at: [f64; 2], read: impl Fn([f64; 2]) -> [Texel; 2]) -> Point {
    let mut out = Point::default();
    for copy in tiling.blend(at).iter().filter(|c| c.weight > 0.0) {
        let place = [0, 1].map(|i| (at[i] / tiling.patch_m).rem_euclid(1.0) + copy.shift[i]);
        let [[dx, eta, dz, shear], [sx, sz, xx, zz]] = read(place);
        let (w, [wx, wz]) = (copy.weight, copy.gradient);
        out = out.plus(&Point {
            moved: [w * dx, w * eta, w * dz],
            slope: [w * sx + wx * eta, w * sz + wz * eta],
            strain: [w * xx + wx * dx, w * zz + wz * dz, w * shear + wz * dx, w * shear + wx * dz],
        });
    }
    out
}
