//! The sea at a point, on the CPU: heights and velocities, and how hulls lie on the water.

pub mod afloat;
pub mod buoy_record;
pub mod heights;

pub use heights::Heights;
