//! The water: mesh, material and lighting; the eye's height above waves; floating objects.

pub mod bed;
pub mod displace;
pub mod eye;
pub mod hull_images;
mod hull_shapes;
pub mod hulls;
pub mod light;
pub mod material;
pub mod mesh;
pub mod noise;
mod seamark_shapes;
pub mod under;
mod yacht_crew;
mod yacht_foam;
mod yacht_shape;
