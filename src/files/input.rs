//! Reads whole files, with a size limit for each kind of file.

use super::{bathymetry, measured, panorama};
#[cfg(not(target_arch = "wasm32"))]
use std::{
    io::Read as _,
    path::{Path, PathBuf},
};

/// Endings of names of files that may hold a bathymetry.
const BATHYMETRY_ENDINGS: [&str; 8] = [".tif", ".tiff", ".asc", ".grd", ".xyz", ".nc", ".txt", ".csv"];

/// Size limit of a file with this name, bytes: for .hdr, .exr and .png that of a sky image, for the endings of
/// bathymetries that of a bathymetry, else that of a measured spectrum.
pub fn max_file_bytes(name: &str) -> usize {
    let name = name.to_ascii_lowercase();
    // A PNG may be a large saved picture.
    if panorama::is_sky_file(&name, &[]) || name.ends_with(".png") {
        panorama::MAX_BYTES
    } else if BATHYMETRY_ENDINGS.iter().any(|ending| name.ends_with(ending)) {
        bathymetry::MAX_FILE_BYTES
    } else {
        measured::MAX_FILE_BYTES
    }
}

/// Reads files and returns name and content of each. Of a file above the limit [`max_file_bytes`] one byte more than
/// the limit is read, so that its decoder refuses it.
///
/// # Errors
/// Returns one sentence that names the file, if a file cannot be opened or read.
#[cfg(not(target_arch = "wasm32"))]
pub fn read_all(paths: &[PathBuf]) -> Result<Vec<(String, Vec<u8>)>, String> {
    paths.iter().map(|path| read_up_to(path, max_file_bytes(&path.to_string_lossy()))).collect()
}

/// Reads a file and returns its name and its content, of a file above `max_bytes` one byte more than that.
///
/// # Errors
/// Returns one sentence that names the file, if it cannot be opened or read.
#[cfg(not(target_arch = "wasm32"))]
pub fn read_up_to(path: &Path, max_bytes: usize) -> Result<(String, Vec<u8>), String> {
    let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
    let fault = |e: std::io::Error| format!("cannot read {}: {e}", path.display());
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(fault)?;
    file.take(max_bytes as u64 + 1).read_to_end(&mut bytes).map_err(fault)?;
    Ok((name, bytes))
}
