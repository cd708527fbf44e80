//! Readers of files from elsewhere: spectra, skies and pictures. Every limit holds before memory is asked for.

pub mod input;
pub mod measured;
pub mod panorama;
#[cfg(feature = "files")]
pub mod picture;

/// Longest state string that is read, in bytes.
pub const MAX_STATE_BYTES: usize = 32 * 1024;
