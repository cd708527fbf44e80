//! Uniform buffers that hold Rust structs.

use super::kit::Gpu;
use std::marker::PhantomData;
use std::num::NonZeroU64;

/// A uniform buffer with one value of the struct `T`, the same for all commands of a submission.
#[derive(Clone, Debug)]
pub struct Uniform<T> {
    /// The wgpu buffer that holds the value; shaders may also bind it as a storage buffer.
    pub buffer: wgpu::Buffer,
    kind: PhantomData<T>,
}

impl<T: bytemuck::Pod> Uniform<T> {
    /// Creates a uniform buffer for one value. Its bytes are 0 until a value is written.
    pub fn new(gpu: &Gpu, label: &str) -> Self {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        Self { buffer: gpu.buffer(label, size_of::<T>() as u64, usage), kind: PhantomData }
    }

    /// Queues a write of `value` to the buffer, before the commands of the next submission.
    pub fn write(&self, gpu: &Gpu, value: &T) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(value));
    }
}

/// A uniform buffer with several values of the struct `T`; each command selects one by its dynamic offset. All values
/// of a submission are sent in one write.
#[derive(Debug)]
pub struct DynamicUniformBuffer<T> {
    /// The wgpu buffer that holds the values, each at a multiple of 256 bytes.
    pub buffer: wgpu::Buffer,
    stride: usize,
    bytes: Vec<u8>,
    used: usize,
    kind: PhantomData<T>,
}

impl<T: bytemuck::Pod> DynamicUniformBuffer<T> {
    /// Creates a uniform buffer with room for `slots` values per submission.
    pub fn new(gpu: &Gpu, label: &str, slots: usize) -> Self {
        let stride = size_of::<T>().next_multiple_of(256);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = gpu.buffer(label, (stride * slots) as u64, usage);
        Self { buffer, stride, bytes: vec![0; stride * slots], used: 0, kind: PhantomData }
    }

    /// Forgets the values that were added for the last submission: the next added value gets the offset 0 again.
    pub fn clear(&mut self) {
        self.used = 0;
    }

    /// Adds a value for the next submission; [`Self::upload`] sends it to the GPU. Returns its dynamic offset, bytes.
    ///
    /// # Panics
    /// If more values are added than there are slots.
    pub fn add(&mut self, value: &T) -> u32 {
        let at = self.used * self.stride;
        self.bytes[at..at + size_of::<T>()].copy_from_slice(bytemuck::bytes_of(value));
        self.used += 1;
        at as u32
    }

    /// Sends all added values to the GPU. Call this before the submission whose commands use them.
    pub fn upload(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.buffer, 0, &self.bytes[..self.used * self.stride]);
    }

    /// The buffer as a resource for a bind group: one value is bound, at the dynamic offset that a command chooses.
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: NonZeroU64::new(size_of::<T>() as u64),
        })
    }
}
