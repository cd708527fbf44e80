//! `seastate info`: prints the program's version, its GPU, and how it uses the GPU.

use crate::ocean::device_info::{DeviceInfo, VERSION, WGPU_VERSION, build_platform};
use serde_json::{Map, Value, json};

/// Formats `about`, the report about the program and its GPU, as a text table.
pub fn about_text(about: &DeviceInfo) -> String {
    about.rows().iter().map(|(name, value)| format!("{name:<28} {value}\n")).collect()
}

/// Converts the report about the program and its GPU to JSON.
pub fn about_json(about: &DeviceInfo) -> Value {
    let limits = about
        .requested_and_adapter_limits
        .iter()
        .map(|(name, [asked, could])| (json_key(name), json!({"asked": asked, "adapter": could})));
    let ways = about.program_choices.iter().map(|(name, way)| (json_key(name), json!(way)));
    json!({
        "seastate": VERSION, "wgpu": WGPU_VERSION, "system": build_platform(),
        "adapter": about.adapter, "kind": about.kind, "backend": about.backend, "driver": about.driver,
        "vendor": about.pci_ids[0], "device": about.pci_ids[1], "features": about.features,
        "ways": ways.collect::<Map<_, _>>(), "limits": limits.collect::<Map<_, _>>(),
    })
}

/// Converts a name to a JSON key: `buffer, bytes` becomes `buffer_bytes`.
fn json_key(name: &str) -> String {
    name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}
