//! The water: its mesh, its matter and its light.

pub mod displace;
pub mod eye;
pub mod floats;
pub mod light;
pub mod material;
pub mod mesh;
pub mod noise;
