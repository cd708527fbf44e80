//! The coast of the app: chosen in the panel, opened from a file, and solved beside the running sea.

use super::App;
use super::coast_maps::CoastMaps;
use super::message::PlaceBefore;
use crate::app::language::{say, text, tr};
use crate::coast::placed::PlacedCoast;
use crate::coast::transfer::TransferSolver;
use crate::files::bathymetry::{self, ReadAs};
use crate::ocean::coast_task::{CoastTask, ShownCoast, Worker};
use crate::state::Params;
use crate::state::coast::{Coast, CoastFile, CoastName};
use crate::state::params::Camera;

/// Least time for work on the coast in each frame, s, and the share of the time since the last frame that it may take:
/// while a slow GPU draws, the processor has time. The rest is left for the frame itself.
const LEAST_SLICE_S: f32 = 0.005;
const SLICE_SHARE: f32 = 0.25;
/// Longest work in a frame, s: a page that is slow by itself still answers a click soon.
const MOST_SLICE_S: f32 = 0.4;
/// Interval at which the progress of the solution is shown, while nothing else asks for frames.
#[cfg(not(target_arch = "wasm32"))]
const SHOWN_EVERY: std::time::Duration = std::time::Duration::from_millis(100);
/// Height of the eye before a shore, m, and pitch of the view, degrees.
const SHORE_VIEW: (f64, f64) = (6.0, -3.0);
/// Difference of the depth of the sea from that of the coast's seaward edge that is worth a notice, as a ratio.
const DEPTH_TOLERANCE: f64 = 0.05;

/// The coasts that come with the program, each with its name in the panel.
pub const COAST_NAMES: [(CoastName, &str); 8] = [
    (CoastName::None, text!("Open sea")),
    (CoastName::Beach, text!("Straight beach")),
    (CoastName::Headland, text!("Headland and bay")),
    (CoastName::Island, text!("Island with a lee")),
    (CoastName::Harbour, text!("Harbour with breakwaters")),
    (CoastName::Bar, text!("Bar and channel")),
    (CoastName::Shoal, text!("Elliptic shoal")),
    (CoastName::File, text!("From a file")),
];

/// The coast of the app, with the file that was opened last.
pub struct AppCoast {
    task: CoastTask<TransferSolver>,
    /// The bathymetry that was opened last. It is used again when an opened link's coast is a file.
    file: Option<CoastFile>,
    /// Maps of the sea near the coast, and gauges.
    pub maps: CoastMaps,
}

impl Default for AppCoast {
    fn default() -> Self {
        #[cfg(target_arch = "wasm32")]
        let worker = Worker::EachCall;
        #[cfg(not(target_arch = "wasm32"))]
        let worker = Worker::Thread;
        Self { task: CoastTask::new(worker), file: None, maps: CoastMaps::default() }
    }
}

impl AppCoast {
    /// The land and the waves that the next frame shows.
    pub fn shown(&self) -> ShownCoast {
        (self.task.land().cloned(), self.task.transfer().cloned())
    }

    /// Whether frames take longer because the page solves the coast in them, or its maps are computed.
    pub fn slows_frames(&self) -> bool {
        cfg!(target_arch = "wasm32") && self.task.progress().is_some() || self.maps.progress().is_some()
    }
}

/// Time for which this frame works on the coast.
pub fn work_slice(ctx: &egui::Context) -> web_time::Duration {
    let slice_s = SLICE_SHARE * ctx.input(|i| i.unstable_dt);
    web_time::Duration::from_secs_f32(slice_s.clamp(LEAST_SLICE_S, MOST_SLICE_S))
}

impl App {
    /// Gives a coast that is a file the one that was opened last, if it has none.
    pub(super) fn adopt_coast_file(&mut self) {
        self.params.coast.adopt_file(self.coast.file.as_ref());
    }

    /// Places the coast of the parameters `drawn`, with which the next frame is drawn, and solves its waves.
    pub(super) fn follow_coast(&mut self, drawn: &Params, ctx: &egui::Context) {
        let slice = work_slice(ctx);
        self.coast.task.update(drawn, ctx.input(|i| i.time), slice);
        self.derived.set_transfer(self.coast.task.transfer());
        if self.coast.task.is_busy(drawn) {
            #[cfg(target_arch = "wasm32")]
            ctx.request_repaint();
            #[cfg(not(target_arch = "wasm32"))]
            ctx.request_repaint_after(SHOWN_EVERY);
        }
        self.advance_coast_maps(ctx);
    }

    /// How far the solution of the coast is, in words; `None` if nothing is being solved.
    pub(super) fn coast_progress(&self) -> Option<String> {
        let percent = (100.0 * self.coast.task.progress()?).floor();
        Some(say!("Waves find their way ashore: {percent} %", percent = percent))
    }

