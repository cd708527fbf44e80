//! wgpu plumbing that knows nothing of oceans.

pub mod device;
pub mod kit;
pub mod layout;
pub mod map_format;
pub mod offscreen;
pub mod readback;
pub mod timer;

pub use kit::Gpu;
