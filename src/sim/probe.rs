//! Read-back of the maps of a drawn frame without waiting for the GPU.

use super::Simulation;
use super::resources::MapKind;
use crate::gpu::Gpu;
use crate::gpu::readback::{self, TextureCopy};
use crate::waves::Plan;

/// Most texels of the gradients that enter the mean square slope: enough for a precise mean, few enough for a page.
const MOST_SLOPES: usize = 1 << 17;

/// Copies of the maps of a frame that is being recorded.
pub struct Probe {
    displacement: TextureCopy,
    gradients: TextureCopy,
    foam: TextureCopy,
    plan: Plan,
}

/// Contents of the maps at one time.
#[derive(Clone, Debug)]
pub struct Probed {
    /// The plan of the sea.
    pub plan: Plan,
    /// Mean square slope of the undisplaced surface.
    pub mss: f64,
    /// Mean computed foam over all levels, 0 to 1, before the factor with which it is shown.
    pub coverage: f64,
    /// Displacement maps, cascade by cascade.
    texels: Vec<[f32; 4]>,
}

impl Simulation {
    /// Records copies of the maps as they are at this point of the submission. None during a transition.
    pub fn probe(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Option<Probe> {
        if self.in_transition() {
            return None;
        }
        let r = &self.resources;
        let cascades = self.plan().cascades.len();
        let mut copy = |kind| readback::stage_layers(gpu, encoder, &r.maps, 0, r.sea_layers(kind, cascades));
        Some(Probe {
            displacement: copy(MapKind::Displacement),
            gradients: copy(MapKind::Gradients),
            foam: readback::stage_texture(gpu, encoder, &r.foam, 0),
            plan: self.plan().clone(),
        })
    }
}

impl Probe {
    /// Reads the maps, after the submission.
    ///
    /// # Errors
    /// If the GPU does not give its memory back.
    pub async fn read(self, gpu: &Gpu) -> Result<Probed, String> {
        let gradients = self.gradients.read_map(gpu).await?;
        let foam = self.foam.read_map(gpu).await?;
        // An odd stride visits all columns.
        let stride = (gradients.len() / MOST_SLOPES) | 1;
        let samples = gradients.iter().step_by(stride);
        let slope = |t: &[f32; 4]| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2);
        // The mean square slope is the sum over the cascades, whose maps have equally many texels.
        let maps = self.plan.cascades.len() as f64;
        Ok(Probed {
            mss: maps * mean(samples.map(slope)),
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
