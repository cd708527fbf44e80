//! File formats of sky images: each has a module here, and [`decode`] is the one place that recognises them.

mod hdr;
mod limits;
mod openexr;

pub use limits::MAX_BYTES;

use super::Panorama;
use super::sky_image::SkyImage;
use limits::MAX_SIZE;

/// Whether a file is a sky image, by its first bytes or by its name.
pub fn is_sky(name: &str, bytes: &[u8]) -> bool {
    let lower = name.to_lowercase();
    hdr::recognises(bytes) || openexr::recognises(bytes) || lower.ends_with(".hdr") || lower.ends_with(".exr")
}

/// Reads a sky image file within the size limits of this platform.
///
/// # Errors
/// One sentence with the name of the file and the reason.
pub fn read(name: &str, bytes: &[u8]) -> Result<Panorama, String> {
    read_within(name, bytes, MAX_SIZE)
}

/// Reads a sky image file with at most `most` columns and rows.
///
/// # Errors
/// One sentence with the name of the file and the reason.
pub fn read_within(name: &str, bytes: &[u8], most: [usize; 2]) -> Result<Panorama, String> {
    decode(bytes, most).and_then(Panorama::from_image).map_err(|reason| format!("{name}: {reason}"))
}

fn decode(bytes: &[u8], most: [usize; 2]) -> Result<SkyImage, String> {
    if bytes.len() > MAX_BYTES {
        Err(format!("the file is larger than {} MiB: save it with fewer pixels", MAX_BYTES >> 20))
    } else if hdr::recognises(bytes) {
        hdr::decode(bytes, most)
    } else if openexr::recognises(bytes) {
        openexr::decode(bytes, most)
    } else {
        Err("neither a Radiance .hdr nor an OpenEXR file: save it as one of these".to_owned())
    }
}
