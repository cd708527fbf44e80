//! Rain near the eye: the largest drops of a box before the eye as streaks, and splashes on the water.

use super::grid_before_eye;
use crate::gpu::layout::gpu_struct;
use crate::optics::rain;
use crate::render::scene::Scene;

/// Side of the box of drops, m. Drops that leave it come in again on the other side.
const BOX_M: f64 = 8.0;
/// The middle of the box lies so far before the eye, m.
const AHEAD_M: f64 = 3.4;
/// Most drops that are drawn, and the diameter from which they are seen singly, mm. All others only take light from
/// what is far away.
const MOST_DROPS: f64 = 12_288.0;
const LEAST_DIAMETER_MM: f64 = 1.0;
/// Largest factor on the opacity of drops by which they stand for smaller ones, too.
const MOST_GAIN: f64 = 6.0;
/// Number of classes of drops, with equal numbers of drops, each with one diameter.
const CLASSES: usize = 8;
/// Wind speed at the height of the box divided by that at 10 m.
const WIND_NEAR_WATER: f64 = 0.75;
/// Number of cells along a side of the square of splashes (`RAIN_SPLASH_SIDE` in shaders/drops/rain.wgsl), and their
/// side, m.
const SPLASH_SIDE: u32 = 64;
const SPLASH_CELL_M: f64 = 0.2;
/// Distance of the middle of the square of splashes before the eye, in sides of the square.
const SPLASHES_AHEAD: f64 = 0.4;
/// Diameter of drops from which a splash is seen, mm, and how long it lasts, s.
const SPLASH_DIAMETER_MM: f64 = 2.0;
const SPLASH_S: f64 = 0.16;

gpu_struct! {
    /// WGSL `Rain`: drops and splashes near the eye.
    pub struct RainUniform as "Rain" {
        /// For each class of drops: place of the box in the pattern of drops that moves with them, in sides of the box;
        /// and the diameter, m.
        classes: [[f32; 4]; CLASSES],
        /// For each class of drops: velocity, m/s, and a factor on the opacity, by which the drawn drops hide as much as
        /// all drops of the box.
        velocities: [[f32; 4]; CLASSES],
        /// Middle of the box relative to the eye, m.
        middle: [f32; 3],
        /// Side of the box, m.
        box_m: f32,
        /// World index (x, z) of the first cell of splashes.
        first_cell: [i32; 2],
        /// Corner (x, z) of that cell relative to the point below the eye, m.
        corner: [f32; 2],
        /// Side of a cell of splashes, m.
        cell_m: f32,
        /// Fraction of the cells that have a splash, 0 to 1.
        splash_share: f32,
        /// Time in lengths of a splash: its whole part, and its fraction.
        moment: u32,
        moment_fraction: f32,
        /// Number of drops that are drawn.
        drops: u32,
        unused: [u32; 3],
    }
}

/// Number of drops that are drawn at a rain rate, and the smallest diameter of them, mm.
fn drawn_drops(rate: f64) -> (f64, f64) {
    let volume_m3 = BOX_M.powi(3);
    let drops = (rain::drops_per_m3(rate, LEAST_DIAMETER_MM) * volume_m3).min(MOST_DROPS);
    (drops, rain::least_diameter_mm(rate, drops / volume_m3))
}

impl RainUniform {
    /// The rain of a scene; None if it has none.
    pub fn new(scene: &Scene) -> Option<Self> {
        let rate = scene.look.sky.rain_mm_h;
        if rate <= 0.0 {
            return None;
        }
        let (sea, view) = (&scene.sea, &scene.view);
        let (drops, least_mm) = drawn_drops(rate);
        let middle = view.eye + view.forward * AHEAD_M;
        let middle = [middle.x, middle.y, middle.z];
        let wind = sea.downwind.map(|x| x * WIND_NEAR_WATER * sea.wind_m_s);
        let diameter_mm = |class: usize| {
            // The median of the class, in an exponential distribution.
            let larger = 1.0 - (class as f64 + 0.5) / CLASSES as f64;
            least_mm - larger.ln() / rain::slope_per_mm(rate)
        };
        let velocity = |class| [wind[0], -rain::fall_speed_m_s(diameter_mm(class)), wind[1]];
        let classes = std::array::from_fn(|class| {
            let v = velocity(class);
            let place: [f64; 3] = std::array::from_fn(|i| ((middle[i] - v[i] * scene.t_s) / BOX_M).rem_euclid(1.0));
            [place[0], place[1], place[2], 1e-3 * diameter_mm(class)].map(|x| x as f32)
        });
        let gain = rain::cover_share(rate, least_mm).recip().min(MOST_GAIN) as f32;
        let (first_cell, corner) = grid_before_eye(view, SPLASH_CELL_M, SPLASH_SIDE, SPLASHES_AHEAD);
        let (moment, moment_fraction) = scene.moment(SPLASH_S);
        let impacts = rain::impacts_per_m2_s(rate, SPLASH_DIAMETER_MM);
        Some(Self {
            classes,
            velocities: std::array::from_fn(|class| {
                let [x, y, z] = velocity(class).map(|v| v as f32);
                [x, y, z, gain]
            }),
            middle: (view.forward * AHEAD_M).as_vec3().to_array(),
            box_m: BOX_M as f32,
            first_cell,
            corner,
            cell_m: SPLASH_CELL_M as f32,
            splash_share: (impacts * SPLASH_S * SPLASH_CELL_M * SPLASH_CELL_M).min(1.0) as f32,
            moment,
            moment_fraction,
            drops: drops.round() as u32,
            unused: [0; 3],
        })
    }

    /// Number of quads: drops, then splashes.
    pub fn quads(&self) -> u32 {
        self.drops + SPLASH_SIDE * SPLASH_SIDE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The drawn drops are the largest ones of the box, as many as Marshall and Palmer's distribution has there.
    #[test]
    fn the_largest_drops_are_drawn() {
        for rate in [0.01, 1.0, 10.0, 100.0] {
            let (drops, least_mm) = drawn_drops(rate);
            let all = rain::drops_per_m3(rate, least_mm) * BOX_M.powi(3);
            assert!(drops <= MOST_DROPS && (drops / all - 1.0).abs() < 1e-9, "{rate} mm/h: {drops} of {all}");
            assert!(least_mm > LEAST_DIAMETER_MM - 1e-9, "{rate} mm/h: {least_mm} mm");
        }
    }
}
