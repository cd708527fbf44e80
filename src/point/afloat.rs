//! Things that float: where they are, and how they lie on the waves.
//!
//! They ride on [`Heights`], the sum of the very waves that the GPU draws, at the time of the frame: nothing is read back, so
//! nothing is late, whatever the frame rate.

use super::heights::Heights;
use crate::state::floats::{Float, FloatKind};
use crate::waves::Plan;

/// Rms error of a height over Hs.
const ERROR: f64 = 0.018;
/// Waves that tilt a hull: the long ones; short ones slap against it.
const TILTING: usize = 500;
/// More points of a lattice only add short waves.
const MOST_POINTS: u32 = 128;

/// How something lies on the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// What it is.
    pub kind: FloatKind,
    /// Point of its waterline in the middle, m: the surface there.
    pub place: [f64; 3],
    /// Unit vector up its mast.
    pub up: [f64; 3],
    /// Unit vector to its bow.
    pub ahead: [f64; 3],
}

/// Half the length and half the width of what lies in the water, m.
fn half_m(kind: FloatKind) -> [f64; 2] {
    match kind {
        FloatKind::Buoy => [0.8, 0.8],
        FloatKind::Boat => [3.2, 1.0],
    }
}

/// The waves under what floats.
#[derive(Clone, Debug)]
pub struct Waterline {
    exact: Heights,
    long: Heights,
    bow: [f64; 2],
    level_m: f64,
}

impl Waterline {
    /// For a sea.
    pub fn new(plan: &Plan) -> Self {
        let plan = &plan.coarser(MOST_POINTS);
        let [x, z] = plan.downwind;
        Self {
            exact: Heights::for_error(plan, ERROR * plan.hs_m()),
            long: Heights::new(plan, TILTING),
            bow: [-x, -z],
            level_m: plan.sea.level_m,
        }
    }

    /// The waves that heights are summed of.
    pub fn heights(&self) -> &Heights {
        &self.exact
    }

    /// Height over the still water, and the mean slope under the hull, along and across it.
    fn lies(&self, float: &Float, bow: [f64; 2], t_s: f64) -> [f64; 3] {
        let [length, width] = half_m(float.kind);
        let ([bx, bz], [sx, sz]) = (bow, [-bow[1], bow[0]]);
        let at = |along: f64, across: f64| {
            let [x, z] = [float.x_m + along * bx + across * sx, float.z_m + along * bz + across * sz];
            self.long.sample(x, z, t_s).height_m
        };
        let pitch = (at(length, 0.0) - at(-length, 0.0)) / (2.0 * length);
        let roll = (at(0.0, width) - at(0.0, -width)) / (2.0 * width);
        [self.exact.sample(float.x_m, float.z_m, t_s).height_m - self.level_m, pitch, roll]
    }
}

/// How something lies at time `t_s` on the sum of seas, each with its amplitude, over still water at `level_m`. The bow points
/// against the wind of the last.
pub fn pose(seas: &[(&Waterline, f64)], float: &Float, t_s: f64, level_m: f64) -> Pose {
    let bow = seas.last().map_or([0.0, -1.0], |(line, _)| line.bow);
    let mut sum = [level_m, 0.0, 0.0];
    for (line, weight) in seas {
        let lies = line.lies(float, bow, t_s);
        for (sum, part) in sum.iter_mut().zip(lies) {
            *sum += weight * part;
        }
    }
    let [height_m, pitch, roll] = sum;
    let ahead = unit([bow[0], pitch, bow[1]]);
    let side = unit([-bow[1], roll, bow[0]]);
    Pose { kind: float.kind, place: [float.x_m, height_m, float.z_m], up: unit(cross(side, ahead)), ahead }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    #[test]
    fn a_hull_lies_on_the_water() {
        let plan = |state: &str| Plan::new(&query::parse(state).0);
        let line = Waterline::new(&plan("wind=12&n=64&level=2"));
        for kind in [FloatKind::Buoy, FloatKind::Boat] {
            let float = Float { kind, x_m: 30.0, z_m: 7.0 };
            for t in 0..20 {
                let pose = pose(&[(&line, 1.0)], &float, f64::from(t), 2.0);
                let dot: f64 = (0..3).map(|i| pose.up[i] * pose.ahead[i]).sum();
                assert!(dot.abs() < 1e-9 && pose.up[1] > 0.8, "{pose:?}");
                // Port is to the left of the bow when the mast is up.
                assert!((pose.place[1] - 2.0).abs() < 3.0);
            }
        }
        // On a flat sea everything stands upright.
        let calm = Waterline::new(&plan("wind=0&n=64"));
        let pose = pose(&[(&calm, 1.0)], &Float { kind: FloatKind::Boat, x_m: 0.0, z_m: 0.0 }, 3.0, 0.0);
        assert!((pose.up[1] - 1.0).abs() < 1e-9 && pose.place[1].abs() < 1e-9, "{pose:?}");
    }
}
