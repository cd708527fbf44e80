//! Waves that come ashore, in plain Rust: the depth of the water near a coast, and how it changes the waves of a sea.
//!
//! - **Frame**: a coast has its own horizontal frame, in metres. The x axis points shoreward, from the open sea to the
//!   land. The y axis points along the shore, 90 degrees clockwise from x as seen from above. Without rotation the two
//!   axes are the world's +x (east) and +z (south).
//! - **Depth** is positive below the still water and negative on land.
//! - **Waves**: the elevation of a component is Re[A(x, y) e^(-i omega t)]. The open sea's waves are [`Incident`]; the
//!   solvers [`parabolic`] and [`elliptic`] give their [`Field`] over a [`Bathymetry`].

pub mod approach;
pub mod bathymetry;
pub mod breaking;
pub mod built_in;
pub mod complex;
pub mod effect;
pub mod elliptic;
pub mod field;
#[cfg(feature = "files")]
pub mod fields_file;
pub mod gauges;
pub mod incident;
mod line;
pub mod local_wave;
pub mod losses;
pub mod open_sea;
pub mod options;
pub mod parabolic;
pub mod placed;
pub mod runup;
pub mod sea_maps;
pub mod seamark;
pub mod structure;
pub mod transfer;

pub use bathymetry::Bathymetry;
pub use breaking::Losses;
pub use built_in::BuiltInCoast;
pub use field::Field;
pub use incident::Incident;
pub use losses::Dissipation;
pub use options::Options;
pub use placed::PlacedCoast;
pub use sea_maps::SeaMaps;
pub use seamark::{Seamark, SeamarkKind};
pub use structure::Structure;
pub use transfer::Transfer;
