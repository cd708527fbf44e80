//! Chooses the picture's resolution, the tier of its light and the FFT size from the times that frames take.
//!
//! The governor aims at 60 frames a second, or at the next lower rate that the display can show, down to 30, before it
//! gives up more than half of the pixels. A frame's cost on the GPU decides how far it steps. Whether frames come too
//! late decides that it steps at all, so a frame that is on time never loses pixels. A step down that brings no faster
//! frames is undone: then the display sets the pace (a power saver, a screen of 30 Hz) or the CPU does.
//! At less than half of the pixels, the governor tries the lean light; if that shortens frames, the pixels return.

/// Time per frame of smooth motion, s: the aim while it costs no more than half of the pixels.
const SMOOTH_FRAME_S: f64 = 1.0 / 60.0;
/// Longest time per frame at which motion still looks right, s: the aim of slow GPUs.
const LONGEST_FRAME_S: f64 = 1.0 / 30.0;
/// Relative tolerance within which two frame times count as equal.
const FRAME_TIME_TOLERANCE: f64 = 0.05;
/// Fraction of the time per frame that the GPU may take. The rest covers noise and the display's own work.
const GPU_TIME_FRACTION: f64 = 0.9;
/// Below this fraction of the GPU time that a frame may take, the resolution is raised.
const RAISE_BELOW_FRACTION: f64 = 0.8;
/// Fraction of the frame time that the GPU takes at most if it is not what limits the frame rate.
const IDLE_GPU_FRACTION: f64 = 0.85;
/// Factor on the frame time that a step down must reach; otherwise it is undone.
const NEEDED_SHORTENING: f64 = 0.9;
/// Lowest resolution scale that the governor accepts for the sake of a higher frame rate.
const MIN_SCALE_FOR_SMOOTH_MOTION: f64 = 0.7;
/// Resolution scale from which the governor returns to a higher frame rate. It is above
/// [`MIN_SCALE_FOR_SMOOTH_MOTION`] so that small changes of cost do not make it change its mind.
const SCALE_TO_RETURN_TO_SMOOTH_MOTION: f64 = 0.76;
/// Ratio of two neighbouring resolution scales. Few sizes mean few new textures.
const SCALE_RATIO: f64 = 0.94;
/// Largest number of halvings of the FFT size.
const MAX_HALVINGS: u32 = 3;
/// Time from one frame to the next above which fewer frames are measured, so that a slow GPU is relieved soon, s.
const SLOW_INTERVAL_S: f64 = 0.1;
/// Least time that is measured before a decision, s.
const MEASURED_TIME_S: f64 = 0.1;
/// Least time that is measured before a decision once some decisions have changed nothing, s.
const QUIET_MEASURED_TIME_S: f64 = 0.4;
/// Number of decisions without a change after which measurements take longer.
const QUIET_DECISIONS: u32 = 2;
/// Number of frames without a picture that tell the display's refresh interval.
const IDLE_FRAMES: usize = 5;
/// Longest interval between two frames without a picture that may be a display's refresh interval, s.
const LONGEST_DISPLAY_S: f64 = 1.0 / 20.0;
/// Time after which a display's refresh interval is measured anew, s, because users change monitors and power savers.
const DISPLAY_MEMORY_S: f64 = 300.0;
/// Least time for which frames must be on time before a higher resolution is tried without a GPU time, s.
const TIME_BEFORE_BLIND_RAISE_S: f64 = 3.0;
/// Time after a raise within which a step down shows that the raise was too much, s.
const RAISE_ON_PROBATION_S: f64 = 3.0;
/// Time for which frames must be on time after the first raise that was too much, s. It doubles with each further one.
const FIRST_TIME_BEFORE_RAISE_S: f64 = 1.0;
/// Longest time for which frames must be on time before the resolution is raised, s.
const MAX_TIME_BEFORE_RAISE_S: f64 = 60.0;

