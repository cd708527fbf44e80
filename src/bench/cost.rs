//! What the passes of the simulation move and compute, counted by hand from their shaders: the least that each has to, every
//! value once, so that a cache can make no pass better than its budget.

use crate::gpu::layout::FOAM_LEVELS;
use crate::gpu::map_format::MapFormat;
use crate::model::tiling::MEAN_COPIES;

/// A budget.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Bytes that are read and written.
    pub bytes: f64,
    /// Additions and multiplications.
    pub flops: f64,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops }
    }
}

/// Of so much for every texel of every cascade.
fn texels(n: u32, cascades: u32, bytes: f64, flops: f64) -> Cost {
    let count = f64::from(n) * f64::from(n) * f64::from(cascades);
    Cost { bytes: count * bytes, flops: count * flops }
}

/// Four complex transforms along one axis, for each point.
fn transforms(n: u32) -> f64 {
    4.0 * 5.0 * f64::from(n.ilog2())
}

/// Waves at a time and their transform along x: h0 of a wave and of the opposite one (16), an eighth of an entry of the table
/// (1), four complex numbers out (32).
pub fn rows(n: u32, cascades: u32) -> Cost {
    texels(n, cascades, 49.0, 30.0 + 14.0 + 40.0 + transforms(n))
}

/// The transform along z and the maps: four complex numbers in (32), two texels out.
pub fn columns(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    texels(n, cascades, 32.0 + 2.0 * f64::from(maps.bytes()), transforms(n))
}

/// The waves: both together.
pub fn waves(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    rows(n, cascades) + columns(n, cascades, maps)
}

/// Mips: two texels in, a third of three out, four values of eleven channels added for each texel that comes out.
pub fn mips(n: u32, cascades: u32, maps: MapFormat) -> Cost {
    texels(n, cascades, 3.0 * f64::from(maps.bytes()), 4.0 * 14.0 / 3.0)
}

/// Foam: history in and out (8), a texel out, and for each cascade and copy four texels of two maps, with the arithmetic of their
/// mixture and of the blend.
pub fn foam(foam_n: u32, cascades: u32, maps: MapFormat) -> Cost {
    let (samples, texel) = (f64::from(cascades) * MEAN_COPIES, f64::from(maps.bytes()));
    let flops = 40.0 + 60.0 * f64::from(cascades) + 60.0 * samples;
    texels(foam_n, FOAM_LEVELS as u32, 8.0 + texel + 8.0 * texel * samples, flops)
}
