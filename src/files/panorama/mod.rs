//! Skies from equirectangular images in linear light. Invalid pixels are corrected, and the sun is found and removed
//! from the environment that the sea reflects.

#[cfg(feature = "files")]
mod formats;
mod pack;
mod sky_image;
mod sun;
#[cfg(test)]
mod tests;

#[cfg(feature = "files")]
pub use formats::{MAX_BYTES, is_sky_file, read, read_with_max_size};
pub use sun::Sun;

use sky_image::{SkyImage, check_shape, luminance};

/// Largest width of a sky image that is kept, pixels; a wider image is reduced by the smallest sufficient whole number.
const MAX_WIDTH: usize = 8192;
/// Columns and rows of [`Panorama::sunless`], the small image without the sun.
pub const SUNLESS_SIZE: [usize; 2] = [512, 256];
/// Irradiance of a horizontal surface by sun and sky to which every sky image is scaled, that of a clear noon; the unit
/// is 6400 lux.
const NOON_IRRADIANCE: f64 = 16.0;

/// A sky from an image file, with its sun. Light is in the renderer's unit, in which an irradiance of 1 is 6400 lux.
#[derive(Clone, Debug)]
pub struct Panorama {
    /// Width of the finest mip level, pixels.
    pub width: usize,
    /// Height of the finest mip level, pixels.
    pub height: usize,
    /// Mip levels of the image with the sun, finest first: linear sRGB packed as RGB9E5, row by row from the zenith.
    /// Sizes are halved and rounded down.
    pub mips: Vec<Vec<u32>>,
    /// Small copy of the image without the sun, [`SUNLESS_SIZE`] pixels in linear sRGB, which the environment map is
    /// made from.
    pub sunless: Vec<[f32; 3]>,
    /// Sun that was found in the image; None if the image shows no compact sun.
    pub sun: Option<Sun>,
    /// Irradiance (red, green, blue) of a horizontal surface by the sky without the sun, in units of 6400 lux.
    pub irradiance: [f64; 3],
    /// Factor by which the light in the file was multiplied to give it the irradiance of a clear noon.
    pub gain: f64,
    /// Messages to the user about what was corrected, reduced or not found in the image.
    pub notices: Vec<String>,
}

impl Panorama {
    /// Makes a sky from the pixels of an equirectangular image, row by row from the zenith, north in its middle column.
    ///
    /// # Errors
    /// One sentence, if the image does not show a whole sky or its sky is black.
    pub fn new(width: usize, height: usize, pixels: Vec<[f32; 3]>) -> Result<Self, String> {
        check_shape(width, height)?;
        if pixels.len() != width * height {
            return Err(format!("{} pixels do not fill an image of {width} x {height}", pixels.len()));
        }
        Self::from_image(SkyImage { width, height, pixels })
    }

    fn from_image(mut image: SkyImage) -> Result<Self, String> {
        let mut notices = Vec::new();
        let corrected = image.repair_pixels();
        if corrected > 0 {
            notices.push(format!("{corrected} pixels were negative, infinite or not a number: they were corrected"));
        }
        let by = image.width.div_ceil(MAX_WIDTH);
        if by > 1 {
            image = image.downsampled(by);
            notices.push(format!("the image was reduced to {} x {} pixels", image.width, image.height));
        }
        let mut image_without_sun = image.clone();
        let sun = sun::extract_sun(&mut image_without_sun);
        if sun.is_none() {
            notices.push("the image shows no compact sun: only the sky lights the sea".to_owned());
        }
        let irradiance = image_without_sun.horizontal_irradiance();
        let by_sun =
            sun.as_ref().map_or(0.0, |s| luminance(s.irradiance) * s.elevation_deg.to_radians().sin().max(0.0));
        let whole = luminance(irradiance) + by_sun;
        if whole <= 0.0 {
            return Err("the upper half, which must show the sky, is black: turn the image if it is upside down".into());
        }
        let gain = NOON_IRRADIANCE / whole;
        // The limit keeps values finite that are far brighter than the sky, such as lamps below the horizon.
        let scaled = |v: f32| (f64::from(v) * gain).min(f64::from(pack::MAX_RGB9E5)) as f32;
        let scale = |pixels: &mut [[f32; 3]]| pixels.iter_mut().flatten().for_each(|v| *v = scaled(*v));
        let mut sunless = image_without_sun.resampled(SUNLESS_SIZE).pixels;
        drop(image_without_sun);
        scale(&mut sunless);
        scale(&mut image.pixels);
        let sun = sun.map(|s| Sun { irradiance: s.irradiance.map(|e| e * gain), ..s });
        let irradiance = irradiance.map(|e| e * gain);
        let (width, height) = (image.width, image.height);
        Ok(Self { width, height, mips: mips(image), sunless, sun, irradiance, gain, notices })
    }
}

/// Makes all mip levels of an image, from its own size down to one row, packed as RGB9E5.
fn mips(mut level: SkyImage) -> Vec<Vec<u32>> {
    let mut levels = Vec::new();
    loop {
        levels.push(level.pixels.iter().map(|c| pack::pack_rgb9e5(*c)).collect());
        if level.height == 1 {
            return levels;
        }
        level = level.resampled([level.width, level.height].map(|side| (side / 2).max(1)));
    }
}
