//! Single GPU passes of the simulation, recorded alone so that they can be timed.

use super::Ocean;
use crate::gpu::map_format::MapFormat;
use crate::sim::Simulation;
use crate::sim::planned_sea::SeaDispatch;

/// A GPU pass of the simulation of waves and foam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavePass {
    /// Computation of the amplitudes h0(k) of all waves at time 0.
    Spectrum,
    /// Computation of all wave amplitudes at the current time, then the first half of their inverse 2d FFT, along x.
    Rows,
    /// Second half of the inverse 2d FFT, along z, and writing of the displacement and gradient maps.
    Columns,
    /// Computation of the maps' mip levels and of the map of slope moments.
    Mips,
    /// One time step of the foam; of length 0 if recorded alone.
    Foam,
}

/// Sizes and texture format of the wave and foam maps of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapSizes {
    /// Number of points along a side of the FFT, and of texels along a side of a map.
    pub n: u32,
    /// Number of cascades, patches of sea with an FFT of their own.
    pub cascades: u32,
    /// Number of cells along a side of a foam level, one of the square foam grids around the camera.
    pub foam_n: u32,
    /// Format of the texels of the maps and of the foam texture: half or single floats.
    pub format: MapFormat,
}

/// The passes of the simulation, prepared for the time of the parameters. Each can be recorded alone and repeatedly.
pub struct WavePasses<'a> {
    sim: &'a Simulation,
    dispatch: SeaDispatch,
    /// Offset of the foam step's uniform in its buffer, bytes.
    foam_uniform_offset: u32,
}

impl Ocean {
    /// Prepares the single passes for the time of the parameters: writes their uniform buffers.
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
        MapSizes { n: r.n, cascades, foam_n: r.foam_n, format: r.format }
    }
}

impl WavePasses<'_> {
    /// Records one pass of the wave or foam simulation alone.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, pass: WavePass) {
        let (passes, r) = (&self.sim.passes, &self.sim.resources);
        match pass {
            WavePass::Spectrum => passes.spectrum.run(encoder, r, self.dispatch),
            WavePass::Rows => passes.transform.record_rows(encoder, self.dispatch),
            WavePass::Columns => passes.transform.record_columns(encoder, r, self.dispatch),
            WavePass::Mips => passes.mips.run(encoder, r, self.dispatch),
            WavePass::Foam => passes.foam.run(encoder, r, self.dispatch, self.foam_uniform_offset),
        }
    }

    /// Number of compute dispatches of an ordinary frame: unchanged waves, one time step of the foam.
    pub fn dispatch_count(&self) -> u32 {
        self.sim.passes.dispatch_count()
    }
}
