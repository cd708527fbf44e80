//! Storage of the desktop window: files in the user's folders.

use super::{DAMAGED_SEAS_FILE_NAME, OLD_PANEL_PLACE_FILE_NAME, PREFERENCES_FILE_NAME, SEAS_FILE_NAME};
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};

/// Saves bytes as a file in `folder`, else in the user's pictures folder, else in the current folder. If the name is
/// taken, the new name gets a number. Returns the path.
///
/// # Errors
/// One sentence with the reason, if the file cannot be written.
pub fn save(folder: Option<&Path>, name: &str, bytes: &[u8]) -> Result<String, String> {
    let pictures = || directories::UserDirs::new().and_then(|d| d.picture_dir().map(Path::to_owned));
    let folder = folder.map(Path::to_owned).or_else(pictures).filter(|f| f.is_dir()).unwrap_or_else(|| ".".into());
    for path in numbered_file_names(name).map(|name| folder.join(name)) {
        let fault = |e: std::io::Error| format!("cannot write {}: {e}", path.display());
        match std::fs::File::create_new(&path) {
            Ok(mut file) => {
                file.write_all(bytes).map_err(fault)?;
                return Ok(path.display().to_string());
            }
            Err(e) if e.kind() == ErrorKind::AlreadyExists => {}
            Err(e) => return Err(fault(e)),
        }
    }
    Err(format!("there are too many files like {name} in {}", folder.display()))
}

/// The file name itself, then the same name with `-2`, `-3` and so on before its extension, up to `-999`.
fn numbered_file_names(name: &str) -> impl Iterator<Item = String> {
    let (stem, end) = name.rsplit_once('.').unwrap_or((name, ""));
    std::iter::once(name.to_owned()).chain((2..1000).map(move |i| format!("{stem}-{i}.{end}")))
}

/// Loads the stored list of the user's own named seas as text; empty if there is none. Invalid UTF-8 is replaced.
pub fn load_seas() -> String {
    seas_path().ok().and_then(|path| read_text(&path)).unwrap_or_default()
}

/// Loads the stored preferences as text, from `folder` if the app has a folder of its own for files, else from that of
/// the program's data; empty if there are none. What an older program stored about the panel comes first, so that what is
/// stored later counts.
pub fn load_preferences(folder: Option<&Path>) -> String {
    let text = |name| preferences_path(folder, name).ok().and_then(|path| read_text(&path)).unwrap_or_default();
    [text(OLD_PANEL_PLACE_FILE_NAME), text(PREFERENCES_FILE_NAME)].join("\n")
}

/// Stores the preferences, given as text, in place of the old ones.
///
/// # Errors
/// One sentence with the reason, if the file cannot be written.
pub fn store_preferences(folder: Option<&Path>, text: &str) -> Result<(), String> {
    store_text(&preferences_path(folder, PREFERENCES_FILE_NAME)?, text)?;
    // The text holds what the older file said. If that file stays, it does no harm.
    preferences_path(folder, OLD_PANEL_PLACE_FILE_NAME).map(|path| drop(std::fs::remove_file(path)))
}

fn preferences_path(folder: Option<&Path>, name: &str) -> Result<PathBuf, String> {
    folder.map_or_else(|| data_path(name), |folder| Ok(folder.join(name)))
}

fn read_text(path: &Path) -> Option<String> {
    let mut bytes = Vec::new();
    // Reads one byte more than the limit, so that the parser notices a file that is too long.
    let most = crate::state::presets::MAX_FILE_BYTES as u64 + 1;
    std::fs::File::open(path).ok()?.take(most).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// Copies the stored list of the user's own named seas to a new file with a free name, which is never overwritten.
///
/// # Errors
/// One sentence with the reason, if the file cannot be written.
pub fn back_up_damaged_seas() -> Result<(), String> {
    copy_damaged_file(&seas_path()?)
}

fn copy_damaged_file(path: &Path) -> Result<(), String> {
    let free =
        numbered_file_names(DAMAGED_SEAS_FILE_NAME).map(|name| path.with_file_name(name)).find(|aside| !aside.exists());
    let aside = free.ok_or("there are too many files of damaged seas")?;
    std::fs::copy(path, &aside).map(drop).map_err(|e| format!("cannot write {}: {e}", aside.display()))
}

/// Stores the list of the user's own named seas, given as text, in place of the old list.
///
/// # Errors
/// One sentence with the reason, if the file cannot be written.
pub fn store_seas(text: &str) -> Result<(), String> {
    store_text(&seas_path()?, text)
}

fn store_text(path: &Path, text: &str) -> Result<(), String> {
    let fault = |e: std::io::Error| format!("cannot write {}: {e}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(fault)?;
    }
    // The old file stays until the new one is complete, so that a full disk loses nothing.
    let new = path.with_extension("new");
    std::fs::write(&new, text).and_then(|()| std::fs::rename(&new, path)).map_err(fault)
}

fn seas_path() -> Result<PathBuf, String> {
    data_path(SEAS_FILE_NAME)
}

/// Path of a file in the folder of the program's data.
fn data_path(name: &str) -> Result<PathBuf, String> {
    let given = std::env::var_os("SEASTATE_DATA_DIR").map(PathBuf::from);
    let usual = || directories::ProjectDirs::from("", "", "seastate").map(|d| d.data_dir().to_owned());
    let folder = given.or_else(usual).ok_or("there is no folder for the program's data")?;
    Ok(folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damaged_seas_are_read_as_far_as_they_go_and_put_aside() {
        let folder = std::env::temp_dir().join(format!("seastate-seas-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join(SEAS_FILE_NAME);
        assert_eq!(read_text(&path), None);
        std::fs::write(&path, b"[a]\nstate: wind=3\n[b]\nabout: \xff\xfe\nstate: wind=4\n[c]\n").expect("a file");
        let (seas, notices) = crate::state::presets::read(&read_text(&path).expect("text"));
        assert_eq!((seas.len(), notices.len()), (2, 1));
        copy_damaged_file(&path).expect("a copy");
        std::fs::write(&path, "").expect("a file");
        copy_damaged_file(&path).expect("another copy");
        assert_eq!(std::fs::read(folder.join(DAMAGED_SEAS_FILE_NAME)).expect("the copy").len(), 50);
        assert!(std::fs::read(folder.join("seas-damaged-2.txt")).expect("the second").is_empty());
        // A file over the size limit gives a notice; it is not cut silently.
        std::fs::write(&path, "[a]\nstate: wind=3\n".repeat(100_000)).expect("a file");
        let (_, notices) = crate::state::presets::read(&read_text(&path).expect("text"));
        assert!(notices.iter().any(|n| n.contains("KiB")), "{notices:?}");
        std::fs::remove_dir_all(&folder).expect("the folder is removed");
    }
}
