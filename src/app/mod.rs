//! The eframe app that runs as a web page and as a desktop window. Only this module uses egui and browser functions.

mod accessible_names;
mod camera;
mod caption;
mod clock;
mod coast;
mod coast_maps;
mod derived;
pub mod device_loss;
mod film;
mod first_steps;
mod gpu_errors;
mod history;
mod icons;
pub mod keys;
pub mod language;
mod measurements;
mod message;
mod mini;
mod mooring;
#[cfg(not(target_arch = "wasm32"))]
pub mod native;
mod notices;
mod opened_files;
mod panel;
mod picture_caption;
mod plots;
mod quality;
mod report;
mod safe_area;
mod saved_picture;
#[cfg(target_arch = "wasm32")]
mod screen_readers;
pub mod setup;
mod share;
mod slow_camera;
mod storage;
mod tasks;
mod text_size;
mod thumbnails;
mod tilt;
mod units;
mod viewport;
mod visitor;
#[cfg(target_arch = "wasm32")]
pub mod web;
#[cfg(target_arch = "wasm32")]
mod web_page;
#[cfg(target_arch = "wasm32")]
mod web_phone;

use crate::gpu::Gpu;
use crate::point::buoy_record::BuoyRecord;
use crate::state::look::SkyFile;
use crate::state::params::{Interface, Screen};
use crate::state::{Params, floats, query, rounding};
use crate::waves::SeaChange;
use derived::DerivedSeaData;
use gpu_errors::GpuErrors;
use quality::FrameTimes;
pub use safe_area::SafeArea;

const NO_WGPU_MESSAGE: &str = "eframe was started without wgpu";

/// The app: parameters of the sea, GPU device, and state of the user interface.
pub struct App {
    params: Params,
    /// Messages about parts of a state string or of a file that could not be used. The panel shows them.
    notices: Vec<String>,
    /// Sentences about the file that was opened last, such as name and size. The panel shows them in a neutral colour.
    news: Vec<String>,
    /// Whether the next frame makes the foam anew, because another sea was opened: that of the old one does not fit.
    restarts_foam: bool,
    derived: DerivedSeaData,
    render_state: egui_wgpu::RenderState,
    ctx: egui::Context,
    gpu_errors: GpuErrors,
    frames: u64,
    /// Files that stand for the user's choice in the system's dialog, which is then not opened.
    #[cfg(not(target_arch = "wasm32"))]
    chosen_files: Option<Vec<std::path::PathBuf>>,
    /// Contents of files that the user opens. They arrive when reading has finished.
    opened_files: tasks::Inbox<opened_files::OpenedFiles>,
    panel: panel::Panel,
    own_seas: panel::OwnSeas,
    history: history::History,
    quality: quality::AdaptiveQuality,
    languages: language::Languages,
    thumbnails: thumbnails::Thumbnails,
    visitor: visitor::Visitor,
    /// Whether the help window with the keyboard shortcuts is open.
    help_is_open: bool,
    /// Factor on egui's text and controls that was set last.
    text_size: f32,
    message: Option<message::Message>,
    /// Camera, with the time of a stopped clock, as last rounded to a link's digits; rounded again after a change.
    rounded_pose: Option<rounding::CameraAndPausedTime>,
    /// Parameters of the last drawn picture, and its width and height in pixels; `None` before the first one.
    drawn: Option<(Params, [u32; 2])>,
    /// Whether the last drawn picture had all its pixels, waves and light, and not less, to keep up.
    drawn_is_whole: bool,
    /// The picture that is being drawn to be saved.
    picture_job: Option<saved_picture::PictureJob>,
    /// The film that is being recorded.
    #[cfg(target_arch = "wasm32")]
    film: Option<film::Film>,
    /// Record of the height of the sea, m above still water, at the first floating object, else below the camera.
    record: BuoyRecord,
    /// Kind of floating object that the next click on the sea places; `None` if a click places nothing.
    placing: Option<floats::FloatingObjectKind>,
    coast: coast::AppCoast,
    save_folder: Option<std::path::PathBuf>,
    /// Results of attempts to save a file: a message for the user with the path, or the reason for the failure.
    save_results: tasks::Inbox<Result<String, String>>,
    /// The sky image file that was read last. It is used again when an opened link names the same file.
    sky: Option<SkyFile>,
    progress: viewport::DrawingProgress,
    safe_area: SafeArea,
    tilt: tilt::Tilt,
    frame_measurements: measurements::FrameMeasurements,
    sea_measurement: measurements::SeaMeasurement,
    visible_readouts: measurements::VisibleReadouts,
    /// User-agent string of the browser, for the bug report.
    #[cfg(target_arch = "wasm32")]
    browser: String,
    #[cfg(target_arch = "wasm32")]
    address: web::Address,
    #[cfg(target_arch = "wasm32")]
    screen_readers: screen_readers::ScreenReaders,
}

