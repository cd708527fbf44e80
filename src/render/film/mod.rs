//! After the picture: what lens and film do to light.

pub mod bloom;
pub mod present;
