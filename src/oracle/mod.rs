//! The f64 twin of every GPU pass, computed from the model alone: no table, constant or code shared with the shaders.
//!
//! Lattices are in FFT order (index i stands for i or i - n), rows along z, columns along x, as on the GPU. Slow and
//! plain on purpose; native programs and tests only.

pub mod foam;
pub mod maps;
pub mod spectrum;
pub mod surface;
pub mod transform;

/// A complex number (re, im).
pub type Complex = [f64; 2];
/// Four real numbers, or two complex ones.
pub type Texel = [f64; 4];

fn mul(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn add(a: Complex, b: Complex) -> Complex {
    [a[0] + b[0], a[1] + b[1]]
}

/// i a.
fn turn(a: Complex) -> Complex {
    [-a[1], a[0]]
}

fn scale(a: Complex, s: f64) -> Complex {
    [a[0] * s, a[1] * s]
}

/// e^{i angle}.
fn unit(angle: f64) -> Complex {
    [angle.cos(), angle.sin()]
}

/// Signed wave-vector index of lattice position `i`.
pub fn signed(i: usize, n: usize) -> i32 {
    if i < n / 2 { i as i32 } else { i as i32 - n as i32 }
}
