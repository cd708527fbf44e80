//! Adaptive quality: a machine that is too slow draws fewer pixels, and after that a smaller FFT.

use crate::app::language::{say, tr};
use crate::governor::Governor;
use crate::state::params::{Detail, Grid, Screen};

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
/// Wall-clock time from one frame to the next above which it is taken for a pause, a hidden tab or a stall, s. It is
/// ignored, unless the frame before it took as long.
const STALL_S: f64 = 4.0;

/// Resolution of the picture and FFT size that a machine can afford: the governor's choice by the times of frames, and
/// limits by out-of-memory errors.
pub struct AdaptiveQuality {
    governor: Governor,
    /// Moving average of the wall-clock time from one frame to the next, s.
    frame_s: f64,
    /// Number of out-of-memory errors of the GPU so far.
    out_of_memory_errors: u32,
    /// Whether the last frame took longer than [`STALL_S`]. Of several such frames in a row only the first is ignored.
    was_stall: bool,
    /// Whether the simulated time is stopped. A still picture has full quality, as far as graphics memory allows.
    time_is_stopped: bool,
}

/// Measured times of the last frame, and what else it did, with which quality is adapted before the next one.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameTimes {
    /// Wall-clock time from one frame to the next, s.
    pub interval_s: f64,
    /// GPU time, s, of a frame whose time became known, and its quality ([`AdaptiveQuality::level`]).
    pub gpu: Option<(u32, f64)>,
    /// Whether simulated time is stopped.
    pub time_is_stopped: bool,
    /// Whether the frame did more than draw the present sea: it simulated foam of the past, or cross-faded two seas.
    pub has_extra_work: bool,
}

impl AdaptiveQuality {
    /// Creates the controller with the initial quality for a kind of adapter. `time_is_stopped`: whether simulated time
    /// is stopped.
    pub fn for_adapter(kind: wgpu::DeviceType, time_is_stopped: bool) -> Self {
        let governor = if kind == wgpu::DeviceType::Cpu {
            Governor::new(SOFTWARE_ADAPTER_RESOLUTION_SCALE, SOFTWARE_ADAPTER_RESOLUTION_SCALE, 1)
        } else {
            Governor::new(1.0, MIN_RESOLUTION_SCALE, 0)
        };
        Self { governor, frame_s: 1.0 / 60.0, was_stall: false, out_of_memory_errors: 0, time_is_stopped }
    }

    /// Notes a frame without a picture, `interval_s` after the previous one, while the pipelines are compiled.
    pub fn note_idle_frame(&mut self, interval_s: f64) {
        self.governor.note_idle_frame(interval_s);
    }

    /// Adapts the quality after a frame. Quality is full, as far as memory allows, while simulated time is stopped and
    /// if the user has not chosen adaptive quality.
    pub fn adapt(&mut self, times: FrameTimes, screen: &Screen) {
        let was_still = std::mem::replace(&mut self.time_is_stopped, times.time_is_stopped);
        let was_stall = std::mem::replace(&mut self.was_stall, times.interval_s > STALL_S);
        let is_pause = self.was_stall && !was_stall;
        if times.time_is_stopped || was_still || times.interval_s <= 0.0 || is_pause {
            self.governor.discard_measurements();
            return;
        }
        let interval_s = times.interval_s.min(STALL_S);
        self.frame_s += (interval_s - self.frame_s) * 0.2;
        self.governor.let_light_be_lean(screen.detail == Detail::Auto);
        if !screen.adaptive {
            self.governor.give_all_pixels();
        } else if times.has_extra_work {
            self.governor.discard_measurements();
        } else {
            let gpu_s = times.gpu.filter(|(level, _)| *level == self.level()).map(|(_, gpu_s)| gpu_s);
            self.governor.note_frame(interval_s, gpu_s);
        }
    }

    /// Tier of the light with which the present frame is drawn.
    pub fn detail(&self, screen: &Screen) -> Detail {
        let is_lean = match screen.detail {
            Detail::Auto => screen.adaptive && self.governor.is_lean(),
            Detail::Full => false,
            Detail::Lean => true,
        };
        if is_lean && !self.time_is_stopped { Detail::Lean } else { Detail::Full }
    }

    /// Whether the present frame is drawn with all pixels, waves and light that the user has chosen.
    pub fn is_full(&self, screen: &Screen) -> bool {
        self.time_is_stopped || !screen.adaptive || self.governor.level() == 0
    }

    /// Number that tells apart the qualities between which the governor chooses.
    pub fn level(&self) -> u32 {
        self.governor.level()
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
        let own = if self.time_is_stopped || !screen.adaptive { 1.0 } else { self.governor.scale() }
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
        if self.time_is_stopped { n } else { (n >> self.governor.halvings()).max(MIN_FFT_SIZE.min(n)) }
    }

    /// Largest FFT size up to the requested `n` that the out-of-memory errors so far allow: every second one halves it.
    fn fft_size_for_memory(&self, n: u32) -> u32 {
        (n >> (self.out_of_memory_errors / 2).min(8)).max(OUT_OF_MEMORY_MIN_FFT_SIZE.min(n))
    }

    /// Frames per second, from the moving average of the frame time.
    pub fn frames_per_second(&self) -> f64 {
        1.0 / self.frame_s.max(1e-4)
    }

    /// Wall-clock time from one frame to the next, ms, as a moving average.
    pub fn frame_ms(&self) -> f64 {
        1e3 * self.frame_s
    }

