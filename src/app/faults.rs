//! What goes wrong on the GPU after the start: each distinct error is logged once and shown; a lost device is a state.

use futures_channel::oneshot;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

const MAX_SHOWN: usize = 8;

#[derive(Default)]
struct Inner {
    errors: Vec<String>,
    lost: Option<String>,
    /// Whether it was given up because its memory does not suffice.
    refused: bool,
    /// Who waits to be told of the loss.
    waiting: Vec<oneshot::Sender<()>>,
}

impl Inner {
    fn lose(&mut self, reason: String) {
        self.lost.get_or_insert(reason);
        for who in self.waiting.drain(..) {
            // Whoever has gone need not know.
            let _ = who.send(());
        }
    }
}

/// Errors of a device, shared with its callbacks.
#[derive(Clone, Default)]
pub struct Faults(Arc<Mutex<Inner>>);

impl Faults {
    /// Listens to a device.
    pub fn watch(device: &wgpu::Device) -> Self {
        let faults = Self::default();
        let on_error = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| match error {
            wgpu::Error::OutOfMemory { .. } => on_error.refuse(error.to_string()),
            _ => on_error.add(error.to_string()),
        }));
        let on_lost = faults.clone();
        device.set_device_lost_callback(move |reason, message| {
            log::error!("GPU device lost ({reason:?}): {message}");
            on_lost.inner().lose(format!("the GPU was lost ({reason:?}): {message}"));
        });
        faults
    }

    /// The distinct errors so far.
    pub fn errors(&self) -> Vec<String> {
        self.inner().errors.clone()
    }

    /// Why the device was lost.
    pub fn lost(&self) -> Option<String> {
        self.inner().lost.clone()
    }

    /// Ends when the device is lost.
    #[cfg(target_arch = "wasm32")]
    pub fn when_lost(&self) -> impl Future<Output = ()> + 'static {
        let (tell, told) = oneshot::channel();
        let mut inner = self.inner();
        inner.waiting.push(tell);
        if let Some(reason) = inner.lost.clone() {
            inner.lose(reason);
        }
        async move {
            // Nobody is left to tell, or somebody has told.
            let _ = told.await;
        }
    }

    /// Whether the graphics memory did not suffice.
    pub fn refused(&self) -> bool {
        self.inner().refused
    }

    /// What a device could not hold is missing from then on in every frame: it counts as lost.
    fn refuse(&self, error: String) {
        log::error!("{error}");
        let mut inner = self.inner();
        inner.refused = true;
        inner.lose(error);
    }

    fn add(&self, error: String) {
        let mut inner = self.inner();
        if !inner.errors.contains(&error) && inner.errors.len() < MAX_SHOWN {
            log::error!("{error}");
            inner.errors.push(error);
        }
    }

    /// A panic while it was held leaves the list as it was.
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
