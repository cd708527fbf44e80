//! What lies in the maps of the frame that was drawn last, read back without holding it up: the sea as the GPU has it.

use super::Simulation;
use crate::gpu::readback::{self, TextureCopy};
use crate::model::Plan;
use half::f16;

/// Copies of the maps of a frame that is being recorded.
pub struct Probe {
    displacement: TextureCopy,
    gradients: TextureCopy,
    foam: TextureCopy,
    plan: Plan,
    first_layer: usize,
}

/// What the maps of one moment hold.
#[derive(Clone, Debug)]
pub struct Probed {
    /// The sea that was computed.
    pub plan: Plan,
    /// Heights of each cascade, n x n, row by row, m.
    pub heights_m: Vec<Vec<f64>>,
    /// Significant wave height 4 sqrt(m0), m: the variances of all cascades.
    pub hs_m: f64,
    /// Mean square slope of the undisplaced surface.
    pub mss: f64,
    /// Mean foam over the levels around the camera.
    pub coverage: f64,
}

impl Simulation {
    /// Records copies of the maps as they are at this point of the submission; None while one sea fades into another.
    pub fn probe(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) -> Option<Probe> {
        if self.fading.is_some() {
            return None;
        }
        let r = &self.resources;
        Some(Probe {
            displacement: readback::stage_texture(device, encoder, &r.displacement, 0),
            gradients: readback::stage_texture(device, encoder, &r.gradients, 0),
            foam: readback::stage_texture(device, encoder, &r.foam, 0),
            plan: self.sea.plan.clone(),
            first_layer: r.sea.first_layer as usize,
        })
    }
}

impl Probe {
    /// The numbers, after the submission.
    ///
    /// # Errors
    /// If the GPU does not give its memory back.
    pub async fn read(self, device: &wgpu::Device) -> Result<Probed, String> {
        let texels = |bytes: Vec<u8>| -> Vec<[f16; 4]> { bytemuck::pod_collect_to_vec(&bytes) };
        let displacement = texels(self.displacement.read(device).await?);
        let gradients = texels(self.gradients.read(device).await?);
        let foam = texels(self.foam.read(device).await?);
        let points = (self.plan.n * self.plan.n) as usize;
        let layers = self.first_layer..self.first_layer + self.plan.cascades.len();
        let own = |all: &[[f16; 4]], channel: usize| -> Vec<Vec<f64>> {
            let map = |layer: usize| &all[layer * points..(layer + 1) * points];
            layers.clone().map(|layer| map(layer).iter().map(|t| t[channel].to_f64()).collect()).collect()
        };
        let variance = |maps: &[Vec<f64>]| maps.iter().map(|map| mean(map.iter().map(|v| v * v))).sum::<f64>();
        let heights_m = own(&displacement, 1);
        Ok(Probed {
            hs_m: 4.0 * variance(&heights_m).sqrt(),
            mss: variance(&own(&gradients, 0)) + variance(&own(&gradients, 1)),
            coverage: mean(foam.iter().map(|t| t[0].to_f64())),
            heights_m,
            plan: self.plan,
        })
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1);
    values.sum::<f64>() / count as f64
}
