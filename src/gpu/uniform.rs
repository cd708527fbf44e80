//! Uniform buffers of structs.

use super::kit::Gpu;
use std::marker::PhantomData;
use std::num::NonZeroU64;

/// A uniform buffer of one struct.
#[derive(Clone, Debug)]
pub struct Uniform<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    kind: PhantomData<T>,
}

impl<T: bytemuck::Pod> Uniform<T> {
    /// An empty buffer.
    pub fn new(gpu: &Gpu, label: &str) -> Self {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self { buffer: gpu.buffer(label, size_of::<T>() as u64, usage), kind: PhantomData }
    }

    /// Sends a value to the GPU, before the commands of the next submission.
    pub fn write(&self, gpu: &Gpu, value: &T) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(value));
    }
}

/// One buffer with several values of a uniform struct, told apart by dynamic offsets. All values of a submission are
/// sent in one write.
#[derive(Debug)]
pub struct UniformRing<T> {
    /// The buffer.
    pub buffer: wgpu::Buffer,
    stride: usize,
    bytes: Vec<u8>,
    used: usize,
    kind: PhantomData<T>,
}

impl<T: bytemuck::Pod> UniformRing<T> {
    /// Room for `slots` values in one submission.
    pub fn new(gpu: &Gpu, label: &str, slots: usize) -> Self {
        let stride = size_of::<T>().next_multiple_of(256);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = gpu.buffer(label, (stride * slots) as u64, usage);
        Self { buffer, stride, bytes: vec![0; stride * slots], used: 0, kind: PhantomData }
    }

    /// Forgets the values of the last submission.
    pub fn restart(&mut self) {
        self.used = 0;
    }

    /// Adds a value and returns its dynamic offset.
    ///
    /// # Panics
    /// If more values are added than there are slots.
    pub fn push(&mut self, value: &T) -> u32 {
        let at = self.used * self.stride;
        self.bytes[at..at + size_of::<T>()].copy_from_slice(bytemuck::bytes_of(value));
        self.used += 1;
        at as u32
    }

    /// Sends the values to the GPU, before the submission that uses them.
    pub fn upload(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.buffer, 0, &self.bytes[..self.used * self.stride]);
    }

    /// The buffer as a binding.
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: NonZeroU64::new(size_of::<T>() as u64),
        })
    }
}
