//! The inverse FFT along x and along z, in two implementations: for GPUs and for software adapters.

mod unrolled;
mod workgroup;

use super::planned_sea::EvaluationSlot;
use super::resources::Resources;
use super::uniforms::UniformRings;
use crate::gpu::Gpu;
use crate::shaders::Shaders;
use unrolled::UnrolledTransform;
use workgroup::WorkgroupTransform;

/// Implementation of the inverse FFT.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformWay {
    /// For GPUs: one dispatch along each axis. Threads exchange points in workgroup memory, with least memory traffic.
    Workgroup,
    /// For software adapters: two dispatches along each axis, without workgroup memory and barriers. At a barrier, a
    /// software adapter stores and reloads the state of every thread.
    Unrolled,
}

impl TransformWay {
    /// The faster implementation on a device.
    pub fn of(gpu: &Gpu) -> Self {
        if gpu.is_software() { Self::Unrolled } else { Self::Workgroup }
    }
}

/// Row and column passes: the inverse FFT along x, then along z.
pub enum Transform {
    /// FFT through workgroup memory, for GPUs; see [`TransformWay::Workgroup`].
    Workgroup(Box<WorkgroupTransform>),
    /// FFT without barriers, for software adapters; see [`TransformWay::Unrolled`].
    Unrolled(Box<UnrolledTransform>),
}

impl Transform {
    /// Compiles the passes of the given implementation and creates their bind groups.
    pub fn new(gpu: &Gpu, shaders: &Shaders, way: TransformWay, r: &Resources, rings: &UniformRings) -> Self {
        match way {
            TransformWay::Workgroup => Self::Workgroup(Box::new(WorkgroupTransform::new(gpu, shaders, r, rings))),
            TransformWay::Unrolled => Self::Unrolled(Box::new(UnrolledTransform::new(gpu, shaders, r, rings))),
        }
    }

    /// Which implementation of the FFT these passes are.
    pub fn way(&self) -> TransformWay {
        match self {
            Self::Workgroup(_) => TransformWay::Workgroup,
            Self::Unrolled(_) => TransformWay::Unrolled,
        }
    }

    /// Number of compute dispatches that transform all cascades of a sea along x and z.
    pub fn dispatches(&self) -> u32 {
        match self {
            Self::Workgroup(_) => 2,
            Self::Unrolled(_) => 4,
        }
    }

    /// Creates the bind groups anew after buffers or textures have been replaced.
    pub fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        match self {
            Self::Workgroup(transform) => transform.bind(gpu, r, rings),
            Self::Unrolled(transform) => transform.bind(gpu, r, rings),
        }
    }

    /// Records the row pass: computes the waves at the evaluation's time and transforms them along x.
    pub fn rows(&self, encoder: &mut wgpu::CommandEncoder, slot: EvaluationSlot) {
        match self {
            Self::Workgroup(transform) => transform.rows(encoder, slot),
            Self::Unrolled(transform) => transform.rows(encoder, slot),
        }
    }

    /// Records the column pass: transforms along z and writes mip level 0 of the displacement and gradient maps.
    pub fn columns(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, slot: EvaluationSlot) {
        match self {
            Self::Workgroup(transform) => transform.columns(encoder, slot),
            Self::Unrolled(transform) => transform.columns(encoder, r, slot),
        }
    }
}
