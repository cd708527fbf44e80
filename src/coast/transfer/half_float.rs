//! Pairs of half floats in 32 bits, as WGSL's `unpack2x16float` reads them.

use crate::coast::complex::Complex;

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
    let sign = if value.is_sign_negative() { 0x8000 } else { 0 };
    let size = value.abs();
    // Half floats below 2^-14 are multiples of 2^-24; above, the spacing is 2^-10 of the power of two below the value.
    let exponent = if size < 6.103_515_625e-5 { -14 } else { (size.log2().floor() as i32).clamp(-14, 15) };
    let steps = (size * 2f64.powi(10 - exponent)).round_ties_even();
    // 1024 steps above a normal number's power of two; a carry into the next exponent adds up correctly.
    let bits = if steps < 1024.0 { steps as u32 } else { (((exponent + 14) as u32) << 10) + steps as u32 };
    sign | bits.min(0x7bff) as u16
}

/// Value of a half float. Its exponent and fraction are those of a single float whose exponent is 112 less.
fn to_f64(bits: u16) -> f64 {
    let two_to_112 = f32::from_bits((127 + 112) << 23);
    let size = f32::from_bits(u32::from(bits & 0x7fff) << 13) * two_to_112;
    f64::from(if bits >> 15 == 0 { size } else { -size })
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
