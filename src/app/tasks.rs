//! Asynchronous work whose result a later frame takes: GPU read-back, and reading files in a browser.

use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};

/// Shared list to which asynchronous tasks add their results, and from which a later frame takes them.
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
    /// Adds the result of a task to the inbox, and requests a frame that takes it.
    pub fn put(&self, result: T, ctx: &egui::Context) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(result);
        ctx.request_repaint();
    }

    /// Removes all results from the inbox and returns them.
    pub fn take(&self) -> Vec<T> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Runs an asynchronous task on the event loop of the web page.
#[cfg(target_arch = "wasm32")]
pub fn spawn(task: impl Future<Output = ()> + 'static) {
    wasm_bindgen_futures::spawn_local(task);
}

/// Runs an asynchronous task on a new thread.
#[cfg(not(target_arch = "wasm32"))]
pub fn spawn(task: impl Future<Output = ()> + Send + 'static) {
    std::thread::spawn(move || pollster::block_on(task));
}
