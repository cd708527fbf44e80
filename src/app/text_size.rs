//! Size of text and controls: the user's choice, times a factor that grows with the window.

use super::App;

/// Height of a window, in the system's points, up to which text has the system's size. On a larger one, such as a screen
/// of 3840 x 2160 without scaling, the panel would be a narrow strip of tiny type.
const USUAL_HEIGHT_POINTS: f32 = 1300.0;
/// Width of a window that counts as high as [`USUAL_HEIGHT_POINTS`]: a narrow high window needs no larger text.
const USUAL_WIDTH_POINTS: f32 = 2300.0;
/// Largest factor by which a large window enlarges the text.
const MAX_WINDOW_FACTOR: f32 = 2.0;

impl App {
    /// Enlarges text and controls by the user's factor and by that of the window's size. Between two changes of these,
    /// egui's own keys for larger and smaller text work.
    pub(super) fn apply_text_size(&mut self, ctx: &egui::Context) {
        let size = ctx.content_rect().size() * ctx.zoom_factor();
        let window = (size.x / USUAL_WIDTH_POINTS).min(size.y / USUAL_HEIGHT_POINTS).clamp(1.0, MAX_WINDOW_FACTOR);
        // Steps of a twentieth: a window that is being resized does not lay out its text anew with each pixel.
        let wanted = (20.0 * window * self.params.screen.text_size as f32).round() / 20.0;
        if self.text_size != wanted {
            self.text_size = wanted;
            ctx.set_zoom_factor(wanted);
        }
    }
}
