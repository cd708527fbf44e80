//! The shapes of seamarks: a lighthouse with its keeper's house, harbour lights, and beacons on piles. Axes: -z points
//! out to sea, x to the right as one looks there, y up; y = 0 is the ground.

use super::hull_shapes::{DARK_GREY, HullFacet, HullLine, RED, surface_of_revolution};
use crate::coast::seamark::SeamarkKind;
use glam::DVec3;
use std::f64::consts::TAU;

/// Limewashed masonry, and where rain and salt have darkened it. Colours are as in [`HullFacet::colour`].
const LIMEWASH: u32 = 0x00d6_e0e2;
const STAINED_LIMEWASH: u32 = 0x00b4_c4c8;
const GRANITE: u32 = 0x0078_868c;
const SLATE: u32 = 0x0058_4e48;
const GREEN: u32 = 0x0038_6c18;
const GLASS: u32 = 0x0060_5c50;
/// Lenses of lamps: white, red and green. The upper 8 bits mark a lamp.
const WHITE_LAMP: u32 = 0xffb8_e8ff;
const RED_LAMP: u32 = 0xff20_20ff;
const GREEN_LAMP: u32 = 0xff60_ff20;
/// How far walls go into the ground, which is not level, m.
const FOUNDATION_M: f64 = 3.0;

/// Radius (m) of the lighthouse's tower at its foot and below its gallery, and the height (m) of the gallery's floor.
const TOWER_RADII_M: [f64; 2] = [3.0, 2.0];
const GALLERY_HEIGHT_M: f64 = 15.0;
/// Height (m) of the platform of a pile over the bed.
const PLATFORM_HEIGHT_M: f64 = 8.0;
/// Middle of the keeper's house on the ground, m.
const HOUSE_MIDDLE_M: DVec3 = DVec3::new(-10.5, 0.0, 3.0);
/// Radius (m) of the gallery's railing.
const RAILING_RADIUS_M: f64 = 2.75;

/// Radius of the lighthouse's tower at the height `y`, m: it widens towards the foot, as masonry towers do.
fn tower_radius_m(y: f64) -> f64 {
    let down = (1.0 - y / GALLERY_HEIGHT_M).clamp(0.0, 1.0);
    TOWER_RADII_M[1] + (TOWER_RADII_M[0] - TOWER_RADII_M[1]) * (0.55 * down + 0.45 * down.powi(4))
}

/// Triangles of a seamark.
pub fn seamark_facets(kind: SeamarkKind) -> Vec<HullFacet> {
    match kind {
        SeamarkKind::Lighthouse => lighthouse(),
        SeamarkKind::PortLight => harbour_light(RED, RED_LAMP),
        SeamarkKind::StarboardLight => harbour_light(GREEN, GREEN_LAMP),
        SeamarkKind::PortBeacon => pile_beacon(RED, RED_LAMP, [0.55, 0.55]),
        SeamarkKind::StarboardBeacon => pile_beacon(GREEN, GREEN_LAMP, [0.6, 0.05]),
    }
}

/// Railings, ladders, the bars of lanterns, and lightning rods of a seamark.
pub fn seamark_lines(kind: SeamarkKind) -> Vec<HullLine> {
    match kind {
        SeamarkKind::Lighthouse => {
            let mut lines = railing(RAILING_RADIUS_M, GALLERY_HEIGHT_M + 0.15, 1.1);
            lines.extend(lantern_bars(1.42, [GALLERY_HEIGHT_M + 1.6, GALLERY_HEIGHT_M + 3.9]));
            lines.push(upright([0.0, 0.0], [GALLERY_HEIGHT_M + 5.6, GALLERY_HEIGHT_M + 7.4], 0.025, DARK_GREY));
            lines
        }
        SeamarkKind::PortBeacon | SeamarkKind::StarboardBeacon => {
            let mut lines = railing(1.0, PLATFORM_HEIGHT_M + 0.2, 1.0);
            lines.push(upright([0.75, 0.0], [PLATFORM_HEIGHT_M - 5.0, PLATFORM_HEIGHT_M], 0.04, DARK_GREY));
            lines.push(upright([0.75, 0.35], [PLATFORM_HEIGHT_M - 5.0, PLATFORM_HEIGHT_M], 0.04, DARK_GREY));
            lines
        }
        SeamarkKind::PortLight | SeamarkKind::StarboardLight => {
            let mut lines = railing(1.35, 6.75, 1.0);
            lines.extend(lantern_bars(0.47, [7.5, 8.3]));
            lines.push(upright([0.0, 0.0], [8.8, 10.2], 0.02, DARK_GREY));
            lines
        }
    }
}