    /// Notices about the coast, in English.
    pub(super) fn coast_notices(&self) -> Vec<String> {
        let mut notices = self.coast.task.notices();
        if let Some(edge_m) = self.unlike_depth_m() {
            notices.push(format!(
                "the sea is {} m deep, and the coast begins in {edge_m} m: the waves jump where they meet",
                self.params.sea.depth_m
            ));
        }
        notices
    }

    /// Depth of the seaward edge of the coast, rounded to decimetres, if that of the sea is another one.
    pub(super) fn unlike_depth_m(&self) -> Option<f64> {
        let edge_m = rounded_depth_m(self.coast.task.land()?);
        let ratio = self.params.sea.depth_m / edge_m;
        (!(1.0 - DEPTH_TOLERANCE..1.0 + DEPTH_TOLERANCE).contains(&ratio)).then_some(edge_m)
    }

    /// Gives the sea the coast `name`, the depth of its seaward edge, and a camera before its shore. If the coast is a
    /// file and none was opened yet, lets the user choose one; until then all stays as it is.
    pub(super) fn choose_coast(&mut self, name: CoastName) {
        if name == CoastName::File && self.coast.file.is_none() {
            self.choose_files();
            return;
        }
        let mut coast = Coast { name, ..Coast::default() };
        coast.adopt_file(self.coast.file.as_ref());
        match PlacedCoast::of_state(&coast, None) {
            Ok(land) => {
                let params = &self.params;
                let (coast_before, camera) = (params.coast.clone(), params.camera.clone());
                let before = PlaceBefore { coast: coast_before, depth_m: params.sea.depth_m, camera };
                self.go_to_coast(coast, land.as_ref());
                self.tell_coast(before);
            }
            Err(reason) => self.notices = vec![reason],
        }
    }

    /// Says what else has changed with the coast, and offers to take all of it back.
    fn tell_coast(&mut self, before: PlaceBefore) {
        let scale = self.length_scale();
        let depth = |m: f64| scale.format(m, usize::from(m < 100.0));
        let (depth_m, coast) = (self.params.sea.depth_m, self.coast_in_words());
        let (now, then) = (depth(depth_m), depth(before.depth_m));
        let text = match coast {
            Some(coast) if now != then => say!(
                "{coast}: the water is {now} deep instead of {then}, and you stand before the shore.",
                coast = coast,
                now = now,
                then = then
            ),
            Some(coast) => say!("{coast}: you stand before the shore.", coast = coast),
            None => say!("Open sea: the water is {now} deep.", now = now),
        };
        self.show_message_with_undo(text, before);
    }

    fn go_to_coast(&mut self, coast: Coast, land: Option<&PlacedCoast>) {
        self.params.coast = coast;
        self.restarts_foam = true;
        let Some(land) = land else {
            self.params.sea.depth_m = Params::default().sea.depth_m;
            return;
        };
        self.params.sea.depth_m = rounded_depth_m(land);
        let ([x_m, z_m], heading_deg) = land.shore_view();
        let (y_m, pitch_deg) = SHORE_VIEW;
        let [x_m, z_m, heading_deg] = [x_m, z_m, heading_deg].map(f64::round);
        let camera = &self.params.camera;
        self.params.camera =
            Camera { x_m, y_m, z_m, dive_m: 0.0, heading_deg, pitch_deg, fov_deg: camera.fov_deg, mode: camera.mode };
    }

    /// Makes the bathymetry in `bytes` the coast.
    ///
    /// # Errors
    /// One sentence, if it cannot be read, or has no open sea where waves could come from.
    pub(super) fn use_coast_file(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let file = CoastFile(std::sync::Arc::new(bathymetry::read(name, bytes, ReadAs::default())?));
        let coast = Coast { name: CoastName::File, file: Some(file.clone()), ..Coast::default() };
        let land = PlacedCoast::of_state(&coast, None)?;
        let about = land.as_ref().map(|land| land.about.clone()).unwrap_or_default();
        let (columns, rows) = (file.0.grid.columns, file.0.grid.rows);
        let details = format!("{}: {columns} x {rows}, {about}", file.0.name);
        self.tell_opened(&say!("{name} is the coast now.", name = file.0.name), details);
        self.notices.clear();
        self.coast.file = Some(file);
        self.go_to_coast(coast, land.as_ref());
        Ok(())
    }

    /// Whether the waves near the coast of the parameters are there, or the sea is open.
    pub fn is_coast_shown(&self) -> bool {
        !self.coast.task.is_busy(&self.params_to_draw())
    }

    /// The name of the coast in the language of the interface; `None` in the open sea.
    pub(super) fn coast_in_words(&self) -> Option<&'static str> {
        let coast = &self.params.coast;
        let (_, name) = COAST_NAMES.iter().find(|(name, _)| *name == coast.name).filter(|_| coast.is_on())?;
        Some(tr(name))
    }
}

/// Depth of the sea that fits a coast, m: that of its seaward edge, rounded to decimetres.
fn rounded_depth_m(land: &PlacedCoast) -> f64 {
    (10.0 * land.seaward_depth_m()).round() / 10.0
}
