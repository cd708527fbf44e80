//! Reference implementation of the inverse discrete Fourier transform without normalisation,
//! x_j = sum over k of X_k e^{+2 pi i j k / n}.

use super::{Complex, add, map_columns, mul, scale, unit_phasor};
use std::f64::consts::TAU;

/// Inverse Fourier transform of one line of complex numbers, whose length must be a power of two.
pub fn inverse(line: &[Complex]) -> Vec<Complex> {
    let n = line.len();
    if n == 1 {
        return line.to_vec();
    }
    let half = |start: usize| inverse(&line.iter().skip(start).step_by(2).copied().collect::<Vec<_>>());
    let (even, odd) = (half(0), half(1));
    let mut out = vec![[0.0; 2]; n];
    for j in 0..n / 2 {
        let twisted = mul(unit_phasor(TAU * j as f64 / n as f64), odd[j]);
        out[j] = add(even[j], twisted);
        out[j + n / 2] = add(even[j], scale(twisted, -1.0));
    }
    out
}

/// Two-dimensional inverse Fourier transform of an n x n array of complex numbers.
pub fn inverse_2d(n: usize, square: &[Complex]) -> Vec<Complex> {
    let rows: Vec<Complex> = square.chunks(n).flat_map(inverse).collect();
    map_columns(n, &rows, inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_definition() {
        let line: Vec<Complex> = (0..16).map(|i| [f64::from(i % 5) - 2.0, f64::from(i % 3)]).collect();
        for (j, got) in inverse(&line).into_iter().enumerate() {
            let want = line
                .iter()
                .enumerate()
                .fold([0.0; 2], |sum, (k, &x)| add(sum, mul(x, unit_phasor(TAU * (j * k) as f64 / 16.0))));
            assert!((got[0] - want[0]).abs() + (got[1] - want[1]).abs() < 1e-12);
        }
    }
}
