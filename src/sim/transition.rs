//! Transitions from one sea to another: their progress and weights, without any GPU code.
//!
//! - **Interpolation** between seas with the same wave numbers and frequencies: amplitudes, surface parameters and foam
//!   parameters move towards the goal. Every frame covers a fraction of the remaining difference, so the goal may
//!   change at any time, for example while a slider is dragged.
//! - **Cross-fade** between seas with different waves: both seas are drawn while the new one fades in and the old one
//!   fades out. The variances of independent waves add, so amplitude factors are square roots of the weights. Waves
//!   that both seas contain (waves/overlap.rs) add by amplitude, and the factors are reduced accordingly.

use crate::waves::overlap::SeaCovariance;
use std::f64::consts::FRAC_PI_2;

/// Duration of an interpolation or cross-fade from one sea to another, s of wall time, not of simulated time.
pub const TRANSITION_DURATION_S: f64 = 0.8;

/// Kind of transition from one sea to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransitionKind {
    /// The new sea replaces the old one at once.
    Immediate,
    /// Interpolation of the foam parameters only; waves, choppiness and water level stay unchanged.
    Foam,
    /// Interpolation of choppiness, water level and foam parameters; the wave amplitudes stay unchanged.
    Surface,
    /// Interpolation of the wave amplitudes, the choppiness, the water level and the foam parameters.
    Amplitudes,
    /// Cross-fade: both seas are drawn while the new one fades in and the old one fades out.
    CrossFade,
}

/// Progress that the running transitions make in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransitionFrameProgress {
    /// Kind of transition that starts in this frame; None if none starts. The other fields tell the progress after the
    /// start.
    pub started: Option<TransitionKind>,
    /// Fraction of the remaining way to the goal that choppiness, water level and foam parameters make in this frame, 0
    /// to 1.
    pub interpolation_fraction: f64,
    /// Fraction of the remaining way to the goal that the wave amplitudes make in this frame, 0 to 1.
    pub amplitude_fraction: f64,
    /// Whether a running cross-fade ends in this frame, so that the old sea is no longer drawn.
    pub ends_cross_fade: bool,
}

impl TransitionFrameProgress {
    /// Progress of a frame in which a transition of the kind `Immediate` replaces the old sea by the new one at once.
    pub const IMMEDIATE: Self = Self {
        started: Some(TransitionKind::Immediate),
        interpolation_fraction: 0.0,
        amplitude_fraction: 0.0,
        ends_cross_fade: false,
    };
}

/// Progress of the running interpolation or cross-fade, or of both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transition {
    interpolation: Option<Interpolation>,
    /// Fraction of the cross-fade's duration that has passed, 0 to 1. None without a cross-fade.
    cross_fade: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Interpolation {
    /// Fraction of the interpolation's duration that has passed since its last start, 0 to 1.
    progress: f64,
    /// Whether wave amplitudes are interpolated, besides choppiness, water level and the foam parameters.
    amplitudes: bool,
}

impl Transition {
    /// Starts a transition of the given kind, or restarts the running interpolation towards a new goal. A cross-fade
    /// ends an interpolation; `Immediate` ends all transitions.
    pub fn start(&mut self, kind: TransitionKind) {
        match kind {
            TransitionKind::Immediate => *self = Self::default(),
            TransitionKind::Foam | TransitionKind::Surface | TransitionKind::Amplitudes => {
                let amplitudes = kind == TransitionKind::Amplitudes || self.interpolates_amplitudes();
                self.interpolation = Some(Interpolation { progress: 0.0, amplitudes });
            }
            // The sea that fades out keeps its present amplitudes; the new sea starts with its final ones.
            TransitionKind::CrossFade => *self = Self { interpolation: None, cross_fade: Some(0.0) },
        }
    }

    /// Advances the running transitions by `dt_s` seconds of wall time, and returns their progress. It starts none, so
    /// `started` of the result is None.
    pub fn advance(&mut self, dt_s: f64) -> TransitionFrameProgress {
        let elapsed = (dt_s / TRANSITION_DURATION_S).max(0.0);
        let mut step = TransitionFrameProgress::default();
        if let Some(Interpolation { progress: from, amplitudes }) = self.interpolation {
            let to = (from + elapsed).min(1.0);
            // The remaining difference shrinks with the cube of the remaining time. A goal that moves in every frame is
            // followed with a lag of a third of the duration.
            step.interpolation_fraction = 1.0 - ((1.0 - to) / (1.0 - from)).powi(3);
            step.amplitude_fraction = if amplitudes { step.interpolation_fraction } else { 0.0 };
            self.interpolation = (to < 1.0).then_some(Interpolation { progress: to, amplitudes });
        }
        if let Some(from) = self.cross_fade {
            let to = from + elapsed;
            step.ends_cross_fade = to >= 1.0;
            self.cross_fade = (to < 1.0).then_some(to);
        }
        step
    }

