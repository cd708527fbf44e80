//! Reads whole files, with a limit for each kind of file.

use super::{measured, panorama};
#[cfg(not(target_arch = "wasm32"))]
use std::{io::Read as _, path::PathBuf};

/// Most bytes that are read from a file of this name.
pub fn most_bytes(name: &str) -> usize {
    // A PNG may be a large saved picture.
    let large = panorama::is_sky(name, &[]) || name.to_ascii_lowercase().ends_with(".png");
    if large { panorama::MAX_BYTES } else { measured::MAX_FILE_BYTES }
}

/// Reads files with their names; a file over the limit of its kind is read only to one byte beyond the limit.
///
/// # Errors
/// One sentence, naming the file.
#[cfg(not(target_arch = "wasm32"))]
pub fn read_all(paths: &[PathBuf]) -> Result<Vec<(String, Vec<u8>)>, String> {
    let read = |path: &PathBuf| {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        let fault = |e: std::io::Error| format!("cannot read {}: {e}", path.display());
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(fault)?;
        file.take(most_bytes(&name) as u64 + 1).read_to_end(&mut bytes).map_err(fault)?;
        Ok((name, bytes))
    };
    paths.iter().map(read).collect()
}
