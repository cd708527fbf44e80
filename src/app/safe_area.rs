//! The safe area of a screen: what no notch, rounded corner or bar of the system covers. The picture fills the whole
//! screen, and everything else keeps to the safe area.

use super::App;

/// Largest inset that is believed, CSS pixels: a page that reports more is wrong.
const MAX_INSET_PX: f32 = 200.0;

/// Distances of the safe area from the edges of the screen, CSS pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SafeArea {
    /// Distance from the top edge.
    pub top: f32,
    /// Distance from the right edge.
    pub right: f32,
    /// Distance from the bottom edge.
    pub bottom: f32,
    /// Distance from the left edge.
    pub left: f32,
}

impl SafeArea {
    /// The same distances in points, where `zoom` points of egui's are one CSS pixel long.
    fn insets(self, zoom: f32) -> egui::SafeAreaInsets {
        let points = |px: f32| if px.is_finite() { (px.clamp(0.0, MAX_INSET_PX) / zoom).round() } else { 0.0 };
        egui::SafeAreaInsets(egui::epaint::MarginF32 {
            left: points(self.left),
            right: points(self.right),
            top: points(self.top),
            bottom: points(self.bottom),
        })
    }
}

impl App {
    /// Sets the safe area of the screen, as the web page measures it.
    pub fn set_safe_area(&mut self, safe_area: SafeArea) {
        if self.safe_area != safe_area {
            self.safe_area = safe_area;
            self.ctx.request_repaint();
        }
    }

    /// Gives egui the safe area with the input of a frame: eframe does not know it on the web.
    pub(super) fn add_safe_area(&self, input: &mut egui::RawInput) {
        if input.safe_area_insets.is_none() {
            input.safe_area_insets = Some(self.safe_area.insets(self.ctx.zoom_factor()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insets_are_in_points_and_within_reason() {
        let phone = SafeArea { top: 0.0, right: 47.0, bottom: 21.0, left: f32::NAN };
        let egui::SafeAreaInsets(insets) = phone.insets(1.0);
        assert_eq!([insets.left, insets.right, insets.top, insets.bottom], [0.0, 47.0, 0.0, 21.0]);
        let egui::SafeAreaInsets(insets) = SafeArea { top: 60.0, right: -5.0, bottom: 1e9, left: 0.0 }.insets(2.0);
        assert_eq!([insets.left, insets.right, insets.top, insets.bottom], [0.0, 0.0, 30.0, 100.0]);
    }
}
