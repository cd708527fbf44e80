//! State of the simulator that the user sets, as plain data: parameters, their state string, presets, camera and views.

pub mod camera;
pub mod coast;
pub mod day_words;
mod field;
pub mod fields;
pub mod floats;
pub mod inactive;
pub mod look;
pub mod motion;
pub mod params;
pub mod presets;
pub mod query;
pub mod rounding;
mod sea;
pub mod start;
mod text;
pub mod tilt;
mod versions;
pub mod views;

pub use params::Params;
