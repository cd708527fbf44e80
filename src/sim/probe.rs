//! What lies in the maps of the frame that was drawn last, read back without holding it up: the sea as the GPU has it.

use super::Simulation;
use super::resources::MapKind;
use crate::gpu::Gpu;
use crate::gpu::readback::{self, TextureCopy};
use crate::waves::Plan;

/// Texels of the gradients that are looked at, at most: their mean is sharp enough, and a page has other things to do.
const MOST_SLOPES: usize = 1 << 17;

/// Copies of the maps of a frame that is being recorded.
pub struct Probe {
    displacement: TextureCopy,
    gradients: TextureCopy,
    foam: TextureCopy,
    plan: Plan,
}

/// What the maps of one moment hold.
#[derive(Clone, Debug)]
pub struct Probed {
    /// The sea that was computed.
    pub plan: Plan,
    /// Mean square slope of the undisplaced surface.
    pub mss: f64,
    /// Mean foam over the squares around the camera, as it was computed: the look may show more or less of it.
    pub coverage: f64,
    /// Displacement maps, cascade by cascade.
    texels: Vec<[f32; 4]>,
}

impl Simulation {
    /// Records copies of the maps as they are at this point of the submission; None while the sea is on its way to its plan.
    pub fn probe(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Option<Probe> {
        if self.is_gliding() {
            return None;
        }
        let r = &self.resources;
        let mut copy = |kind| {
            let first = r.layers(kind).start + r.sea.first_layer;
            let layers = first..first + self.sea.plan.cascades.len() as u32;
            readback::stage_layers(gpu, encoder, &r.maps, 0, layers)
        };
        Some(Probe {
            displacement: copy(MapKind::Displacement),
            gradients: copy(MapKind::Gradients),
            foam: readback::stage_texture(gpu, encoder, &r.foam, 0),
            plan: self.sea.plan.clone(),
        })
    }
}

impl Probe {
    /// The maps, after the submission.
    ///
    /// # Errors
    /// If the GPU does not give its memory back.
    pub async fn read(self, gpu: &Gpu) -> Result<Probed, String> {
        let gradients = self.gradients.read_map(gpu).await?;
        let foam = self.foam.read_map(gpu).await?;
        // Odd, so that it does not run along the columns.
        let stride = (gradients.len() / MOST_SLOPES) | 1;
        let looked_at = gradients.iter().step_by(stride);
        let slope = |t: &[f32; 4]| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2);
        // Each map has its share of the variance, and all have one size.
        let maps = self.plan.cascades.len() as f64;
        Ok(Probed {
            mss: maps * mean(looked_at.map(slope)),
            coverage: mean(foam.iter().map(|t| f64::from(t[0]))),
            texels: self.displacement.read_map(gpu).await?,
            plan: self.plan,
        })
    }
}

impl Probed {
    /// Heights along a row of a cascade's map, m.
    pub fn row(&self, cascade: usize, z: usize) -> impl Iterator<Item = f64> {
        let n = self.plan.n as usize;
        self.texels[(cascade * n + z) * n..][..n].iter().map(|t| f64::from(t[1]))
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1);
    values.sum::<f64>() / count as f64
}
