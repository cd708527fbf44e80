//! The optical properties of sea water, and the place of the sun.

pub mod sun;
pub mod water;
