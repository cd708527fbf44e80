//! Description of a device for a report: adapter, driver, limits, features, and the choices that follow from them.

use crate::gpu::Gpu;
use crate::gpu::map_format::MapFormat;
use crate::gpu::timer;
use crate::sim::transform::FftImplementation;

/// The version of this program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The version of wgpu; a test compares it with Cargo.lock.
pub const WGPU_VERSION: &str = "30.0.1";

/// Description of a GPU device, as a bug report needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceInfo {
    /// Name of the GPU (wgpu's adapter); "not told" if wgpu gives no name.
    pub adapter: String,
    /// Kind of adapter: discrete GPU, integrated GPU, virtual GPU, CPU or other.
    pub kind: String,
    /// Graphics interface of the system that wgpu uses, such as Vulkan.
    pub backend: String,
    /// Name and version of the driver; empty in a browser.
    pub driver: String,
    /// PCI numbers: that of the GPU's vendor, then that of the device; 0 if unknown.
    pub pci_ids: [u32; 2],
    /// Names of the optional wgpu features that the device has and the program uses, such as "timestamps".
    pub features: Vec<&'static str>,
    /// Limits of the GPU: name, such as "texture side"; then the value that the program requests and the adapter's own.
    pub requested_and_adapter_limits: Vec<(&'static str, [u64; 2])>,
    /// Choices that the program made for this adapter, such as the texture format of the maps: names and values.
    pub program_choices: Vec<(&'static str, String)>,
}

impl DeviceInfo {
    /// Collects the description of a GPU device and of its adapter.
    pub fn new(adapter: &wgpu::Adapter, gpu: &Gpu) -> Self {
        let info = adapter.get_info();
        let (asked, could) = (gpu.device.limits(), adapter.limits());
        let limit = |name, of: fn(&wgpu::Limits) -> u64| (name, [of(&asked), of(&could)]);
        let features = [
            ("timestamps", timer::TIMESTAMP_FEATURE),
            ("timestamps between passes", timer::TIMESTAMPS_BETWEEN_PASSES_FEATURE),
            ("filtered floats", MapFormat::FILTERABLE_FLOATS),
        ];
        let transform = match FftImplementation::for_device(gpu) {
            FftImplementation::Workgroup => "workgroup: one dispatch for each axis, through workgroup memory",
            FftImplementation::Unrolled => "unrolled: two dispatches for each axis, without barriers",
        };
        let maps = match MapFormat::for_device(gpu) {
            MapFormat::Half => "half floats",
            MapFormat::Float => "floats",
        };
        Self {
            adapter: if info.name.is_empty() { "not told".to_owned() } else { info.name },
            kind: format!("{:?}", info.device_type),
            backend: info.backend.to_string(),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            pci_ids: [info.vendor, info.device],
            features: features
                .iter()
                .filter(|(_, f)| gpu.device.features().contains(*f))
                .map(|(name, _)| *name)
                .collect(),
            requested_and_adapter_limits: vec![
                limit("texture side", |l| l.max_texture_dimension_2d.into()),
                limit("texture layers", |l| l.max_texture_array_layers.into()),
                limit("buffer, bytes", |l| l.max_buffer_size),
                limit("storage binding, bytes", |l| l.max_storage_buffer_binding_size),
                limit("storage buffers in a stage", |l| l.max_storage_buffers_per_shader_stage.into()),
                limit("storage textures in a stage", |l| l.max_storage_textures_per_shader_stage.into()),
                limit("workgroup memory, bytes", |l| l.max_compute_workgroup_storage_size.into()),
                limit("threads of a workgroup", |l| l.max_compute_invocations_per_workgroup.into()),
            ],
            program_choices: vec![("transform", transform.to_owned()), ("maps", maps.to_owned())],
        }
    }

    /// All properties as rows of a table for the user: name and value.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let known = |text: &str| if text.is_empty() { "not told".to_owned() } else { text.to_owned() };
        let [vendor, device] = self.pci_ids;
        let mut rows = vec![
            ("Seastate", VERSION.to_owned()),
            ("wgpu", WGPU_VERSION.to_owned()),
            ("system", build_platform()),
            ("adapter", format!("{} ({})", self.adapter, self.kind)),
            ("backend", self.backend.clone()),
            ("driver", known(&self.driver)),
            ("vendor, device", format!("{vendor:#06x}, {device:#06x}")),
            ("features", if self.features.is_empty() { "none".to_owned() } else { self.features.join(", ") }),
        ];
        rows.extend(self.program_choices.iter().cloned());
        rows.extend(
            self.requested_and_adapter_limits
                .iter()
                .map(|(name, [asked, could])| (*name, format!("{asked} of {could}"))),
        );
        rows
    }
}

/// The operating system and processor that the program was built for.
pub fn build_platform() -> String {
    format!("{} {}", std::env::consts::OS, std::env::consts::ARCH).trim().to_owned()
}
