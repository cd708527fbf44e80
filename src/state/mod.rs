//! The state of a sea as the user sets it: parameters, their state string, presets and views. All of it is plain data.

pub mod camera;
mod field;
pub mod fields;
pub mod floats;
pub mod look;
pub mod params;
pub mod presets;
pub mod query;
mod sea;
mod text;
mod versions;
pub mod views;

pub use params::Params;
