//! GPU errors after the start: each distinct error is logged once and shown in the panel; a device loss ends the
//! frames.

use futures_channel::oneshot;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most distinct errors that are kept.
const MAX_SHOWN: usize = 8;

#[derive(Default)]
struct Inner {
    errors: Vec<String>,
    /// Why the device was lost.
    lost: Option<String>,
    /// Whether the device was given up because its memory was too small.
    out_of_memory: bool,
    /// Senders of the futures that wait for the loss.
    waiting: Vec<oneshot::Sender<()>>,
}

impl Inner {
    fn lose(&mut self, reason: String) {
        self.lost.get_or_insert(reason);
        for sender in self.waiting.drain(..) {
            // The receiver may have been dropped.
            let _ = sender.send(());
        }
    }
}

/// Errors of one device, shared with the device's callbacks.
#[derive(Clone, Default)]
pub struct GpuErrors(Arc<Mutex<Inner>>);

impl GpuErrors {
    /// Installs the error and loss callbacks of a device.
    pub fn watch(device: &wgpu::Device) -> Self {
        let errors = Self::default();
        let on_error = errors.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| match error {
            wgpu::Error::OutOfMemory { .. } => on_error.run_out_of_memory(error.to_string()),
            _ => on_error.add(error.to_string()),
        }));
        let on_lost = errors.clone();
        device.set_device_lost_callback(move |reason, message| {
            log::error!("GPU device lost ({reason:?}): {message}");
            on_lost.inner().lose(format!("the GPU was lost ({reason:?}): {message}"));
        });
        errors
    }

    /// The distinct errors so far.
    pub fn errors(&self) -> Vec<String> {
        self.inner().errors.clone()
    }

    /// Why the device was lost, if it was.
    pub fn lost(&self) -> Option<String> {
        self.inner().lost.clone()
    }

    /// Completes when the device is lost.
    #[cfg(target_arch = "wasm32")]
    pub fn when_lost(&self) -> impl Future<Output = ()> + 'static {
        let (sender, receiver) = oneshot::channel();
        let mut inner = self.inner();
        inner.waiting.push(sender);
        if let Some(reason) = inner.lost.clone() {
            inner.lose(reason);
        }
        async move {
            // A dropped sender counts as a loss.
            let _ = receiver.await;
        }
    }

    /// Whether the graphics memory was too small.
    pub fn is_out_of_memory(&self) -> bool {
        self.inner().out_of_memory
    }

    /// Gives the device up: a resource that it could not allocate would be missing from every later frame.
    fn run_out_of_memory(&self, error: String) {
        log::error!("{error}");
        let mut inner = self.inner();
        inner.out_of_memory = true;
        inner.lose(error);
    }

    fn add(&self, error: String) {
        let mut inner = self.inner();
        if !inner.errors.contains(&error) && inner.errors.len() < MAX_SHOWN {
            log::error!("{error}");
            inner.errors.push(error);
        }
    }

    /// The locked state; a panic while it was locked leaves it valid.
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
