//! LDR-FLIP, the perceived difference of two pictures shown in alternation: Andersson et al., "FLIP: A Difference
//! Evaluator for Alternating Images", 2020. Names and constants are the paper's.

use std::f64::consts::PI;

/// Pixels per degree of visual angle for a 4K screen, 70 cm wide, seen from 70 cm: FLIP's usual viewing condition.
pub const PIXELS_PER_DEGREE: f64 = 67.02064;

/// A picture in 8-bit sRGB, without alpha.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SrgbPicture {
    /// Width of the picture, pixels.
    pub width: usize,
    /// Height of the picture, pixels.
    pub height: usize,
    /// Red, green and blue of each pixel, row by row.
    pub pixels: Vec<[u8; 3]>,
}

impl SrgbPicture {
    /// Creates a picture from RGBA bytes, row by row. Alpha is dropped.
    pub fn from_rgba(width: u32, bytes: &[u8]) -> Self {
        let pixels: Vec<[u8; 3]> = bytes.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
        Self { width: width as usize, height: pixels.len() / (width as usize).max(1), pixels }
    }
}

/// Perceived difference (FLIP) of two pictures at every pixel, from 0 (equal) to 1, row by row. `pixels_per_degree` is
/// the number of pixels in a degree of the observer's visual angle, usually [`PIXELS_PER_DEGREE`].
///
/// # Errors
/// If the pictures differ in size.
pub fn flip_errors(reference: &SrgbPicture, test: &SrgbPicture, pixels_per_degree: f64) -> Result<Vec<f64>, String> {
    if (reference.width, reference.height) != (test.width, test.height) {
        return Err(format!(
            "the pictures differ in size: {}x{} and {}x{}",
            reference.width, reference.height, test.width, test.height
        ));
    }
    let (a, b) = (perceived_lab(reference, pixels_per_degree), perceived_lab(test, pixels_per_degree));
    let (fa, fb) =
        (FeatureStrengths::new(reference, pixels_per_degree), FeatureStrengths::new(test, pixels_per_degree));
    let most = hyab_distance(lab_with_hunt_effect([0.0, 1.0, 0.0]), lab_with_hunt_effect([0.0, 0.0, 1.0]))
        .powf(COLOUR_EXPONENT);
    let error = |i: usize| {
        let colour = to_flip_scale(hyab_distance(a[i], b[i]).powf(COLOUR_EXPONENT), most);
        let edge = (fa.edges[i] - fb.edges[i]).abs();
        let point = (fa.points[i] - fb.points[i]).abs();
        let feature = (edge.max(point) / 2f64.sqrt()).powf(FEATURE_EXPONENT);
        colour.powf(1.0 - feature.min(1.0))
    };
    Ok((0..a.len()).map(error).collect())
}

/// Mean FLIP difference over all pixels; 0 without pixels.
pub fn mean_error(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len().max(1) as f64
}

const COLOUR_EXPONENT: f64 = 0.7;
const FEATURE_EXPONENT: f64 = 0.5;
/// Colour difference (HyAB distance to the power 0.7), as a fraction of the largest possible one, above which FLIP
/// compresses differences into the range from [`KNEE_FLIP_VALUE`] to 1.
const KNEE_DIFFERENCE_FRACTION: f64 = 0.4;
/// Value that FLIP gives to a colour difference of [`KNEE_DIFFERENCE_FRACTION`] times the largest one.
const KNEE_FLIP_VALUE: f64 = 0.95;
/// Width of the edges and points that FLIP detects, degrees of visual angle.
const FEATURE_WIDTH_DEG: f64 = 0.082;
/// Matrix that converts linear sRGB to CIE XYZ.
const RGB_TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];
/// Matrix that converts CIE XYZ to linear sRGB.
const XYZ_TO_RGB: [[f64; 3]; 3] = [
    [3.241_003_275, -1.537_398_934, -0.498_615_861],
    [-0.969_224_334, 1.875_930_071, 0.041_554_224],
    [0.055_639_423, -0.204_011_202, 1.057_148_933],
];

