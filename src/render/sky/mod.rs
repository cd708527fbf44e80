//! The sky: its look-up tables, the light on the sea, and the background.

pub mod background;
pub mod panorama;
pub mod tables;
pub mod uniform;
