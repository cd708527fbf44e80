//! The sky: its look-up tables, the light on the sea, and the background.

pub mod background;
mod cloud_field;
mod cloud_passes;
pub mod clouds;
pub mod panorama;
mod table_pass;
pub mod tables;
pub mod uniform;