/// Controller of the picture's resolution and FFT size. All times are in seconds.
#[derive(Debug)]
pub struct Governor {
    /// The resolution scale is [`SCALE_RATIO`] to this power, and at least `min_scale`.
    steps_down: u32,
    /// Lower limit of the resolution scale.
    min_scale: f64,
    /// How often the requested FFT size is halved.
    halvings: u32,
    /// Whether halving the FFT size has shown not to help.
    halving_is_useless: bool,
    /// Whether the water has the lean light.
    is_lean: bool,
    /// Whether the user leaves the choice of the light.
    may_be_lean: bool,
    /// Whether the lean light has shown not to help.
    lean_is_useless: bool,
    /// GPU time of a frame with the lean light, divided by that with the full one.
    lean_factor: f64,
    /// GPU time before the lean light, s, while its effect is being measured.
    lean_trial_s: Option<f64>,
    /// Number of frames after the last change that are not measured.
    unmeasured: u32,
    /// Time per frame that the governor aims at.
    aim_s: f64,
    /// The display's refresh interval, if it is known, and for how long it has been.
    display: Option<(f64, f64)>,
    /// The last step down, until it is known whether it helped.
    trial: Option<Trial>,
    /// Frames since the last change.
    frames: u32,
    /// Time from one frame to the next of each measured frame since the last decision.
    intervals_s: Vec<f64>,
    /// GPU time of each measured frame since the last decision.
    gpu_times_s: Vec<f64>,
    /// Time that a frame with all pixels would take on the GPU, s, if GPU times are known.
    whole_frame_gpu_s: Option<f64>,
    /// Number of decisions since the last change.
    quiet_decisions: u32,
    /// For how long frames have been on time.
    on_time_s: f64,
    /// Time since the last raise, s, if no other change followed it.
    since_raise_s: Option<f64>,
    /// For how long frames must be on time before the resolution is raised, s. It grows with each raise that was too
    /// much.
    time_before_raise_s: f64,
}

/// A step down whose effect is being measured.
#[derive(Clone, Copy, Debug)]
struct Trial {
    steps_before: u32,
    halvings_before: u32,
    interval_before_s: f64,
    /// Whether this is the second step down in a row, towards half of the frame time.
    is_second: bool,
}

/// Medians over the frames since the last change.
#[derive(Clone, Copy, Debug)]
struct Measured {
    /// Time from one frame to the next, s.
    interval_s: f64,
    /// Time that a frame takes on the GPU, s; without GPU times, its upper limit `interval_s`.
    gpu_s: f64,
    has_gpu_time: bool,
}

impl Measured {
    /// GPU time, s, with which frames can follow each other twice as fast.
    fn gpu_time_for_twice_the_rate_s(&self) -> f64 {
        0.5 * GPU_TIME_FRACTION * self.interval_s
    }
}

impl Governor {
    /// Creates a governor that starts at a resolution scale (0 to 1) and with an FFT size that is halved `halvings`
    /// times. It keeps the scale at `min_scale` or above.
    pub fn new(scale: f64, min_scale: f64, halvings: u32) -> Self {
        let mut governor = Self {
            steps_down: 0,
            min_scale,
            halvings,
            halving_is_useless: false,
            is_lean: scale < MIN_SCALE_FOR_SMOOTH_MOTION,
            may_be_lean: true,
            lean_is_useless: false,
            lean_factor: light::UNKNOWN_LEAN_FACTOR,
            lean_trial_s: None,
            unmeasured: 0,
            aim_s: SMOOTH_FRAME_S,
            display: None,
            trial: None,
            frames: 0,
            intervals_s: Vec::new(),
            gpu_times_s: Vec::new(),
            whole_frame_gpu_s: None,
            quiet_decisions: 0,
            on_time_s: 0.0,
            since_raise_s: None,
            time_before_raise_s: 0.0,
        };
        governor.steps_down = governor.steps_for(scale);
        governor
    }

    /// Factor, at most 1, on the width and the height of the picture.
    pub fn scale(&self) -> f64 {
        SCALE_RATIO.powi(self.steps_down as i32).max(self.min_scale)
    }

    /// Time that a frame with all pixels would take on the GPU, s, if its time is proportional to the pixels; `None`
    /// if GPU times are not known.
    pub fn whole_frame_gpu_s(&self) -> Option<f64> {
        self.whole_frame_gpu_s
    }

    /// How often the requested FFT size is halved.
    pub fn halvings(&self) -> u32 {
        self.halvings
    }

    /// Number that differs between any two choices of resolution, light and FFT size; 0 for the best of all.
    pub fn level(&self) -> u32 {
        self.steps_down << 8 | u32::from(self.is_lean) << 4 | self.halvings
    }

    /// Returns to all pixels, full light and the full FFT size, because the user wants no adaptive quality.
    pub fn give_all_pixels(&mut self) {
        (self.trial, self.halving_is_useless) = (None, false);
        (self.is_lean, self.lean_is_useless, self.lean_trial_s) = (false, false, None);
        if self.level() != 0 {
            self.change(0, 0);
        }
    }

    /// Discards the measurements in progress: the frames before and after are not comparable.
    pub fn discard_measurements(&mut self) {
        self.frames = 0;
        self.intervals_s.clear();
        self.gpu_times_s.clear();
    }

