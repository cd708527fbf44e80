//! What Seastate demands of a GPU: WebGPU's base limits. Of optional features it takes timestamps, to say what costs what,
//! filters of floats and long numbers where these are faster (map_format.rs, fft.rs).

use super::fft::Way;
use super::map_format::MapFormat;
use super::timer;

/// The device that every shell asks an adapter for.
pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let info = adapter.get_info();
    let wanted = timer::FEATURES | timer::BETWEEN_PASSES | MapFormat::features(&info) | Way::features(&info);
    wgpu::DeviceDescriptor {
        label: Some("seastate"),
        required_features: adapter.features() & wanted,
        required_limits: wgpu::Limits::default(),
        ..Default::default()
    }
}

/// Backends that the program uses: the browser's WebGPU there, modern native ones here.
pub fn backends() -> wgpu::Backends {
    if cfg!(target_arch = "wasm32") {
        wgpu::Backends::BROWSER_WEBGPU
    } else {
        wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY)
    }
}

/// A device without a window.
#[derive(Debug)]
pub struct Gpu {
    /// Where it came from.
    pub adapter: wgpu::Adapter,
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens a GPU for headless work. `WGPU_ADAPTER_NAME` picks one by a part of its name.
    ///
    /// # Errors
    /// One sentence that says what to install when there is no adapter.
    #[cfg(not(target_arch = "wasm32"))]
    pub async fn request() -> Result<Self, String> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends();
        let instance = wgpu::Instance::new(descriptor);
        let adapter = match std::env::var("WGPU_ADAPTER_NAME").ok().filter(|name| !name.is_empty()) {
            Some(name) => {
                let all = instance.enumerate_adapters(backends()).await;
                let known: Vec<String> = all.iter().map(|a| a.get_info().name).collect();
                let wanted = |a: &wgpu::Adapter| a.get_info().name.to_lowercase().contains(&name.to_lowercase());
                all.into_iter().find(wanted).ok_or_else(|| {
                    format!("WGPU_ADAPTER_NAME: no GPU is called \"{name}\"; there are: {}", known.join(", "))
                })?
            }
            None => instance
                .request_adapter(&wgpu::RequestAdapterOptions {
                    power_preference: wgpu::PowerPreference::HighPerformance,
                    ..Default::default()
                })
                .await
                .map_err(|_| NO_ADAPTER.to_owned())?,
        };
        Self::open(adapter).await
    }

    /// Opens the browser's GPU without a canvas.
    ///
    /// # Errors
    /// If there is none, or it cannot be used.
    #[cfg(target_arch = "wasm32")]
    pub async fn request() -> Result<Self, String> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends();
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = wgpu::Instance::new(descriptor).request_adapter(&options).await;
        Self::open(adapter.map_err(|e| e.to_string())?).await
    }

    async fn open(adapter: wgpu::Adapter) -> Result<Self, String> {
        let name = adapter.get_info().name;
        let (device, queue) = adapter
            .request_device(&descriptor(&adapter))
            .await
            .map_err(|e| format!("the GPU \"{name}\" cannot be used: {e}"))?;
        Ok(Self { adapter, device, queue })
    }
}

/// What to do when there is no adapter.
pub const NO_ADAPTER: &str = "no Vulkan, Metal or Direct3D 12 adapter found: install your GPU's driver, or the software \
     one (Debian and Ubuntu: mesa-vulkan-drivers, Fedora: mesa-vulkan-drivers, Arch: vulkan-swrast)";
