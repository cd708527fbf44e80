//! Errors of the GPU device while the app runs. Each distinct error is logged once and shown in the panel; a device
//! loss stops the drawing of frames.

use super::App;
use futures_channel::oneshot;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Largest number of distinct GPU errors that are kept.
const MAX_DISTINCT_ERRORS: usize = 8;

#[derive(Default)]
struct GpuErrorState {
    errors: Vec<String>,
    /// The reason why the device was lost; `None` while it works.
    lost: Option<String>,
    /// Whether the device is treated as lost because an allocation failed for want of graphics memory.
    out_of_memory: bool,
    /// Senders that complete the futures of `GpuErrors::when_lost` when the device is lost.
    loss_senders: Vec<oneshot::Sender<()>>,
}

impl GpuErrorState {
    fn mark_lost(&mut self, reason: String) {
        self.lost.get_or_insert(reason);
        for sender in self.loss_senders.drain(..) {
            // Sending fails if the receiver has been dropped.
            let _ = sender.send(());
        }
    }
}

/// Error messages and loss of one GPU device. Clones share the same list, which wgpu's callbacks fill.
#[derive(Clone, Default)]
pub struct GpuErrors(Arc<Mutex<GpuErrorState>>);

impl GpuErrors {
    /// Installs the callbacks with which wgpu reports errors and the loss of `device`. Returns the list that they fill.
    pub fn watch(device: &wgpu::Device) -> Self {
        let errors = Self::default();
        let on_error = errors.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| match error {
            wgpu::Error::OutOfMemory { .. } => on_error.note_out_of_memory(error.to_string()),
            _ => on_error.add(error.to_string()),
        }));
        let on_lost = errors.clone();
        device.set_device_lost_callback(move |reason, message| {
            log::error!("GPU device lost ({reason:?}): {message}");
            on_lost.lock().mark_lost(format!("the GPU was lost ({reason:?}): {message}"));
        });
        errors
    }

    /// The distinct error messages of the device so far, at most `MAX_DISTINCT_ERRORS`.
    pub fn errors(&self) -> Vec<String> {
        self.lock().errors.clone()
    }

    /// The reason why the GPU device was lost; `None` while it works.
    pub fn lost(&self) -> Option<String> {
        self.lock().lost.clone()
    }

    /// Returns a future that completes when the GPU device is lost, or at once if it is lost already.
    #[cfg(target_arch = "wasm32")]
    pub fn when_lost(&self) -> impl Future<Output = ()> + 'static {
        let (sender, receiver) = oneshot::channel();
        let mut inner = self.lock();
        inner.loss_senders.push(sender);
        if let Some(reason) = inner.lost.clone() {
            inner.mark_lost(reason);
        }
        async move {
            // A dropped sender counts as a device loss.
            let _ = receiver.await;
        }
    }

    /// Whether the device was lost because its graphics memory was too small.
    pub fn is_out_of_memory(&self) -> bool {
        self.lock().out_of_memory
    }

    /// Marks the device as lost after an out-of-memory error, because the buffer or texture that could not be allocated
    /// would be missing in every later frame.
    fn note_out_of_memory(&self, error: String) {
        log::error!("{error}");
        let mut inner = self.lock();
        inner.out_of_memory = true;
        inner.mark_lost(error);
    }

    fn add(&self, error: String) {
        let mut inner = self.lock();
        if !inner.errors.contains(&error) && inner.errors.len() < MAX_DISTINCT_ERRORS {
            log::error!("{error}");
            inner.errors.push(error);
        }
    }

    /// Locks the shared state. A panic of another holder of the lock leaves the state valid.
    fn lock(&self) -> MutexGuard<'_, GpuErrorState> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl App {
    /// The reason why the GPU device was lost; `None` while it works.
    pub fn device_lost(&self) -> Option<String> {
        self.gpu_errors.lost()
    }

    /// The distinct error messages that the GPU device has reported so far.
    pub fn errors(&self) -> Vec<String> {
        self.gpu_errors.errors()
    }
}
