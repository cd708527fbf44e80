//! `seastate gallery --thumbnails`: draws the built-in named seas as small pictures, one below the other in one file.

use super::write_file;
use crate::gpu::Gpu;
use crate::ocean::still;
use crate::state::{presets, query};
use image::codecs::jpeg::JpegEncoder;
use std::path::Path;

/// Width and height of a thumbnail, pixels.
pub const THUMBNAIL_SIZE: [u32; 2] = [160, 90];
/// The pictures are drawn this many times larger along each axis, and then averaged.
const OVERSAMPLING: u32 = 3;
/// Quality of the JPEG file, 1 to 100.
const JPEG_QUALITY: u8 = 84;

/// Draws a thumbnail of each built-in named sea, in the order of the list, and writes them below each other as one JPEG
/// file to `path`. Returns a line for the terminal.
///
/// # Errors
/// If reading back from the GPU fails, or the file cannot be written.
pub async fn run(gpu: &Gpu, path: &Path) -> Result<String, String> {
    let [width, height] = THUMBNAIL_SIZE;
    let seas = presets::built_in();
    let mut rows = Vec::new();
    for sea in seas {
        let size = THUMBNAIL_SIZE.map(|side| side * OVERSAMPLING);
        let pixels = still::draw_picture(gpu, &query::parse(&sea.state).0, size).await?;
        let large = image::RgbaImage::from_raw(size[0], size[1], pixels).ok_or("the picture has another size")?;
        let small = image::imageops::resize(&large, width, height, image::imageops::FilterType::Triangle);
        rows.extend(small.pixels().flat_map(|p| [p.0[0], p.0[1], p.0[2]]));
    }
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY)
        .encode(&rows, width, height * seas.len() as u32, image::ExtendedColorType::Rgb8)
        .map_err(|e| format!("cannot encode {}: {e}", path.display()))?;
    let size = bytes.len();
    write_file(path, bytes)?;
    Ok(format!("{}: {} thumbnails, {size} bytes", path.display(), seas.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Most bytes of the file: the page fetches it when the tab of the seas opens.
    const MOST_BYTES: usize = 150_000;

    /// If the list of seas has changed: `seastate gallery --thumbnails assets/thumbnails/seas.jpg`.
    #[test]
    fn every_named_sea_has_a_picture() {
        let bytes = include_bytes!("../../assets/thumbnails/seas.jpg");
        assert!(bytes.len() <= MOST_BYTES, "{} bytes", bytes.len());
        let image = image::load_from_memory(bytes).expect("a picture").to_rgb8();
        let [width, height] = THUMBNAIL_SIZE;
        assert_eq!(image.dimensions(), (width, height * presets::built_in().len() as u32));
        // No two seas look alike.
        let rows: Vec<Vec<u8>> = image.as_raw().chunks((3 * width * height) as usize).map(<[u8]>::to_vec).collect();
        for (i, one) in rows.iter().enumerate() {
            for (j, other) in rows.iter().enumerate().skip(i + 1) {
                let difference: f64 =
                    one.iter().zip(other).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / one.len() as f64;
                assert!(difference > 3.0, "seas {i} and {j} differ by {difference}");
            }
        }
    }
}
