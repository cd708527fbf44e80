//! Position and attitude of floating buoys, boats and yachts on the waves.
//!
//! Hulls follow [`StrongestWaves`], which sums the strongest of the drawn waves on the CPU, without read-back or delay.

use super::heights::StrongestWaves;
use crate::coast::Transfer;
use crate::state::floats::{FloatingObject, FloatingObjectKind};
use crate::waves::Plan;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Largest rms height of the waves that a hull's heave leaves out, as a fraction of the significant wave height.
const MAX_HEIGHT_ERROR_TO_HS: f64 = 0.018;
/// Number of waves that make a hull pitch and roll: the strongest waves, which are mostly long.
const TILT_WAVE_COUNT: usize = 500;
/// FFT size to which a plan is reduced to select the waves that move hulls; a larger FFT only adds short waves.
const MAX_FFT_SIZE_FOR_FLOATING_OBJECTS: u32 = 128;
/// Angle between the wind and the bow of a close-hauled yacht. The wind comes from port.
const CLOSE_HAULED_RAD: f64 = 45.0 * PI / 180.0;
/// Largest heel of a close-hauled yacht: its crew reefs the sails before it heels farther.
const MAX_HEEL_RAD: f64 = 25.0 * PI / 180.0;
/// Wind speed at which a yacht has heeled to 63 % of its largest heel, m/s, and the exponent of the wind speed.
const HEEL_WIND_M_S: f64 = 7.0;
const HEEL_EXPONENT: f64 = 1.7;

/// Position and attitude of a floating hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HullPose {
    /// Type of the hull.
    pub kind: FloatingObjectKind,
    /// Centre of the waterplane in the world (x, y, z), m.
    pub position_m: [f64; 3],
    /// Unit vector (x, y, z) in the world along the hull's upward axis, which pitch and roll tilt.
    pub up: [f64; 3],
    /// Unit vector (x, y, z) in the world from the hull's centre towards its bow.
    pub forward: [f64; 3],
    /// Mean slope of the water from the hull's port to its starboard, m/m.
    pub water_roll: f64,
    /// Height of the water at bow and stern over that at the middle, m.
    pub water_sag_m: f64,
}

/// Half the length and half the width, m, of a hull's waterplane (its outline at the water surface).
fn half_length_and_width_m(kind: FloatingObjectKind) -> [f64; 2] {
    match kind {
        FloatingObjectKind::Buoy => [0.8, 0.8],
        FloatingObjectKind::Boat => [3.2, 1.0],
        FloatingObjectKind::Yacht => [4.8, 1.5],
    }
}

/// The strongest waves of one sea, from which heave, pitch and roll of floating hulls are computed.
#[derive(Clone, Debug)]
pub struct HullWaves {
    /// Strongest waves of the sea, from which the height (heave) of hulls is computed.
    heave_waves: StrongestWaves,
    /// The 500 strongest waves of the sea, from which pitch and roll of a hull are computed.
    tilt_waves: StrongestWaves,
    /// Unit vector (x, z) that points into the local wind.
    upwind: [f64; 2],
    wind_m_s: f64,
    still_water_level_m: f64,
}

impl HullWaves {
    /// Selects the strongest waves of a planned sea, from which the motions of floating hulls are computed.
    pub fn new(plan: &Plan) -> Self {
        let plan = &plan.with_fft_size_at_most(MAX_FFT_SIZE_FOR_FLOATING_OBJECTS);
        let rms_m = MAX_HEIGHT_ERROR_TO_HS * plan.hs_m();
        let [heave_waves, tilt_waves] = StrongestWaves::for_height_error_and_count(plan, rms_m, TILT_WAVE_COUNT);
        Self {
            heave_waves,
            tilt_waves,
            upwind: plan.downwind.map(|d| -d),
            wind_m_s: plan.sea.first_system().wind_m_s,
            still_water_level_m: plan.sea.still_water_level_m,
        }
    }

    /// The same waves at a coast; see [`StrongestWaves::with_coast`]. `plan` is that from which they were selected.
    #[must_use]
    pub fn with_coast(self, plan: &Plan, transfer: &Arc<Transfer>) -> Self {
        let plan = &plan.with_fft_size_at_most(MAX_FFT_SIZE_FOR_FLOATING_OBJECTS);
        Self {
            heave_waves: self.heave_waves.with_coast(plan, transfer),
            tilt_waves: self.tilt_waves.with_coast(plan, transfer),
            ..self
        }
    }

    /// The waves from which heave is computed. Of the waves that an FFT of at most 128 points a side holds, those left
    /// out have an rms height of at most 1.8 % of the significant wave height.
    pub fn heave_waves(&self) -> &StrongestWaves {
        &self.heave_waves
    }

