//! The texture format RGB9E5: three numbers with a shared exponent, in a third of the memory of f32.

/// Largest value that the texture format RGB9E5 can hold.
pub(super) const MAX_RGB9E5: f32 = 65408.0;

/// Packs linear red, green and blue as RGB9E5; negative values become 0 and too large ones [`MAX_RGB9E5`].
pub(super) fn pack_rgb9e5(c: [f32; 3]) -> u32 {
    let c = c.map(|v| v.clamp(0.0, MAX_RGB9E5));
    let most = c[0].max(c[1]).max(c[2]);
    // Mantissas have nine bits without a hidden leading bit; exponents are -15 to 16.
    let mut exponent = if most > 0.0 { (most.log2().floor() as i32).max(-16) + 1 } else { -15 };
    if (most / value_spacing(exponent)).round() >= 512.0 {
        exponent += 1;
    }
    let unit = value_spacing(exponent);
    let [r, g, b] = c.map(|v| (v / unit).round() as u32);
    r | g << 9 | b << 18 | ((exponent + 15) as u32) << 27
}

/// Difference between neighbouring numbers that RGB9E5 can hold with the shared exponent `exponent`, -15 to 16: the
/// stored exponent minus 15.
fn value_spacing(exponent: i32) -> f32 {
    2f32.powi(exponent - 9)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unpack(v: u32) -> [f32; 3] {
        [0, 9, 18].map(|shift| (v >> shift & 0x1ff) as f32 * value_spacing((v >> 27) as i32 - 15))
    }

    #[test]
    fn colours_survive() {
        for c in [[0.0; 3], [1.0, 0.5, 0.25], [3.1, 0.02, 700.0], [65408.0, 1.0, 0.0], [0.9999, 0.0, 1e-5], [1e-4; 3]] {
            let most = c.iter().fold(0f32, |a, b| a.max(*b));
            for (a, b) in c.iter().zip(unpack(pack_rgb9e5(c))) {
                assert!((a - b).abs() <= most / 512.0, "{c:?}");
            }
        }
        assert_eq!(unpack(pack_rgb9e5([1e9, 0.0, 0.0])), [MAX_RGB9E5, 0.0, 0.0]);
    }
}
