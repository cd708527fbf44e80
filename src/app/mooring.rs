//! Places floating objects on the sea, where the user clicks or presses B.

use super::App;
use crate::app::language::tr;
use crate::state::camera::View;
use crate::state::floats::{self, FloatingObject};

/// Largest distance from the camera at which a floating object can be placed, m. Farther away it is too small to see.
const MAX_FLOATING_OBJECT_DISTANCE_M: f64 = 3000.0;
/// Number of iterations that find where a line of sight meets the waves. Each intersects the line with the horizontal
/// plane at the height of the water at the point found before.
const WATER_INTERSECTION_ITERATIONS: usize = 8;

impl App {
    /// Heights of the sea above the still water, m, at `places` (x and z of one point after the other, m) and the
    /// simulated time `t_s`, s, or the present, from the strongest waves.
    #[cfg(target_arch = "wasm32")]
    pub(super) fn heights_m(&self, places: &[f64], t_s: Option<f64>) -> Vec<f64> {
        let (sea, level_m) = (self.derived.strongest_waves(), self.params.sea.still_water_level_m);
        let t_s = t_s.unwrap_or(self.params.clock.t_s);
        places.chunks_exact(2).map(|place| sea.sample(place[0], place[1], t_s).height_m - level_m).collect()
    }

    /// Places a buoy at the pointer when B is pressed, or, after a choice in the panel, that object where the sea is
    /// clicked. A message says if there is no water or no room for more.
    pub(super) fn place_floating_object(&mut self, response: &egui::Response, ctx: &egui::Context) {
        if self.placing.is_some() && response.hovered() {
            ctx.set_cursor_icon(egui::CursorIcon::Crosshair);
        }
        let key = !ctx.egui_wants_keyboard_input() && ctx.input(|i| i.key_pressed(egui::Key::B));
        let (kind, at) = match (response.clicked().then_some(self.placing).flatten(), key) {
            (Some(kind), _) => (kind, response.interact_pointer_pos()),
            (None, true) => (floats::FloatingObjectKind::Buoy, response.hover_pos().or(Some(response.rect.center()))),
            (None, false) => return,
        };
        self.placing = None;
        let Some(at) = at else { return };
        let Some([x_m, z_m]) = self.water_position_at(at, response.rect) else {
            self.show_brief_message(tr("There is no water there."));
            return;
        };
        if self.params.floating_objects.len() >= floats::MAX_FLOATING_OBJECTS {
            self.show_brief_message(tr("There is no room for more."));
            return;
        }
        let round = |x: f64| (10.0 * x).round() / 10.0;
        self.params.floating_objects.push(FloatingObject { kind, x_m: round(x_m), z_m: round(z_m) });
    }

    /// The position on the sea, m east and south, seen at the point `at` of the window; `rect` is the area that shows
    /// the sea. `None` if there is no water, if it is farther than [`MAX_FLOATING_OBJECT_DISTANCE_M`], or if
    /// the camera dives.
    fn water_position_at(&self, at: egui::Pos2, rect: egui::Rect) -> Option<[f64; 2]> {
        let camera = &self.params_to_draw().camera;
        if camera.dive_m > 0.0 {
            return None;
        }
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        let view = View::new(camera, aspect, 0.0);
        let to = (at - rect.center()) / (0.5 * rect.size());
        let ray = view.ray(f64::from(to.x), -f64::from(to.y));
        let mut height_m = self.params.sea.still_water_level_m;
        let mut place = None;
        for _ in 0..WATER_INTERSECTION_ITERATIONS {
            let distance = (height_m - camera.y_m) / ray.y;
            if !(ray.y < -1e-3 && distance < MAX_FLOATING_OBJECT_DISTANCE_M) {
                return place;
            }
            let [x, z] = [camera.x_m + distance * ray.x, camera.z_m + distance * ray.z];
            height_m =
                self.derived.strongest_waves().sample(x, z, self.params.clock.t_s).height_m.min(camera.y_m - 0.3);
            place = Some([x, z]);
        }
        place
    }
}
