//! Seastate computes and draws an ocean from oceanographic spectra in real time: with wgpu on a GPU, natively and in
//! the browser, and in plain Rust for heights at single points.
//!
//! A sea begins as a state string such as `wind=14&fetch=300`. [`state::query::parse`] turns it into parameters,
//! [`waves::Plan`] into wave systems and cascades, and `ocean::Ocean` simulates and draws it.
//!
//! Conventions:
//! - World axes are right-handed: +x east, +y up, -z north. Units are metres, seconds and radians unless a name says
//!   otherwise.
//! - `dir` is the direction that the wind comes from, in degrees clockwise from north. Waves travel the opposite way.
//! - S(omega) is the one-sided variance density of the elevation, m^2 s. Its integral is m0, and Hs = 4 sqrt(m0).
//! - Colours are linear light up to the tone pass. Depth is reverse-Z.
//!
//! Cargo features, each of which includes the previous ones:
//! - none: [`state`], [`waves`], [`point`], [`optics`], [`files`] and [`oracle`]. Spectra, plans, statistics, and the
//!   height of the sea at a point ([`point::heights`]), without a GPU.
//! - `files`: readers of sky files, and of pictures that carry a state string.
//! - `gpu`: the simulation and the picture on a wgpu device of the caller (`gpu`, `shaders`, `sim`, `render`, `ocean`).
//! - `app`: the eframe app of the page and the window (`app`, `bench`, `governor`).
//! - `desktop` (default): the laboratory and the command line (`lab`, `cli`).

#[cfg(feature = "app")]
pub mod app;
#[cfg(feature = "app")]
pub mod bench;
#[cfg(all(feature = "desktop", not(target_arch = "wasm32")))]
pub mod cli;
pub mod coast;
pub mod files;
#[cfg(feature = "app")]
pub mod governor;
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
