//! Seastate: an ocean you can believe.
//!
//! Conventions, stated once:
//! - World axes: right-handed, +x east, +y up, -z north; metres, seconds, radians, unless a name says otherwise.
//! - `dir` is where the wind comes from, degrees clockwise from north; the waves run the other way.
//! - S(omega) is the one-sided variance density of the elevation, m^2 s; its integral is m0, and Hs = 4 sqrt(m0).
//! - Light is linear until the last shader; depth is reverse-Z.
//!
//! Features, each holding the one before:
//! - none: [`state`], [`waves`], [`point`], [`optics`], [`files`] and [`oracle`]: spectra, plans, statistics, and the height
//!   of the sea at a point ([`point::heights`]), in plain Rust without a GPU.
//! - `files`: skies from files, and pictures that carry a state, read with every limit before memory is asked for.
//! - `gpu`: the simulation and the picture on a wgpu device that the program brings.
//! - `app`: the eframe app of the page and the window.
//! - `desktop` (default): the command line.

#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "app")]
pub mod bench;
#[cfg(all(feature = "desktop", not(target_arch = "wasm32")))]
pub mod cli;
pub mod files;
#[cfg(feature = "gpu")]
pub mod gpu;
#[cfg(all(feature = "desktop", not(target_arch = "wasm32")))]
pub mod lab;
#[cfg(feature = "gpu")]
pub mod ocean;
pub mod optics;
#[cfg(not(target_arch = "wasm32"))]
pub mod oracle;
pub mod point;
#[cfg(feature = "gpu")]
pub mod render;
#[cfg(feature = "gpu")]
pub mod shaders;
#[cfg(feature = "gpu")]
pub mod sim;
pub mod state;
pub mod waves;
