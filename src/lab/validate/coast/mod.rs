//! Part 8 of the validation page: waves that come ashore, against analytic solutions and independent integrations.
//!
//! Each case is a function that solves it and returns the solution beside theory. The page shows the cases, and
//! `tests/coast*.rs` hold them to their limits.

pub mod gap;
pub mod plane;
pub mod random;
pub mod shoals;
pub mod structures;
pub mod theory;

/// Acceleration of gravity in all cases, m/s^2.
pub const GRAVITY_M_S2: f64 = 9.81;
