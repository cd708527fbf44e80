//! Reading a sky's file: Radiance `.hdr` and OpenEXR.

use super::Panorama;
use image::{ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// Largest file that is read.
pub const MAX_BYTES: usize = 512 << 20;
/// Widest picture that is decoded.
const MAX_DECODED_WIDTH: u32 = 16384;
/// Memory that decoding may take.
const MAX_MEMORY: u64 = if cfg!(target_arch = "wasm32") { 1 << 30 } else { 4 << 30 };

/// Whether a file is meant to be a sky: by its first bytes, or else by its name.
pub fn is_sky(name: &str, bytes: &[u8]) -> bool {
    let lower = name.to_lowercase();
    format(bytes).is_some() || lower.ends_with(".hdr") || lower.ends_with(".exr")
}

fn format(bytes: &[u8]) -> Option<ImageFormat> {
    if bytes.starts_with(b"#?RADIANCE") || bytes.starts_with(b"#?RGBE") {
        Some(ImageFormat::Hdr)
    } else {
        bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]).then_some(ImageFormat::OpenExr)
    }
}

/// The sky of a file.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn read(name: &str, bytes: &[u8]) -> Result<Panorama, String> {
    decode(bytes).map_err(|reason| format!("{name}: {reason}"))
}

fn decode(bytes: &[u8]) -> Result<Panorama, String> {
    if bytes.len() > MAX_BYTES {
        return Err(format!("larger than {} MB", MAX_BYTES >> 20));
    }
    let format = format(bytes).ok_or("neither a Radiance .hdr nor an OpenEXR file")?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_DECODED_WIDTH);
    limits.max_image_height = Some(MAX_DECODED_WIDTH / 2 + 1);
    limits.max_alloc = Some(MAX_MEMORY);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits.clone());
    // The header alone, so that a file that claims to be enormous is refused before memory is asked for.
    let decoder = reader.into_decoder().map_err(|e| said(&e))?;
    let (width, height) = decoder.dimensions();
    limits.check_dimensions(width, height).map_err(|_| {
        format!(
            "{width} x {height} pixels, more than the {MAX_DECODED_WIDTH} x {} that are read",
            MAX_DECODED_WIDTH / 2
        )
    })?;
    let image = image::DynamicImage::from_decoder(decoder).map_err(|e| said(&e))?.into_rgb32f();
    let pixels = image.pixels().map(|p| p.0).collect();
    Panorama::new(width as usize, height as usize, pixels)
}

/// An error of the decoder on one line.
fn said(error: &ImageError) -> String {
    if let ImageError::IoError(e) = error
        && e.kind() == std::io::ErrorKind::UnexpectedEof
    {
        return "it ends too early".to_owned();
    }
    error.to_string().lines().next().unwrap_or("not readable").to_owned()
}
