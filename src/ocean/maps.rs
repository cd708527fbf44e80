//! The maps of single states, read back from the GPU.

use crate::gpu::Gpu;
use crate::shaders::Shaders;
use crate::sim::resources::MapKind;
use crate::sim::{MAX_STEPS, Simulation};
use crate::state::Params;
use crate::waves::Plan;

pub use crate::sim::MapsF32;

/// The maps of a state at its time in single precision, before they are rounded to the format of the textures.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn read(gpu: &Gpu, params: &Params) -> Result<MapsF32, String> {
    Simulation::new(gpu, Plan::new(params), &Shaders::default()).read_f32(gpu, params.clock.t_s).await
}

/// The displacement maps of a state at its time as the textures hold them: Dx, eta, Dz and dDx/dz, cascade by cascade.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn read_displacement(gpu: &Gpu, params: &Params) -> Result<Vec<[f32; 4]>, String> {
    let mut sim = Simulation::new(gpu, Plan::new(params), &Shaders::default());
    let mut encoder = gpu.encoder("read displacement");
    sim.encode(gpu, &mut encoder, params.clock.t_s, [0.0; 2], MAX_STEPS);
    let copy = sim.resources.stage(gpu, &mut encoder, MapKind::Displacement, 0);
    gpu.submit(encoder);
    copy.read_map(gpu).await
}
