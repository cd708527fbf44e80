//! The sea at a point, computed on the CPU: height, normal and orbital velocity, and the position of floating hulls.

pub mod buoy_record;
pub mod floating;
pub mod heights;
pub mod kinematics;

pub use heights::{StrongestWaves, SurfaceSample, WaveStaff};