/// Whether a triangle belongs to the lens of a lamp.
pub fn is_lamp(facet: &HullFacet) -> bool {
    facet.colour >= 0xff00_0000
}

fn lighthouse() -> Vec<HullFacet> {
    let g = GALLERY_HEIGHT_M;
    let mut profile = vec![(3.5, -FOUNDATION_M, GRANITE), (3.5, 0.7, GRANITE), (3.05, 0.75, STAINED_LIMEWASH)];
    let courses = [(1.2, STAINED_LIMEWASH), (2.2, LIMEWASH), (5.0, LIMEWASH), (8.0, LIMEWASH), (11.0, LIMEWASH)];
    profile.extend(courses.map(|(y, colour)| (tower_radius_m(y), y, colour)));
    profile.extend([
        (tower_radius_m(g - 1.1), g - 1.1, STAINED_LIMEWASH),
        // A cornice carries the gallery.
        (tower_radius_m(g - 0.7), g - 0.7, GRANITE),
        (2.6, g - 0.15, GRANITE),
        (2.85, g - 0.1, GRANITE),
        (2.85, g + 0.15, GRANITE),
        (1.5, g + 0.2, RED),
        (1.5, g + 1.5, RED),
        (1.42, g + 1.6, GLASS),
        (1.42, g + 2.25, WHITE_LAMP),
        (1.42, g + 3.25, GLASS),
        (1.42, g + 3.9, RED),
        (1.8, g + 3.95, RED),
        (1.6, g + 4.25, RED),
        (1.1, g + 4.85, RED),
        (0.4, g + 5.2, RED),
        (0.28, g + 5.25, RED),
        (0.34, g + 5.5, RED),
        (0.12, g + 5.75, RED),
        (0.0, g + 5.78, RED),
    ]);
    let mut facets = surface_of_revolution(&profile);
    for (y, around) in [(3.6, 0.0), (7.2, 0.9), (10.8, -0.5), (5.6, 3.4), (9.2, 2.2)] {
        facets.extend(tower_window(y, around));
    }
    house(&mut facets);
    facets
}

/// A dark window of the tower at the height `y`, m, in the direction `around`, rad from the sea.
fn tower_window(y: f64, around: f64) -> Vec<HullFacet> {
    let (sin, cos) = around.sin_cos();
    let (out, aside) = (DVec3::new(sin, 0.0, -cos), DVec3::new(cos, 0.0, sin));
    let at = |x: f64, up: f64| out * (tower_radius_m(y + up) + 0.04) + aside * x + DVec3::Y * (y + up);
    quad([at(-0.35, -0.6), at(0.35, -0.6), at(0.35, 0.6), at(-0.35, 0.6)], out, DARK_GREY)
}

