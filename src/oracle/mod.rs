//! Reference implementations in f64 of the GPU passes, without any table, constant or code in common with the shaders.
//!
//! Lattices are in FFT order (index i stands for i or i - n), with rows along x and columns along z, as on the GPU. The
//! code is slow and plain on purpose; only native programs and tests use it.

pub mod foam;
pub mod maps;
pub mod spectrum;
pub mod surface;
pub mod transform;

/// A complex number (re, im).
pub type Complex = [f64; 2];
/// One texel: four real or two complex numbers.
pub type Texel = [f64; 4];

fn mul(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn add(a: Complex, b: Complex) -> Complex {
    [a[0] + b[0], a[1] + b[1]]
}

/// i a.
fn times_i(a: Complex) -> Complex {
    [-a[1], a[0]]
}

fn scale(a: Complex, s: f64) -> Complex {
    [a[0] * s, a[1] * s]
}

/// e^{i angle}.
fn cis(angle: f64) -> Complex {
    [angle.cos(), angle.sin()]
}

/// Signed wave-vector index of position `i` in FFT order.
pub fn signed_index(i: usize, n: usize) -> i32 {
    if i < n / 2 { i as i32 } else { i as i32 - n as i32 }
}

/// Applies `line` to every column of an n x n square.
fn map_columns<T: Copy + Default>(n: usize, square: &[T], line: impl Fn(&[T]) -> Vec<T>) -> Vec<T> {
    let mut out = vec![T::default(); n * n];
    for x in 0..n {
        let column: Vec<T> = square[x..].iter().step_by(n).copied().collect();
        for (z, value) in line(&column).into_iter().enumerate() {
            out[z * n + x] = value;
        }
    }
    out
}
