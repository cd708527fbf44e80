//! An ocean inside a host's own renderer: the host brings the wgpu device and the target, and records the frame.
//!
//! `cargo run --release --example own_device`

#![expect(clippy::print_stdout, reason = "the example prints its results")]

use seastate::gpu::{Gpu, device, readback};
use seastate::ocean::{Ocean, OutputKind};
use seastate::state::query;

const SIZE: [u32; 2] = [640, 360];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    pollster::block_on(run())
}

async fn run() -> Result<(), Box<dyn std::error::Error>> {
    // The host's own device. `device::descriptor` asks for the optional features that the ocean uses; none is required.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
    let (device, queue) = adapter.request_device(&device::device_descriptor(&adapter)).await?;
    let gpu = Gpu { device, queue };

    let (mut params, _) = query::parse("wind=10&sun=25&n=128");
    let mut ocean = Ocean::new(&gpu, FORMAT, OutputKind::Screen, &params);
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    let target = gpu.texture("host target", [SIZE[0], SIZE[1], 1], 1, FORMAT, usage);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());

    // The host's frame loop. Parameters may change at any time; the sea cross-fades to the new ones.
    for frame in 0..3 {
        let dt_s = 1.0 / 60.0;
        params.clock.t_s += dt_s;
        ocean.transition_to(&params, dt_s);
        let mut encoder = gpu.encoder("host frame");
        let foam_is_complete = ocean.record_frame(&mut encoder, SIZE, 6);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host pass"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        // The ocean fills the viewport of the pass. The host may draw before or after it.
        ocean.present(&mut pass);
        drop(pass);
        gpu.submit(encoder);
        println!("frame {frame}: foam {}", if foam_is_complete { "complete" } else { "catching up" });
    }

    // Reads the picture back and prints one pixel.
    let mut encoder = gpu.encoder("host read-back");
    let copy = readback::stage_texture(&gpu, &mut encoder, &target, 0);
    gpu.submit(encoder);
    let pixels = copy.read(&gpu).await?;
    let middle = 4 * (SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2) as usize;
    println!("pixel in the middle: {:?}", &pixels[middle..middle + 4]);
    Ok(())
}
