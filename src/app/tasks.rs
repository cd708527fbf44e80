//! Work that ends in a later frame: reading back from the GPU, files of the browser.

use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};

/// Where results arrive, for the next frame to take.
#[derive(Debug)]
pub struct Inbox<T>(Arc<Mutex<Vec<T>>>);

impl<T> Clone for Inbox<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Default for Inbox<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T> Inbox<T> {
    /// Leaves a result and asks for a frame.
    pub fn put(&self, result: T, ctx: &egui::Context) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(result);
        ctx.request_repaint();
    }

    /// What has arrived since the last time.
    pub fn take(&self) -> Vec<T> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Runs something to its end without holding up a frame.
#[cfg(target_arch = "wasm32")]
pub fn spawn(task: impl Future<Output = ()> + 'static) {
    wasm_bindgen_futures::spawn_local(task);
}

/// Runs something to its end without holding up a frame.
#[cfg(not(target_arch = "wasm32"))]
pub fn spawn(task: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(task));
}
