//! Reading a sky's file: what it is, and how large it may be. All limits hold before memory is asked for.

use super::{Panorama, hdr, openexr};

/// Largest file that is read.
pub const MAX_BYTES: usize = 512 << 20;
/// Most columns and rows that are decoded, a row to spare; a page has less memory.
const MOST: [usize; 2] = if cfg!(target_arch = "wasm32") { [11_586, 5_794] } else { [16_384, 8_193] };

/// Linear light, row by row from the top, with the width and the height.
pub(super) type Pixels = (usize, usize, Vec<[f32; 3]>);

/// Whether a file is meant to be a sky: by its first bytes, or else by its name.
pub fn is_sky(name: &str, bytes: &[u8]) -> bool {
    let lower = name.to_lowercase();
    hdr::begins(bytes) || openexr::begins(bytes) || lower.ends_with(".hdr") || lower.ends_with(".exr")
}

/// The sky of a file.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn read(name: &str, bytes: &[u8]) -> Result<Panorama, String> {
    read_within(name, bytes, MOST)
}

/// The same where a picture has no more columns and rows than these.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn read_within(name: &str, bytes: &[u8], most: [usize; 2]) -> Result<Panorama, String> {
    let read = || {
        let (width, height, pixels) = decode(bytes, most)?;
        Panorama::new(width, height, pixels)
    };
    read().map_err(|reason| format!("{name}: {reason}"))
}

fn decode(bytes: &[u8], most: [usize; 2]) -> Result<Pixels, String> {
    if bytes.len() > MAX_BYTES {
        Err(format!("larger than {} MiB: save it with fewer pixels", MAX_BYTES >> 20))
    } else if hdr::begins(bytes) {
        hdr::decode(bytes, most)
    } else if openexr::begins(bytes) {
        openexr::decode(bytes, most)
    } else {
        Err("neither a Radiance .hdr nor an OpenEXR file".to_owned())
    }
}

/// Refuses a picture by the size that it claims.
pub(super) fn check_size([width, height]: [usize; 2], most: [usize; 2]) -> Result<(), String> {
    if width > most[0] || height > most[1] {
        let [columns, rows] = most;
        return Err(format!("{width} x {height} pixels, where {columns} x {rows} are read: save it smaller"));
    }
    Panorama::check_shape(width, height)
}

/// Room for a picture, or a sentence instead of the end of the program.
pub(super) fn room(pixels: usize) -> Result<Vec<[f32; 3]>, String> {
    let mut out = Vec::new();
    let asked = out.try_reserve_exact(pixels);
    asked.map_err(|_| "there is not enough memory for it: save it smaller".to_owned())?;
    Ok(out)
}