/// The keeper's house, to the left of the tower and a little inland: two gables, two chimneys, doors and windows.
fn house(facets: &mut Vec<HullFacet>) {
    const HALF_M: [f64; 2] = [5.2, 3.0];
    const EAVES_HEIGHT_M: f64 = 3.2;
    const RIDGE_HEIGHT_M: f64 = 5.6;
    let at = |x: f64, y: f64, z: f64| HOUSE_MIDDLE_M + DVec3::new(x, y, z);
    let [length, width] = HALF_M;
    facets.extend(walls(HOUSE_MIDDLE_M, HALF_M, [-FOUNDATION_M, EAVES_HEIGHT_M]));
    for side in [-1.0, 1.0] {
        let (x, z) = (side * length, side * width);
        let gable = [at(x, EAVES_HEIGHT_M, -width), at(x, EAVES_HEIGHT_M, width), at(x, RIDGE_HEIGHT_M, 0.0)];
        facets.push(triangle(gable, DVec3::X * side, LIMEWASH));
        // The roof overhangs.
        let (eaves, over) = (1.08 * z, length + 0.25);
        let low = EAVES_HEIGHT_M - 0.08 * (RIDGE_HEIGHT_M - EAVES_HEIGHT_M);
        let roof = [
            at(-over, low, eaves),
            at(over, low, eaves),
            at(over, RIDGE_HEIGHT_M, 0.0),
            at(-over, RIDGE_HEIGHT_M, 0.0),
        ];
        facets.extend(quad(roof, DVec3::new(0.0, width, side * (RIDGE_HEIGHT_M - EAVES_HEIGHT_M)).normalize(), SLATE));
        for x in [-3.4, -1.2, 1.6, 3.6] {
            let door = x == -1.2;
            let (half, low, high) = if door { (0.5, 0.0, 2.1) } else { (0.45, 0.9, 2.2) };
            let z = side * (width + 0.03);
            let corners = [at(x - half, low, z), at(x + half, low, z), at(x + half, high, z), at(x - half, high, z)];
            facets.extend(quad(corners, DVec3::Z * side, if door { RED } else { DARK_GREY }));
        }
        let chimney = at(0.82 * x, 0.0, 0.0);
        facets.extend(walls(chimney, [0.45, 0.45], [4.6, 6.6]));
        let top = [(-0.45, -0.45), (0.45, -0.45), (0.45, 0.45), (-0.45, 0.45)];
        facets.extend(quad(top.map(|(x, z)| chimney + DVec3::new(x, 6.6, z)), DVec3::Y, DARK_GREY));
    }
}

/// Four limewashed walls around `middle`: half the length along x and half the width along z, and their heights, m.
fn walls(middle: DVec3, [length, width]: [f64; 2], [low, high]: [f64; 2]) -> Vec<HullFacet> {
    let wall = |out: DVec3| {
        let (aside, half) = (DVec3::new(-out.z, 0.0, out.x), DVec3::new(length, 0.0, width));
        let at = |end: f64, y: f64| middle + (out + end * aside) * half + DVec3::Y * y;
        quad([at(-1.0, low), at(1.0, low), at(1.0, high), at(-1.0, high)], out, LIMEWASH)
    };
    [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z].into_iter().flat_map(wall).collect()
}

/// The light at the head of a breakwater.
fn harbour_light(paint: u32, lamp: u32) -> Vec<HullFacet> {
    surface_of_revolution(&[
        (1.7, -FOUNDATION_M, GRANITE),
        (1.7, 0.9, GRANITE),
        (1.1, 0.95, paint),
        (0.95, 3.5, paint),
        (0.82, 6.3, paint),
        (1.1, 6.55, paint),
        (1.4, 6.6, paint),
        (1.4, 6.75, paint),
        (0.52, 6.8, paint),
        (0.52, 7.4, paint),
        (0.47, 7.5, lamp),
        (0.47, 8.3, paint),
        (0.62, 8.35, paint),
        (0.4, 8.65, paint),
        (0.08, 8.8, paint),
        (0.0, 8.82, paint),
    ])
}

/// A beacon on a pile in shallow water, with a platform, a lamp, and a topmark: its radii at its foot and its head, m.
fn pile_beacon(paint: u32, lamp: u32, topmark_m: [f64; 2]) -> Vec<HullFacet> {
    let p = PLATFORM_HEIGHT_M;
    surface_of_revolution(&[
        (0.42, -FOUNDATION_M, DARK_GREY),
        (0.42, 0.45 * p, paint),
        (0.42, p, DARK_GREY),
        (1.05, p + 0.05, DARK_GREY),
        (1.05, p + 0.2, DARK_GREY),
        (0.2, p + 0.22, DARK_GREY),
        (0.2, p + 1.5, lamp),
        (0.2, p + 1.8, DARK_GREY),
        (0.06, p + 1.85, DARK_GREY),
        (0.06, p + 2.2, paint),
        (topmark_m[0], p + 2.25, paint),
        (topmark_m[1], p + 3.3, paint),
        (0.0, p + 3.35, paint),
    ])
}

