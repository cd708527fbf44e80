//! Read-back of the wave maps and of the foam from the GPU.

use super::{MAX_FOAM_STEPS, MapsF32, Ocean};
use crate::gpu::readback;
use crate::sim::map_statistics::with_offshore_waves;
use crate::sim::resources::MapKind;

/// Foam on one foam level, a square grid around the camera, in coordinates of the undisplaced water.
#[derive(Clone, Debug)]
pub struct FoamMap {
    /// Number of cells along a side of the square grid.
    pub cells_per_side: usize,
    /// Side of a cell, m.
    pub cell_m: f64,
    /// World x and z of the grid's corner with the smallest coordinates (north-west), m.
    pub north_west_corner_m: [f64; 2],
    /// Foam in each cell, 0 (none) to 1 (fully covered), row by row from north to south, each row from west to east.
    pub foam: Vec<f32>,
}

impl Ocean {
    /// Computes the wave maps at the time of the parameters and reads them back with the values of the GPU's f32
    /// arithmetic, before they are rounded to the texture format.
    ///
    /// # Errors
    /// If the read-back from the GPU fails.
    pub async fn read_maps(&mut self) -> Result<MapsF32, String> {
        self.sim.read_maps_f32(&self.gpu, self.params.clock.t_s).await
    }

    /// Computes the displacement maps at the time of the parameters and reads them back from the textures, cascade by
    /// cascade, row by row. A texel holds Dx, the elevation and Dz, m, and the derivative dDx/dz; Dx and Dz are the
    /// horizontal displacement without choppiness.
    ///
    /// # Errors
    /// If the read-back from the GPU fails.
    pub async fn read_displacement(&mut self) -> Result<Vec<[f32; 4]>, String> {
        let mut encoder = self.gpu.encoder("read displacement");
        self.encode_waves(&mut encoder, MAX_FOAM_STEPS);
        let r = &self.sim.resources;
        let (cascades, layer) = (self.plan().cascades.len(), (r.n * r.n) as usize);
        let layers = r.current_sea_layers(MapKind::Displacement, cascades + usize::from(self.sim.has_coast()));
        let copy = readback::stage_layers(&self.gpu, &mut encoder, &r.maps, 0, layers);
        self.gpu.submit(encoder);
        Ok(with_offshore_waves(copy.read_map(&self.gpu).await?, layer, cascades))
    }

    /// Computes the foam at the time of the parameters and reads back its levels around the camera, finest level first.
    ///
    /// # Errors
    /// If the read-back from the GPU fails.
    pub async fn read_foam(&mut self) -> Result<Vec<FoamMap>, String> {
        let mut encoder = self.gpu.encoder("read foam");
        self.encode_waves(&mut encoder, MAX_FOAM_STEPS);
        let copy = readback::stage_texture(&self.gpu, &mut encoder, &self.sim.resources.foam, 0);
        self.gpu.submit(encoder);
        let texels = copy.read_map(&self.gpu).await?;
        let n = self.sim.resources.foam_n as usize;
        let map = |(level, texels): (&crate::sim::FoamLevel, &[[f32; 4]])| {
            let corner = level.centre_m.map(|x| x - 0.5 * n as f64 * level.cell_m);
            // A cell is stored at its world index modulo n.
            let first = corner.map(|x| (x / level.cell_m).round() as i64);
            let place = |i: usize, axis: usize| (first[axis] + i as i64).rem_euclid(n as i64) as usize;
            let foam = (0..n * n).map(|i| texels[place(i / n, 1) * n + place(i % n, 0)][0]).collect();
            FoamMap { cells_per_side: n, cell_m: level.cell_m, north_west_corner_m: corner, foam }
        };
        Ok(self.maps().foam_levels.iter().zip(texels.chunks(n * n)).map(map).collect())
    }
}
