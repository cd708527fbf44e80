//! Tools on top of wgpu. Nothing in this module depends on what the program computes or draws.

pub mod device;
pub mod kit;
pub mod layout;
pub mod map_format;
pub mod observer;
pub mod offscreen;
pub mod readback;
pub mod timer;
pub mod uniform;

pub use kit::Gpu;
