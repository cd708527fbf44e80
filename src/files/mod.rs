//! Readers of files that users bring: measured spectra, bathymetry, sky images and pictures; and writers of spectra. Every
//! size limit is checked before memory is allocated.

pub mod bathymetry;
#[cfg(feature = "files")]
pub mod input;
pub mod measured;
#[cfg(feature = "files")]
pub mod netcdf;
pub mod panorama;
#[cfg(feature = "files")]
pub mod picture;

/// Longest state string (all parameters as a URL query, such as `wind=14&t=40`) that is read, bytes.
pub const MAX_STATE_BYTES: usize = 32 * 1024;
