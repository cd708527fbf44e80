//! The inverse transforms along x and along z, in one of two ways.

mod unrolled;
mod workgroup;

use super::planned_sea::EvaluationSlot;
use super::resources::Resources;
use super::uniforms::UniformRings;
use crate::gpu::Gpu;
use crate::shaders::Shaders;
use unrolled::UnrolledTransform;
use workgroup::WorkgroupTransform;

/// How the transforms run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformWay {
    /// One dispatch along each axis; threads exchange points through workgroup memory. Has the least memory traffic:
    /// for GPUs.
    Workgroup,
    /// Two dispatches along each axis, without workgroup memory and barriers: for software adapters, which store and
    /// reload the state of every thread at a barrier.
    Unrolled,
}

impl TransformWay {
    /// The faster way on a device.
    pub fn of(gpu: &Gpu) -> Self {
        if gpu.is_software() { Self::Unrolled } else { Self::Workgroup }
    }
}

/// The row and column passes.
pub enum Transform {
    /// See [`TransformWay::Workgroup`].
    Workgroup(Box<WorkgroupTransform>),
    /// Transform without barriers, for software adapters; see [`TransformWay::Unrolled`].
    Unrolled(Box<UnrolledTransform>),
}

impl Transform {
    /// Compiles the passes and binds them.
    pub fn new(gpu: &Gpu, shaders: &Shaders, way: TransformWay, r: &Resources, rings: &UniformRings) -> Self {
        match way {
            TransformWay::Workgroup => Self::Workgroup(Box::new(WorkgroupTransform::new(gpu, shaders, r, rings))),
            TransformWay::Unrolled => Self::Unrolled(Box::new(UnrolledTransform::new(gpu, shaders, r, rings))),
        }
    }

    /// The way of these passes.
    pub fn way(&self) -> TransformWay {
        match self {
            Self::Workgroup(_) => TransformWay::Workgroup,
            Self::Unrolled(_) => TransformWay::Unrolled,
        }
    }

    /// Number of dispatches of an evaluation.
    pub fn dispatches(&self) -> u32 {
        match self {
            Self::Workgroup(_) => 2,
            Self::Unrolled(_) => 4,
        }
    }

    /// Binds resources that have been replaced.
    pub fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        match self {
            Self::Workgroup(transform) => transform.bind(gpu, r, rings),
            Self::Unrolled(transform) => transform.bind(gpu, r, rings),
        }
    }

    /// Records the waves at the evaluation's time and their transform along x.
    pub fn rows(&self, encoder: &mut wgpu::CommandEncoder, slot: EvaluationSlot) {
        match self {
            Self::Workgroup(transform) => transform.rows(encoder, slot),
            Self::Unrolled(transform) => transform.rows(encoder, slot),
        }
    }

    /// Records the transform along z and the maps of mip level 0.
    pub fn columns(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, slot: EvaluationSlot) {
        match self {
            Self::Workgroup(transform) => transform.columns(encoder, slot),
            Self::Unrolled(transform) => transform.columns(encoder, r, slot),
        }
    }
}
