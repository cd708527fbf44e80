//! Undo and redo of parameter changes, and of moves of the camera. The simulated time is not undone, because it runs by
//! itself.

use super::App;
use crate::state::Params;
use crate::state::rounding::with_rounded_pose;
use egui::util::undoer::{Settings, Undoer};

/// Largest number of undo steps that are kept.
const MAX_UNDO_STEPS: usize = 200;
/// Time for which a changed parameter must stay constant before the change becomes an undo step, s.
const UNDO_STEP_DELAY_S: f32 = 0.4;

/// The undo history: the parameters after each step, without the simulated time.
pub struct History(Undoer<Params>);

impl Default for History {
    fn default() -> Self {
        // The undoer's list holds the current state in addition to the undo steps.
        let max_undos = MAX_UNDO_STEPS + 1;
        Self(Undoer::with_settings(Settings {
            max_undos,
            stable_time: UNDO_STEP_DELAY_S,
            auto_save_interval: f32::INFINITY,
        }))
    }
}

impl History {
    /// Records the parameters of the frame at time `now_s`, s on egui's clock. While a pointer button is down (`held`)
    /// it records nothing, so a drag becomes one undo step.
    pub fn note_params(&mut self, params: &Params, held: bool, now_s: f64) {
        if !held {
            self.0.feed_state(now_s, &recorded_params(params));
        }
    }

    /// Whether a recent change has not become an undo step yet. Another frame is then needed to complete it.
    pub fn has_uncommitted_change(&self) -> bool {
        self.0.is_in_flux()
    }

    /// Makes an undo step of the changes since the last one at once, without waiting until they have been constant for
    /// `UNDO_STEP_DELAY_S`.
    pub fn commit(&mut self, params: &Params) {
        let now = self.feed_undoer(params);
        self.0.add_undo(&now);
    }

    /// Whether there is a step to undo, and whether there is a step to redo, in this order. `params` are the current
    /// ones.
    pub fn can_undo_redo(&self, params: &Params) -> (bool, bool) {
        let now = recorded_params(params);
        (self.0.has_undo(&now), self.0.has_redo(&now))
    }

    /// Undoes one step: sets all parameters but the time to their values before it. Changes nothing if no step
    /// is left.
    pub fn undo(&mut self, params: &mut Params) {
        let now = self.feed_undoer(params);
        restore_recorded_params(params, self.0.undo(&now));
    }

    /// Redoes one step: sets all parameters but the time to their values before the last undo. Changes nothing
    /// if nothing was undone.
    pub fn redo(&mut self, params: &mut Params) {
        let now = self.feed_undoer(params);
        restore_recorded_params(params, self.0.redo(&now));
    }

    /// Records the current parameters, which may have changed since the last frame. A change discards all redo steps.
    /// Returns the parameters as recorded: with the default time.
    fn feed_undoer(&mut self, params: &Params) -> Params {
        let now = recorded_params(params);
        self.0.feed_state(f64::NEG_INFINITY, &now);
        now
    }
}

impl App {
    /// Passes the parameters of this frame to the undo history, and requests another frame while a change waits to
    /// become an undo step.
    pub(super) fn watch_history(&mut self, ctx: &egui::Context) {
        let (held, now_s) = ctx.input(|i| (i.pointer.any_down(), i.time));
        self.history.note_params(&self.params, held, now_s);
        if self.history.has_uncommitted_change() {
            ctx.request_repaint();
        }
    }
}

/// Sets all parameters to those of `to`, except the simulated time, which stays as it is. `None` (nothing to undo or
/// redo) changes nothing. A camera that is recorded as it is keeps the digits that the rounding leaves out.
fn restore_recorded_params(params: &mut Params, to: Option<&Params>) {
    if let Some(to) = to {
        let is_at_rest = with_rounded_pose(params).camera == to.camera;
        let camera = if is_at_rest { &params.camera } else { &to.camera };
        *params = Params { clock: params.clock.clone(), camera: camera.clone(), ..to.clone() };
    }
}

