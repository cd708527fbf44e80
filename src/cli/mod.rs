//! The native command line.

pub mod check;
