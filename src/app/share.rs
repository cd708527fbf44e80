//! Links and pictures: what leaves the program so that somebody else sees the same sea.

use super::{App, files, picture, tasks};
use crate::gpu::readback;
use crate::model::{Params, query};
use crate::ocean::Ocean;

impl App {
    /// The page's address with the state, or on the desktop the bare state string.
    pub fn link(&self) -> String {
        #[cfg(target_arch = "wasm32")]
        return super::web::link(&self.state());
        #[cfg(not(target_arch = "wasm32"))]
        self.state()
    }

    /// Copies the link and says so.
    pub(super) fn copy_link(&mut self) {
        self.ctx.copy_text(self.link());
        self.say("Link copied.");
    }

    /// Copies what embeds the sea in another page, without the panel.
    pub(super) fn copy_frame(&mut self) {
        let mut params = super::tidy(&self.params);
        params.screen.panel = false;
        let state = query::write(&params);
        #[cfg(target_arch = "wasm32")]
        let link = super::web::link(&state);
        #[cfg(not(target_arch = "wasm32"))]
        let link = format!("https://example.org/seastate/?{state}");
        let link = link.replace('&', "&amp;");
        self.ctx.copy_text(format!(
            "<iframe src=\"{link}\" title=\"Seastate\" width=\"960\" height=\"540\" style=\"border:0\" allow=\"fullscreen\" loading=\"lazy\"></iframe>"
        ));
        self.say("Frame copied: paste it into a page.");
    }

    /// Turns to the sea of a link, or of a bare state string.
    pub(super) fn open_link(&mut self, text: &str) {
        self.set_state(text);
        if self.notices.is_empty() {
            self.say("Opened.");
        }
    }

    /// Saves the picture that is on the screen, with its state. It arrives in the inbox.
    pub(super) fn save_picture(&mut self) {
        let Some((params, size)) = self.drawn.clone() else { return };
        let params = super::tidy(&params);
        let (state, link) = (query::write(&params), self.link());
        let (device, queue) = (self.render_state.device.clone(), self.render_state.queue.clone());
        let format = self.render_state.target_format;
        let target = target(&device, format, size);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("screenshot") });
        {
            let renderer = self.render_state.renderer.read();
            let Some(ocean) = renderer.callback_resources.get::<Ocean>() else { return };
            let view = target.create_view(&wgpu::TextureViewDescriptor::default());
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("screenshot"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: None,
                timestamp_writes: None,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            ocean.present(&mut pass);
        }
        let copy = readback::stage_texture(&device, &mut encoder, &target, 0);
        queue.submit([encoder.finish()]);
        let swapped = matches!(format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Bgra8UnormSrgb);
        let (inbox, ctx, name) = (self.saved.clone(), self.ctx.clone(), picture_name(&params));
        let folder = self.save_folder.clone();
        tasks::spawn(async move {
            let made = copy.read(&device).await.and_then(|mut pixels| {
                if swapped {
                    pixels.chunks_exact_mut(4).for_each(|p| p.swap(0, 2));
                }
                picture::encode(size, &pixels, &state, &link)
            });
            inbox.put(made.and_then(|png| files::save(folder.as_deref(), &name, &png)), &ctx);
        });
    }

    /// Says what has been saved since the last frame.
    pub(super) fn take_saved(&mut self) {
        for result in self.saved.take() {
            self.report(result);
        }
    }

    /// Saves bytes under a name and says where, or why not.
    pub(super) fn save(&mut self, name: &str, bytes: &[u8]) {
        self.report(files::save(self.save_folder.as_deref(), name, bytes));
    }

    fn report(&mut self, result: Result<String, String>) {
        match result {
            Ok(said) => self.say(&said),
            Err(reason) => self.notices.push(reason),
        }
    }
}

fn target(device: &wgpu::Device, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("screenshot"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// A name that says what the picture shows.
fn picture_name(params: &Params) -> String {
    format!("seastate-wind{:.0}-t{:.0}.png", params.sea.local().wind_m_s, params.clock.t_s)
}
