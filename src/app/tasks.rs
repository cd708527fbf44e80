//! Asynchronous work whose result a later frame takes: GPU read-back, and reading files in a browser.

use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};

/// Results of tasks, for the next frame to take.
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
    /// Adds a result and requests a frame.
    pub fn put(&self, result: T, ctx: &egui::Context) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(result);
        ctx.request_repaint();
    }

    /// Takes all results.
    pub fn take(&self) -> Vec<T> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Runs a task on the page's event loop.
#[cfg(target_arch = "wasm32")]
pub fn spawn(task: impl Future<Output = ()> + 'static) {
    wasm_bindgen_futures::spawn_local(task);
}

/// Runs a task on a thread of its own.
#[cfg(not(target_arch = "wasm32"))]
pub fn spawn(task: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(task));
}