/// A railing of posts and two rails around the y axis: radius, height of its foot, and its height, m.
fn railing(radius_m: f64, foot_m: f64, height_m: f64) -> Vec<HullLine> {
    const POSTS: u32 = 20;
    let place = |post: u32| {
        let (sin, cos) = (TAU * f64::from(post) / f64::from(POSTS)).sin_cos();
        [radius_m * cos, radius_m * sin]
    };
    let mut lines = Vec::new();
    for post in 0..POSTS {
        let [from, to] = [post, post + 1].map(place);
        lines.push(upright(from, [foot_m, foot_m + height_m], 0.02, DARK_GREY));
        for share in [0.5, 1.0] {
            let ends = [from, to].map(|[x, z]| DVec3::new(x, foot_m + share * height_m, z));
            lines.push(HullLine { ends, half_width_m: 0.02, colour: DARK_GREY });
        }
    }
    lines
}

/// The bars between the panes of a lantern.
fn lantern_bars(radius_m: f64, heights_m: [f64; 2]) -> Vec<HullLine> {
    let bar = |i: u32| {
        let (sin, cos) = (TAU * f64::from(i) / 10.0).sin_cos();
        upright([radius_m * cos, radius_m * sin], heights_m, 0.035, RED)
    };
    (0..10).map(bar).collect()
}

fn upright([x, z]: [f64; 2], heights_m: [f64; 2], half_width_m: f64, colour: u32) -> HullLine {
    HullLine { ends: heights_m.map(|y| DVec3::new(x, y, z)), half_width_m, colour }
}

fn triangle(corners: [DVec3; 3], normal: DVec3, colour: u32) -> HullFacet {
    HullFacet { corners, normals: [normal; 3], colour, cloth: [0; 3] }
}

fn quad([a, b, c, d]: [DVec3; 4], normal: DVec3, colour: u32) -> Vec<HullFacet> {
    [[a, b, c], [a, c, d]].map(|corners| triangle(corners, normal, colour)).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seamarks_face_outwards_and_stand_in_the_ground() {
        for kind in SeamarkKind::ALL {
            let facets = seamark_facets(kind);
            let corners = || facets.iter().flat_map(|facet| facet.corners);
            let (low, high) = corners().fold((0.0_f64, 0.0_f64), |(low, high), p| (low.min(p.y), high.max(p.y)));
            assert!(low == -FOUNDATION_M && (8.0..25.0).contains(&high), "{kind:?}: {low} to {high} m");
            // The tower's sides look away from its axis.
            let tower = facets.iter().filter(|facet| facet.corners.iter().all(|p| p.x.hypot(p.z) < 4.0));
            for facet in tower.filter(|facet| facet.normals[0].y.abs() < 0.5) {
                let middle = (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
                assert!(facet.normals[0].dot(DVec3 { y: 0.0, ..middle }) > 0.0, "{kind:?}: {middle}");
            }
            // Normals are those of the triangles, but for which side is meant, and the house's walls look away from it.
            for facet in &facets {
                let [a, b, c] = facet.corners;
                let flat = (b - a).cross(c - a);
                let along = facet.normals.iter().map(|n| n.dot(flat.normalize_or_zero()).abs()).fold(1.0, f64::min);
                assert!(along > 0.9 || flat.length() < 1e-9, "{kind:?}: {facet:?}");
                let middle = (a + b + c) / 3.0;
                let is_wall = facet.colour == LIMEWASH && middle.x < -4.0 && middle.y < 3.0;
                let from_house = DVec3 { y: 0.0, ..middle } - HOUSE_MIDDLE_M;
                assert!(!is_wall || facet.normals[0].dot(from_house) > 0.0, "{facet:?}");
            }
            assert!(!seamark_lines(kind).is_empty() && facets.iter().any(is_lamp));
        }
    }
}
