//! Undo and redo of what was set. Time and camera move on by themselves and are left out of it.

use crate::state::Params;

/// Steps that are kept.
const MOST_STEPS: usize = 200;
/// A value that has not changed for this long is what the user meant, s.
const SETTLED_S: f64 = 0.4;

/// What was set before, and what was undone.
#[derive(Default)]
pub struct History {
    /// The last state that counts as a step.
    current: Option<Params>,
    /// The state at the last look, and since when.
    latest: Option<(Params, f64)>,
    undo: Vec<Params>,
    redo: Vec<Params>,
}

impl History {
    /// Looks at the parameters, once a frame at time `now_s`. A drag is one step: it counts when the value rests.
    pub fn watch(&mut self, params: &Params, held: bool, now_s: f64) {
        let key = key(params);
        match &mut self.latest {
            Some((latest, since)) if *latest != key => (*latest, *since) = (key, now_s),
            None => self.latest = Some((key, now_s)),
            Some(_) => {}
        }
        let Some((latest, since)) = &self.latest else { return };
        match &self.current {
            None => self.current = Some(latest.clone()),
            Some(current) if current != latest && !held && now_s - since >= SETTLED_S => self.commit(),
            Some(_) => {}
        }
    }

    /// Whether a change has not become a step yet: someone must look again.
    pub fn is_open(&self) -> bool {
        self.latest.as_ref().map(|(p, _)| p) != self.current.as_ref()
    }

    /// Makes a step of what has changed since the last one, rested or not.
    pub fn commit(&mut self) {
        let Some((latest, _)) = self.latest.clone() else { return };
        if let Some(current) = self.current.replace(latest.clone())
            && current != latest
        {
            self.undo.push(current);
            self.redo.clear();
            if self.undo.len() > MOST_STEPS {
                self.undo.remove(0);
            }
        }
    }

    /// Whether there is something to undo, or to redo.
    pub fn can(&self) -> (bool, bool) {
        (!self.undo.is_empty() || self.is_open(), !self.redo.is_empty())
    }

    /// Goes one step back.
    pub fn undo(&mut self, params: &mut Params) {
        self.commit();
        if let (Some(before), Some(current)) = (self.undo.pop(), self.current.clone()) {
            self.redo.push(current);
            self.turn(params, before);
        }
    }

    /// Goes one step forward again.
    pub fn redo(&mut self, params: &mut Params) {
        self.commit();
        if let (Some(next), Some(current)) = (self.redo.pop(), self.current.clone()) {
            self.undo.push(current);
            self.turn(params, next);
        }
    }

    fn turn(&mut self, params: &mut Params, to: Params) {
        let (clock, camera) = (params.clock.clone(), params.camera.clone());
        *params = to.clone();
        (params.clock, params.camera) = (clock, camera);
        self.latest = Some((to.clone(), f64::NEG_INFINITY));
        self.current = Some(to);
    }
}

/// The parameters without what moves by itself.
fn key(params: &Params) -> Params {
    let usual = Params::default();
    Params { clock: usual.clock, camera: usual.camera, ..params.clone() }
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
        history.watch(&with_wind(12.0), false, 0.0);
        for i in 1..=20 {
            history.watch(&with_wind(12.0 + 0.1 * f64::from(i)), true, 0.1 * f64::from(i));
        }
        history.watch(&with_wind(14.0), false, 3.0);
        let mut p = with_wind(14.0);
        p.clock.t_s = 77.0;
        history.undo(&mut p);
        assert_eq!((p.sea.local().wind_m_s, p.clock.t_s), (12.0, 77.0));
        assert_eq!(history.can(), (false, true));
        history.redo(&mut p);
        assert_eq!((p.sea.local().wind_m_s, history.can()), (14.0, (true, false)));
    }

    #[test]
    fn what_is_undone_at_once_is_not_lost() {
        let mut history = History::default();
        history.watch(&with_wind(12.0), false, 0.0);
        history.watch(&with_wind(20.0), true, 0.1);
        let mut p = with_wind(20.0);
        history.undo(&mut p);
        assert_eq!(p.sea.local().wind_m_s, 12.0);
        history.redo(&mut p);
        assert_eq!(p.sea.local().wind_m_s, 20.0);
        history.undo(&mut p);
        history.watch(&with_wind(5.0), false, 1.0);
        history.watch(&with_wind(5.0), false, 2.0);
        assert_eq!(history.can(), (true, false), "another change leaves nothing to redo");
    }

    /// Random values of random rows, one after the other: back to the first, forth to the last, each exactly.
    #[test]
    fn every_value_is_undone_and_redone() {
        let mut history = History::default();
        let mut now_s = 0.0;
        let mut rest = |history: &mut History, p: &Params| {
            for _ in 0..2 {
                now_s += 1.0;
                history.watch(p, false, now_s);
            }
        };
        let mut steps = vec![Params::default()];
        rest(&mut history, &steps[0]);
        let fields = || FIELDS.iter().filter(|f| !matches!(f.group, Group::Camera | Group::Clock));
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
            if p != steps[steps.len() - 1] {
                rest(&mut history, &p);
                steps.push(p);
            }
        }
        let kept = steps.len().min(MOST_STEPS + 1);
        assert!(steps.len() > 100, "{}", steps.len());
        let mut p = steps[steps.len() - 1].clone();
        for want in steps.iter().rev().take(kept).skip(1) {
            history.undo(&mut p);
            assert_eq!(&p, want);
        }
        assert!(!history.can().0);
        for want in steps.iter().rev().take(kept - 1).rev() {
            history.redo(&mut p);
            assert_eq!(&p, want);
        }
        assert!(!history.can().1);
    }
}