/// Copy of the parameters as the history records them: with the default time, because undo and redo leave the current one
/// as it is. The camera is rounded as in a link, because the app rounds it, too, once the user lets it rest.
fn recorded_params(params: &Params) -> Params {
    let Params { clock, .. } = Params::default();
    Params { clock, ..with_rounded_pose(params) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::fields::{FIELDS, FieldKind, Group};
    use crate::waves::noise::pcg4d;

    fn with_wind(wind_m_s: f64) -> Params {
        let mut p = Params::default();
        p.sea.systems[0].wind_m_s = wind_m_s;
        p
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::default();
        history.note_params(&with_wind(12.0), false, 0.0);
        for i in 1..=20 {
            history.note_params(&with_wind(12.0 + 0.1 * f64::from(i)), true, 0.1 * f64::from(i));
        }
        history.note_params(&with_wind(14.0), false, 3.0);
        let mut p = with_wind(14.0);
        p.clock.t_s = 77.0;
        history.undo(&mut p);
        assert_eq!((p.sea.first_system().wind_m_s, p.clock.t_s), (12.0, 77.0));
        assert_eq!(history.can_undo_redo(&p), (false, true));
        history.redo(&mut p);
        assert_eq!((p.sea.first_system().wind_m_s, history.can_undo_redo(&p)), (14.0, (true, false)));
    }

    #[test]
    fn a_drag_of_the_camera_is_one_step_and_keeps_the_digits_of_a_link() {
        let looking = |heading_deg: f64, wind_m_s: f64| {
            let mut p = with_wind(wind_m_s);
            (p.camera.heading_deg, p.camera.y_m) = (heading_deg, 3.217);
            p
        };
        let mut history = History::default();
        history.note_params(&looking(40.0, 12.0), false, 0.0);
        for i in 1..=20 {
            history.note_params(&looking(40.0 + f64::from(i), 12.0), true, 0.1 * f64::from(i));
        }
        for now_s in [3.0, 4.0] {
            history.note_params(&looking(60.0, 12.0), false, now_s);
        }
        for now_s in [5.0, 6.0] {
            history.note_params(&looking(60.0, 20.0), false, now_s);
        }
        let mut p = looking(60.0, 20.0);
        history.undo(&mut p);
        assert_eq!(p, looking(60.0, 12.0), "the wind, while the camera keeps all of its digits");
        history.undo(&mut p);
        assert_eq!((p.camera.heading_deg, history.can_undo_redo(&p)), (40.0, (false, true)));
        history.redo(&mut p);
        assert_eq!(p.camera.heading_deg, 60.0);
    }

    #[test]
    fn what_is_undone_at_once_is_not_lost() {
        let mut history = History::default();
        history.note_params(&with_wind(12.0), false, 0.0);
        history.note_params(&with_wind(20.0), true, 0.1);
        let mut p = with_wind(20.0);
        history.undo(&mut p);
        assert_eq!(p.sea.first_system().wind_m_s, 12.0);
        history.redo(&mut p);
        assert_eq!(p.sea.first_system().wind_m_s, 20.0);
        history.undo(&mut p);
        history.note_params(&with_wind(5.0), false, 1.0);
        history.note_params(&with_wind(5.0), false, 2.0);
        assert_eq!(history.can_undo_redo(&p), (true, false), "another change leaves nothing to redo");
    }

    /// Changes one parameter after the other, undoes all changes, then redoes them. Each step restores the exact
    /// values.
    #[test]
    fn every_value_is_undone_and_redone() {
        let mut history = History::default();
        let mut now_s = 0.0;
        let mut rest = |history: &mut History, p: &Params| {
            for _ in 0..2 {
                now_s += 1.0;
                history.note_params(p, false, now_s);
            }
        };
        let mut steps = vec![Params::default()];
        rest(&mut history, &steps[0]);
        let fields = || FIELDS.iter().filter(|f| f.group != Group::Clock);
        for (i, field) in (0..).zip(fields()) {
            let mut p = steps[steps.len() - 1].clone();
            let value = match field.kind {
                FieldKind::Number { min, max, .. } => {
                    min + (max - min) * f64::from(pcg4d([i, 9, 9, 9])[0]) / f64::from(u32::MAX)
                }
                FieldKind::Integer { min, max } => f64::from(min + pcg4d([i, 9, 9, 9])[0] % (max - min).max(1)),
                FieldKind::Choice(words) => words.len() as f64 - 1.0,
                FieldKind::Heading => 217.3,
                FieldKind::Flag => 1.0 - (field.get)(&p),
                FieldKind::Colour => f64::from(0x0012_3456),
            };
            (field.set)(&mut p, value);
            p.camera = with_rounded_pose(&p).camera;
            if p != steps[steps.len() - 1] {
                rest(&mut history, &p);
                steps.push(p);
            }
        }
        let kept = steps.len().min(MAX_UNDO_STEPS + 1);
        assert!(steps.len() > 100, "{}", steps.len());
        let mut p = steps[steps.len() - 1].clone();
        for want in steps.iter().rev().take(kept).skip(1) {
            history.undo(&mut p);
            assert_eq!(&p, want);
        }
        assert!(!history.can_undo_redo(&p).0);
        for want in steps.iter().rev().take(kept - 1).rev() {
            history.redo(&mut p);
            assert_eq!(&p, want);
        }
        assert!(!history.can_undo_redo(&p).1);
    }
}
