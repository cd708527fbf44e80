//! `seastate render`: a picture of a state, the same on every run.

use crate::gpu::Gpu;
use crate::lab::reference::{self, Sampling};
use crate::ocean::still::{FORMAT, picture_of};
use crate::ocean::{Film, Ocean};
use crate::state::Params;
use std::path::Path;

/// Renders a state at its time and writes a PNG: as a page shows it, or the reference of that picture.
///
/// # Errors
/// One sentence, if there is no adapter or the file cannot be written.
pub async fn run(params: &Params, size: [u32; 2], reference: Option<Sampling>, output: &Path) -> Result<(), String> {
    let gpu = Gpu::request().await?;
    let mut ocean = Ocean::new(&gpu, FORMAT, Film::Screen, params);
    let mut pixels = picture_of(&gpu, &mut ocean, size).await?;
    if let Some(sampling) = reference {
        pixels = reference::picture_of(&gpu, &mut ocean, size, sampling).await?;
    }
    let image = image::RgbaImage::from_raw(size[0], size[1], pixels).ok_or("the picture has a wrong size")?;
    image
        .save_with_format(output, image::ImageFormat::Png)
        .map_err(|e| format!("cannot write {}: {e}", output.display()))
}