    /// Weight of the new sea in a cross-fade: its fraction of the sum of both elevation variances; else 1.
    ///
    /// The amplitude factors, its square root and that of the rest, are sine and cosine of an angle that grows evenly: no
    /// other course has a smaller largest step.
    pub fn cross_fade_weight(&self) -> f64 {
        self.cross_fade.map_or(1.0, |x| (FRAC_PI_2 * x).sin().powi(2))
    }

    /// Whether an interpolation that changes the amplitudes of the waves is running.
    pub fn interpolates_amplitudes(&self) -> bool {
        self.interpolation.is_some_and(|interpolation| interpolation.amplitudes)
    }

    /// Whether an interpolation or a cross-fade is running.
    pub fn is_running(&self) -> bool {
        self.interpolation.is_some() || self.cross_fade.is_some()
    }
}

/// Factors of the wave amplitudes of one cascade in a cross-fade, \[old sea, new sea\]: they give the new sea the
/// fraction `fraction` (0 to 1) of the sum of both elevation variances. The second result is the variance of the
/// blended waves divided by that sum: above 1 if some waves are in both seas, as their covariance in `overlap` tells.
pub fn cross_fade_amplitudes(overlap: &SeaCovariance, fraction: f64) -> ([f64; 2], f64) {
    let variance_gain = overlap.blended_variance_ratio(fraction);
    ([((1.0 - fraction) / variance_gain).sqrt(), (fraction / variance_gain).sqrt()], variance_gain)
}

/// Parameters of a sea between which a transition can interpolate, from those of one sea to those of another.
pub trait Interpolate: Clone {
    /// The parameters at the fraction `fraction` (0 to 1) of the way from `self` to `to`; at 1 exactly `to`.
    #[must_use]
    fn interpolate(&self, to: &Self, fraction: f64) -> Self;
}

/// Parameters of the drawn sea during a transition: present values and goal, and those of a cross-fade's old sea.
#[derive(Clone, Debug)]
pub struct Interpolated<T> {
    /// Present parameters of the old sea of a cross-fade. None without a cross-fade.
    fading: Option<T>,
    now: T,
    goal: T,
}

impl<T: Interpolate> Interpolated<T> {
    /// Makes parameters whose present values are `goal`, without an old sea, as when no transition is running.
    pub fn new(goal: T) -> Self {
        Self { fading: None, now: goal.clone(), goal }
    }

    /// Applies the progress of one frame of a transition. If a transition starts in this frame, `goal` gets the
    /// previous goal and returns the new one.
    pub fn apply_transition_step(&mut self, step: &TransitionFrameProgress, goal: impl FnOnce(&T) -> T) {
        if let Some(kind) = step.started {
            self.goal = goal(&self.goal);
            match kind {
                TransitionKind::Immediate => *self = Self::new(self.goal.clone()),
                TransitionKind::Foam | TransitionKind::Surface | TransitionKind::Amplitudes => {}
                TransitionKind::CrossFade => self.fading = Some(std::mem::replace(&mut self.now, self.goal.clone())),
            }
        }
        if step.interpolation_fraction >= 1.0 {
            self.now = self.goal.clone();
        } else if step.interpolation_fraction > 0.0 {
            self.now = self.now.interpolate(&self.goal, step.interpolation_fraction);
        }
        if step.ends_cross_fade {
            self.fading = None;
        }
    }

    /// The parameters of the old sea of a cross-fade (None without a cross-fade), and those of the current sea.
    pub fn fading_and_current(&self) -> (Option<&T>, &T) {
        (self.fading.as_ref(), &self.now)
    }

    /// The parameters of the drawn sea as a whole: in a cross-fade those of both seas mixed, with the weight `fraction`
    /// (0 to 1) for the new sea; otherwise the present ones.
    pub fn cross_faded_value(&self, fraction: f64) -> T {
        match &self.fading {
            Some(old) if fraction < 1.0 => old.interpolate(&self.now, fraction),
            _ => self.now.clone(),
        }
    }

