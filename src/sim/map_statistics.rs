//! Reads back the maps of a drawn frame for statistics. The copies are part of the frame's own submission.

use super::Simulation;
use super::resources::MapKind;
use crate::gpu::Gpu;
use crate::gpu::readback::{self, StagedTexture};
use crate::waves::Plan;

/// Approximate largest number of gradient texels, evenly spread, that the mean square slope is computed from.
const MAX_SLOPE_SAMPLES: usize = 1 << 17;

/// Copies of the displacement, gradient and foam maps of one frame, to be read after its submission to the GPU.
pub struct PendingMapRead {
    displacement: StagedTexture,
    gradients: StagedTexture,
    foam: StagedTexture,
    plan: Plan,
}

/// Statistics of one frame's maps (mean square slope, mean foam), and the texels of its displacement maps.
#[derive(Clone, Debug)]
pub struct MapStatistics {
    /// Plan of the sea that the maps show: its waves, divided among cascades.
    pub plan: Plan,
    /// Mean square slope (both components added) of the surface without horizontal displacement.
    pub mean_square_slope: f64,
    /// Mean of the simulated foam over all cells of all levels, 0 to 1, before the user's factor on the visible foam.
    pub mean_foam: f64,
    /// Texels of the displacement maps, cascade by cascade and row by row: Dx, height, Dz (m) and dDx/dz.
    texels: Vec<[f32; 4]>,
}

impl Simulation {
    /// Records copies of the current sea's displacement and gradient maps and of the foam maps, after the commands that
    /// `encoder` already has. Returns the copies, or None during a transition, when the maps are not those of one plan.
    pub fn record_map_copies(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Option<PendingMapRead> {
        if self.in_transition() {
            return None;
        }
        let r = &self.resources;
        let layers = self.plan().cascades.len() + usize::from(self.sea.has_coast);
        let mut copy = |kind| readback::stage_layers(gpu, encoder, &r.maps, 0, r.current_sea_layers(kind, layers));
        Some(PendingMapRead {
            displacement: copy(MapKind::Displacement),
            gradients: copy(MapKind::Gradients),
            foam: readback::stage_texture(gpu, encoder, &r.foam, 0),
            plan: self.plan().clone(),
        })
    }
}

impl PendingMapRead {
    /// Reads the copies of the maps and computes their statistics. Call this once the commands that copy are submitted.
    ///
    /// # Errors
    /// If mapping a read-back buffer fails.
    pub async fn read(self, gpu: &Gpu) -> Result<MapStatistics, String> {
        let (cascades, layer) = (self.plan.cascades.len(), (self.plan.n * self.plan.n) as usize);
        let gradients = with_offshore_waves(self.gradients.read_map(gpu).await?, layer, cascades);
        let foam = self.foam.read_map(gpu).await?;
        // An odd stride visits all columns, because rows have a power of two texels.
        let stride = (gradients.len() / MAX_SLOPE_SAMPLES) | 1;
        let samples = gradients.iter().step_by(stride);
        let slope = |t: &[f32; 4]| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2);
        // The mean square slope is the sum over the cascades, whose maps have equally many texels.
        let maps = self.plan.cascades.len() as f64;
        Ok(MapStatistics {
            mean_square_slope: maps * mean(samples.map(slope)),
            mean_foam: mean(foam.iter().map(|t| f64::from(t[0]))),
            texels: with_offshore_waves(self.displacement.read_map(gpu).await?, layer, cascades),
            plan: self.plan,
        })
    }
}

impl MapStatistics {
    /// Surface heights in row `z` (0 to n - 1) of the displacement map of the cascade with index `cascade`, m.
    pub fn heights_in_row(&self, cascade: usize, z: usize) -> impl Iterator<Item = f64> {
        let n = self.plan.n as usize;
        self.texels[(cascade * n + z) * n..][..n].iter().map(|t| f64::from(t[1]))
    }
}

/// Adds the maps of offshore waves, if there are any behind those of all cascades, to those of the first cascade, whose
/// waves they are. Each cascade has `layer` texels.
pub fn with_offshore_waves(mut texels: Vec<[f32; 4]>, layer: usize, cascades: usize) -> Vec<[f32; 4]> {
    let offshore = texels.split_off((layer * cascades).min(texels.len()));
    for (all, more) in texels.iter_mut().zip(offshore) {
        *all = std::array::from_fn(|i| all[i] + more[i]);
    }
    texels
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1);
    values.sum::<f64>() / count as f64
}
