//! Files that the program writes: saved pictures and texts, and the user's own seas.
//!
//! A desktop has folders; a page has downloads and the browser's local storage. Both modules have the same functions.

#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;

#[cfg(target_arch = "wasm32")]
pub use browser::{load_seas, put_seas_aside, save, store_seas};
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::{load_seas, put_seas_aside, save, store_seas};

/// File name, or key in the browser's storage, of the user's own seas.
const SEAS: &str = "seas.txt";
/// File name, or key, of a copy of seas that could only be read in part.
const SEAS_ASIDE: &str = "seas-damaged.txt";
