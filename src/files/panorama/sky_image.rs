//! An equirectangular image of the whole sky: its geometry, resampling and irradiance.

use std::f64::consts::{PI, TAU};

/// Smallest number of rows of an image that is accepted as a sky.
const MIN_HEIGHT: usize = 8;

/// An equirectangular sky in linear light. Columns: south, west, north (in the middle), east; rows: zenith to nadir.
#[derive(Clone, Debug)]
pub(super) struct SkyImage {
    pub width: usize,
    pub height: usize,
    /// Pixels in linear sRGB, row by row from the zenith.
    pub pixels: Vec<[f32; 3]>,
}

impl SkyImage {
    /// Corrects pixel values that cannot be light: negative values and NaN become 0, infinite ones the largest finite
    /// value in the image (at most 1e30). Returns the number of corrected pixels.
    pub fn repair_pixels(&mut self) -> usize {
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

    /// Returns the image reduced by the whole-number factor `by`: means over squares of `by` x `by` pixels, without the
    /// remainder at the right and bottom edges.
    pub fn downsampled(&self, by: usize) -> Self {
        let size = [self.width / by, self.height / by];
        self.resampled_part(size.map(|side| side * by), size)
    }

    /// Returns the image resampled to `size` columns and rows. A new pixel is the mean of the pixels that it covers, or
    /// the nearest one if it covers none.
    pub fn resampled(&self, size: [usize; 2]) -> Self {
        self.resampled_part([self.width, self.height], size)
    }

    /// Resamples the upper left part of the image, `part` columns and rows, to `width` columns and `height` rows.
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

    /// Irradiance (red, green, blue) of a horizontal surface by the image's upper half, in the pixels' unit x sr.
    pub fn horizontal_irradiance(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (y, row) in self.pixels.chunks(self.width).enumerate() {
            let weight = self.row_elevation_rad(y as f64 + 0.5).sin() * self.pixel_solid_angle_sr(y);
            if weight <= 0.0 {
                break;
            }
            for pixel in row {
                sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += weight * f64::from(*v));
            }
        }
        sum
    }

    /// Elevation angle above the horizon of a point `y` rows below the top edge of the image, rad.
    pub fn row_elevation_rad(&self, y: f64) -> f64 {
        PI * (0.5 - y / self.height as f64)
    }

    /// Solid angle of a pixel in row `y`, counted from 0 at the zenith, sr.
    pub fn pixel_solid_angle_sr(&self, y: usize) -> f64 {
        (self.row_elevation_rad(y as f64).sin() - self.row_elevation_rad(y as f64 + 1.0).sin()) * TAU
            / self.width as f64
    }

    /// Unit vector (east, up, south) towards the point of the image `x` columns and `y` rows from its top left corner,
    /// if its middle column shows the north.
    pub fn pixel_direction(&self, x: f64, y: f64) -> [f64; 3] {
        let (sin_a, cos_a) = (TAU * (x / self.width as f64 - 0.5)).sin_cos();
        let (sin_e, cos_e) = self.row_elevation_rad(y).sin_cos();
        [sin_a * cos_e, sin_e, -cos_a * cos_e]
    }
}

/// Returns an error if an image of this size, pixels, has less than [`MIN_HEIGHT`] rows or is not about twice as wide
/// as high.
pub(super) fn check_shape(width: usize, height: usize) -> Result<(), String> {
    if height < MIN_HEIGHT {
        return Err(format!("{width} x {height} pixels are too few for a sky: save it with {MIN_HEIGHT} rows or more"));
    }
    // Small deviations, such as one row more or less, are accepted.
    if (width as f64 / height as f64 - 2.0).abs() > 0.1 {
        return Err(format!("{width} x {height} pixels: an equirectangular sky must be twice as wide as high"));
    }
    Ok(())
}

/// Relative luminance of a colour (red, green, blue) in linear sRGB, in the unit of the colour.
pub(super) fn luminance<T: Into<f64>>(c: [T; 3]) -> f64 {
    let [r, g, b] = c.map(Into::into);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
