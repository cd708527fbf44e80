//! Small pictures of the named seas (assets/thumbnails/seas.jpg, made by `seastate gallery --thumbnails`): all below each
//! other in one file. The window has it built in; the page fetches it when the tab of the seas opens.

use super::tasks::{self, Inbox};
use crate::state::presets;

/// Size at which a thumbnail is shown, points.
pub const SHOWN_SIZE: egui::Vec2 = egui::vec2(96.0, 54.0);

/// Columns of the texture: one column of all pictures would be higher than textures may be everywhere.
const COLUMNS: usize = 2;

/// The thumbnails, which are loaded when they are first asked for.
#[derive(Default)]
pub struct Thumbnails {
    is_asked_for: bool,
    loaded: Inbox<Result<egui::ColorImage, String>>,
    texture: Option<egui::TextureHandle>,
}

impl Thumbnails {
    /// The picture of the built-in named sea at `index` of the list; `None` until the file is there, or if it cannot be
    /// loaded.
    pub fn image(&mut self, index: usize, ctx: &egui::Context) -> Option<egui::Image<'static>> {
        if !std::mem::replace(&mut self.is_asked_for, true) {
            let (loaded, ctx) = (self.loaded.clone(), ctx.clone());
            tasks::spawn(async move { loaded.put(load().await, &ctx) });
        }
        for result in self.loaded.take() {
            match result {
                Ok(image) => {
                    let image = in_columns(&image, presets::built_in().len());
                    self.texture = Some(ctx.load_texture("thumbnails", image, egui::TextureOptions::LINEAR));
                }
                // The cards say all that the pictures show.
                Err(reason) => log::warn!("the pictures of the named seas are missing: {reason}"),
            }
        }
        let texture = self.texture.as_ref()?;
        let rows = presets::built_in().len().div_ceil(COLUMNS);
        let size = egui::vec2((COLUMNS as f32).recip(), (rows as f32).recip());
        let place = egui::vec2((index / rows) as f32, (index % rows) as f32);
        let uv = egui::Rect::from_min_size((place * size).to_pos2(), size);
        Some(egui::Image::new((texture.id(), SHOWN_SIZE)).uv(uv).fit_to_exact_size(SHOWN_SIZE).corner_radius(6.0))
    }
}

/// Arranges `count` pictures that lie below each other in columns beside each other.
fn in_columns(image: &egui::ColorImage, count: usize) -> egui::ColorImage {
    let [width, height] = [image.size[0], image.size[1] / count.max(1)];
    let rows = count.div_ceil(COLUMNS);
    let mut out = egui::ColorImage::filled([COLUMNS * width, rows * height], egui::Color32::TRANSPARENT);
    for (y, line) in image.pixels.chunks(width).take(count * height).enumerate() {
        let (column, row) = (y / (rows * height), y % (rows * height));
        out.pixels[(row * COLUMNS + column) * width..][..width].copy_from_slice(line);
    }
    out
}

/// Decodes the file, which is built into the program.
#[cfg(not(target_arch = "wasm32"))]
#[expect(clippy::unused_async, reason = "the page's function of the same name waits for the host")]
async fn load() -> Result<egui::ColorImage, String> {
    let bytes = include_bytes!("../../assets/thumbnails/seas.jpg");
    let image = image::load_from_memory(bytes).map_err(|e| e.to_string())?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Ok(egui::ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// Lets the browser fetch and decode the file.
#[cfg(target_arch = "wasm32")]
async fn load() -> Result<egui::ColorImage, String> {
    use wasm_bindgen::{JsCast as _, JsValue};
    let run = async || -> Result<egui::ColorImage, JsValue> {
        let image = web_sys::HtmlImageElement::new()?;
        image.set_src("thumbnails/seas.jpg");
        wasm_bindgen_futures::JsFuture::from(image.decode()).await?;
        let document = web_sys::window().and_then(|w| w.document()).ok_or("no document")?;
        let canvas: web_sys::HtmlCanvasElement = document.create_element("canvas")?.unchecked_into();
        let [width, height] = [image.natural_width(), image.natural_height()];
        canvas.set_width(width);
        canvas.set_height(height);
        let context = canvas.get_context("2d")?.ok_or("no 2D canvas")?;
        let context: web_sys::CanvasRenderingContext2d = context.unchecked_into();
        context.draw_image_with_html_image_element(&image, 0.0, 0.0)?;
        let pixels = context.get_image_data(0.0, 0.0, f64::from(width), f64::from(height))?.data();
        Ok(egui::ColorImage::from_rgba_unmultiplied([width as usize, height as usize], &pixels))
    };
    run().await.map_err(|e| format!("{e:?}"))
}
