//! How a line of n points is shared out over threads. shaders/fft.wgsl.

use std::f64::consts::TAU;

/// Points of the table of twiddle factors: the longest line.
pub const TWIDDLES: usize = 1024;
/// Workgroup memory that a kernel may use, in vec4f: WebGPU's base limit.
const EXCHANGE_LIMIT: u32 = 1024;

/// The factorisation n = r1 x r2 and how many lines share a workgroup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transform {
    /// Points of a line.
    pub n: u32,
    /// Points that a thread transforms first.
    pub r1: u32,
    /// Points that it transforms second; also the threads of a line.
    pub r2: u32,
    /// Lines of a workgroup.
    pub lines: u32,
}

impl Transform {
    /// The kernel for lines of `n` points, a power of two from 64 to 1024.
    pub fn new(n: u32) -> Self {
        let log = n.ilog2();
        let r1 = 1 << log.div_ceil(2);
        let r2 = n / r1;
        // At least a warp's worth of threads, as far as the workgroup memory reaches.
        let lines = (64 / r2).clamp(1, EXCHANGE_LIMIT / n);
        Self { n, r1, r2, lines }
    }

    /// Override constants of the kernels.
    pub fn constants(&self) -> [(&'static str, f64); 5] {
        let exchange = self.lines * self.n;
        [("N", self.n), ("R1", self.r1), ("R2", self.r2), ("LINES", self.lines), ("EXCHANGE", exchange)]
            .map(|(name, value)| (name, f64::from(value)))
    }
}

/// e^(2 pi i j / 1024), rounded from f64.
pub fn twiddles() -> Vec<[f32; 2]> {
    (0..TWIDDLES)
        .map(|j| {
            let angle = TAU * j as f64 / TWIDDLES as f64;
            [angle.cos() as f32, angle.sin() as f32]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_fit_the_base_limits() {
        for n in [64, 128, 256, 512, 1024] {
            let t = Transform::new(n);
            assert_eq!(t.r1 * t.r2, n);
            assert!(t.r1 >= t.r2 && [8, 16, 32].contains(&t.r1) && [8, 16, 32].contains(&t.r2));
            assert!(t.lines * t.n <= EXCHANGE_LIMIT && n % t.lines == 0 && t.lines * t.r2 <= 256);
        }
    }
}
