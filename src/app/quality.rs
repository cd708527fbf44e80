//! Adaptive quality: a machine that is too slow gets fewer pixels, and then fewer points per cascade.

use crate::state::params::{Grid, Screen};

/// Frame time above which motion stutters, s.
const LONG_S: f64 = 1.0 / 40.0;
/// Frame time below which more pixels are tried, s; a screen of 60 Hz takes 1/60 s.
const SHORT_S: f64 = 1.0 / 55.0;
/// Least scale of the pixels along a side, relative to the requested ones.
const LEAST_SCALE: f64 = 0.4;
/// First and least scale on a software adapter, where a frame of 1280 x 720 takes seconds.
const CPU_SCALE: f64 = 0.25;
/// Fewest points along a side of a cascade; fewer would leave gaps between the bands.
const LEAST_N: u32 = 128;
/// Factor of the pixels along a side after every other out-of-memory error, and the fewest points that such errors
/// leave.
const REFUSED_SCALE: f64 = 0.7;
const REFUSED_N: u32 = 64;
/// How long frames must be long before the quality falls, and at first short before it rises, s.
const PATIENCE_S: f64 = 0.6;
const TRIAL_S: f64 = 3.0;
/// The longest wait between two trials, s.
const MOST_TRIAL_S: f64 = 60.0;
/// Frame time above which a single frame is ignored, s: it followed a pause, a hidden tab or a stall.
const ODD_S: f64 = 4.0;

/// Scale of the picture and number of points, controlled by the frame time.
pub struct Quality {
    /// Smoothed time of a frame, s.
    frame_s: f64,
    /// Pixels along a side, relative to the requested ones.
    scale: f64,
    /// Least value of `scale`.
    least_scale: f64,
    /// Halvings of n.
    halvings: u32,
    /// Time for which frames have been long (positive) or short (negative), s.
    pressure_s: f64,
    /// Time of short frames before the quality rises, s: it doubles after each failed trial.
    trial_s: f64,
    /// Whether the last change raised the quality.
    tried: bool,
    /// Number of out-of-memory errors.
    refusals: u32,
    /// Whether the last frame was longer than [`ODD_S`].
    was_odd: bool,
    /// Whether time is stopped.
    still: bool,
}

impl Quality {
    /// Initial quality on a kind of adapter; `still` if time is stopped.
    pub fn on(kind: wgpu::DeviceType, still: bool) -> Self {
        let is_cpu = kind == wgpu::DeviceType::Cpu;
        Self {
            frame_s: 1.0 / 60.0,
            scale: if is_cpu { CPU_SCALE } else { 1.0 },
            least_scale: if is_cpu { CPU_SCALE } else { LEAST_SCALE },
            halvings: u32::from(is_cpu),
            was_odd: false,
            pressure_s: 0.0,
            trial_s: TRIAL_S,
            tried: false,
            refusals: 0,
            still,
        }
    }

    /// Adapts to the time since the last frame. A stopped time always gets full quality.
    pub fn watch(&mut self, dt_s: f64, still: bool, adaptive: bool) {
        let was_still = std::mem::replace(&mut self.still, still);
        let was_odd = std::mem::replace(&mut self.was_odd, dt_s > ODD_S);
        if still || was_still || dt_s <= 0.0 || (self.was_odd && !was_odd) {
            self.pressure_s = 0.0;
            return;
        }
        let dt_s = dt_s.min(ODD_S);
        self.frame_s += (dt_s - self.frame_s) * 0.2;
        if !adaptive {
            (self.scale, self.halvings, self.pressure_s) = (1.0, 0, 0.0);
            return;
        }
        if self.frame_s > LONG_S {
            self.pressure_s = self.pressure_s.max(0.0) + dt_s;
        } else if self.frame_s < SHORT_S {
            self.pressure_s = self.pressure_s.min(0.0) - dt_s;
        } else {
            self.pressure_s = 0.0;
        }
        if self.pressure_s > PATIENCE_S {
            self.pressure_s = 0.0;
            if std::mem::take(&mut self.tried) {
                self.trial_s = (2.0 * self.trial_s).min(MOST_TRIAL_S);
            }
            if self.scale > self.least_scale {
                // The cost of a frame is proportional to its pixels; limits keep the change gradual.
                let wanted = (0.9 * LONG_S / self.frame_s).sqrt().clamp(0.7, 0.95);
                self.scale = (self.scale * wanted).max(self.least_scale);
            } else {
                self.halvings = (self.halvings + 1).min(3);
            }
        } else if -self.pressure_s > self.trial_s && (self.scale < 1.0 || self.halvings > 0) {
            self.pressure_s = 0.0;
            self.tried = true;
            if self.halvings > 0 {
                self.halvings -= 1;
            } else {
                self.scale = (1.1 * self.scale).min(1.0);
            }
        }
    }

    /// Lowers the pixels and the points alternately after each out-of-memory error, also for a stopped time.
    pub fn refuse(&mut self) {
        self.refusals += 1;
    }

    /// Scale of the pixels along a side that the memory allows.
    fn most_scale(&self) -> f64 {
        REFUSED_SCALE.powi(self.refusals.div_ceil(2) as i32)
    }