    /// Notes a frame without a picture, while the pipelines are compiled: such frames show the display's refresh rate.
    pub fn note_idle_frame(&mut self, interval_s: f64) {
        self.intervals_s.push(interval_s);
        if self.intervals_s.len() >= IDLE_FRAMES {
            let interval_s = median(&mut self.intervals_s);
            self.intervals_s.clear();
            // Slower frames were held up by the compiler.
            if interval_s < self.display.map_or(LONGEST_DISPLAY_S, |(known_s, _)| known_s) {
                self.display = Some((interval_s, 0.0));
            }
        }
    }

    /// Notes a frame that began `interval_s` after the previous one. `gpu_s`: the time that a frame of the present
    /// resolution took on the GPU, if it became known since then.
    pub fn note_frame(&mut self, interval_s: f64, gpu_s: Option<f64>) {
        for age_s in self.display.iter_mut().map(|(_, age_s)| age_s).chain(&mut self.since_raise_s) {
            *age_s += interval_s;
        }
        self.display = self.display.filter(|(_, age_s)| *age_s < DISPLAY_MEMORY_S);
        self.frames += 1;
        // After a change, the GPU may still work on frames recorded before it.
        let (skipped, least_measured) = if interval_s > SLOW_INTERVAL_S { (1, 2) } else { (2, 4) };
        if self.frames <= skipped.max(self.unmeasured) {
            return;
        }
        self.intervals_s.push(interval_s);
        self.gpu_times_s.extend(gpu_s);
        let measured_s: f64 = self.intervals_s.iter().sum();
        let needed_s = if self.quiet_decisions > QUIET_DECISIONS { QUIET_MEASURED_TIME_S } else { MEASURED_TIME_S };
        if measured_s < needed_s || self.intervals_s.len() < least_measured {
            return;
        }
        let interval_s = median(&mut self.intervals_s);
        let has_gpu_time = !self.gpu_times_s.is_empty();
        let gpu_s = if has_gpu_time { median(&mut self.gpu_times_s) } else { interval_s };
        self.intervals_s.clear();
        self.gpu_times_s.clear();
        self.whole_frame_gpu_s = has_gpu_time.then(|| gpu_s / self.scale().powi(2));
        self.decide(Measured { interval_s, gpu_s, has_gpu_time }, measured_s);
    }

    fn decide(&mut self, measured: Measured, measured_s: f64) {
        self.quiet_decisions += 1;
        self.learn_display(measured);
        if let Some(trial) = self.trial.take()
            && !self.conclude(trial, measured)
        {
            return;
        }
        if self.judge_light(measured) {
            return;
        }
        self.choose_aim(measured);
        let is_on_time = self.is_on_time(measured);
        self.on_time_s = if is_on_time { self.on_time_s + measured_s } else { 0.0 };
        let may_take_s = GPU_TIME_FRACTION * self.aim_s;
        if !is_on_time && measured.gpu_s > may_take_s {
            self.step_down(measured, may_take_s);
        } else if !is_on_time {
            // The GPU is fast enough, and yet frames are late. Either the display shows a frame at every second
            // refresh only, because the GPU just missed the first, or it is slow itself.
            let missed_s = measured.gpu_time_for_twice_the_rate_s();
            if measured.gpu_s <= missed_s || self.scale_for(missed_s, measured) < MIN_SCALE_FOR_SMOOTH_MOTION {
                self.display = Some((measured.interval_s, 0.0));
            } else {
                self.step_down(measured, missed_s);
            }
        } else if self.on_time_s <= self.time_before_raise_s {
            // Noise or a changing view made the last raise too much.
        } else if measured.gpu_s < RAISE_BELOW_FRACTION * may_take_s {
            self.step_up(self.steps_for(self.scale_for(may_take_s, measured)));
        } else if !measured.has_gpu_time && self.on_time_s > TIME_BEFORE_BLIND_RAISE_S {
            self.step_up(self.steps_down.saturating_sub(1));
        }
    }

    fn is_on_time(&self, measured: Measured) -> bool {
        measured.interval_s <= self.aim_s * (1.0 + FRAME_TIME_TOLERANCE)
    }

    /// Learns the display's refresh interval from frames during which the GPU was idle for a while, and forgets it if
    /// frames are faster.
    fn learn_display(&mut self, measured: Measured) {
        let known_s = self.display.map_or(f64::INFINITY, |(interval_s, _)| interval_s);
        let is_idle = measured.gpu_s <= IDLE_GPU_FRACTION * measured.interval_s;
        if measured.interval_s < known_s / (1.0 + FRAME_TIME_TOLERANCE) {
            let is_display = is_idle && measured.interval_s <= SMOOTH_FRAME_S * (1.0 + FRAME_TIME_TOLERANCE);
            self.display = is_display.then_some((measured.interval_s, 0.0));
        }
    }

