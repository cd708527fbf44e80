//! Copies the WGSL files of `shaders` without comment lines to the build's output folder, from which src/shaders/mod.rs
//! embeds them. Comments would make the compressed page 1.5 % larger.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=shaders");
    let output = env::var("OUT_DIR").map_err(io::Error::other)?;
    copy_shaders(Path::new("shaders"), &Path::new(&output).join("shaders"))
}

/// Copies the folder `from` with its subfolders to `to`.
fn copy_shaders(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let copy = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_shaders(&path, &copy)?;
        } else {
            let text = fs::read_to_string(&path)?;
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            fs::write(copy, code.map(|line| format!("{line}\n")).collect::<String>())?;
        }
    }
    Ok(())
}
