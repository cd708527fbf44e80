//! Storage of what the app saves: pictures, texts, the user's own named seas, and preferences.
//!
//! The desktop window saves to folders; the web page uses downloads and the browser's local storage. Both modules have
//! the same functions.

#[cfg(target_arch = "wasm32")]
mod browser;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;

#[cfg(target_arch = "wasm32")]
pub use browser::{back_up_damaged_seas, load_preferences, load_seas, save, store_preferences, store_seas};
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::{back_up_damaged_seas, load_preferences, load_seas, save, store_preferences, store_seas};

/// Where the user's own named seas are stored: file name on the desktop, key in the browser's local storage.
const SEAS_FILE_NAME: &str = "seas.txt";
/// Where a list of the user's seas that contains errors is copied before it is overwritten: file name on the desktop,
/// key in the browser's local storage.
const DAMAGED_SEAS_FILE_NAME: &str = "seas-damaged.txt";
/// Where the preferences of the visitor are stored: file name on the desktop, key in the browser's local storage.
const PREFERENCES_FILE_NAME: &str = "preferences.txt";
/// Where place and width of the panel were stored before they became preferences: file name on the desktop, key in the
/// browser's local storage.
const OLD_PANEL_PLACE_FILE_NAME: &str = "panel.txt";
