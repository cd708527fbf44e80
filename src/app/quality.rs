//! Adaptive quality: a machine that is too slow draws fewer pixels, and after that a smaller FFT.

use crate::state::params::{Grid, Screen};

/// Wall-clock time per frame above which motion stutters and the quality is lowered, s.
const SLOW_FRAME_S: f64 = 1.0 / 40.0;
/// Wall-clock time per frame below which a higher quality is tried, s. A screen of 60 Hz takes 1/60 s per frame.
const FAST_FRAME_S: f64 = 1.0 / 55.0;
/// Lowest factor by which adaptive quality scales the picture's width and height on a hardware GPU.
const MIN_RESOLUTION_SCALE: f64 = 0.4;
/// Initial factor, and lower limit, of the picture's width and height on a software adapter, which draws on the CPU and
/// takes seconds per frame.
const SOFTWARE_ADAPTER_RESOLUTION_SCALE: f64 = 0.25;
/// Smallest FFT size to which slow frames reduce a cascade. A smaller one would leave wave numbers in no cascade.
const MIN_FFT_SIZE: u32 = 128;
/// Factor by which each odd-numbered out-of-memory error (the first, the third, ...) scales the picture's width and
/// height. Each even-numbered one halves the FFT size.
const OUT_OF_MEMORY_RESOLUTION_FACTOR: f64 = 0.7;
/// Smallest FFT size to which out-of-memory errors reduce a cascade.
const OUT_OF_MEMORY_MIN_FFT_SIZE: u32 = 64;
/// Time for which frames must be too slow before the quality is lowered, s.
const SLOW_TIME_BEFORE_DROP_S: f64 = 0.6;
/// Initial time for which frames must be fast before a higher quality is tried, s. It doubles after each failed trial.
const FAST_TIME_BEFORE_TRIAL_S: f64 = 3.0;
/// Upper limit of the time for which frames must be fast before a higher quality is tried, s.
const MAX_FAST_TIME_BEFORE_TRIAL_S: f64 = 60.0;
/// Wall-clock time from one frame to the next above which it is taken for a pause, a hidden tab or a stall, s. It is
/// ignored, unless the frame before it took as long.
const STALL_S: f64 = 4.0;

/// Controller that lowers and raises the picture's resolution and the FFT size, according to the frame time and to
/// out-of-memory errors.
pub struct AdaptiveQuality {
    /// Moving average of the wall-clock time from one frame to the next, s.
    frame_s: f64,
    /// Factor, at most 1, by which adaptive quality scales the width and height of the picture that the user's settings
    /// ask for.
    scale: f64,
    /// Lower limit of `scale`: [`MIN_RESOLUTION_SCALE`], or [`SOFTWARE_ADAPTER_RESOLUTION_SCALE`] on a software
    /// adapter.
    min_scale: f64,
    /// How often adaptive quality halves the requested FFT size: 0 for the full size, at most 3.
    halvings: u32,
    /// Time for which frames have been too slow (positive), or fast enough for a higher quality (negative), s.
    slow_or_fast_time_s: f64,
    /// Time for which frames must be fast before a higher quality is tried, s. It doubles after each failed trial.
    fast_time_before_trial_s: f64,
    /// Whether the last change of quality was a trial of a higher one. If frames then become too slow, the trial has
    /// failed.
    trial_in_progress: bool,
    /// Number of out-of-memory errors of the GPU so far.
    out_of_memory_errors: u32,
    /// Whether the last frame took longer than [`STALL_S`]. Of several such frames in a row only the first is ignored.
    was_stall: bool,
    /// Whether the simulated time is stopped. A still picture has full quality, as far as graphics memory allows.
    time_is_stopped: bool,
}

impl AdaptiveQuality {
    /// Creates the controller with the initial quality for a kind of adapter. `time_is_stopped`: whether simulated time
    /// is stopped.
    pub fn for_adapter(kind: wgpu::DeviceType, time_is_stopped: bool) -> Self {
        let is_cpu = kind == wgpu::DeviceType::Cpu;
        Self {
            frame_s: 1.0 / 60.0,
            scale: if is_cpu { SOFTWARE_ADAPTER_RESOLUTION_SCALE } else { 1.0 },
            min_scale: if is_cpu { SOFTWARE_ADAPTER_RESOLUTION_SCALE } else { MIN_RESOLUTION_SCALE },
            halvings: u32::from(is_cpu),
            was_stall: false,
            slow_or_fast_time_s: 0.0,
            fast_time_before_trial_s: FAST_TIME_BEFORE_TRIAL_S,
            trial_in_progress: false,
            out_of_memory_errors: 0,
            time_is_stopped,
        }
    }

