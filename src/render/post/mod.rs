//! After the picture: what film does to light.

pub mod present;
