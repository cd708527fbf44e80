//! Pairs of half floats in 32 bits, as WGSL's `unpack2x16float` reads them.

use crate::coast::complex::Complex;
use half::f16;

/// Packs a complex number: the real part in the low 16 bits, the imaginary part in the high ones.
pub(super) fn pack(value: Complex) -> u32 {
    u32::from(from_f64(value.re)) | u32::from(from_f64(value.im)) << 16
}

/// The complex number of two half floats.
pub(super) fn unpack(bits: u32) -> Complex {
    Complex::new(to_f64(bits as u16), to_f64((bits >> 16) as u16))
}

/// The half float nearest to `value`, ties to even. Too large values become the largest finite one.
fn from_f64(value: f64) -> u16 {
    f16::from_f64(value.clamp(f16::MIN.to_f64(), f16::MAX.to_f64())).to_bits()
}

fn to_f64(bits: u16) -> f64 {
    f16::from_bits(bits).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_half_floats_are_read_back_and_values_are_rounded() {
        for bits in (0..0x7c00_u16).chain(0x8000..0xfc00) {
            assert_eq!(from_f64(to_f64(bits)), bits, "{bits:#x}");
        }
        assert_eq!((to_f64(0x3c00), to_f64(0xc000), to_f64(0x0001)), (1.0, -2.0, 2f64.powi(-24)));
        // A third of the way to the next number goes down, two thirds up; half goes to the even one.
        let between = |part: f64| from_f64(1.0 + part / 1024.0);
        assert_eq!([between(0.3), between(0.7), between(0.5), between(1.5)], [0x3c00, 0x3c01, 0x3c00, 0x3c02]);
        assert_eq!((from_f64(1e9), from_f64(1e-12), from_f64(1.999_99)), (0x7bff, 0, 0x4000));
        let z = unpack(pack(Complex::new(-0.75, 3.5)));
        assert_eq!((z.re, z.im), (-0.75, 3.5));
    }
}
