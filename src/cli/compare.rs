//! `seastate compare`: the perceived difference (FLIP) of two pictures.

use super::args::MAX_PICTURE_SIDE;
use crate::lab::flip::{self, SrgbPicture};
use image::{ImageError, ImageFormat, ImageReader, Limits};
use std::path::Path;

/// Compares two PNG files and returns the mean FLIP difference as text. If `map` is given, writes the difference of
/// every pixel to this PNG file, from black (0) to white (1).
///
/// # Errors
/// One sentence, if a file cannot be read or written, or the pictures differ in size.
pub fn compare_pictures(
    reference: &Path,
    test: &Path,
    map: Option<&Path>,
    pixels_per_degree: f64,
) -> Result<String, String> {
    if !(1.0..=1000.0).contains(&pixels_per_degree) {
        return Err("pixels per degree are from 1 to 1000".to_owned());
    }
    let (a, b) = (read_picture(reference)?, read_picture(test)?);
    let errors = flip::flip_errors(&a, &b, pixels_per_degree)?;
    if let Some(path) = map {
        let grey = errors.iter().map(|e| (255.0 * e).round() as u8).collect();
        let image =
            image::GrayImage::from_raw(a.width as u32, a.height as u32, grey).ok_or("the map has a wrong size")?;
        image.save_with_format(path, ImageFormat::Png).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(format!("mean FLIP {:.4}", flip::mean_error(&errors)))
}

fn read_picture(path: &Path) -> Result<SrgbPicture, String> {
    let fault = |e: &dyn std::fmt::Display| format!("cannot read {}: {e}", path.display());
    let mut reader = ImageReader::open(path).map_err(|e| fault(&e))?;
    reader.set_format(ImageFormat::Png);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MAX_PICTURE_SIDE), Some(MAX_PICTURE_SIDE));
    reader.limits(limits);
    let image = match reader.decode() {
        Ok(image) => image.into_rgb8(),
        Err(ImageError::Limits(_)) => {
            return Err(fault(&format!(
                "it has more than {MAX_PICTURE_SIDE} x {MAX_PICTURE_SIDE} pixels: make it smaller"
            )));
        }
        Err(e) => return Err(fault(&e)),
    };
    let (width, height) = (image.width() as usize, image.height() as usize);
    Ok(SrgbPicture { width, height, pixels: image.pixels().map(|p| p.0).collect() })
}
