//! How one sea becomes another, as pure numbers.
//!
//! - **The same waves, other amplitudes** (two seas on the same rungs): amplitudes ease towards the new ones in place. Every
//!   frame takes a part of the way that is left, so that the goal may move at any time: dragging a slider.
//! - **Other waves** (rungs, depth, gravity, loop, seed): both seas are drawn, and the new one fades in while the old one
//!   fades out. Independent waves add by their variances, hence the roots; what the two have in common (waves/overlap.rs)
//!   would add to more than either, and is taken off.

use crate::waves::overlap::Overlap;

/// Length of a glide, s of wall time.
pub const GLIDE_S: f64 = 0.8;

/// How a sea turned to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// All at once.
    Jump,
    /// By the amplitudes of its waves.
    Ease,
    /// By fading into it.
    Fade,
}

/// What happened in one step of a glide, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moved {
    /// A turn to another goal.
    pub turn: Option<Turn>,
    /// Part of the way to the goal's amplitudes, from 0 to 1.
    pub ease: f64,
    /// The old sea has faded.
    pub faded: bool,
}

/// How far ways have been gone, from 0 to 1; None for those that are at their end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glide {
    ease: Option<f64>,
    fade: Option<f64>,
}

impl Glide {
    /// Starts a way, or anew.
    pub fn start(&mut self, turn: Turn) {
        match turn {
            Turn::Jump => *self = Self::default(),
            Turn::Ease => self.ease = Some(0.0),
            // The amplitudes of the sea that fades stay where they are; those of the new one are drawn at once.
            Turn::Fade => *self = Self { ease: None, fade: Some(0.0) },
        }
    }

    /// Goes on by some seconds.
    pub fn advance(&mut self, dt_s: f64) -> Moved {
        let step = (dt_s / GLIDE_S).max(0.0);
        let mut moved = Moved::default();
        if let Some(from) = self.ease {
            let to = (from + step).min(1.0);
            // What is left shrinks as a cube: a goal that moves every frame is followed with a lag of a third of a glide.
            moved.ease = 1.0 - ((1.0 - to) / (1.0 - from)).powi(3);
            self.ease = (to < 1.0).then_some(to);
        }
        if let Some(from) = self.fade {
            let to = from + step;
            moved.faded = to >= 1.0;
            self.fade = (to < 1.0).then_some(to);
        }
        moved
    }

    /// Share of the new sea in the variance: 1 when nothing fades.
    pub fn share(&self) -> f64 {
        self.fade.map_or(1.0, |x| x * x * (3.0 - 2.0 * x))
    }

    /// Whether any way is left.
    pub fn is_running(&self) -> bool {
        self.ease.is_some() || self.fade.is_some()
    }
}

/// Amplitudes of a cascade before and after a fade, while the new sea has this share; and what their summed variances are
/// short of.
pub fn weights(overlap: &Overlap, share: f64) -> ([f64; 2], f64) {
    let excess = overlap.excess(share);
    ([((1.0 - share) / excess).sqrt(), (share / excess).sqrt()], excess)
}

/// Numbers that a sea is drawn by, between those of two seas.
pub trait Mix: Clone {
    /// A share of the way to others; at 1 they are the others, exactly.
    #[must_use]
    fn mix(&self, to: &Self, share: f64) -> Self;
}

/// Numbers that follow a glide.
#[derive(Clone, Debug)]
pub struct Drawn<T> {
    fading: Option<T>,
    now: T,
    goal: T,
}

impl<T: Mix> Drawn<T> {
    /// Numbers at rest.
    pub fn new(goal: T) -> Self {
        Self { fading: None, now: goal.clone(), goal }
    }

