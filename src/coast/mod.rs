//! Waves that come ashore, in plain Rust: the depth of the water near a coast, and how it changes the waves of a sea.
//!
//! - **Frame**: a coast has its own horizontal frame, in metres. The x axis points shoreward, from the open sea to the
//!   land. The y axis points along the shore, 90 degrees clockwise from x as seen from above. Without rotation the two
//!   axes are the world's +x (east) and +z (south).
//! - **Depth** is positive below the still water and negative on land.

pub mod bathymetry;
pub mod built_in;
pub mod structure;

pub use bathymetry::Bathymetry;
pub use built_in::BuiltInCoast;
pub use structure::Structure;