    /// Adapts the quality after a frame, `dt_s` seconds after the previous one. Quality is full, as far as memory
    /// allows, while simulated time is stopped (`time_is_stopped`) and if the user has not chosen `adaptive` quality.
    pub fn adapt(&mut self, dt_s: f64, time_is_stopped: bool, adaptive: bool) {
        let was_still = std::mem::replace(&mut self.time_is_stopped, time_is_stopped);
        let was_stall = std::mem::replace(&mut self.was_stall, dt_s > STALL_S);
        if time_is_stopped || was_still || dt_s <= 0.0 || (self.was_stall && !was_stall) {
            self.slow_or_fast_time_s = 0.0;
            return;
        }
        let dt_s = dt_s.min(STALL_S);
        self.frame_s += (dt_s - self.frame_s) * 0.2;
        if !adaptive {
            (self.scale, self.halvings, self.slow_or_fast_time_s) = (1.0, 0, 0.0);
            return;
        }
        if self.frame_s > SLOW_FRAME_S {
            self.slow_or_fast_time_s = self.slow_or_fast_time_s.max(0.0) + dt_s;
        } else if self.frame_s < FAST_FRAME_S {
            self.slow_or_fast_time_s = self.slow_or_fast_time_s.min(0.0) - dt_s;
        } else {
            self.slow_or_fast_time_s = 0.0;
        }
        if self.slow_or_fast_time_s > SLOW_TIME_BEFORE_DROP_S {
            self.slow_or_fast_time_s = 0.0;
            if std::mem::take(&mut self.trial_in_progress) {
                self.fast_time_before_trial_s = (2.0 * self.fast_time_before_trial_s).min(MAX_FAST_TIME_BEFORE_TRIAL_S);
            }
            if self.scale > self.min_scale {
                // The cost of a frame is proportional to its pixels, hence the root. The limits smooth the change.
                let wanted = (0.9 * SLOW_FRAME_S / self.frame_s).sqrt().clamp(0.7, 0.95);
                self.scale = (self.scale * wanted).max(self.min_scale);
            } else {
                self.halvings = (self.halvings + 1).min(3);
            }
        } else if -self.slow_or_fast_time_s > self.fast_time_before_trial_s && (self.scale < 1.0 || self.halvings > 0) {
            self.slow_or_fast_time_s = 0.0;
            self.trial_in_progress = true;
            if self.halvings > 0 {
                self.halvings -= 1;
            } else {
                self.scale = (1.1 * self.scale).min(1.0);
            }
        }
    }

    /// Notes an out-of-memory error of the GPU. The errors alternately lower the resolution and the FFT size, also
    /// while the time is stopped.
    pub fn note_out_of_memory(&mut self) {
        self.out_of_memory_errors += 1;
    }

    /// Largest factor on the picture's width and height that graphics memory allows: 1, multiplied by 0.7 at the first,
    /// third, fifth... out-of-memory error. Those between halve the FFT size instead.
    fn resolution_scale_for_memory(&self) -> f64 {
        OUT_OF_MEMORY_RESOLUTION_FACTOR.powi(self.out_of_memory_errors.div_ceil(2) as i32)
    }

    /// Width and height of the picture in pixels at the current quality. `points` are width and height of the area that
    /// shows the sea, points; `screen`: the user's resolution; `limit`: the GPU's largest texture side, pixels.
    pub fn picture_size(&self, points: egui::Vec2, pixels_per_point: f32, screen: &Screen, limit: u32) -> [u32; 2] {
        let density = f64::from(pixels_per_point).min(screen.max_pixel_ratio) * screen.render_scale;
        let own = if self.time_is_stopped || !screen.adaptive { 1.0 } else { self.scale }
            .min(self.resolution_scale_for_memory());
        [points.x, points.y].map(|side| ((f64::from(side) * density * own).round() as u32).min(limit))
    }

    /// Copy of the FFT grid parameters with an FFT size that the GPU's memory and, with adaptive quality, its speed
    /// allow.
    pub fn reduced_grid(&self, grid: &Grid, screen: &Screen) -> Grid {
        let n = if screen.adaptive { self.reduced_fft_size(grid.n) } else { self.fft_size_for_memory(grid.n) };
        Grid { n, ..grid.clone() }
    }

