//! Random numbers of the waves: an integer hash of the seed, the key of the cascade and the signed indices of the wave
//! vector. Shaders compute the same bits. The random numbers of a wave do not depend on the FFT size.

use std::f64::consts::TAU;

/// Integer hash `pcg4d` of four 32-bit words to four (Jarzynski and Olano, "Hash Functions for GPU Rendering", 2020).
pub fn pcg4d(v: [u32; 4]) -> [u32; 4] {
    let mut v = v.map(|x| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mix = |v: &mut [u32; 4]| {
        v[0] = v[0].wrapping_add(v[1].wrapping_mul(v[3]));
        v[1] = v[1].wrapping_add(v[2].wrapping_mul(v[0]));
        v[2] = v[2].wrapping_add(v[0].wrapping_mul(v[1]));
        v[3] = v[3].wrapping_add(v[1].wrapping_mul(v[2]));
    };
    mix(&mut v);
    v = v.map(|x| x ^ (x >> 16));
    mix(&mut v);
    v
}

/// Returns two random words for the wave with signed lattice indices (ix, iz) in the cascade with the noise key `key`,
/// for the `seed` of the sea. [`complex_gaussian`] turns them into two standard normal numbers.
pub fn noise_words(seed: u32, key: u32, ix: i32, iz: i32) -> [u32; 2] {
    let h = pcg4d([ix as u32, iz as u32, key, seed]);
    [h[0], h[1]]
}

/// Converts two random words to two independent standard normal numbers by the Box-Muller transform. The first word is
/// mapped to the open interval (0, 1), so the result is always finite.
pub fn complex_gaussian(noise_words: [u32; 2]) -> [f64; 2] {
    let u = (f64::from(noise_words[0] >> 9) + 0.5) / f64::from(1u32 << 23);
    let radius = (-2.0 * u.ln()).sqrt();
    let angle = f64::from(noise_words[1]) * (TAU / 4_294_967_296.0);
    [radius * angle.cos(), radius * angle.sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_a_complex_gaussian() {
        let (mut m1, mut m2, mut m4, mut cross, n) = (0.0, 0.0, 0.0, 0.0, 256);
        for ix in -n..n {
            for iz in -n..n {
                let [a, b] = complex_gaussian(noise_words(7, 3, ix, iz));
                m1 += a + b;
                m2 += a * a + b * b;
                m4 += (a * a + b * b).powi(2);
                cross += a * b;
            }
        }
        let count = f64::from(4 * n * n);
        assert!((m1 / count).abs() < 0.01);
        assert!((m2 / count - 2.0).abs() < 0.02);
        assert!((m4 / count - 8.0).abs() < 0.2, "Rayleigh amplitudes: <|z|^4> = 2 <|z|^2>^2");
        assert!((cross / count).abs() < 0.01);
    }
}
