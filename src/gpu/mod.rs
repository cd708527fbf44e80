//! Tools on top of wgpu. Nothing here depends on what is computed or drawn.

pub mod device;
pub mod kit;
pub mod layout;
pub mod map_format;
pub mod offscreen;
pub mod readback;
pub mod timer;
pub mod uniform;

pub use kit::Gpu;
