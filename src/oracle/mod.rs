//! Reference implementations (oracles) of the GPU passes in f64, without table, constant or code from the shaders.
//!
//! Lattices of wave vectors are stored in FFT order, as on the GPU: element i has the signed index i for i < n/2 and
//! i - n otherwise. Rows run along x, columns along z. The code is slow and simple on purpose.

pub mod coast;
pub mod foam;
pub mod maps;
pub mod spectrum;
pub mod surface;
pub mod transform;

/// A complex number (re, im).
pub type Complex = [f64; 2];
/// One texel of a displacement or gradient map: four real numbers, or two complex numbers (re, im, re, im) between the
/// Fourier transforms along rows and along columns.
pub type Texel = [f64; 4];

fn mul(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn add(a: Complex, b: Complex) -> Complex {
    [a[0] + b[0], a[1] + b[1]]
}

/// Product of the imaginary unit i and `a`.
fn times_i(a: Complex) -> Complex {
    [-a[1], a[0]]
}

fn scale(a: Complex, s: f64) -> Complex {
    [a[0] * s, a[1] * s]
}

/// Complex exponential e^{i angle} of an angle in rad.
fn unit_phasor(angle: f64) -> Complex {
    [angle.cos(), angle.sin()]
}

/// Signed wave-vector index of the element `i` of an array in FFT order: first 0 to n/2 - 1, then -n/2 to -1.
pub fn signed_index(i: usize, n: usize) -> i32 {
    if i < n / 2 { i as i32 } else { i as i32 - n as i32 }
}

/// Returns the n x n array `square` (row by row) with the function `line` applied to every column.
fn apply_to_columns<T: Copy + Default>(n: usize, square: &[T], line: impl Fn(&[T]) -> Vec<T>) -> Vec<T> {
    let mut out = vec![T::default(); n * n];
    for x in 0..n {
        let column: Vec<T> = square[x..].iter().step_by(n).copied().collect();
        for (z, value) in line(&column).into_iter().enumerate() {
            out[z * n + x] = value;
        }
    }
    out
}
