//! Factors and twiddle factors of the transforms in shaders/waves/fft.wgsl.

use std::f64::consts::TAU;

/// Entries of the table of twiddle factors, and points of the longest line.
pub const TWIDDLES: usize = 1024;

/// The factors of a line of n = first x second points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factors {
    /// Points per transform of the first half; also transforms per line of the second half.
    pub first: u32,
    /// Points per transform of the second half; also transforms per line of the first half.
    pub second: u32,
}

impl Factors {
    /// Factors of `n`, a power of two from 64 to 1024: equal, or the first twice the second.
    pub fn new(n: u32) -> Self {
        let second = 1 << (n.ilog2() / 2);
        Self { first: n / second, second }
    }
}

/// e^(2 pi i j / 1024) for each j, rounded from f64.
pub fn twiddles() -> Vec<[f32; 2]> {
    (0..TWIDDLES)
        .map(|j| {
            let (sin, cos) = (TAU * j as f64 / TWIDDLES as f64).sin_cos();
            [cos as f32, sin as f32]
        })
        .collect()
}
