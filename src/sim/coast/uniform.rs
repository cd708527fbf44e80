//! The uniform struct of the passes of a coast.

use crate::gpu::layout::gpu_struct;

gpu_struct! {
    /// WGSL `Coast`: the uniform of the passes that compute the waves at a coast.
    #[derive(Default)]
    pub struct CoastUniform as "Coast" {
        /// Cosine and sine of the angle by which the coast's frame is turned from the world's +x towards +z.
        pub turn: [f32; 2],
        /// Corner with the lowest x and z of the square of the world that encloses the coast, from the origin of the
        /// coast's frame, m in the world's axes.
        pub corner: [f32; 2],
        /// Texel of the maps (column, row) that stands for this corner.
        pub corner_texel: [u32; 2],
        /// Side of a texel of the maps of the square, m.
        pub texel_m: f32,
        /// Number of texels along a side of the maps.
        pub n: u32,
        /// Number of points of the grid along x of the coast's frame.
        pub columns: u32,
        /// Number of points of the grid along y.
        pub rows: u32,
        /// Reciprocal of the distance of two points of the grid, 1/m.
        pub inverse_cell: f32,
        /// Number of waves that the coast transforms.
        pub wave_count: u32,
        /// Number of groups of these waves.
        pub group_count: u32,
        /// Unused; pads the struct to a multiple of 16 bytes.
        pub unused: [u32; 3],
    }
}
