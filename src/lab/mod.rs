//! The laboratory: measures, compares, exports and documents the sea. The command line and the tests call it.

pub mod check;
pub mod coast;
pub mod crests;
pub mod ensemble;
pub mod estimate;
pub mod export;
pub mod figure;
pub mod flip;
pub mod gallery;
pub mod page;
pub mod parameters;
pub mod record;
pub mod reference;
pub mod render;
pub mod stats;
pub mod thumbnails;
pub mod validate;

use std::path::Path;

/// Writes `bytes` to a file, in place of its old contents. The error is a sentence that names the path.
fn write_file(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

/// Creates a folder and its parent folders. The error is a sentence that names the path.
fn create_folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|e| format!("cannot make {}: {e}", path.display()))
}
