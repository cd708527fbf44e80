//! How many pixels the picture has: those of the window, as far as the machine keeps up with them.

use crate::state::params::{Grid, Screen};

/// A frame longer than this is seen as a stutter, s.
const LONG_S: f64 = 1.0 / 40.0;
/// A frame shorter than this leaves time for more, s: a screen of 60 Hz waits for its next turn.
const SHORT_S: f64 = 1.0 / 55.0;
/// Fewest pixels along a side, over those asked for.
const LEAST_SCALE: f64 = 0.4;
/// Pixels along a side that an adapter starts with which is a CPU, over those asked for, and its fewest: there a frame of
/// 1280x720 takes seconds, and the first one stands between a visitor and the sea.
const CPU_SCALE: f64 = 0.25;
/// Fewest points along a side of a cascade: with these no gap opens between the bands.
const LEAST_N: u32 = 128;
/// What each second refusal of memory leaves of the pixels along a side, and the fewest points that it leaves of a cascade.
const REFUSED_SCALE: f64 = 0.7;
const REFUSED_N: u32 = 64;
/// How long frames must have been long before something is given up, and short before it is tried again, s.
const PATIENCE_S: f64 = 0.6;
const TRIAL_S: f64 = 3.0;
/// The longest wait between two trials, s.
const MOST_TRIAL_S: f64 = 60.0;
/// A frame after a pause, a hidden tab or a stall says nothing of the picture's cost, s; two in a row do.
const ODD_S: f64 = 4.0;

/// Follows the frame time.
pub struct Quality {
    /// Smoothed time of a frame, s.
    frame_s: f64,
    /// Pixels along a side over those asked for.
    scale: f64,
    /// The fewest.
    least_scale: f64,
    /// Halvings of n.
    halvings: u32,
    /// How long frames have been long (positive) or short (negative), s.
    pressure_s: f64,
    /// Wait before the next trial, s: longer after each that failed.
    trial_s: f64,
    tried: bool,
    /// How often the graphics memory did not suffice.
    refusals: u32,
    /// Whether the last frame was an odd one.
    was_odd: bool,
    still: bool,
    size: [u32; 2],
}

impl Quality {
    /// To start with on an adapter of a kind, with a sea that stands still or not.
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
            size: [0; 2],
        }
    }

    /// Takes the time since the last frame into account. A sea that stands still has all the time in the world.
    pub fn watch(&mut self, dt_s: f64, still: bool, adaptive: bool) {
        let was_still = std::mem::replace(&mut self.still, still);
        let was_odd = std::mem::replace(&mut self.was_odd, dt_s > ODD_S);
        if still || was_still || dt_s <= 0.0 || (self.was_odd && !was_odd) {
            self.pressure_s = 0.0;
            return;
        }
        let dt_s = dt_s.min(ODD_S);
        // One long frame is no trend, five are.
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
                // Most of a frame is its pixels: as many fewer as it takes too long, but no leap.
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

    /// The graphics memory did not suffice: from now on fewer pixels and points in turn, moving or not.
    pub fn refuse(&mut self) {
        self.refusals += 1;
    }

    /// Share of the pixels along a side that the memory allows.
    fn most_scale(&self) -> f64 {
        REFUSED_SCALE.powi(self.refusals.div_ceil(2) as i32)
    }

    /// Pixels of the picture in a window of so many points with so many pixels each, at most `limit` along a side.
    pub fn picture_size(&mut self, points: egui::Vec2, pixels_per_point: f32, screen: &Screen, limit: u32) -> [u32; 2] {
        let density = f64::from(pixels_per_point).min(screen.max_pixel_ratio) * screen.render_scale;
        let own = if self.still || !screen.adaptive { 1.0 } else { self.scale }.min(self.most_scale());
        self.size = [points.x, points.y].map(|side| ((f64::from(side) * density * own).round() as u32).min(limit));
        self.size
    }

    /// The grid to compute on.
    pub fn grid(&self, grid: &Grid, screen: &Screen) -> Grid {
        let n = if screen.adaptive { self.fft_size(grid.n) } else { self.affordable(grid.n) };
        Grid { n, ..grid.clone() }
    }

    /// Points along a side of a cascade of which `n` are asked for.
    pub fn fft_size(&self, n: u32) -> u32 {
        let n = self.affordable(n);
        if self.still { n } else { (n >> self.halvings).max(LEAST_N.min(n)) }
    }

    /// What the memory allows of `n` points.
    fn affordable(&self, n: u32) -> u32 {
        (n >> (self.refusals / 2).min(8)).max(REFUSED_N.min(n))
    }

    /// Pixels of the last picture.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Frames a second, smoothed.
    pub fn frames_a_second(&self) -> f64 {
        1.0 / self.frame_s.max(1e-4)
    }

    /// What is given up, in words.
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

    /// Seconds of frames whose length follows from the quality.
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
        // A machine that needs 50 ms for all pixels, and less for fewer.
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
        // All pixels are just too many, nine tenths are fast.
        let frame = |q: &Quality| if q.scale > 0.93 { 0.03 } else { 1.0 / 60.0 };
        run(&mut quality, 400.0, frame);
        assert!(quality.trial_s >= 24.0, "{}", quality.trial_s);
    }
}
