//! The caption of a saved picture: a line of text on a dark band at the lower edge, drawn on the CPU with egui's glyphs.

use egui::epaint::text::Galley;
use std::sync::Arc;

/// Height of the text relative to the shorter side of the picture.
const TEXT_HEIGHT_RATIO: f32 = 0.03;
/// Least height of the text, pixels.
const MIN_TEXT_PX: f32 = 12.0;
/// Height of the band relative to the height of the text.
const BAND_RATIO: f32 = 1.9;
/// Part of the picture's light that the band lets through.
const BAND_TRANSMITTANCE: f32 = 0.45;

/// A line of text as coverage of pixels.
pub struct PictureCaption {
    width: usize,
    height: usize,
    /// Height of the band below the text, pixels.
    band_px: usize,
    /// Coverage of each pixel by letters, row by row, 0 to 255.
    coverage: Vec<u8>,
}

impl PictureCaption {
    /// Sets `text` with the interface's font, in a size that suits a picture of `size` (width, height) pixels. A text
    /// that would be wider than the picture is set smaller.
    pub fn new(ctx: &egui::Context, text: &str, size: [u32; 2]) -> Self {
        let [width, height] = size.map(|s| s as f32);
        let mut text_px = (TEXT_HEIGHT_RATIO * width.min(height)).max(MIN_TEXT_PX);
        let pixels_per_point = ctx.pixels_per_point();
        let set = |px: f32| {
            let font = egui::FontId::proportional(px / pixels_per_point);
            ctx.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE))
        };
        let mut galley = set(text_px);
        let room = width - 2.0 * text_px;
        let found = galley.size().x * pixels_per_point;
        if found > room && room > 0.0 {
            text_px *= room / found;
            galley = set(text_px);
        }
        // The atlas is read after the layout, which adds the letters to it.
        let atlas = ctx.fonts(|fonts| fonts.image());
        Self::from_galley(&galley, &atlas, pixels_per_point, text_px)
    }

    fn from_galley(galley: &Arc<Galley>, atlas: &egui::ColorImage, pixels_per_point: f32, text_px: f32) -> Self {
        let [width, height] = [galley.size().x, galley.size().y].map(|s| (s * pixels_per_point).ceil() as usize + 2);
        let mut coverage = vec![0; width * height];
        for row in &galley.rows {
            for glyph in &row.row.glyphs {
                let area = glyph.uv_rect;
                let corner = (row.pos.to_vec2() + glyph.pos.to_vec2() + area.offset) * pixels_per_point;
                let [left, top] = [corner.x, corner.y].map(|s| s.round().max(0.0) as usize);
                for v in area.min[1]..area.max[1] {
                    for u in area.min[0]..area.max[0] {
                        let (x, y) = (left + usize::from(u - area.min[0]), top + usize::from(v - area.min[1]));
                        if x < width && y < height {
                            let letter = atlas[(usize::from(u), usize::from(v))].a();
                            let texel = &mut coverage[y * width + x];
                            *texel = letter.max(*texel);
                        }
                    }
                }
            }
        }
        Self { width, height, band_px: (BAND_RATIO * text_px).ceil() as usize, coverage }
    }

    /// Draws the band and the text on RGBA `pixels` of a picture of `size` (width, height).
    pub fn draw(&self, pixels: &mut [u8], size: [u32; 2]) {
        let [width, height] = size.map(|s| s as usize);
        let band = self.band_px.max(self.height).min(height);
        let (left, top) = (band / 3, (band - self.height.min(band)) / 2);
        for y in 0..band {
            for x in 0..width {
                let at = 4 * ((height - band + y) * width + x);
                let inside = x >= left && x < left + self.width && y >= top && y < top + self.height;
                let letter = if inside { self.coverage[(y - top) * self.width + x - left] } else { 0 };
                let ink = f32::from(letter) / 255.0;
                for channel in &mut pixels[at..at + 3] {
                    let below = BAND_TRANSMITTANCE * f32::from(*channel);
                    *channel = (below + (255.0 - below) * ink).round() as u8;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A context with the interface's fonts, which its first frame loads.
    fn context() -> egui::Context {
        let ctx = egui::Context::default();
        crate::app::icons::install(&ctx);
        ctx.run_ui(egui::RawInput::default(), |_| {}).textures_delta.clear();
        ctx
    }

    #[test]
    fn letters_stand_on_a_dark_band() {
        let ctx = context();
        let size = [400, 200];
        let mut pixels = vec![200; 4 * 400 * 200];
        PictureCaption::new(&ctx, "Force 5 sea, waves 1.9 m high", size).draw(&mut pixels, size);
        assert!(pixels[..4 * 400 * 150].iter().all(|p| *p == 200), "the picture above is as it was");
        let reds = |rows: std::ops::Range<usize>| pixels[4 * 400 * rows.start..4 * 400 * rows.end].iter().step_by(4);
        assert_eq!(reds(199..200).filter(|p| **p == 90).count(), 400, "the last row is the band");
        let bright = reds(178..200).filter(|p| **p > 220).count();
        assert!((100..3000).contains(&bright), "{bright} pixels of letters");
    }

    #[test]
    fn pictures_of_any_size_have_room() {
        let ctx = context();
        for size in [[1, 1], [30, 8], [8, 300]] {
            let mut pixels = vec![0; 4 * (size[0] * size[1]) as usize];
            PictureCaption::new(&ctx, "Force 12 sea, waves 14.0 m high", size).draw(&mut pixels, size);
        }
    }
}