    /// Returns heave (m above still water), pitch and roll of a hull at time `t_s` (s), and how much higher the water
    /// is at bow and stern than in the middle (m). `bow` is the unit vector (x, z) towards the bow. Pitch is the mean
    /// slope of the water from stern to bow, roll from port to starboard (both m/m).
    fn heave_pitch_roll_sag(&self, float: &FloatingObject, bow: [f64; 2], t_s: f64) -> [f64; 4] {
        let [length, width] = half_length_and_width_m(float.kind);
        let height = |along: f64, across: f64| {
            let x = float.x_m + along * bow[0] - across * bow[1];
            let z = float.z_m + along * bow[1] + across * bow[0];
            self.tilt_waves.sample(x, z, t_s).height_m
        };
        let [at_bow, at_stern] = [height(length, 0.0), height(-length, 0.0)];
        let pitch = (at_bow - at_stern) / (2.0 * length);
        let roll = (height(0.0, width) - height(0.0, -width)) / (2.0 * width);
        let heave = self.heave_waves.sample(float.x_m, float.z_m, t_s).height_m - self.still_water_level_m;
        [heave, pitch, roll, at_bow.midpoint(at_stern) - height(0.0, 0.0)]
    }
}

/// Heel of a close-hauled cruising yacht of 11 m. The force on the sails grows with the square of the wind speed, until
/// the crew eases and reefs them. The curve is a fit to 8, 14, 18 and 21 degrees in 4, 6, 8 and 10 m/s of wind, within
/// 1 degree.
fn heel_rad(wind_m_s: f64) -> f64 {
    MAX_HEEL_RAD * (1.0 - (-(wind_m_s / HEEL_WIND_M_S).powf(HEEL_EXPONENT)).exp())
}

/// Position and attitude of the hull `float` at time `t_s` (s), with the still water at the height `level_m` (m).
/// `seas` pairs the waves of each drawn sea (several during a cross-fade, the oldest first) with the cross-fade's
/// factor on their heights. The bow points into the wind of the last sea; a yacht sails close-hauled on the port tack and
/// heels.
pub fn hull_pose(seas: &[(&HullWaves, f64)], float: &FloatingObject, t_s: f64, level_m: f64) -> HullPose {
    let (upwind, wind_m_s) = seas.last().map_or(([0.0, -1.0], 0.0), |(waves, _)| (waves.upwind, waves.wind_m_s));
    let (turn, heel) = match float.kind {
        FloatingObjectKind::Buoy | FloatingObjectKind::Boat => (0.0, 0.0),
        FloatingObjectKind::Yacht => (CLOSE_HAULED_RAD, heel_rad(wind_m_s)),
    };
    let (sin, cos) = f64::sin_cos(turn);
    let bow = [cos * upwind[0] - sin * upwind[1], cos * upwind[1] + sin * upwind[0]];
    let mut sum = [level_m, 0.0, 0.0, 0.0];
    for (waves, amplitude) in seas {
        let parts = waves.heave_pitch_roll_sag(float, bow, t_s);
        sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum += amplitude * part);
    }
    let [height_m, pitch, roll, water_sag_m] = sum;
    let unit = |v: DVec3| v / v.length();
    let forward = unit(DVec3::new(bow[0], pitch, bow[1]));
    let starboard = unit(DVec3::new(-bow[1], roll - heel.tan(), bow[0]));
    let up = unit(starboard.cross(forward)).to_array();
    let (position_m, forward) = ([float.x_m, height_m, float.z_m], forward.to_array());
    HullPose { kind: float.kind, position_m, up, forward, water_roll: roll, water_sag_m }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    #[test]
    fn a_yacht_heels_as_cruising_yachts_do() {
        for (wind_m_s, degrees) in [(0.0, 0.0), (4.0, 8.0), (6.0, 14.0), (8.0, 18.0), (10.0, 21.0), (30.0, 25.0)] {
            let heel_deg = heel_rad(wind_m_s).to_degrees();
            assert!((heel_deg - degrees).abs() < 1.0, "{wind_m_s} m/s: {heel_deg}");
        }
    }

    #[test]
    fn a_hull_lies_on_the_water() {
        let plan = |state: &str| Plan::new(&query::parse(state).0);
        let waves = HullWaves::new(&plan("wind=12&n=64&level=2"));
        for kind in FloatingObjectKind::ALL {
            let float = FloatingObject { kind, x_m: 30.0, z_m: 7.0 };
            for t in 0..20 {
                let pose = hull_pose(&[(&waves, 1.0)], &float, f64::from(t), 2.0);
                let dot: f64 = (0..3).map(|i| pose.up[i] * pose.forward[i]).sum();
                assert!(dot.abs() < 1e-9 && pose.up[1] > 0.8, "{pose:?}");
                assert!((pose.position_m[1] - 2.0).abs() < 3.0);
            }
        }
        let calm = HullWaves::new(&plan("wind=0&n=64"));
        let pose = hull_pose(
            &[(&calm, 1.0)],
            &FloatingObject { kind: FloatingObjectKind::Boat, x_m: 0.0, z_m: 0.0 },
            3.0,
            0.0,
        );
        assert!((pose.up[1] - 1.0).abs() < 1e-9 && pose.position_m[1].abs() < 1e-9, "{pose:?}");
    }
}
