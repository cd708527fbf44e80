//! The colour that a spectrum has for the eye, as linear sRGB.

/// Wavelengths between which spectra are integrated, nm.
const VISIBLE_NM: std::ops::RangeInclusive<u32> = 400..=700;
/// Step of the integration, nm.
const STEP_NM: usize = 5;
/// XYZ of the white point D65 of sRGB, with Y = 1.
const D65_XYZ: [f64; 3] = [0.950_47, 1.0, 1.088_83];
/// XYZ to linear sRGB (IEC 61966-2-1).
const XYZ_TO_SRGB: [[f64; 3]; 3] = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
/// Second radiation constant h c / k, nm K.
const SECOND_RADIATION_CONSTANT_NM_K: f64 = 1.4388e7;
/// Temperature of the black body that stands for daylight, K.
const DAYLIGHT_K: f64 = 6500.0;

/// Linear sRGB of a surface whose reflectance at a wavelength (nm) is `reflectance`, in daylight. A reflectance of 1 at
/// all wavelengths gives (1, 1, 1). Colours outside of the display's gamut have a negative channel.
pub fn linear_srgb_of_reflectance(reflectance: impl Fn(f64) -> f64) -> [f64; 3] {
    let (mut seen, mut white) = ([0.0; 3], [0.0; 3]);
    for nm in VISIBLE_NM.step_by(STEP_NM).map(f64::from) {
        let light = 1.0 / (nm.powi(5) * ((SECOND_RADIATION_CONSTANT_NM_K / (nm * DAYLIGHT_K)).exp() - 1.0));
        let observer = observer_xyz(nm);
        for i in 0..3 {
            white[i] += observer[i] * light;
            seen[i] += observer[i] * light * reflectance(nm);
        }
    }
    let xyz: [f64; 3] = std::array::from_fn(|i| D65_XYZ[i] * seen[i] / white[i]);
    XYZ_TO_SRGB.map(|row| row.iter().zip(xyz).map(|(m, c)| m * c).sum())
}

/// Colour-matching functions of the CIE 1931 observer at `nm`, as fitted by Wyman, Sloan and Shirley, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions", JCGT 2 (2013).
fn observer_xyz(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let x = (nm - middle) / if nm < middle { below } else { above };
        height * (-0.5 * x * x).exp()
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_single_wavelengths_have_their_hue() {
        for channel in linear_srgb_of_reflectance(|_| 1.0) {
            assert!((channel - 1.0).abs() < 2e-3, "{channel}");
        }
        let near = |at: f64| move |nm: f64| if (nm - at).abs() < 10.0 { 1.0 } else { 0.0 };
        for (nm, strongest) in [(620.0, 0), (540.0, 1), (450.0, 2)] {
            let colour = linear_srgb_of_reflectance(near(nm));
            assert!((0..3).all(|i| i == strongest || colour[i] < colour[strongest]), "{nm} nm: {colour:?}");
        }
    }

    #[test]
    fn the_observer_is_that_of_the_cie_table() {
        // CIE 015: x, y and z of the 1931 observer.
        for (nm, want) in
            [(450.0, [0.3362, 0.0380, 1.7721]), (550.0, [0.4334, 0.9950, 0.0087]), (600.0, [1.0622, 0.6310, 0.0008])]
        {
            for (got, want) in observer_xyz(nm).into_iter().zip(want) {
                assert!((got - want).abs() < 0.03, "{nm} nm: {got} for {want}");
            }
        }
    }
}
