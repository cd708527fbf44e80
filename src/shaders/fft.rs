//! Twiddle factors of the FFT, and factors of the FFT size for software adapters.

use std::f64::consts::TAU;

/// Number of entries in the table of FFT twiddle factors, which equals the largest FFT size.
pub const TWIDDLE_COUNT: usize = 1024;

/// Factors of the FFT size n = first x second. Software adapters do the
/// FFT of a line of n points in two rounds of shorter FFTs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FftFactors {
    /// Number of points of each short FFT in the first round, and number of short FFTs per line in the second round.
    pub first_round_points: u32,
    /// Number of points of each short FFT in the second round, and number of short FFTs per line in the first round.
    pub second_round_points: u32,
}

impl FftFactors {
    /// Factors of the FFT size `n`, a power of two from 64 to 1024: equal, or the first is twice the second.
    pub fn new(n: u32) -> Self {
        let second = 1 << (n.ilog2() / 2);
        Self { first_round_points: n / second, second_round_points: second }
    }
}

/// FFT twiddle factors e^(2 pi i j / 1024) for j from 0 to 1023: \[real part, imaginary part\], rounded from f64.
pub fn twiddle_factors() -> Vec<[f32; 2]> {
    (0..TWIDDLE_COUNT)
        .map(|j| {
            let (sin, cos) = (TAU * j as f64 / TWIDDLE_COUNT as f64).sin_cos();
            [cos as f32, sin as f32]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_make_the_size() {
        for n in [64, 128, 256, 512, 1024] {
            let FftFactors { first_round_points: first, second_round_points: second } = FftFactors::new(n);
            assert_eq!(first * second, n);
            assert!(first >= second && [8, 16, 32].contains(&first) && [8, 16, 32].contains(&second));
        }
    }
}
