//! The rainbow by ray optics: what the picture's fit (shaders/sky/rainbow.wgsl) stands for.

use super::colour;
use std::f64::consts::PI;

/// Width of the bins in which rays are counted, degrees, and the range of angles from the point opposite the sun.
const BIN_DEG: f64 = 0.02;
const RANGE_DEG: [f64; 2] = [30.0, 62.0];
/// Number of rays of a wavelength, with equal steps of their distance from the axis of the drop.
const RAYS: u32 = 50_000;
/// Angular radius of the sun's disc, degrees.
const SUN_RADIUS_DEG: f64 = 0.266;
/// Standard deviation of the blur by diffraction, degrees. By Airy's theory, drops of 1.15 mm, the mean of rain by area,
/// spread yellow light over 0.4 degrees, and a mixture of sizes spreads it further.
const DIFFRACTION_DEG: f64 = 0.3;

/// Refractive index of fresh water at 20 °C for light of the wavelength `nm`: Huibers, "Models for the wavelength
/// dependence of the index of refraction of water", Applied Optics 36 (1997).
fn refractive_index(nm: f64) -> f64 {
    1.3199 + 6878.0 / nm.powi(2) - 1.132e9 / nm.powi(4) + 1.11e14 / nm.powi(6)
}

/// Angle from the point opposite the sun, rad, of a ray that enters a drop at `b` of its radius from the axis and is
/// reflected `reflections` times inside, and the share of its light that leaves there.
fn ray(b: f64, index: f64, reflections: i32) -> [f64; 2] {
    let (outside, inside) = (b.asin(), (b / index).asin());
    let (minus, plus) = (outside - inside, outside + inside);
    let leaves = |r: f64| 0.5 * (1.0 - r).powi(2) * r.powi(reflections);
    let share = leaves((minus.sin() / plus.sin()).powi(2)) + leaves((minus.tan() / plus.tan()).powi(2));
    let k = f64::from(reflections);
    let turned = k * PI + 2.0 * outside - 2.0 * (k + 1.0) * inside;
    [PI - turned.cos().clamp(-1.0, 1.0).acos(), share]
}

/// Phase function, relative to scattering that is equal in all directions, of light that drops reflect `reflections`
/// times inside, for the wavelength `nm`: one value for each bin.
fn sharp_bow(nm: f64, reflections: i32) -> Vec<f64> {
    let bins = ((RANGE_DEG[1] - RANGE_DEG[0]) / BIN_DEG).round() as usize;
    let mut bow = vec![0.0; bins];
    for i in 0..RAYS {
        let b = (f64::from(i) + 0.5) / f64::from(RAYS);
        let [angle, share] = ray(b, refractive_index(nm), reflections);
        let bin = (angle.to_degrees() - RANGE_DEG[0]) / BIN_DEG;
        if bin >= 0.0 && bin < bins as f64 {
            // All light has the weight 1: 2 b db.
            bow[bin as usize] += 2.0 * b * share / f64::from(RAYS);
        }
    }
    for (i, light) in bow.iter_mut().enumerate() {
        let edge = |n: usize| (RANGE_DEG[0] + BIN_DEG * n as f64).to_radians().cos();
        *light *= 2.0 / (edge(i) - edge(i + 1));
    }
    bow
}

/// Convolution with a symmetric kernel of the half width `half_deg`, degrees, whose weights sum to 1 here.
fn blurred(values: &[f64], half_deg: f64, kernel: impl Fn(f64) -> f64) -> Vec<f64> {
    let half = (half_deg / BIN_DEG) as i64;
    let weights: Vec<f64> = (-half..=half).map(|i| kernel(BIN_DEG * i as f64)).collect();
    let whole: f64 = weights.iter().sum();
    let at = |i: i64| values.get(usize::try_from(i).unwrap_or(usize::MAX)).copied().unwrap_or(0.0);
    let sum = |i: i64| weights.iter().zip(i - half..).map(|(w, j)| w * at(j)).sum::<f64>() / whole;
    (0..values.len() as i64).map(sum).collect()
}

/// The bow of the order `reflections` (1: primary, 2: secondary) of large drops of fresh water in sunlight: pairs of an
/// angle from the point opposite the sun, degrees, and the phase function there in linear sRGB, relative to scattering
/// that is equal in all directions. Channels of colours outside of the display's gamut are negative.
pub fn bow(reflections: i32) -> Vec<(f64, [f64; 3])> {
    const FIRST_NM: u32 = 400;
    const STEP_NM: usize = 5;
    let disc = |x: f64| (SUN_RADIUS_DEG * SUN_RADIUS_DEG - x * x).max(0.0).sqrt();
    let diffraction = |x: f64| (-0.5 * (x / DIFFRACTION_DEG).powi(2)).exp();
    let bows: Vec<Vec<f64>> = (FIRST_NM..=700)
        .step_by(STEP_NM)
        .map(|nm| blurred(&sharp_bow(f64::from(nm), reflections), SUN_RADIUS_DEG, disc))
        .map(|bow| blurred(&bow, 4.0 * DIFFRACTION_DEG, diffraction))
        .collect();
    let colour = |i: usize| {
        colour::linear_srgb_of_reflectance(|nm| bows[(nm.round() as usize - FIRST_NM as usize) / STEP_NM][i])
    };
    (0..bows[0].len()).map(|i| (RANGE_DEG[0] + BIN_DEG * (i as f64 + 0.5), colour(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angle of least deviation, degrees from the point opposite the sun, by Descartes' formula.
    fn descartes_deg(index: f64, reflections: i32) -> f64 {
        let k = f64::from(reflections);
        let b = (1.0 - (index * index - 1.0) / (k * (k + 2.0))).sqrt();
        ray(b, index, reflections)[0].to_degrees()
    }

    #[test]
    fn bows_lie_where_descartes_found_them() {
        // Textbooks give 42 degrees 2 minutes and 50 degrees 59 minutes for the index 4/3.
        for (reflections, wanted) in [(1, 42.0 + 2.0 / 60.0), (2, 50.0 + 59.0 / 60.0)] {
            let at = descartes_deg(4.0 / 3.0, reflections);
            assert!((at - wanted).abs() < 0.01, "{reflections} reflections: {at}, expected {wanted}");
        }
        for (nm, reflections) in [(700.0, 1), (400.0, 1), (700.0, 2), (400.0, 2)] {
            let at = descartes_deg(refractive_index(nm), reflections);
            let sharp = sharp_bow(nm, reflections);
            let brightest = (0..sharp.len()).max_by(|a, b| sharp[*a].total_cmp(&sharp[*b])).expect("bins");
            let brightest_deg = RANGE_DEG[0] + BIN_DEG * (brightest as f64 + 0.5);
            assert!((brightest_deg - at).abs() <= BIN_DEG, "{nm} nm: {brightest_deg}, {at}");
        }
    }

    /// No light of one or two reflections reaches Alexander's dark band between the bows.
    #[test]
    fn the_band_between_the_bows_is_dark() {
        for reflections in [1, 2] {
            for (angle, colour) in bow(reflections) {
                assert!(
                    !(44.5..=48.5).contains(&angle) || colour.iter().all(|c| c.abs() < 1e-9),
                    "{angle}: {colour:?}"
                );
            }
        }
    }
}
