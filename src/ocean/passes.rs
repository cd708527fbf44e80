//! Single GPU passes of the simulation, recorded alone so that they can be timed.

use super::land::{built_in_land, relative_to_still_water};
use super::{MIN_EYE_HEIGHT_M, Ocean, TimedPart};
use crate::gpu::map_format::MapFormat;
use crate::gpu::timer::Timer;
use crate::render::{Renderer, SeaAppearance, planned_mesh_vertices, waves_cast_shadows};
use crate::sim::Simulation;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::foam_cells_per_side;
use crate::state::Params;
use crate::state::camera::View;
use crate::waves::{Plan, slopes};

/// A GPU compute pass of the simulation of waves and foam, which [`WavePasses::record`] can run alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavePass {
    /// Computation of the Fourier amplitudes h0(k) of all waves at time 0.
    Spectrum,
    /// Computation of the Fourier amplitudes of all waves at the current time, then an inverse FFT of each row along x.
    Rows,
    /// Inverse FFT of each column along z, which completes the 2d FFT; writes the displacement and gradient maps.
    Columns,
    /// Computation of the mip levels of the displacement and gradient maps, and of the map of slope moments.
    Mips,
    /// One time step of the foam simulation. [`WavePasses::record`] gives it a length of 0 s, so that repeating the
    /// pass does not change the foam.
    Foam,
}

/// Sizes and texture format of the wave and foam maps of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapSizes {
    /// Number of points along a side of the FFT, and of texels along a side of a map.
    pub map_texels_per_side: u32,
    /// Number of cascades, patches of sea with an FFT of their own.
    pub cascades: u32,
    /// Number of cells along a side of a foam level, one of the square foam grids around the camera.
    pub foam_cells_per_side: u32,
    /// Format of the texels of the maps and of the foam texture: half or single floats.
    pub format: MapFormat,
}

/// GPU passes of waves and foam, prepared for the simulated time of the parameters; each can be recorded alone.
pub struct WavePasses<'a> {
    sim: &'a Simulation,
    dispatch: SeaDispatch,
    /// Dynamic offset, bytes, of the uniform for the foam pass in the buffer of foam uniforms.
    foam_uniform_offset: u32,
}

impl Ocean {
    /// Records the part `part` of the drawing of the last frame again, alone, to measure its GPU time. Records nothing
    /// before the first frame.
    pub fn record_part(&self, encoder: &mut wgpu::CommandEncoder, part: TimedPart) {
        if let Some(renderer) = &self.renderer {
            renderer.record_part(encoder, part);
        }
    }

    /// Number of vertices of the water mesh in the last frame; 0 before the first frame.
    pub fn vertex_count(&self) -> u32 {
        self.renderer.as_ref().map_or(0, Renderer::vertex_count)
    }
}

impl MapSizes {
    /// Sizes of the maps of a sea on a GPU, where they are of half floats.
    pub fn planned(plan: &Plan) -> Self {
        Self {
            map_texels_per_side: plan.n,
            cascades: plan.cascades.len() as u32,
            foam_cells_per_side: foam_cells_per_side(plan.n),
            format: MapFormat::Half,
        }
    }
}

/// Number of vertices of the water mesh in a picture of `size` (width, height) pixels of the sea of `params`, whose
/// plan is `plan`.
pub fn planned_vertex_count(params: &Params, plan: &Plan, size: [u32; 2]) -> u32 {
    let sea = SeaAppearance::new(plan, &params.look);
    let [width, height] = size.map(f64::from);
    let camera = relative_to_still_water(&params.camera, &sea, built_in_land(params).as_deref());
    planned_mesh_vertices(&View::new(&camera, width / height, MIN_EYE_HEIGHT_M), &sea, &params.look, size)
}

/// Whether waves shade each other in a picture of the sea of `params`, whose plan is `plan`.
pub fn planned_wave_shadows(params: &Params, plan: &Plan) -> bool {
    let sun_deg = params.look.sky.sun_elevation_azimuth_deg()[0];
    waves_cast_shadows(sun_deg, slopes::resolved_slope_variance(plan))
}

impl Ocean {
    /// Computes the foam anew from the recent past once the present transition, if any, has ended.
    pub fn restart_foam_after_transition(&mut self) {
        self.sim.restart_foam_after_transition();
    }

    /// Prepares the passes of waves and foam for the time of the parameters: uploads their uniform buffers, but records
    /// nothing. [`WavePasses::record`] then records single passes.
    pub fn wave_passes(&mut self) -> WavePasses<'_> {
        let t_s = self.params.clock.t_s;
        let centre = [self.params.camera.x_m, self.params.camera.z_m];
        let dispatch = self.sim.upload_sea_uniform(&self.gpu, t_s, false);
        let foam = self.sim.upload_foam_uniform(&self.gpu, t_s, centre);
        WavePasses { sim: &self.sim, dispatch, foam_uniform_offset: foam }
    }

    /// The sizes and the texture format of the wave and foam maps.
    pub fn map_sizes(&self) -> MapSizes {
        let r = &self.sim.resources;
        let cascades = self.plan().cascades.len() as u32;
        MapSizes { map_texels_per_side: r.n, cascades, foam_cells_per_side: r.foam_n, format: r.format }
    }
}

impl WavePasses<'_> {
    /// Records the pass `pass` of the wave or foam simulation alone, so that its GPU time can be measured.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, pass: WavePass) {
        let (passes, r, timer) = (&self.sim.passes, &self.sim.resources, &Timer::default());
        match pass {
            WavePass::Spectrum => passes.spectrum.run(encoder, timer, r, self.dispatch),
            WavePass::Rows => passes.transform.record_rows(encoder, timer, self.dispatch),
            WavePass::Columns => passes.transform.record_columns(encoder, timer, r, self.dispatch),
            WavePass::Mips => passes.mips.run(encoder, timer, r, self.dispatch),
            WavePass::Foam => passes.foam.run(encoder, timer, r, self.dispatch, self.foam_uniform_offset),
        }
    }

    /// Number of compute dispatches for waves and foam in an ordinary frame: one sea, unchanged waves, one foam step.
    pub fn dispatch_count(&self) -> u32 {
        self.sim.passes.dispatch_count()
    }
}