impl App {
    /// Creates the app from a state string or from a URL that contains one.
    ///
    /// # Errors
    /// If eframe was started without a wgpu device.
    pub fn new(cc: &eframe::CreationContext<'_>, state: &str) -> Result<Self, String> {
        Self::with_sky(cc, state, None)
    }

    /// Creates the app from a state string. `sky` is the image file that the state string names for the sky, if the
    /// caller has read it.
    ///
    /// # Errors
    /// If eframe was started without a wgpu device.
    pub fn with_sky(cc: &eframe::CreationContext<'_>, state: &str, sky: Option<SkyFile>) -> Result<Self, String> {
        let render_state = cc.wgpu_render_state.clone().ok_or(NO_WGPU_MESSAGE)?;
        let (mut params, notices) = query::parse(state);
        params.look.sky.adopt_loaded_image(sky.as_ref());
        let own_seas = panel::OwnSeas::load();
        let quality =
            quality::AdaptiveQuality::for_adapter(render_state.adapter.get_info().device_type, params.clock.paused);
        let grid = quality.reduced_grid(&params.grid, &params.screen);
        let gpu_errors = device_loss::create_ocean(&render_state, &Params { grid, ..params.clone() });
        setup::apply_style(&cc.egui_ctx);
        #[cfg(target_arch = "wasm32")]
        let screen_readers = screen_readers::ScreenReaders::default();
        #[cfg(target_arch = "wasm32")]
        cc.egui_ctx.add_plugin(screen_readers.clone());
        Ok(Self {
            derived: DerivedSeaData::new(&params),
            notices: [notices, own_seas.notices()].concat(),
            news: Vec::new(),
            restarts_foam: false,
            render_state,
            ctx: cc.egui_ctx.clone(),
            gpu_errors,
            frames: 0,
            #[cfg(not(target_arch = "wasm32"))]
            chosen_files: None,
            opened_files: tasks::Inbox::default(),
            panel: panel::Panel::default(),
            own_seas,
            history: history::History::default(),
            quality,
            languages: language::Languages::default(),
            thumbnails: thumbnails::Thumbnails::default(),
            visitor: visitor::Visitor::default(),
            help_is_open: false,
            text_size: 1.0,
            message: None,
            drawn: None,
            drawn_is_whole: false,
            picture_job: None,
            #[cfg(target_arch = "wasm32")]
            film: None,
            rounded_pose: Some(rounding::camera_pose(&params)),
            record: BuoyRecord::default(),
            placing: None,
            coast: coast::AppCoast::default(),
            save_folder: None,
            save_results: tasks::Inbox::default(),
            sky: sky.filter(|s| s.image.is_some()),
            progress: viewport::DrawingProgress::default(),
            safe_area: SafeArea::default(),
            tilt: tilt::Tilt::default(),
            frame_measurements: measurements::FrameMeasurements::default(),
            sea_measurement: measurements::SeaMeasurement::default(),
            visible_readouts: measurements::VisibleReadouts::default(),
            #[cfg(target_arch = "wasm32")]
            browser: cc.integration_info.web_info.user_agent.clone(),
            #[cfg(target_arch = "wasm32")]
            address: web::Address::new(&params),
            #[cfg(target_arch = "wasm32")]
            screen_readers,
            params,
        })
    }

