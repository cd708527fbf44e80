//! Measured wave spectra: reads the spectral files of a wave buoy or a wave model as a frequency spectrum with
//! directions.
//!
//! [`MeasuredSpectrum::read`] reads files, [`MeasuredSpectrum::to_state`] and [`MeasuredSpectrum::from_state`] carry a
//! spectrum in a link. [`MaximumEntropyDistribution`] turns directional moments into a directional distribution; a
//! [`DirectionalTable`] holds the energy over directions as data.

mod direction;
mod directional;
mod formats;
mod list;
mod mem;
mod spectrum;
mod state;
#[cfg(test)]
mod tests;
pub(in crate::files) mod text;
mod write;

pub use direction::DirectionalParameters;
pub use directional::{DirectionalTable, MAX_DIRECTIONS, MIN_DIRECTIONS, TabulatedDistribution};
pub use formats::MAX_FILES_PER_SPECTRUM;
pub use list::{DefaultSpectrum, SpectrumList, SpectrumRecord};
pub use mem::MaximumEntropyDistribution;
pub use spectrum::{MAX_BANDS, MIN_BANDS, MeasuredSpectrum, SpectrumFile};
pub use state::MAX_TEXT_BYTES;
pub use text::MAX_FILE_BYTES;
pub use write::DirectionalSpectrum;
