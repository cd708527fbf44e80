//! Chooses a graphics adapter and opens a device on it. The program requires WebGPU's base limits. Optional features
//! are timestamps, to time passes, and filterable float textures on adapters where these are faster ([`MapFormat`]).

use super::kit::Gpu;
use super::map_format::MapFormat;
use super::timer;

/// Describes the device that the program requests from an adapter: WebGPU's base limits, and optional features where
/// the adapter has them: timestamps, and filterable float textures if these are faster.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let info = adapter.get_info();
    let wanted =
        timer::TIMESTAMP_FEATURE | timer::TIMESTAMPS_BETWEEN_PASSES_FEATURE | MapFormat::wanted_features(&info);
    wgpu::DeviceDescriptor {
        label: Some("seastate"),
        required_features: adapter.features() & wanted,
        required_limits: wgpu::Limits::default(),
        ..Default::default()
    }
}

/// Graphics APIs that wgpu may use: WebGPU in a browser, otherwise those that the environment variable `WGPU_BACKEND`
/// names, or else Vulkan, Metal and Direct3D 12.
pub fn backends() -> wgpu::Backends {
    if cfg!(target_arch = "wasm32") {
        wgpu::Backends::BROWSER_WEBGPU
    } else {
        wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY)
    }
}

/// Chooses an adapter for work without a window: one whose name contains the value of the environment variable
/// `WGPU_ADAPTER_NAME` (in any case), or else the one that the system prefers for high performance.
///
/// # Errors
/// If there is no adapter, or none with that name: one sentence that says what to do.
pub async fn choose_adapter() -> Result<wgpu::Adapter, String> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends();
    let instance = wgpu::Instance::new(descriptor);
    #[cfg(not(target_arch = "wasm32"))]
    if let Some(name) = std::env::var("WGPU_ADAPTER_NAME").ok().filter(|name| !name.is_empty()) {
        let all = instance.enumerate_adapters(backends()).await;
        let known: Vec<String> = all.iter().map(|a| a.get_info().name).collect();
        let wanted = |a: &wgpu::Adapter| a.get_info().name.to_lowercase().contains(&name.to_lowercase());
        return all
            .into_iter()
            .find(wanted)
            .ok_or_else(|| format!("WGPU_ADAPTER_NAME: no GPU is called \"{name}\"; there are: {}", known.join(", ")));
    }
    let options =
        wgpu::RequestAdapterOptions { power_preference: wgpu::PowerPreference::HighPerformance, ..Default::default() };
    instance
        .request_adapter(&options)
        .await
        .map_err(|e| if cfg!(target_arch = "wasm32") { e.to_string() } else { NO_ADAPTER_MESSAGE.to_owned() })
}

impl Gpu {
    /// Whether the adapter is a software rasterizer, which runs on the CPU instead of a GPU.
    pub fn is_software(&self) -> bool {
        self.device.adapter_info().device_type == wgpu::DeviceType::Cpu
    }

    /// Opens a device for work without a window or canvas, on the adapter that [`choose_adapter`] chooses.
    ///
    /// # Errors
    /// If there is no adapter, or it refuses to open a device: one sentence for the user.
    pub async fn request() -> Result<Self, String> {
        Self::open(&choose_adapter().await?).await
    }

    /// Opens a device on the given adapter, with the limits and features that [`device_descriptor`] describes.
    ///
    /// # Errors
    /// If the adapter refuses to open a device: one sentence for the user.
    pub async fn open(adapter: &wgpu::Adapter) -> Result<Self, String> {
        let (device, queue) = adapter
            .request_device(&device_descriptor(adapter))
            .await
            .map_err(|e| format!("the GPU \"{}\" cannot be used: {e}", adapter.get_info().name))?;
        Ok(Self { device, queue })
    }
}

/// Error message for a user whose system has no graphics adapter: says what to install.
pub const NO_ADAPTER_MESSAGE: &str = "no Vulkan, Metal or Direct3D 12 adapter found: install your GPU's driver, or the \
     software one (Debian and Ubuntu: mesa-vulkan-drivers, Fedora: mesa-vulkan-drivers, Arch: vulkan-swrast)";
