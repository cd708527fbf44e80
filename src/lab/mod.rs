//! The laboratory: what measures, compares and documents the sea. The tests and the command line run it.

pub mod check;
pub mod flip;
pub mod gallery;
pub mod reference;
pub mod stats;
pub mod validate;