    /// Largest FFT size up to the requested `n` that adaptive quality allows: halved while frames are slow (unless time
    /// is stopped) and after out-of-memory errors.
    fn reduced_fft_size(&self, n: u32) -> u32 {
        let n = self.fft_size_for_memory(n);
        if self.time_is_stopped { n } else { (n >> self.halvings).max(MIN_FFT_SIZE.min(n)) }
    }

    /// Largest FFT size up to the requested `n` that the out-of-memory errors so far allow: every second one halves it.
    fn fft_size_for_memory(&self, n: u32) -> u32 {
        (n >> (self.out_of_memory_errors / 2).min(8)).max(OUT_OF_MEMORY_MIN_FFT_SIZE.min(n))
    }

    /// Frames per second, from the moving average of the frame time.
    pub fn frames_per_second(&self) -> f64 {
        1.0 / self.frame_s.max(1e-4)
    }

    /// Describes the picture quality for a bug report: "full quality" or, say, "50 % of the pixels, to keep up".
    pub fn describe(&self) -> String {
        if self.out_of_memory_errors > 0 {
            let scale = self.resolution_scale_for_memory().min(if self.time_is_stopped { 1.0 } else { self.scale });
            return format!("{:.0} % of the pixels, for want of graphics memory", 100.0 * scale * scale);
        }
        if self.time_is_stopped || self.scale >= 1.0 && self.halvings == 0 {
            return "full quality".to_owned();
        }
        format!("{:.0} % of the pixels, to keep up", 100.0 * self.scale * self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates some seconds of frames whose frame time depends on the quality.
    fn run(quality: &mut AdaptiveQuality, seconds: f64, frame_s: impl Fn(&AdaptiveQuality) -> f64) {
        let mut t = 0.0;
        while t < seconds {
            let dt = frame_s(quality);
            quality.adapt(dt, false, true);
            t += dt;
        }
    }

    #[test]
    fn slow_frames_cost_pixels_and_fast_ones_bring_them_back() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, true);
        let screen = Screen::default();
        let points = egui::vec2(1000.0, 500.0);
        run(&mut quality, 1.0, |_| 1.0 / 60.0);
        assert_eq!(quality.picture_size(points, 1.0, &screen, 8192), [1000, 500]);
        // A machine that needs 50 ms for a frame at full resolution.
        run(&mut quality, 10.0, |q| 0.05 * q.scale * q.scale);
        let [width, _] = quality.picture_size(points, 1.0, &screen, 8192);
        assert!((500..850).contains(&width), "{width}");
        run(&mut quality, 60.0, |_| 1.0 / 60.0);
        assert_eq!(quality.picture_size(points, 1.0, &screen, 8192), [1000, 500]);
    }

    #[test]
    fn what_stands_still_and_what_may_not_adapt_is_whole() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, true);
        let points = egui::vec2(1000.0, 500.0);
        run(&mut quality, 20.0, |_| 0.3);
        let mut screen = Screen::default();
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [800, 400]);
        let grid = Grid::default();
        assert_eq!(quality.reduced_grid(&grid, &screen).n, 128);
        screen.adaptive = false;
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        screen.adaptive = true;
        quality.adapt(0.3, true, true);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        assert_eq!(quality.reduced_grid(&grid, &screen), grid);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 512), [512, 512]);
    }

    #[test]
    fn refused_memory_costs_pixels_and_points_even_of_a_still() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, true);
        let screen = Screen { adaptive: false, ..Screen::default() };
        let points = egui::vec2(1000.0, 500.0);
        let grid = Grid { n: 256, ..Grid::default() };
        let mut found = Vec::new();
        for _ in 0..8 {
            found.push((quality.picture_size(points, 1.0, &screen, 8192)[0], quality.reduced_grid(&grid, &screen).n));
            quality.note_out_of_memory();
        }
        let wanted = [(1000, 256), (700, 256), (700, 128), (490, 128), (490, 64), (343, 64), (343, 64), (240, 64)];
        assert_eq!(found, wanted);
        assert!(quality.describe().contains("memory"), "{}", quality.describe());
    }

    #[test]
    fn trials_that_fail_become_rare() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, true);
        // The full resolution is slow, and 0.93 of it is fast.
        let frame = |q: &AdaptiveQuality| if q.scale > 0.93 { 0.03 } else { 1.0 / 60.0 };
        run(&mut quality, 400.0, frame);
        assert!(quality.fast_time_before_trial_s >= 24.0, "{}", quality.fast_time_before_trial_s);
    }
}
