//! An equirectangular image of the whole sky and its geometry.

use std::f64::consts::{PI, TAU};

/// Fewest rows of an image that shows a sky.
const MIN_HEIGHT: usize = 8;

/// An equirectangular image in linear light. Columns go clockwise around the horizon from the south; the middle column is
/// north. Rows go down from the zenith.
#[derive(Clone, Debug)]
pub(super) struct SkyImage {
    pub width: usize,
    pub height: usize,
    /// Linear sRGB, row by row from the zenith.
    pub pixels: Vec<[f32; 3]>,
}

impl SkyImage {
    pub fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Result<Self, String> {
        check_shape(width, height)?;
        if pixels.len() != width * height {
            return Err(format!("{} pixels do not fill an image of {width} x {height}", pixels.len()));
        }
        Ok(Self { width, height, pixels })
    }

    /// Corrects values that are not light: negative ones and NaN become 0, infinite ones the largest finite value. Returns
    /// the number of corrected pixels.
    pub fn correct(&mut self) -> usize {
        let finite = self.pixels.iter().flatten().copied().filter(|v| v.is_finite());
        let most = finite.fold(0f32, f32::max).min(1e30);
        let mut corrected = 0;
        for pixel in &mut self.pixels {
            corrected += usize::from(!pixel.iter().all(|v| (0.0..=most).contains(v)));
            // f32::max ignores NaN.
            *pixel = pixel.map(|v| v.max(0.0).min(most));
        }
        corrected
    }

    /// The image reduced by a whole number: means over squares of `by` pixels, without the remainder at the right and the
    /// bottom.
    pub fn reduced(&self, by: usize) -> Self {
        let size = [self.width / by, self.height / by];
        self.resampled_part(size.map(|side| side * by), size)
    }

    /// The image with other numbers of columns and rows. A pixel is the mean of the pixels that it covers, or the nearest
    /// one if it covers none.
    pub fn resampled(&self, size: [usize; 2]) -> Self {
        self.resampled_part([self.width, self.height], size)
    }

    /// The upper left part of the image, given by its columns and rows, resampled to `size`.
    fn resampled_part(&self, part: [usize; 2], [width, height]: [usize; 2]) -> Self {
        let range = |i: usize, to: usize, from: usize| {
            let start = i * from / to;
            start..((i + 1) * from / to).max(start + 1)
        };
        let mean = |x: usize, y: usize| {
            let mut sum = [0f64; 3];
            let (columns, rows) = (range(x, width, part[0]), range(y, height, part[1]));
            let count = columns.len() * rows.len();
            for row in rows {
                for pixel in &self.pixels[row * self.width..][columns.clone()] {
                    sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += f64::from(*v));
                }
            }
            sum.map(|s| (s / count as f64) as f32)
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| mean(x, y))).collect();
        Self { width, height, pixels }
    }

    /// Irradiance of a horizontal surface by the upper half.
    pub fn horizontal_irradiance(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (y, row) in self.pixels.chunks(self.width).enumerate() {
            let weight = self.elevation(y as f64 + 0.5).sin() * self.solid_angle(y);
            if weight <= 0.0 {
                break;
            }
            for pixel in row {
                sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += weight * f64::from(*v));
            }
        }
        sum
    }

    /// Elevation at a distance from the top edge in rows, rad.
    pub fn elevation(&self, y: f64) -> f64 {
        PI * (0.5 - y / self.height as f64)
    }

    /// Solid angle of a pixel in row `y`, sr.
    pub fn solid_angle(&self, y: usize) -> f64 {
        (self.elevation(y as f64).sin() - self.elevation(y as f64 + 1.0).sin()) * TAU / self.width as f64
    }

    /// Unit vector (east, up, south) of a point of the image, in columns and rows from the top left corner.
    pub fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let (sin_a, cos_a) = (TAU * (x / self.width as f64 - 0.5)).sin_cos();
        let (sin_e, cos_e) = self.elevation(y).sin_cos();
        [sin_a * cos_e, sin_e, -cos_a * cos_e]
    }
}

/// Refuses an image that cannot show a whole sky.
pub(super) fn check_shape(width: usize, height: usize) -> Result<(), String> {
    if height < MIN_HEIGHT {
        return Err(format!("{width} x {height} pixels are too few for a sky: save it with {MIN_HEIGHT} rows or more"));
    }
    // One row more or less is accepted.
    if (width as f64 / height as f64 - 2.0).abs() > 0.1 {
        return Err(format!("{width} x {height} pixels: an equirectangular sky must be twice as wide as high"));
    }
    Ok(())
}

/// Luminance of a colour in linear sRGB.
pub(super) fn luminance<T: Into<f64>>(c: [T; 3]) -> f64 {
    let [r, g, b] = c.map(Into::into);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
