//! The inverse FFT along x and along z, in two implementations: for GPUs and for software adapters.

mod unrolled;
mod workgroup;

use super::planned_sea::SeaDispatch;
use super::resources::Resources;
use super::uniforms::SimulationUniforms;
use crate::gpu::Gpu;
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use unrolled::UnrolledTransform;
use workgroup::WorkgroupTransform;

/// Implementation of the inverse FFT that turns Fourier amplitudes into maps: one for GPUs, one for software adapters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FftImplementation {
    /// For GPUs: one dispatch along each axis. Threads exchange points in workgroup memory, with least memory traffic.
    Workgroup,
    /// For software adapters: two dispatches along each axis, without workgroup memory and barriers. At a barrier, a
    /// software adapter stores and reloads the state of every thread.
    Unrolled,
}

impl FftImplementation {
    /// The faster implementation of the FFT on a device: `Unrolled` on a software adapter, else `Workgroup`.
    pub fn for_device(gpu: &Gpu) -> Self {
        if gpu.is_software() { Self::Unrolled } else { Self::Workgroup }
    }
}

/// Row pass and column pass: the inverse FFT along x, then along z, in one of two implementations.
pub enum Transform {
    /// FFT through workgroup memory, for GPUs; see [`FftImplementation::Workgroup`].
    Workgroup(Box<WorkgroupTransform>),
    /// FFT without workgroup memory, for software adapters; see [`FftImplementation::Unrolled`].
    Unrolled(Box<UnrolledTransform>),
}

impl Transform {
    /// Compiles the row and column pass in the given implementation and binds the buffers and maps of `r` to them.
    pub fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        implementation: FftImplementation,
        r: &Resources,
        uniforms: &SimulationUniforms,
    ) -> Self {
        match implementation {
            FftImplementation::Workgroup => {
                Self::Workgroup(Box::new(WorkgroupTransform::new(gpu, shaders, r, uniforms)))
            }
            FftImplementation::Unrolled => Self::Unrolled(Box::new(UnrolledTransform::new(gpu, shaders, r, uniforms))),
        }
    }

    /// Which of the two implementations of the FFT these passes are, for GPUs or for software adapters.
    pub fn implementation(&self) -> FftImplementation {
        match self {
            Self::Workgroup(_) => FftImplementation::Workgroup,
            Self::Unrolled(_) => FftImplementation::Unrolled,
        }
    }

    /// Number of compute dispatches of row and column pass for one sea; each dispatch covers all its cascades.
    pub fn dispatch_count(&self) -> u32 {
        match self {
            Self::Workgroup(_) => 2,
            Self::Unrolled(_) => 4,
        }
    }

    /// Creates the bind groups anew after buffers or textures of `r` have been replaced.
    pub fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        match self {
            Self::Workgroup(transform) => transform.recreate_bind_groups(gpu, r, uniforms),
            Self::Unrolled(transform) => transform.recreate_bind_groups(gpu, r, uniforms),
        }
    }

    /// Records the row pass for one sea: the Fourier amplitudes of its waves at one time, and their inverse FFT along
    /// x.
    pub fn record_rows(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, dispatch: SeaDispatch) {
        match self {
            Self::Workgroup(transform) => transform.record_rows(encoder, timer, dispatch),
            Self::Unrolled(transform) => transform.record_rows(encoder, timer, dispatch),
        }
    }

    /// Records the column pass for one sea: inverse FFT along z, to mip level 0 of its displacement and gradient maps.
    pub fn record_columns(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        r: &Resources,
        dispatch: SeaDispatch,
    ) {
        match self {
            Self::Workgroup(transform) => transform.record_columns(encoder, timer, dispatch),
            Self::Unrolled(transform) => transform.record_columns(encoder, timer, r, dispatch),
        }
    }
}