fn matrix_times_vector(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// CIE XYZ of the reference white: linear sRGB (1, 1, 1).
fn white_point_xyz() -> [f64; 3] {
    matrix_times_vector(&RGB_TO_XYZ, [1.0; 3])
}

fn srgb_to_linear(byte: u8) -> f64 {
    let x = f64::from(byte) / 255.0;
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// Converts an sRGB colour to YCxCz: luminance and two opponent colours, in which contrast sensitivity is measured.
fn srgb_to_opponent(rgb: [u8; 3]) -> [f64; 3] {
    let xyz = matrix_times_vector(&RGB_TO_XYZ, rgb.map(srgb_to_linear));
    let white = white_point_xyz();
    let [x, y, z]: [f64; 3] = std::array::from_fn(|i| xyz[i] / white[i]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Converts YCxCz (luminance and two opponent colours) to linear sRGB, clamped to the gamut.
fn opponent_to_linear_rgb([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let relative = [y + cx / 500.0, y, y - cz / 200.0];
    let white = white_point_xyz();
    matrix_times_vector(&XYZ_TO_RGB, std::array::from_fn(|i| relative[i] * white[i])).map(|c| c.clamp(0.0, 1.0))
}

/// Converts linear sRGB to L*a*b*, with a* and b* multiplied by L*/100: the Hunt effect (dark colours look less vivid).
fn lab_with_hunt_effect(rgb: [f64; 3]) -> [f64; 3] {
    let delta: f64 = 6.0 / 29.0;
    let f = |t: f64| if t > delta.powi(3) { t.cbrt() } else { t / (3.0 * delta * delta) + 4.0 / 29.0 };
    let (xyz, white) = (matrix_times_vector(&RGB_TO_XYZ, rgb), white_point_xyz());
    let [x, y, z]: [f64; 3] = std::array::from_fn(|i| f(xyz[i] / white[i]));
    let l = 116.0 * y - 16.0;
    [l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)]
}

/// HyAB distance of two L*a*b* colours: the difference of L* plus the Euclidean distance in a* and b*. It stays valid
/// for large colour differences (Abasi et al. 2020).
fn hyab_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Maps a colour difference (HyAB distance to the power 0.7; 0 to `max_difference`, the largest possible one) to FLIP's
/// scale from 0 to 1: linearly up to [`KNEE_DIFFERENCE_FRACTION`] of `max_difference`, and with a smaller slope above.
fn to_flip_scale(difference: f64, max_difference: f64) -> f64 {
    let knee = KNEE_DIFFERENCE_FRACTION * max_difference;
    if difference < knee {
        KNEE_FLIP_VALUE / knee * difference
    } else {
        KNEE_FLIP_VALUE + (difference - knee) / (max_difference - knee) * (1.0 - KNEE_FLIP_VALUE)
    }
}

/// L*a*b* (with the Hunt effect) of each pixel as an observer perceives it who sees `pixels_per_degree` pixels in a
/// degree of visual angle: the eye's contrast sensitivity blurs luminance and the two opponent colours.
fn perceived_lab(picture: &SrgbPicture, pixels_per_degree: f64) -> Vec<[f64; 3]> {
    // Weight and width of two Gaussians each for luminance, red-green and blue-yellow.
    const CONTRAST_SENSITIVITY_GAUSSIANS: [[[f64; 2]; 2]; 3] =
        [[[1.0, 0.0047], [0.0, 1e-5]], [[1.0, 0.0053], [0.0, 1e-5]], [[34.1, 0.04], [13.5, 0.025]]];
    let colours: Vec<[f64; 3]> = picture.pixels.iter().map(|&p| srgb_to_opponent(p)).collect();
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
    let offsets: Vec<f64> = (-radius..=radius).map(|i| f64::from(i) / pixels_per_degree).collect();
    let mut out = colours.clone();
    for (channel, gaussians) in CONTRAST_SENSITIVITY_GAUSSIANS.iter().enumerate() {
        let plane: Vec<f64> = colours.iter().map(|c| c[channel]).collect();
        let (mut sum, mut whole) = (vec![0.0; plane.len()], 0.0);
        for [weight, width] in gaussians.iter().filter(|g| g[0] > 0.0) {
            let kernel: Vec<f64> = offsets.iter().map(|x| (-PI * PI * x * x / width).exp()).collect();
            let scale = weight * (PI / width).sqrt();
            whole += scale * kernel.iter().sum::<f64>().powi(2);
            let blurred = filter_channel_separably(&plane, picture.width, &kernel, &kernel);
            sum.iter_mut().zip(blurred).for_each(|(s, b)| *s += scale * b);
        }
        out.iter_mut().zip(sum).for_each(|(c, s)| c[channel] = s / whole);
    }
    out.into_iter().map(|c| lab_with_hunt_effect(opponent_to_linear_rgb(c))).collect()
}

/// Filters one channel of a picture: rows by the kernel `along`, then columns by `down`. Border pixels are repeated.
fn filter_channel_separably(plane: &[f64], width: usize, along: &[f64], down: &[f64]) -> Vec<f64> {
    let height = plane.len() / width;
    let reach = (along.len() / 2) as isize;
    let at = |i: usize, k: usize, last: usize| (i as isize + k as isize - reach).clamp(0, last as isize - 1) as usize;
    let rows: Vec<f64> = (0..plane.len())
        .map(|i| {
            let (x, y) = (i % width, i / width);
            along.iter().enumerate().map(|(k, w)| w * plane[y * width + at(x, k, width)]).sum()
        })
        .collect();
    (0..plane.len())
        .map(|i| {
            let (x, y) = (i % width, i / width);
            down.iter().enumerate().map(|(k, w)| w * rows[at(y, k, height) * width + x]).sum()
        })
        .collect()
}

/// Strength, at every pixel of a picture, of the edges and of the small dots (points) that FLIP detects.
struct FeatureStrengths {
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl FeatureStrengths {
    fn new(picture: &SrgbPicture, pixels_per_degree: f64) -> Self {
        let sd = 0.5 * FEATURE_WIDTH_DEG * pixels_per_degree;
        let radius = (3.0 * sd).ceil() as i32;
        let offsets: Vec<f64> = (-radius..=radius).map(f64::from).collect();
        let gauss: Vec<f64> = offsets.iter().map(|x| (-x * x / (2.0 * sd * sd)).exp()).collect();
        let kernel = |f: &dyn Fn(f64) -> f64| {
            let raw: Vec<f64> = offsets.iter().zip(&gauss).map(|(&x, g)| f(x) * g).collect();
            let (up, down) = raw.iter().fold((0.0, 0.0), |(u, d), &w| (u + w.max(0.0), d - w.min(0.0)));
            raw.iter().map(|&w| if w > 0.0 { w / up } else { w / down }).collect::<Vec<f64>>()
        };
        let (first, second) = (kernel(&|x| -x), kernel(&|x| x * x / (sd * sd) - 1.0));
        let total: f64 = gauss.iter().sum();
        let blur: Vec<f64> = gauss.iter().map(|g| g / total).collect();
        let grey: Vec<f64> = picture.pixels.iter().map(|&p| (srgb_to_opponent(p)[0] + 16.0) / 116.0).collect();
        let size = |kernel: &[f64]| {
            let x = filter_channel_separably(&grey, picture.width, kernel, &blur);
            let y = filter_channel_separably(&grey, picture.width, &blur, kernel);
            x.iter().zip(&y).map(|(x, y)| x.hypot(*y)).collect()
        };
        Self { edges: size(&first), points: size(&second) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, f: impl Fn(u32, u32) -> [u8; 3]) -> SrgbPicture {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| f(x, y)).collect();
        SrgbPicture { width: width as usize, height: height as usize, pixels }
    }

    fn noise(x: u32, y: u32) -> [u8; 3] {
        let h = (x.wrapping_mul(1_664_525) ^ y.wrapping_mul(22_695_477)).wrapping_mul(2_654_435_761);
        [(h >> 24) as u8, (x * 5 % 256) as u8, (y * 7 % 256) as u8]
    }

    fn disc(x: u32, y: u32, middle: i32) -> [u8; 3] {
        let inside = (x as i32 - middle).pow(2) + (y as i32 - 20).pow(2) < 100;
        if inside { [255, 240, 200] } else { [20, 40, 90] }
    }

    /// Compares the mean with NVIDIA's implementation (nv-flip 0.1.2, FLIP 1.2, in f32) at 67.02064 and 30 pixels per
    /// degree.
    #[test]
    fn means_are_those_of_the_authors() {
        let mixed = |x, y| {
            let [r, g, b] = noise(x, y);
            [r / 2 + 40, g, 255 - b]
        };
        let even = |c: [u8; 3]| picture(8, 8, move |_, _| c);
        let cases = [
            (picture(60, 40, noise), picture(60, 40, mixed), [0.725_822, 0.766_853]),
            (
                picture(60, 40, |x, y| [(x * 4) as u8, (y * 5) as u8, 128]),
                picture(60, 40, |x, y| [((x + 2) * 4) as u8, (y * 5) as u8, 120]),
                [0.137_725, 0.135_884],
            ),
            (picture(60, 40, |x, y| disc(x, y, 30)), picture(60, 40, |x, y| disc(x, y, 31)), [0.071_627, 0.054_777]),
            (even([0, 255, 0]), even([0, 0, 255]), [1.0, 1.0]),
            (even([0; 3]), even([255; 3]), [0.967_388, 0.967_384]),
            (even([100; 3]), even([110, 100, 100]), [0.116_379, 0.116_355]),
        ];
        for (i, (a, b, wanted)) in cases.iter().enumerate() {
            for (ppd, wanted) in [PIXELS_PER_DEGREE, 30.0].iter().zip(wanted) {
                let mean = mean_error(&flip_errors(a, b, *ppd).expect("same sizes"));
                assert!((mean - wanted).abs() < 2e-3 * wanted, "{i} at {ppd}: {mean}, wanted {wanted}");
            }
        }
    }

    #[test]
    fn a_picture_is_itself() {
        let a = picture(20, 10, noise);
        assert_eq!(mean_error(&flip_errors(&a, &a, PIXELS_PER_DEGREE).expect("same sizes")), 0.0);
        let other = flip_errors(&a, &picture(10, 20, noise), PIXELS_PER_DEGREE);
        assert_eq!(other, Err("the pictures differ in size: 20x10 and 10x20".to_owned()));
    }
}