    /// The current parameters as a state string, with camera and time rounded as in a link.
    pub fn state(&self) -> String {
        query::write(&rounding::with_rounded_pose(&self.params))
    }

    /// Replaces all parameters by those of a state string. Keys that are missing there get their default values.
    pub fn set_state(&mut self, state: &str) {
        (self.params, self.notices) = query::parse(state);
        self.news.clear();
        self.restarts_foam = true;
        self.params.look.sky.adopt_loaded_image(self.sky.as_ref());
        self.rounded_pose = Some(rounding::camera_pose(&self.params));
        // A caller outside of a frame (JavaScript or a test) needs one, also while time is stopped.
        self.ctx.request_repaint();
    }

    /// Width and height of the last drawn picture in pixels; `[0, 0]` before the first one.
    pub fn picture_size(&self) -> [u32; 2] {
        self.drawn.as_ref().map_or([0; 2], |(_, size)| *size)
    }

    /// Sets the folder for saved files, instead of the user's pictures folder. The web page downloads files and ignores
    /// it.
    pub fn set_save_folder(&mut self, folder: std::path::PathBuf) {
        self.save_folder = Some(folder);
    }

    /// Number of frames that the app has laid out and painted since it was created, also while simulated time is
    /// stopped.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Whether the GPU has finished the first picture since the start or since the last device loss.
    pub fn has_first_picture(&self) -> bool {
        self.progress.has_first_picture()
    }

    /// Returns whether the picture is complete: the GPU has finished the first one since the start or the last device
    /// loss, the foam has reached the present, the waves near a coast are there, and no cross-fade is in progress. Also
    /// requests one more frame.
    pub fn is_picture_complete(&self) -> bool {
        self.ctx.request_repaint();
        self.is_coast_shown() && self.progress.has_first_picture() && !self.progress.is_replaying_foam_or_fading()
    }

    /// eframe's wgpu state, with the device and queue that the app draws with.
    pub fn render_state(&self) -> &egui_wgpu::RenderState {
        &self.render_state
    }

    fn gpu(&self) -> Gpu {
        Gpu { device: self.render_state.device.clone(), queue: self.render_state.queue.clone() }
    }

    /// If the parameters of the sea or the FFT grid have changed, recomputes the plan, the statistics and the plot
    /// data, and discards what was measured in the old sea.
    fn update_derived_sea_data(&mut self) {
        let Some(change) = self.derived.update(&self.params) else { return };
        if change > SeaChange::Foam {
            self.record.clear();
            self.coast.maps.clear_records();
        }
        self.discard_measurements();
    }

    /// Brings everything but the picture up to this frame: input, time, files, history, measurements, the governor.
    fn advance(&mut self, ctx: &egui::Context) {
        self.apply_text_size(ctx);
        self.forget_tilt_button();
        self.advance_picture_job();
        self.handle_keys(ctx);
        self.advance_time(ctx);
        self.advance_slow_camera(ctx);
        #[cfg(target_arch = "wasm32")]
        self.advance_film();
        self.take_opened_files(ctx);
        self.take_save_results();
        self.watch_history(ctx);
        self.update_derived_sea_data();
        self.extend_height_record();
        self.advance_sea_measurement(ctx);
        let interval_s = f64::from(ctx.input(|i| i.unstable_dt));
        if self.progress.is_first_picture_pending() {
            self.quality.note_idle_frame(interval_s);
        } else {
            let times = FrameTimes {
                interval_s,
                gpu: self.frame_measurements.take_gpu_time(),
                time_is_stopped: self.stands_still(),
                has_extra_work: self.progress.is_replaying_foam_or_fading()
                    || self.panel.sheet.is_moving()
                    || self.coast.slows_frames(),
            };
            self.quality.adapt(times, &self.params.screen);
        }
    }

