//! Reference implementation of the inverse discrete Fourier transform without normalisation,
//! x_j = sum over k of X_k e^{+2 pi i j k / n}.

use super::{Complex, apply_to_columns};
use crate::waves::fft::Fft;

/// Inverse Fourier transform, without the factor 1/n, of a line of n complex numbers, n a power of two.
pub fn inverse_dft(line: &[Complex]) -> Vec<Complex> {
    // The forward transform of the conjugate numbers gives the conjugate of the result.
    let conjugate = |[re, im]: Complex| [re, -im];
    let mut out: Vec<Complex> = line.iter().copied().map(conjugate).collect();
    Fft::new(out.len()).forward(&mut out);
    out.into_iter().map(conjugate).collect()
}

/// Two-dimensional inverse Fourier transform, without the factor 1/n^2, of n x n complex numbers stored row by row.
pub fn inverse_2d(n: usize, square: &[Complex]) -> Vec<Complex> {
    let rows: Vec<Complex> = square.chunks(n).flat_map(inverse_dft).collect();
    apply_to_columns(n, &rows, inverse_dft)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{add, mul, unit_phasor};
    use std::f64::consts::TAU;

    #[test]
    fn agrees_with_the_definition() {
        let line: Vec<Complex> = (0..16).map(|i| [f64::from(i % 5) - 2.0, f64::from(i % 3)]).collect();
        for (j, got) in inverse_dft(&line).into_iter().enumerate() {
            let want = line
                .iter()
                .enumerate()
                .fold([0.0; 2], |sum, (k, &x)| add(sum, mul(x, unit_phasor(TAU * (j * k) as f64 / 16.0))));
            assert!((got[0] - want[0]).abs() + (got[1] - want[1]).abs() < 1e-12);
        }
    }
}