    /// Judges a step down by the frames after it. Returns false if it was undone or followed by a second one.
    fn conclude(&mut self, trial: Trial, measured: Measured) -> bool {
        if self.is_on_time(measured) || measured.interval_s <= NEEDED_SHORTENING * trial.interval_before_s {
            return true;
        }
        let half_s = measured.gpu_time_for_twice_the_rate_s();
        let is_worth_it = self.scale_for(half_s, measured) >= MIN_SCALE_FOR_SMOOTH_MOTION;
        if !trial.is_second && trial.halvings_before == self.halvings && measured.gpu_s > half_s && is_worth_it {
            self.change(self.steps_for(self.scale_for(half_s, measured)).max(self.steps_down + 1), self.halvings);
            self.trial = Some(Trial { is_second: true, ..trial });
            return false;
        }
        self.halving_is_useless |= trial.halvings_before != self.halvings;
        self.change(trial.steps_before, trial.halvings_before);
        self.display = Some((measured.interval_s, 0.0));
        false
    }

    /// Chooses the time per frame to aim at: the shortest multiple of the display's refresh interval, from
    /// [`SMOOTH_FRAME_S`] to [`LONGEST_FRAME_S`], that leaves enough pixels.
    fn choose_aim(&mut self, measured: Measured) {
        let display_s = self.display.map_or(SMOOTH_FRAME_S, |(interval_s, _)| interval_s);
        let longest_s = LONGEST_FRAME_S * (1.0 + FRAME_TIME_TOLERANCE);
        let mut aim_s = display_s * (SMOOTH_FRAME_S * (1.0 + FRAME_TIME_TOLERANCE) / display_s).floor().max(1.0);
        while aim_s + display_s <= longest_s {
            let is_raised = aim_s < self.aim_s / (1.0 + FRAME_TIME_TOLERANCE);
            let least = if is_raised { SCALE_TO_RETURN_TO_SMOOTH_MOTION } else { MIN_SCALE_FOR_SMOOTH_MOTION };
            if self.scale_for(GPU_TIME_FRACTION * aim_s, measured) >= least {
                break;
            }
            aim_s += display_s;
        }
        self.aim_s = aim_s;
    }

    /// Resolution scale at which the GPU would take the time `gpu_s`, if its time is proportional to the pixels.
    fn scale_for(&self, gpu_s: f64, measured: Measured) -> f64 {
        (self.scale() * (gpu_s / measured.gpu_s.max(1e-5)).sqrt()).min(1.0)
    }

    /// Number of steps down to the largest possible resolution scale that is at most `scale`.
    fn steps_for(&self, scale: f64) -> u32 {
        (scale.max(self.min_scale).ln() / SCALE_RATIO.ln() - 0.01).ceil().max(0.0) as u32
    }

    /// Lowers the resolution so that the GPU takes the time `gpu_s`. At the lowest resolution, halves the FFT size.
    fn step_down(&mut self, measured: Measured, gpu_s: f64) {
        if self.since_raise_s.is_some_and(|since_s| since_s < RAISE_ON_PROBATION_S) {
            self.time_before_raise_s =
                (2.0 * self.time_before_raise_s).clamp(FIRST_TIME_BEFORE_RAISE_S, MAX_TIME_BEFORE_RAISE_S);
            if !measured.has_gpu_time {
                return self.change(self.steps_down + 1, self.halvings);
            }
        }
        let trial = Trial {
            steps_before: self.steps_down,
            halvings_before: self.halvings,
            interval_before_s: measured.interval_s,
            is_second: false,
        };
        if self.scale() > self.min_scale {
            let steps = self.steps_for(self.scale_for(gpu_s, measured)).max(self.steps_down + 1);
            self.change(steps, self.halvings);
        } else if self.halvings < MAX_HALVINGS && !self.halving_is_useless {
            self.change(self.steps_down, self.halvings + 1);
        } else {
            return;
        }
        self.trial = Some(trial);
    }

    /// Raises the resolution to the scale with this number of steps down. Where pixels are back, the FFT size follows.
    fn step_up(&mut self, steps_down: u32) {
        if steps_down < self.steps_down {
            self.change(steps_down, self.halvings);
        } else if self.halvings > 0 && self.steps_down == 0 {
            self.change(0, self.halvings - 1);
        } else {
            return;
        }
        self.since_raise_s = Some(0.0);
    }

    fn change(&mut self, steps_down: u32, halvings: u32) {
        (self.steps_down, self.halvings) = (steps_down, halvings);
        (self.since_raise_s, self.unmeasured) = (None, 0);
        self.on_time_s = 0.0;
        self.quiet_decisions = 0;
        self.discard_measurements();
    }
}

/// Median of the values, the upper one of two; sorts them.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

mod light;
#[cfg(test)]
mod tests;
