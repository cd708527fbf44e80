//! Optical properties of sea water, and the position of the sun.

pub mod sun;
pub mod water;
