//! Lens and film: bloom, exposure, local exposure and tone curve, applied to the HDR picture; and the finished picture on
//! the canvas.

pub mod bloom;
pub mod local_exposure;
pub mod present;
pub mod tone;
