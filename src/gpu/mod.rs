//! wgpu plumbing that knows nothing of rendering: what we demand of a device, the shader table, layouts, read-back.

pub mod device;
pub mod fft;
pub mod kernel;
pub mod layout;
pub mod map_format;
pub mod offscreen;
pub mod readback;
pub mod shaders;
pub mod timer;