    /// Applies the function `change` to the present parameters, to the goal, and to those of a cross-fade's old sea.
    pub fn change_all(&mut self, change: impl Fn(&mut T)) {
        self.fading.iter_mut().chain([&mut self.now, &mut self.goal]).for_each(change);
    }
}

/// Number at the fraction `fraction` (0 to 1) of the way from `from` to `to`; at 1 exactly `to`.
pub fn interpolate(from: f64, to: f64, fraction: f64) -> f64 {
    if fraction >= 1.0 { to } else { from + (to - from) * fraction }
}

/// Pair of numbers at the fraction `fraction` (0 to 1) of the way from `from` to `to`; at 1 exactly `to`.
pub fn interpolate_pair(from: [f64; 2], to: [f64; 2], fraction: f64) -> [f64; 2] {
    [interpolate(from[0], to[0], fraction), interpolate(from[1], to[1], fraction)]
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Interpolate for f64 {
        fn interpolate(&self, to: &Self, fraction: f64) -> Self {
            interpolate(*self, *to, fraction)
        }
    }

    #[test]
    fn an_interpolated_number_ends_exactly_wherever_its_goal_went() {
        let (mut transition, mut drawn) = (Transition::default(), Interpolated::new(2.0));
        let mut before = 2.0;
        for i in 0..200 {
            let mut start = None;
            if i < 30 {
                transition.start(TransitionKind::Amplitudes);
                start = Some(TransitionKind::Amplitudes);
            }
            let step = TransitionFrameProgress { started: start, ..transition.advance(1.0 / 60.0) };
            drawn.apply_transition_step(&step, |_| 2.1 + 0.1 * f64::from(i));
            let now = drawn.cross_faded_value(transition.cross_fade_weight());
            assert!(now >= before && now - before < 0.11, "{i}: {before} to {now}");
            before = now;
            // The transition ends 0.8 s after the last change, not earlier: after 48 frames, or one more by rounding.
            assert!(transition.is_running() == (i < 76) || i == 76, "{i}");
        }
        assert_eq!(drawn.cross_faded_value(1.0), 2.1 + 0.1 * 29.0);
    }

    #[test]
    fn a_fade_starts_and_ends_on_its_seas() {
        let (mut transition, mut drawn) = (Transition::default(), Interpolated::new(5.0));
        transition.start(TransitionKind::CrossFade);
        let mut step = TransitionFrameProgress { started: Some(TransitionKind::CrossFade), ..transition.advance(0.0) };
        drawn.apply_transition_step(&step, |_| 7.0);
        assert_eq!(
            (drawn.cross_faded_value(transition.cross_fade_weight()), transition.cross_fade_weight()),
            (5.0, 0.0)
        );
        let mut before = 5.0;
        while transition.is_running() {
            step = transition.advance(0.016);
            drawn.apply_transition_step(&step, |_| unreachable!("the goal stays"));
            let now = drawn.cross_faded_value(transition.cross_fade_weight());
            assert!(now > before && now - before < 0.1);
            before = now;
        }
        assert!(step.ends_cross_fade && drawn.fading_and_current() == (None, &7.0) && before == 7.0);
    }

    #[test]
    fn foam_leaves_the_amplitudes_unless_they_are_under_way() {
        let mut transition = Transition::default();
        transition.start(TransitionKind::Foam);
        let step = transition.advance(0.1);
        assert!(step.interpolation_fraction > 0.0 && step.amplitude_fraction == 0.0);
        transition.start(TransitionKind::Amplitudes);
        transition.advance(0.1);
        transition.start(TransitionKind::Surface);
        assert!(
            transition.advance(TRANSITION_DURATION_S).amplitude_fraction == 1.0,
            "the waves come to their goal, too"
        );
        assert!(!transition.is_running());
    }

    #[test]
    fn independent_seas_keep_their_power_and_common_ones_their_amplitude() {
        let ([a, b], gain) = cross_fade_amplitudes(&SeaCovariance::default(), 0.3);
        assert!((a * a + b * b - 1.0).abs() < 1e-12 && gain == 1.0);
        assert_eq!(cross_fade_amplitudes(&SeaCovariance::default(), 1.0), ([0.0, 1.0], 1.0));
        assert_eq!(cross_fade_amplitudes(&SeaCovariance::default(), 0.0), ([1.0, 0.0], 1.0));
    }
}
