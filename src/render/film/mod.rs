//! Lens and film: bloom, exposure and tone curve, applied to the finished HDR picture.

pub mod bloom;
pub mod present;