    /// Copy of the current parameters, with the FFT size and the light that adaptive quality allows, and with the slow
    /// camera; the frame is drawn with it.
    fn params_to_draw(&self) -> Params {
        let grid = self.quality.reduced_grid(&self.params.grid, &self.params.screen);
        let screen = Screen { detail: self.quality.detail(&self.params.screen), ..self.params.screen.clone() };
        let mut params = Params { grid, screen, ..self.params.clone() };
        // A saved picture has the camera of its state.
        if self.picture_job.is_none() {
            self.visitor.slow_camera.apply(&mut params.camera);
        }
        params
    }
}

impl eframe::App for App {
    fn raw_input_hook(&mut self, _ctx: &egui::Context, input: &mut egui::RawInput) {
        self.add_safe_area(input);
    }

    fn logic(&mut self, _ctx: &egui::Context, _frame: &mut eframe::Frame) {
        #[cfg(target_arch = "wasm32")]
        {
            self.sync_address_and_state();
            self.write_tab_title();
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if self.gpu_errors.lost().is_some() {
            // egui-wgpu panics when it paints with a lost device; the host restarts the app on another device.
            return;
        }
        if let Err(reason) = self.languages.update(self.params.screen.language, &ctx) {
            self.notices.push(reason);
        }
        self.advance(&ctx);
        let interface = if self.is_filming() { Interface::None } else { self.params.screen.interface };
        if interface == Interface::Panel {
            panel::show_bottom_sheet(self, ui);
        }
        self.adopt_coast_file();
        let params = self.params_to_draw();
        self.follow_coast(&params, &ctx);
        let limit = self.render_state.device.limits().max_texture_dimension_2d;
        let is_adaptive = self.params.screen.adaptive && !self.stands_still();
        let kind = viewport::FrameKind {
            quality_level: is_adaptive.then(|| self.quality.level()),
            restarts_foam: std::mem::take(&mut self.restarts_foam),
            is_saved: self.picture_job.is_some(),
        };
        // The number of pixels does not depend on the size of the text.
        let (zoom, density) = (ctx.zoom_factor(), ctx.native_pixels_per_point().unwrap_or(1.0));
        let asked = self.picture_job.as_ref().and_then(|job| job.size);
        let pixels = |points: egui::Vec2| {
            let usual = || self.quality.picture_size(points * zoom, density, &params.screen, limit);
            asked.map_or_else(usual, |size| size.map(|side| side.min(limit)))
        };
        // Clicks on the sea are sensed only while an object is to be placed: with them, egui would take a finger that
        // rests before it drags for a long press.
        let sense = if self.placing.is_some() { egui::Sense::click_and_drag() } else { egui::Sense::drag() };
        let (sea, measured) = ((&params, self.coast.shown()), (&self.progress, &self.frame_measurements));
        let (response, size) = viewport::show_sea(ui, sea, measured, sense, kind, pixels);
        // A saved picture remembers the user's choices, not what this machine can draw at this moment.
        self.drawn = Some((self.params.clone(), size));
        self.drawn_is_whole = self.quality.is_full(&self.params.screen);
        self.visitor.pointer_is_off_sea = ctx.pointer_hover_pos().is_some() && !response.contains_pointer();
        self.place_floating_object(&response, &ctx);
        camera::apply_pointer_to_camera(&mut self.params.camera, &response, &ctx);
        self.panel.sea = Some(response.rect);
        self.show_view_caption(interface == Interface::Panel, &ctx);
        match interface {
            Interface::None => {}
            Interface::Panel => {
                panel::show_panel(self, &ctx);
                panel::show_summary(self, &ctx);
                self.show_first_steps(response.rect, &ctx);
            }
            Interface::Mini => mini::show_caption(self, &ctx),
        }
        keys::show_keyboard_help(&mut self.help_is_open, &ctx);
        if !self.is_filming() {
            self.draw_message(&ctx);
        }
        opened_files::show_drop_hint(&ctx);
        self.progress.request_wanted_frame(&ctx);
        self.round_pose_when_idle(&ctx);
        self.frames += 1;
    }
}
