//! Optical properties of sea water, of rain and of the rainbow, and the position of the sun.

pub mod colour;
pub mod rain;
pub mod rainbow;
pub mod sun;
pub mod water;
