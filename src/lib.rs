//! Seastate: an ocean you can believe.
//!
//! Conventions, stated once:
//! - World axes: right-handed, +x east, +y up, -z north; metres, seconds, radians, unless a name says otherwise.
//! - `dir` is where the wind comes from, degrees clockwise from north; the waves run the other way.
//! - S(omega) is the one-sided variance density of the elevation, m^2 s; its integral is m0, and Hs = 4 sqrt(m0).
//! - Light is linear until the last shader; depth is reverse-Z.

pub mod app;
#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
pub mod gpu;
pub mod model;
pub mod ocean;
#[cfg(not(target_arch = "wasm32"))]
pub mod oracle;
pub mod render;
pub mod sim;
