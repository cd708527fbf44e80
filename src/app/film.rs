//! Films: the page records its canvas while the sea moves for some seconds, without the panel (web/film.js). The desktop
//! window shows the command that draws the frames of a film.

use super::App;
#[cfg(not(target_arch = "wasm32"))]
use crate::app::language::tr;

/// Longest film, s of simulated time at the sea's own speed.
pub const MAX_FILM_S: f64 = 600.0;
/// Length of a film of a sea that never repeats, s.
const USUAL_FILM_S: f64 = 10.0;
/// Frames a second of a film that the command line draws.
#[cfg(not(target_arch = "wasm32"))]
const FRAMES_PER_S: f64 = 30.0;

/// A film that is being recorded.
#[cfg(target_arch = "wasm32")]
pub struct Film {
    /// Simulated time at which the film ends, s.
    end_t_s: f64,
}

impl App {
    /// Length of a film, s: one period of a sea that repeats (parameter `loop`), so that its end fits its beginning;
    /// else the length that the user has chosen.
    pub(super) fn film_length_s(&self) -> f64 {
        let period_s = self.params.sea.repeat_period_s;
        if period_s > 0.0 { period_s } else { self.panel.film_s.unwrap_or(USUAL_FILM_S) }
    }

    /// Whether a film is being recorded. Nothing is drawn over the sea meanwhile.
    pub(super) fn is_filming(&self) -> bool {
        #[cfg(target_arch = "wasm32")]
        return self.film.is_some();
        #[cfg(not(target_arch = "wasm32"))]
        false
    }

    /// The command that draws the frames of a film of this sea.
    #[cfg(not(target_arch = "wasm32"))]
    fn film_command(&self) -> String {
        let frames = (FRAMES_PER_S * self.film_length_s()).round();
        let state = self.state();
        format!("seastate render \"{state}\" --frames {frames:.0} --fps {FRAMES_PER_S:.0} --output frames")
    }

    /// Copies the command that draws the frames of a film of this sea.
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn copy_film_command(&mut self) {
        self.ctx.copy_text(self.film_command());
        self.show_brief_message(tr("Command copied: paste it into a terminal."));
    }

    /// Begins a film: the time runs, and the page records until it has advanced by the film's length.
    #[cfg(target_arch = "wasm32")]
    pub(super) fn begin_film(&mut self) {
        self.params.clock.paused = false;
        self.visitor.slow_camera.stop();
        let length_s = self.film_length_s().min(MAX_FILM_S);
        self.film = Some(Film { end_t_s: self.params.clock.t_s + length_s * self.params.clock.speed });
        super::web_page::tell_page("seastate-film-start");
    }

    /// Ends the film that is being recorded once its time is over, or at once if the user has stopped the time.
    #[cfg(target_arch = "wasm32")]
    pub(super) fn advance_film(&mut self) {
        let Some(film) = &self.film else { return };
        let clock = &self.params.clock;
        if clock.t_s >= film.end_t_s || clock.paused {
            self.film = None;
            super::web_page::tell_page("seastate-film-stop");
        }
    }
}
