//! Tilt to look, an offer on phones: the view follows how the device is held. The page asks the browser for the sensors
//! (web/phone.js) only after the user has switched it on.

use super::App;
use super::accessible_names::with_accessible_name;
use crate::app::language::tr;
use crate::state::tilt::Following;

/// Whether looking by tilting is offered and used.
#[derive(Debug, Default)]
pub struct Tilt {
    is_offered: bool,
    following: Option<Following>,
    /// Where the button that switches it on was shown in the last frame, points.
    button: Option<egui::Rect>,
}

impl Tilt {
    /// Whether the view follows the device.
    pub fn is_on(&self) -> bool {
        self.following.is_some()
    }
}

impl App {
    /// Offers to look by tilting the device, because it has the sensors: the tab of the view gets a button.
    pub fn offer_tilt(&mut self) {
        self.tilt.is_offered = true;
    }

    /// Makes the camera follow the device, if the user has switched that on. The angles are those of the browser's event
    /// `deviceorientation`, degrees.
    pub fn follow_tilt(&mut self, angles_deg: [f64; 3]) {
        if let Some(following) = &mut self.tilt.following {
            following.follow(&mut self.params.camera, angles_deg);
            self.ctx.request_repaint();
        }
    }

    /// Ends looking by tilting because the browser does not tell how the device is held.
    pub fn refuse_tilt(&mut self) {
        if self.tilt.is_on() {
            self.stop_tilt();
            self.show_brief_message(tr("The browser does not tell the page how the device is held."));
        }
    }

    /// Bounds of the button that switches looking by tilting on, in points; `None` while there is none. The page asks for
    /// the sensors while it handles the tap on it, since browsers grant them to nothing else.
    pub fn tilt_button(&self) -> Option<egui::Rect> {
        self.tilt.button.filter(|_| !self.tilt.is_on())
    }

    fn start_tilt(&mut self) {
        self.tilt.following = Some(Following::new(&self.params.camera));
        #[cfg(target_arch = "wasm32")]
        super::web_page::tell_page("seastate-tilt-start");
    }

    /// Ends looking by tilting, and returns to the view before.
    fn stop_tilt(&mut self) {
        let Some(following) = self.tilt.following.take() else { return };
        following.give_back(&mut self.params.camera);
        #[cfg(target_arch = "wasm32")]
        super::web_page::tell_page("seastate-tilt-stop");
    }

    /// Forgets where the button was; [`Self::show_tilt_button`] notes it again if it is shown in this frame.
    pub(super) fn forget_tilt_button(&mut self) {
        self.tilt.button = None;
    }

    /// Adds the button that switches looking by tilting on and off, if the device can do it.
    pub(super) fn show_tilt_button(&mut self, ui: &mut egui::Ui) {
        if !self.tilt.is_offered {
            return;
        }
        let is_on = self.tilt.is_on();
        let button = ui.add(egui::Button::new(tr("Tilt to look")).selected(is_on));
        let help = tr("The view follows how you hold the device. Switched off, it returns to where it was.");
        let button = with_accessible_name(button.on_hover_text(help), tr("Tilt to look"));
        self.tilt.button = Some(button.rect);
        if button.clicked() {
            if is_on { self.stop_tilt() } else { self.start_tilt() }
        }
    }
}
