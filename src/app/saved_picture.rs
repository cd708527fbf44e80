//! Saved pictures: PNG files of the chosen size, in full quality however slow the machine is, that carry their sea.

use super::picture_caption::PictureCaption;
use super::{App, storage, tasks};
use crate::app::language::tr;
use crate::files::picture;
use crate::gpu::offscreen::PendingPicture;
use crate::ocean::Ocean;
use crate::state::{Params, query, rounding::with_rounded_pose};

/// Number of frames of the job before its picture is taken: egui may lay out one frame twice, and only painting records
/// the sea.
const LEAST_FRAMES: u32 = 2;

/// Size of a saved picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureSize {
    /// All pixels of the window or of the page.
    #[default]
    AsShown,
    /// 1920 x 1080 pixels.
    FullHd,
    /// 3840 x 2160 pixels.
    UltraHd,
}

impl PictureSize {
    /// All sizes.
    pub const ALL: [Self; 3] = [Self::AsShown, Self::FullHd, Self::UltraHd];

    /// Text of the size in the panel.
    pub fn label(self) -> &'static str {
        match self {
            Self::AsShown => tr("As shown here"),
            Self::FullHd => "1920 x 1080",
            Self::UltraHd => "3840 x 2160",
        }
    }

    /// Width and height, pixels; `None` for those of the window.
    fn pixels(self) -> Option<[u32; 2]> {
        match self {
            Self::AsShown => None,
            Self::FullHd => Some([1920, 1080]),
            Self::UltraHd => Some([3840, 2160]),
        }
    }
}

/// How pictures are saved, as chosen in the panel.
#[derive(Clone, Copy, Debug, Default)]
pub struct PictureChoice {
    /// Size of the picture.
    pub size: PictureSize,
    /// Whether the sea in words stands at the lower edge.
    pub has_caption: bool,
}

/// A picture that is being drawn to be saved. Meanwhile time stands still, and each frame has the picture's size and
/// full quality, until foam and waves are complete.
pub struct PictureJob {
    /// Width and height, pixels; `None` for those of the window.
    pub size: Option<[u32; 2]>,
    /// Frames that were laid out for this picture.
    frames: u32,
}

impl App {
    /// Saves a picture of the sea as a PNG that contains its state string. A machine that draws less than the whole
    /// picture in each frame draws it whole first. The result arrives later in `save_results`.
    pub(super) fn save_picture(&mut self) {
        let size = self.panel.picture.size.pixels();
        let is_as_in_state = self.drawn_is_whole && self.visitor.slow_camera.is_at_rest();
        if size.is_none() && is_as_in_state && !self.progress.wants_frame() {
            self.take_picture();
            return;
        }
        self.picture_job = Some(PictureJob { size, frames: 0 });
    }

    /// Whether the sea stands still: the user has stopped the time, or a picture is being drawn to be saved.
    pub(super) fn stands_still(&self) -> bool {
        self.params.clock.paused || self.picture_job.is_some()
    }

    /// Takes the picture that is being drawn, once it is complete. Each frame calls this before it changes anything.
    pub(super) fn advance_picture_job(&mut self) {
        let is_drawn = !self.progress.wants_frame() && self.is_coast_shown();
        let Some(job) = &mut self.picture_job else { return };
        if job.frames >= LEAST_FRAMES && is_drawn {
            self.picture_job = None;
            self.take_picture();
        } else {
            job.frames += 1;
            self.ctx.request_repaint();
        }
    }

    /// Reads the picture of the last frame back from the GPU and saves it.
    fn take_picture(&mut self) {
        let Some((params, size)) = self.drawn.clone() else { return };
        let params = with_rounded_pose(&params);
        let (state, link) = (query::write_to_keep(&params), self.link());
        let caption =
            self.panel.picture.has_caption.then(|| PictureCaption::new(&self.ctx, &self.sea_in_words(), size));
        let gpu = self.gpu();
        let format = self.render_state.target_format;
        let encoder = gpu.encoder("screenshot");
        let made = {
            let renderer = self.render_state.renderer.read();
            let Some(ocean) = renderer.callback_resources.get::<Ocean>() else { return };
            PendingPicture::submit(&gpu, encoder, format, size, |pass| ocean.present(pass))
        };
        let (inbox, ctx, name) = (self.save_results.clone(), self.ctx.clone(), picture_name(&params));
        let folder = self.save_folder.clone();
        tasks::spawn(async move {
            let made = made.read(&gpu).await.and_then(|mut pixels| {
                if let Some(caption) = caption {
                    caption.draw(&mut pixels, size);
                }
                picture::encode(size, &pixels, &state, &link)
            });
            inbox.put(made.and_then(|png| storage::save(folder.as_deref(), &name, &png)), &ctx);
        });
    }
}

/// File name of a saved picture, with wind speed (m/s) and time (s), such as `seastate-wind14-t40.png`.
fn picture_name(params: &Params) -> String {
    let wind_m_s = (10.0 * params.sea.first_system().wind_m_s).round() / 10.0;
    format!("seastate-wind{wind_m_s}-t{:.0}.png", params.clock.t_s)
}