    /// Says in a sentence what is left out of the picture, and why; `None` if nothing is.
    pub fn reduction_in_words(&self, grid: &Grid, screen: &Screen) -> Option<String> {
        let is_reduced = screen.adaptive && !self.time_is_stopped && self.governor.level() != 0;
        if self.out_of_memory_errors == 0 && !is_reduced {
            return None;
        }
        if self.out_of_memory_errors > 0 {
            return Some(say!("Drawn with {quality}.", quality = self.describe()));
        }
        let percent = 100.0 * self.governor.scale().powi(2);
        let light = if self.detail(screen) == Detail::Lean { tr(", with simpler light") } else { "" };
        let has_all_waves = self.reduced_grid(grid, screen).n == grid.n;
        let waves = if has_all_waves { "" } else { tr(", without the shortest waves") };
        let why = match self.governor.whole_frame_gpu_s() {
            Some(gpu_s) => say!("with all of them this GPU needs {time} a frame", time = frame_time(gpu_s)),
            None => say!("a frame takes {time}", time = frame_time(1e-3 * self.frame_ms())),
        };
        Some(say!(
            "Drawn at {percent} % of the pixels{light}{waves}: {why}.",
            percent = format!("{percent:.0}"),
            light = light,
            waves = waves,
            why = why,
        ))
    }

    /// Describes the picture quality for a bug report: "full quality" or, say, "50 % of the pixels, to keep up".
    pub fn describe(&self) -> String {
        if self.out_of_memory_errors > 0 {
            let scale =
                self.resolution_scale_for_memory().min(if self.time_is_stopped { 1.0 } else { self.governor.scale() });
            let percent = format!("{:.0}", 100.0 * scale * scale);
            return say!("{percent} % of the pixels, for want of graphics memory", percent = percent);
        }
        if self.time_is_stopped || self.governor.level() == 0 {
            return tr("full quality").to_owned();
        }
        let percent = format!("{:.0}", 100.0 * self.governor.scale().powi(2));
        if self.governor.is_lean() {
            say!("{percent} % of the pixels, simpler light, to keep up", percent = percent)
        } else {
            say!("{percent} % of the pixels, to keep up", percent = percent)
        }
    }
}

/// The time of a frame with its unit: milliseconds, or seconds if it is longer than two.
fn frame_time(time_s: f64) -> String {
    if time_s > 2.0 { format!("{time_s:.0} s") } else { format!("{:.0} ms", 1e3 * time_s) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulates some seconds of frames whose frame time depends on the quality.
    fn run(quality: &mut AdaptiveQuality, seconds: f64, frame_s: impl Fn(&AdaptiveQuality) -> f64) {
        let mut t = 0.0;
        while t < seconds {
            let dt = frame_s(quality);
            quality.adapt(FrameTimes { interval_s: dt, ..FrameTimes::default() }, &Screen::default());
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
        run(&mut quality, 10.0, |q| 0.05 * q.governor.scale().powi(2));
        let [width, _] = quality.picture_size(points, 1.0, &screen, 8192);
        assert!((500..850).contains(&width), "{width}");
        run(&mut quality, 60.0, |_| 1.0 / 60.0);
        assert_eq!(quality.picture_size(points, 1.0, &screen, 8192), [1000, 500]);
    }

    #[test]
    fn what_stands_still_and_what_may_not_adapt_is_whole() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, true);
        let points = egui::vec2(1000.0, 500.0);
        run(&mut quality, 20.0, |q| q.governor.scale().powi(2) / f64::from(1 + q.governor.halvings()));
        let mut screen = Screen::default();
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [800, 400]);
        let grid = Grid::default();
        assert_eq!(quality.reduced_grid(&grid, &screen).n, 128);
        screen.adaptive = false;
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        screen.adaptive = true;
        quality.adapt(FrameTimes { interval_s: 0.3, time_is_stopped: true, ..FrameTimes::default() }, &screen);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        assert_eq!(quality.reduced_grid(&grid, &screen), grid);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 512), [512, 512]);
    }

    #[test]
    fn fewer_pixels_are_explained_in_words() {
        let mut quality = AdaptiveQuality::for_adapter(wgpu::DeviceType::DiscreteGpu, false);
        let screen = Screen::default();
        run(&mut quality, 1.0, |_| 1.0 / 60.0);
        assert_eq!(quality.reduction_in_words(&Grid::default(), &screen), None);
        // A GPU that needs 24 ms for all pixels.
        let mut t = 0.0;
        while t < 5.0 {
            let gpu_s = 0.024 * quality.governor.scale().powi(2);
            let interval_s = if gpu_s < 1.0 / 60.0 { 1.0 / 60.0 } else { 1.0 / 30.0 };
            let gpu = Some((quality.level(), gpu_s));
            quality.adapt(FrameTimes { interval_s, gpu, ..FrameTimes::default() }, &screen);
            t += interval_s;
        }
        let percent = (100.0 * quality.governor.scale().powi(2)).round();
        let words = format!("Drawn at {percent} % of the pixels: with all of them this GPU needs 24 ms a frame.");
        assert_eq!(quality.reduction_in_words(&Grid::default(), &screen), Some(words));
        let whole = Screen { adaptive: false, ..Screen::default() };
        assert_eq!(quality.reduction_in_words(&Grid::default(), &whole), None);
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
}
