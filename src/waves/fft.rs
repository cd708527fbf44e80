//! Fast Fourier transform on the CPU, for the spectra of buoy records and of maps read back from the GPU.

use std::f64::consts::TAU;

/// Radix-2 fast Fourier transform of a fixed number of points, with precomputed twiddle factors.
#[derive(Clone, Debug)]
pub struct Fft {
    /// Twiddle factors e^(-2 pi i j / n) as (re, im), for j from 0 to n / 2 - 1, where n is the number of points.
    roots: Vec<[f64; 2]>,
}

impl Fft {
    /// Prepares a Fourier transform of `n` points.
    ///
    /// # Panics
    /// If `n` is not a power of two.
    pub fn new(n: usize) -> Self {
        assert!(n.is_power_of_two(), "{n} points are not a power of two");
        let root = |j| {
            let (sin, cos) = (-TAU * j as f64 / n as f64).sin_cos();
            [cos, sin]
        };
        Self { roots: (0..n / 2).map(root).collect() }
    }

    /// Transforms complex numbers (re, im) in place: X_k = sum over j of x_j e^(-2 pi i j k / n).
    ///
    /// # Panics
    /// If `x` does not have the length given to [`Fft::new`].
    pub fn forward(&self, x: &mut [[f64; 2]]) {
        let n = x.len();
        assert_eq!(n.max(2) / 2, self.roots.len().max(1), "wrong length");
        for i in 0..n {
            let j = i.reverse_bits().checked_shr(usize::BITS - n.trailing_zeros()).unwrap_or(0);
            if i < j {
                x.swap(i, j);
            }
        }
        let mut half = 1;
        while half < n {
            let stride = n / (2 * half);
            for block in x.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                for (k, (a, b)) in low.iter_mut().zip(high).enumerate() {
                    let [cos, sin] = self.roots[k * stride];
                    let t = [b[0] * cos - b[1] * sin, b[0] * sin + b[1] * cos];
                    (*a, *b) = ([a[0] + t[0], a[1] + t[1]], [a[0] - t[0], a[1] - t[1]]);
                }
            }
            half *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_transformed_as_the_sum_says() {
        for n in [1, 2, 8, 64] {
            let line: Vec<[f64; 2]> = (0..n).map(|i| [(0.7 * i as f64).sin(), (1.3 * i as f64).cos() - 0.2]).collect();
            let mut fast = line.clone();
            Fft::new(n).forward(&mut fast);
            for (k, got) in fast.iter().enumerate() {
                let sum = line.iter().enumerate().fold([0.0; 2], |sum, (j, x)| {
                    let (sin, cos) = (-TAU * (j * k) as f64 / n as f64).sin_cos();
                    [sum[0] + x[0] * cos - x[1] * sin, sum[1] + x[0] * sin + x[1] * cos]
                });
                assert!((got[0] - sum[0]).hypot(got[1] - sum[1]) < 1e-12 * n as f64, "{n} {k}: {got:?} {sum:?}");
            }
        }
    }
}
