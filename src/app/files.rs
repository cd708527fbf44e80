//! What the program leaves on a disk: pictures and texts to save, and the user's own seas.

use std::path::Path;

/// Saves bytes under a name: in a folder (else that for pictures, else the current one) on a desktop, as a download on a
/// page. Says where.
///
/// # Errors
/// One sentence with the reason.
#[cfg(not(target_arch = "wasm32"))]
pub fn save(folder: Option<&Path>, name: &str, bytes: &[u8]) -> Result<String, String> {
    let pictures = || directories::UserDirs::new().and_then(|d| d.picture_dir().map(Path::to_owned));
    let folder = folder.map(Path::to_owned).or_else(pictures).filter(|f| f.is_dir()).unwrap_or_else(|| ".".into());
    let (stem, end) = name.rsplit_once('.').unwrap_or((name, ""));
    // Nothing that is there is written over.
    let names = std::iter::once(name.to_owned()).chain((2..1000).map(|i| format!("{stem}-{i}.{end}")));
    for path in names.map(|name| folder.join(name)) {
        let fault = |e: std::io::Error| format!("cannot write {}: {e}", path.display());
        match std::fs::File::create_new(&path) {
            Ok(mut file) => {
                std::io::Write::write_all(&mut file, bytes).map_err(fault)?;
                return Ok(format!("saved {}", path.display()));
            }
            Err(e) if e.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(e) => return Err(fault(e)),
        }
    }
    Err(format!("there are too many files like {name} in {}", folder.display()))
}

/// Saves bytes under a name: in a folder (else that for pictures, else the current one) on a desktop, as a download on a
/// page. Says where.
///
/// # Errors
/// One sentence with the reason.
#[cfg(target_arch = "wasm32")]
pub fn save(_folder: Option<&Path>, name: &str, bytes: &[u8]) -> Result<String, String> {
    use wasm_bindgen::JsCast as _;
    let run = || -> Result<(), wasm_bindgen::JsValue> {
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
    run().map(|()| format!("downloaded {name}")).map_err(|e| format!("cannot save {name}: {e:?}"))
}

/// Name of the file, or key of the browser's storage, of the user's own seas.
const SEAS: &str = "seas.txt";

/// Where seas are kept that could not be read whole.
const SEAS_ASIDE: &str = "seas-damaged.txt";

/// The user's own seas, as text; empty if there are none. What is no text in them is replaced.
#[cfg(not(target_arch = "wasm32"))]
pub fn load_seas() -> String {
    seas_path().and_then(|path| read_seas(&path)).unwrap_or_default()
}

#[cfg(not(target_arch = "wasm32"))]
fn read_seas(path: &Path) -> Option<String> {
    use std::io::Read as _;
    let mut bytes = Vec::new();
    // One byte more than is read is enough to be noticed.
    let most = crate::state::presets::MAX_FILE_BYTES as u64 + 1;
    std::fs::File::open(path).ok()?.take(most).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// Copies the user's own seas to a place where nothing is written over them.
///
/// # Errors
/// One sentence with the reason.
#[cfg(not(target_arch = "wasm32"))]
pub fn put_seas_aside() -> Result<(), String> {
    copy_aside(&seas_path().ok_or("there is no folder for the program's data")?)
}

#[cfg(not(target_arch = "wasm32"))]
fn copy_aside(path: &Path) -> Result<(), String> {
    let (stem, end) = SEAS_ASIDE.rsplit_once('.').unwrap_or((SEAS_ASIDE, "txt"));
    // Those of an earlier time stay, too.
    let names = std::iter::once(SEAS_ASIDE.to_owned()).chain((2..1000).map(|i| format!("{stem}-{i}.{end}")));
    let free = names.map(|name| path.with_file_name(name)).find(|aside| !aside.exists());
    let aside = free.ok_or("there are too many files of damaged seas")?;
    std::fs::copy(path, &aside).map(drop).map_err(|e| format!("cannot write {}: {e}", aside.display()))
}

/// Keeps the user's own seas for the next time.
///
/// # Errors
/// One sentence with the reason.
#[cfg(not(target_arch = "wasm32"))]
pub fn store_seas(text: &str) -> Result<(), String> {
    let path = seas_path().ok_or("there is no folder for the program's data")?;
    let fault = |e: std::io::Error| format!("cannot write {}: {e}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(fault)?;
    }
    // A full disk must not cost the seas that are there: the old file stays until the new one is whole.
    let new = path.with_extension("new");
    std::fs::write(&new, text).and_then(|()| std::fs::rename(&new, &path)).map_err(fault)
}

#[cfg(not(target_arch = "wasm32"))]
fn seas_path() -> Option<std::path::PathBuf> {
    let given = std::env::var_os("SEASTATE_DATA_DIR").map(std::path::PathBuf::from);
    let usual = || directories::ProjectDirs::from("", "", "seastate").map(|d| d.data_dir().to_owned());
    given.or_else(usual).map(|folder| folder.join(SEAS))
}

/// The user's own seas, as text; empty if there are none.
#[cfg(target_arch = "wasm32")]
pub fn load_seas() -> String {
    storage().and_then(|s| s.get_item(SEAS).ok().flatten()).unwrap_or_default()
}

/// Copies the user's own seas to a place where nothing is written over them.
///
/// # Errors
/// One sentence with the reason.
#[cfg(target_arch = "wasm32")]
pub fn put_seas_aside() -> Result<(), String> {
    let storage = storage().ok_or("this browser keeps nothing for this page")?;
    let full =
        |_| "not kept: this site's storage in the browser is full or switched off (a private window?)".to_owned();
    storage.set_item(SEAS_ASIDE, &load_seas()).map_err(full)
}

/// Keeps the user's own seas for the next time.
///
/// # Errors
/// One sentence with the reason.
#[cfg(target_arch = "wasm32")]
pub fn store_seas(text: &str) -> Result<(), String> {
    let storage = storage().ok_or("this browser keeps nothing for this page")?;
    storage.set_item(SEAS, text).map_err(|_| {
        "not kept: this site's storage in the browser is full or switched off (a private window?)".to_owned()
    })
}

#[cfg(target_arch = "wasm32")]
fn storage() -> Option<web_sys::Storage> {
    web_sys::window().and_then(|w| w.local_storage().ok().flatten())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn damaged_seas_are_read_as_far_as_they_go_and_put_aside() {
        let folder = std::env::temp_dir().join(format!("seastate-seas-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join(SEAS);
        assert_eq!(read_seas(&path), None);
        std::fs::write(&path, b"[a]\nstate: wind=3\n[b]\nabout: \xff\xfe\nstate: wind=4\n[c]\n").expect("a file");
        let (seas, notices) = crate::state::presets::read(&read_seas(&path).expect("text"));
        assert_eq!((seas.len(), notices.len()), (2, 1));
        copy_aside(&path).expect("a copy");
        std::fs::write(&path, "").expect("a file");
        copy_aside(&path).expect("another copy");
        assert_eq!(std::fs::read(folder.join(SEAS_ASIDE)).expect("the copy").len(), 50);
        assert!(std::fs::read(folder.join("seas-damaged-2.txt")).expect("the second").is_empty());
        // Longer than a file may be: what is too much is noticed, not taken for the end.
        std::fs::write(&path, "[a]\nstate: wind=3\n".repeat(100_000)).expect("a file");
        let (_, notices) = crate::state::presets::read(&read_seas(&path).expect("text"));
        assert!(notices.iter().any(|n| n.contains("KiB")), "{notices:?}");
        std::fs::remove_dir_all(&folder).expect("the folder is removed");
    }
}
