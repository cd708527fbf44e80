//! Lens and film: bloom, exposure and tone curve, applied to the HDR picture; and the finished picture on the canvas.

pub mod bloom;
pub mod present;
pub mod tone;