    /// Size of the picture in pixels for a viewport in points, at most `limit` along a side.
    pub fn picture_size(&self, points: egui::Vec2, pixels_per_point: f32, screen: &Screen, limit: u32) -> [u32; 2] {
        let density = f64::from(pixels_per_point).min(screen.max_pixel_ratio) * screen.render_scale;
        let own = if self.still || !screen.adaptive { 1.0 } else { self.scale }.min(self.most_scale());
        [points.x, points.y].map(|side| ((f64::from(side) * density * own).round() as u32).min(limit))
    }

    /// The requested grid with the points that speed and memory allow.
    pub fn grid(&self, grid: &Grid, screen: &Screen) -> Grid {
        let n = if screen.adaptive { self.fft_size(grid.n) } else { self.affordable(grid.n) };
        Grid { n, ..grid.clone() }
    }

    /// Points along a side of a cascade where `n` are requested.
    fn fft_size(&self, n: u32) -> u32 {
        let n = self.affordable(n);
        if self.still { n } else { (n >> self.halvings).max(LEAST_N.min(n)) }
    }

    /// Points along a side that the memory allows where `n` are requested.
    fn affordable(&self, n: u32) -> u32 {
        (n >> (self.refusals / 2).min(8)).max(REFUSED_N.min(n))
    }

    /// Smoothed frames per second.
    pub fn frames_a_second(&self) -> f64 {
        1.0 / self.frame_s.max(1e-4)
    }

    /// The current quality in words.
    pub fn word(&self) -> String {
        if self.refusals > 0 {
            let scale = self.most_scale().min(if self.still { 1.0 } else { self.scale });
            return format!("{:.0} % of the pixels, for want of graphics memory", 100.0 * scale * scale);
        }
        if self.still || self.scale >= 1.0 && self.halvings == 0 {
            return "full quality".to_owned();
        }
        format!("{:.0} % of the pixels, to keep up", 100.0 * self.scale * self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs frames for some seconds; the frame time depends on the quality.
    fn run(quality: &mut Quality, seconds: f64, frame_s: impl Fn(&Quality) -> f64) {
        let mut t = 0.0;
        while t < seconds {
            let dt = frame_s(quality);
            quality.watch(dt, false, true);
            t += dt;
        }
    }

    #[test]
    fn slow_frames_cost_pixels_and_fast_ones_bring_them_back() {
        let mut quality = Quality::on(wgpu::DeviceType::DiscreteGpu, true);
        let screen = Screen::default();
        let points = egui::vec2(1000.0, 500.0);
        run(&mut quality, 1.0, |_| 1.0 / 60.0);
        assert_eq!(quality.picture_size(points, 1.0, &screen, 8192), [1000, 500]);
        // A machine that takes 50 ms for all pixels.
        run(&mut quality, 10.0, |q| 0.05 * q.scale * q.scale);
        let [width, _] = quality.picture_size(points, 1.0, &screen, 8192);
        assert!((500..850).contains(&width), "{width}");
        run(&mut quality, 60.0, |_| 1.0 / 60.0);
        assert_eq!(quality.picture_size(points, 1.0, &screen, 8192), [1000, 500]);
    }

    #[test]
    fn what_stands_still_and_what_may_not_adapt_is_whole() {
        let mut quality = Quality::on(wgpu::DeviceType::DiscreteGpu, true);
        let points = egui::vec2(1000.0, 500.0);
        run(&mut quality, 20.0, |_| 0.3);
        let mut screen = Screen::default();
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [800, 400]);
        let grid = Grid::default();
        assert_eq!(quality.grid(&grid, &screen).n, 128);
        screen.adaptive = false;
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        screen.adaptive = true;
        quality.watch(0.3, true, true);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 8192), [2000, 1000]);
        assert_eq!(quality.grid(&grid, &screen), grid);
        assert_eq!(quality.picture_size(points, 3.0, &screen, 512), [512, 512]);
    }

    #[test]
    fn refused_memory_costs_pixels_and_points_even_of_a_still() {
        let mut quality = Quality::on(wgpu::DeviceType::DiscreteGpu, true);
        let screen = Screen { adaptive: false, ..Screen::default() };
        let points = egui::vec2(1000.0, 500.0);
        let grid = Grid { n: 256, ..Grid::default() };
        let mut found = Vec::new();
        for _ in 0..8 {
            found.push((quality.picture_size(points, 1.0, &screen, 8192)[0], quality.grid(&grid, &screen).n));
            quality.refuse();
        }
        let wanted = [(1000, 256), (700, 256), (700, 128), (490, 128), (490, 64), (343, 64), (343, 64), (240, 64)];
        assert_eq!(found, wanted);
        assert!(quality.word().contains("memory"), "{}", quality.word());
    }

    #[test]
    fn trials_that_fail_become_rare() {
        let mut quality = Quality::on(wgpu::DeviceType::DiscreteGpu, true);
        // Full scale is slow, and nine tenths of it are fast.
        let frame = |q: &Quality| if q.scale > 0.93 { 0.03 } else { 1.0 / 60.0 };
        run(&mut quality, 400.0, frame);
        assert!(quality.trial_s >= 24.0, "{}", quality.trial_s);
    }
}
