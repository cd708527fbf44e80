//! `seastate info`: the program, the GPU that it takes, and what it makes of it.

use crate::gpu::{Gpu, device};
use crate::ocean::about::{About, VERSION, WGPU_VERSION, system};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// The report, as a table or as JSON.
///
/// # Errors
/// If there is no adapter.
pub async fn run(as_json: bool) -> Result<String, String> {
    let adapter = device::adapter().await?;
    let about = About::new(&adapter, &Gpu::open(&adapter).await?);
    Ok(if as_json { serde_json::to_string_pretty(&value(&about)).unwrap_or_default() } else { text(&about) })
}

fn text(about: &About) -> String {
    let mut out = String::new();
    for (name, value) in about.rows() {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{name:<28} {value}");
    }
    out
}

fn value(about: &About) -> Value {
    let limits =
        about.limits.iter().map(|(name, [asked, could])| (key(name), json!({"asked": asked, "adapter": could})));
    let ways = about.ways.iter().map(|(name, way)| (key(name), json!(way)));
    json!({
        "seastate": VERSION, "wgpu": WGPU_VERSION, "system": system(),
        "adapter": about.adapter, "kind": about.kind, "backend": about.backend, "driver": about.driver,
        "vendor": about.ids[0], "device": about.ids[1], "features": about.features,
        "ways": ways.collect::<Map<_, _>>(), "limits": limits.collect::<Map<_, _>>(),
    })
}

/// A name as a key: `buffer, bytes` is `buffer_bytes`.
fn key(name: &str) -> String {
    name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}
