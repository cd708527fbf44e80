//! Storage of the web page: downloads for saved files, and the browser's local storage for the user's own named seas.
//! The functions are the same as in desktop.rs.

use super::{DAMAGED_SEAS_FILE_NAME, OLD_PANEL_PLACE_FILE_NAME, PREFERENCES_FILE_NAME, SEAS_FILE_NAME};
use std::path::Path;
use wasm_bindgen::{JsCast as _, JsValue};

/// Makes the browser download `bytes` as a file called `name`. The folder is ignored. Returns the name.
pub fn save(_folder: Option<&Path>, name: &str, bytes: &[u8]) -> Result<String, String> {
    let run = || -> Result<(), JsValue> {
        let parts = js_sys::Array::of1(&js_sys::Uint8Array::from(bytes).into());
        let blob = web_sys::Blob::new_with_u8_array_sequence(&parts)?;
        let url = web_sys::Url::create_object_url_with_blob(&blob)?;
        let document = web_sys::window().and_then(|w| w.document()).ok_or("no document")?;
        let anchor: web_sys::HtmlAnchorElement = document.create_element("a")?.unchecked_into();
        anchor.set_href(&url);
        anchor.set_download(name);
        anchor.click();
        web_sys::Url::revoke_object_url(&url)
    };
    run().map(|()| name.to_owned()).map_err(|e| format!("cannot save {name}: {e:?}"))
}

/// Loads the stored list of the user's own named seas as text; empty if there is none.
pub fn load_seas() -> String {
    load_item(SEAS_FILE_NAME)
}

/// Loads the stored preferences as text; empty if there are none. What an older program stored about the panel comes
/// first, so that what is stored later counts. The folder is ignored.
pub fn load_preferences(_folder: Option<&Path>) -> String {
    [OLD_PANEL_PLACE_FILE_NAME, PREFERENCES_FILE_NAME].map(load_item).join("\n")
}

/// Stores the preferences, given as text, in place of the old ones. The folder is ignored.
///
/// # Errors
/// One sentence, if the browser refuses to store them.
pub fn store_preferences(_folder: Option<&Path>, text: &str) -> Result<(), String> {
    store_item(PREFERENCES_FILE_NAME, text)?;
    // The text holds what the older item said. If that item stays, it does no harm.
    if let Some(storage) = storage() {
        storage.remove_item(OLD_PANEL_PLACE_FILE_NAME).ok();
    }
    Ok(())
}

/// Copies the stored list of the user's own named seas to a second key of the browser's storage, over an older copy.
///
/// # Errors
/// One sentence, if the browser refuses to store the copy.
pub fn back_up_damaged_seas() -> Result<(), String> {
    store_item(DAMAGED_SEAS_FILE_NAME, &load_seas())
}

/// Stores the list of the user's own named seas, given as text, in place of the old list.
pub fn store_seas(text: &str) -> Result<(), String> {
    store_item(SEAS_FILE_NAME, text)
}

fn load_item(key: &str) -> String {
    storage().and_then(|s| s.get_item(key).ok().flatten()).unwrap_or_default()
}

fn store_item(key: &str, text: &str) -> Result<(), String> {
    let storage = storage().ok_or("this browser keeps nothing for this page")?;
    storage.set_item(key, text).map_err(|_| {
        "not kept: this site's storage in the browser is full or switched off (a private window?)".to_owned()
    })
}

fn storage() -> Option<web_sys::Storage> {
    web_sys::window().and_then(|w| w.local_storage().ok().flatten())
}
