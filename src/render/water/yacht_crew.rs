//! The crew of the sailing yacht: two persons of rounded limbs, who sit on the windward side.

use super::hull_shapes::{DARK_GREY, HullFacet, RED, WHITE};
use super::yacht_shape::{NAVY, smooth_sheet};
use glam::DVec3;
use std::f64::consts::TAU;

const YELLOW: u32 = 0x0018_98d8;
const SKIN: u32 = 0x0068_88b8;
const HAIR: u32 = 0x0020_3040;

/// Adds a limb: rings around its joints, each with its place and its radius, m, and the paint above.
fn limb(facets: &mut Vec<HullFacet>, joints: &[(DVec3, f64, u32)]) {
    const SIDES: usize = 8;
    let along = (joints[joints.len() - 1].0 - joints[0].0).normalize_or(DVec3::Y);
    let right = along.any_orthonormal_vector();
    let ahead = along.cross(right);
    let ring = |&(at, radius_m, _): &(DVec3, f64, u32)| {
        let corner = |i: usize| {
            let (sin, cos) = (TAU * i as f64 / SIDES as f64).sin_cos();
            at + (right * cos - ahead * sin) * radius_m
        };
        (0..=SIDES).map(corner).collect::<Vec<_>>()
    };
    let rings: Vec<_> = joints.iter().map(ring).collect();
    smooth_sheet(facets, &rings, |i| joints[i].2, |_, _| 0);
}

/// Adds a person who sits at `seat` and looks along `ahead`. `hand` is where the hands are and `foot` where the feet
/// are, ahead, to the right and above the seat, m.
fn person(facets: &mut Vec<HullFacet>, seat: DVec3, ahead: DVec3, [hand, foot]: [DVec3; 2], [jacket, cap]: [u32; 2]) {
    let right = ahead.cross(DVec3::Y);
    let at = |[x, y, z]: [f64; 3]| seat + ahead * x + right * y + DVec3::Y * z;
    let torso = [(-0.06, 0.14, 0.02), (0.0, 0.19, 0.12), (0.03, 0.16, 0.3), (0.05, 0.2, 0.48), (0.06, 0.13, 0.58)];
    let mut joints: Vec<_> = torso.map(|(x, radius_m, y)| (at([x, 0.0, y]), radius_m, jacket)).to_vec();
    joints.push((at([0.07, 0.0, 0.62]), 0.06, SKIN));
    limb(facets, &joints);
    // The head, from the neck up: the face, then a cap.
    let head = [(0.62, 0.06, SKIN), (0.68, 0.095, SKIN), (0.77, 0.115, cap), (0.85, 0.09, cap), (0.885, 0.0, cap)];
    limb(facets, &head.map(|(y, radius_m, paint)| (at([0.09, 0.0, y]), radius_m, paint)));
    limb(facets, &[(at([0.07, 0.0, 0.73]), 0.1, HAIR), (at([-0.03, 0.0, 0.72]), 0.06, HAIR)]);
    for side in [-1.0, 1.0] {
        let [elbow, knee] = [[0.5 * hand.x - 0.02, side * 0.27, 0.26], [0.5 * foot.x + 0.22, side * 0.13, 0.1]];
        limb(
            facets,
            &[
                (at([0.05, side * 0.16, 0.54]), 0.09, jacket),
                (at(elbow), 0.065, jacket),
                (at([hand.x, hand.y + side * 0.12, hand.z]), 0.05, SKIN),
            ],
        );
        limb(
            facets,
            &[
                (at([0.0, side * 0.1, 0.08]), 0.12, NAVY),
                (at(knee), 0.085, NAVY),
                (at([foot.x, side * 0.14, foot.z]), 0.06, DARK_GREY),
            ],
        );
        let foot_at = [foot.x, side * 0.14, foot.z];
        limb(facets, &[(at(foot_at), 0.06, WHITE), (at([foot.x + 0.2, foot_at[1], foot.z - 0.02]), 0.03, WHITE)]);
    }
}

/// The helmsman at the wheel, who looks ahead, and one of the crew on the windward deck, who looks to leeward.
pub fn crew(facets: &mut Vec<HullFacet>) {
    let place = |x, y, z| DVec3::new(x, y, z);
    let (at_wheel, to_floor) = (place(0.42, 0.3, 0.3), place(0.35, 0.0, -0.42));
    person(facets, place(-0.95, 1.38, 4.1), DVec3::new(0.25, 0.0, -0.97), [at_wheel, to_floor], [RED, WHITE]);
    let (on_knees, braced) = (place(0.4, 0.0, 0.18), place(0.55, 0.0, -0.12));
    person(facets, place(-1.4, 1.1, 1.9), DVec3::new(0.9, 0.0, -0.43), [on_knees, braced], [YELLOW, NAVY]);
}