    /// Follows a step; `goal` makes the numbers of a new goal.
    pub fn follow(&mut self, moved: &Moved, goal: impl FnOnce() -> T) {
        match moved.turn {
            Some(Turn::Jump) => *self = Self::new(goal()),
            Some(Turn::Ease) => self.goal = goal(),
            Some(Turn::Fade) => {
                let new = Self::new(goal());
                let old = std::mem::replace(self, new);
                self.fading = Some(old.now);
            }
            None => {}
        }
        if moved.ease > 0.0 {
            self.now = if moved.ease < 1.0 { self.now.mix(&self.goal, moved.ease) } else { self.goal.clone() };
        }
        if moved.faded {
            self.fading = None;
        }
    }

    /// The numbers of both seas: of the one that fades, if any, and of the other.
    pub fn parts(&self) -> (Option<&T>, &T) {
        (self.fading.as_ref(), &self.now)
    }

    /// The numbers while the new sea has this share.
    pub fn value(&self, share: f64) -> T {
        match &self.fading {
            Some(old) if share < 1.0 => old.mix(&self.now, share),
            _ => self.now.clone(),
        }
    }

    /// Changes all of them alike.
    pub fn change(&mut self, change: impl Fn(&mut T)) {
        self.fading.iter_mut().chain([&mut self.now, &mut self.goal]).for_each(change);
    }
}

/// A number between two; at 1 the second, exactly.
pub fn mix(from: f64, to: f64, share: f64) -> f64 {
    if share >= 1.0 { to } else { from + (to - from) * share }
}

/// The same for pairs.
pub fn mix2(from: [f64; 2], to: [f64; 2], share: f64) -> [f64; 2] {
    [mix(from[0], to[0], share), mix(from[1], to[1], share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Mix for f64 {
        fn mix(&self, to: &Self, share: f64) -> Self {
            mix(*self, *to, share)
        }
    }

    #[test]
    fn an_eased_number_ends_exactly_wherever_its_goal_went() {
        let (mut glide, mut drawn) = (Glide::default(), Drawn::new(2.0));
        let mut before = 2.0;
        for i in 0..200 {
            let mut turn = None;
            if i < 30 {
                glide.start(Turn::Ease);
                turn = Some(Turn::Ease);
            }
            let moved = Moved { turn, ..glide.advance(1.0 / 60.0) };
            drawn.follow(&moved, || 2.1 + 0.1 * f64::from(i));
            let now = drawn.value(glide.share());
            assert!(now >= before && now - before < 0.11, "{i}: {before} to {now}");
            before = now;
            // 0.8 s after the last change, not earlier: 48 frames, or one more by rounding.
            assert!(glide.is_running() == (i < 76) || i == 76, "{i}");
        }
        assert_eq!(drawn.value(1.0), 2.1 + 0.1 * 29.0);
    }

    #[test]
    fn a_fade_starts_and_ends_on_its_seas() {
        let (mut glide, mut drawn) = (Glide::default(), Drawn::new(5.0));
        glide.start(Turn::Fade);
        let mut moved = Moved { turn: Some(Turn::Fade), ..glide.advance(0.0) };
        drawn.follow(&moved, || 7.0);
        assert_eq!((drawn.value(glide.share()), glide.share()), (5.0, 0.0));
        let mut before = 5.0;
        while glide.is_running() {
            moved = glide.advance(0.016);
            drawn.follow(&moved, || unreachable!("the goal stays"));
            let now = drawn.value(glide.share());
            assert!(now > before && now - before < 0.1);
            before = now;
        }
        assert!(moved.faded && drawn.parts() == (None, &7.0) && before == 7.0);
    }

    #[test]
    fn independent_seas_keep_their_power_and_common_ones_their_amplitude() {
        let ([a, b], gain) = weights(&Overlap::default(), 0.3);
        assert!((a * a + b * b - 1.0).abs() < 1e-12 && gain == 1.0);
        assert_eq!(weights(&Overlap::default(), 1.0), ([0.0, 1.0], 1.0));
        assert_eq!(weights(&Overlap::default(), 0.0), ([1.0, 0.0], 1.0));
    }
}
