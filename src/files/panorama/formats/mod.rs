//! File formats of sky images: each has a module here, and [`decode`] is the one place that recognises them.

mod hdr;
mod limits;
mod openexr;

pub use limits::MAX_BYTES;

use super::Panorama;
use super::sky_image::SkyImage;
use limits::MAX_IMAGE_SIZE;

/// Whether a file is a sky image (.hdr or .exr), by its first bytes or by its name.
pub fn is_sky_file(name: &str, bytes: &[u8]) -> bool {
    let lower = name.to_lowercase();
    hdr::is_radiance_file(bytes)
        || openexr::is_openexr_file(bytes)
        || lower.ends_with(".hdr")
        || lower.ends_with(".exr")
}

/// Reads the contents of a sky image file (.hdr or .exr). Too many columns or rows are an error.
///
/// # Errors
/// One sentence with the name of the file and the reason.
pub fn read(name: &str, bytes: &[u8]) -> Result<Panorama, String> {
    read_with_max_size(name, bytes, MAX_IMAGE_SIZE)
}

/// Reads the contents of a sky image file; one with more columns or rows than `max_size` is refused, not reduced.
///
/// # Errors
/// One sentence with the name of the file and the reason.
pub fn read_with_max_size(name: &str, bytes: &[u8], max_size: [usize; 2]) -> Result<Panorama, String> {
    decode(bytes, max_size).and_then(Panorama::from_image).map_err(|reason| format!("{name}: {reason}"))
}

fn decode(bytes: &[u8], max_size: [usize; 2]) -> Result<SkyImage, String> {
    if bytes.len() > MAX_BYTES {
        Err(format!("the file is larger than {} MiB: save it with fewer pixels", MAX_BYTES >> 20))
    } else if hdr::is_radiance_file(bytes) {
        hdr::decode(bytes, max_size)
    } else if openexr::is_openexr_file(bytes) {
        openexr::decode(bytes, max_size)
    } else {
        Err("neither a Radiance .hdr nor an OpenEXR file: save it as one of these".to_owned())
    }
}
