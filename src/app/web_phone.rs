//! What a phone's browser tells the app: the safe area of its screen, and how it is held (web/phone.js).

use super::safe_area::SafeArea;
use super::web::WebHandle;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl WebHandle {
    /// Sets the safe area of the screen by its distances from the edges, CSS pixels. Returns whether the app has taken
    /// it: false before the app has started.
    pub fn set_safe_area(&self, top: f32, right: f32, bottom: f32, left: f32) -> bool {
        self.with_app(|app| app.set_safe_area(SafeArea { top, right, bottom, left })).is_some()
    }

    /// Offers to look by tilting the device.
    pub fn offer_tilt(&self) {
        self.with_app(|app| app.offer_tilt());
    }

    /// Bounds of the button that switches looking by tilting on, CSS pixels: x and y of the top left corner, width,
    /// height; `None` while there is none.
    pub fn tilt_button(&self) -> Option<Vec<f32>> {
        let (button, zoom) = self.with_app(|app| app.tilt_button().map(|rect| (rect, app.ctx.zoom_factor())))??;
        Some([button.left(), button.top(), button.width(), button.height()].map(|x| zoom * x).to_vec())
    }

    /// Tells how the device is held: the angles of the event `deviceorientation`, degrees.
    pub fn follow_tilt(&self, alpha: f64, beta: f64, gamma: f64) {
        self.with_app(|app| app.follow_tilt([alpha, beta, gamma]));
    }

    /// Ends looking by tilting because the browser does not tell how the device is held.
    pub fn refuse_tilt(&self) {
        self.with_app(|app| app.refuse_tilt());
    }
}
