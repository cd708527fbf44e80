//! Optical properties of sea water and of rain, and the position of the sun.

pub mod colour;
pub mod rain;
pub mod sun;
pub mod water;
