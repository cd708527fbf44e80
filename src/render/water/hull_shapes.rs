//! The shapes of buoys and open boats: triangles in the axes of the hull, x to starboard, y up the mast, z to the stern.

use glam::DVec3;
use std::f64::consts::TAU;

/// A triangle of a floating object: corners, m, unit normals at the corners, and paint colour. Axes of the hull: x to
/// starboard, y up the mast, z to the stern.
#[derive(Clone, Copy, Debug)]
pub struct HullFacet {
    pub corners: [DVec3; 3],
    pub normals: [DVec3; 3],
    /// sRGB as 0xTTBBGGRR; TT is the fraction of the sunlight, in 255ths, that shines through a sail, or 255 for the
    /// lens of a lamp.
    pub colour: u32,
    /// Place of each corner on a sail, as packed by [`cloth_place`], or 0.
    pub cloth: [u32; 3],
}

/// A wire or rope of a floating object, in the axes of the hull, m.
#[derive(Clone, Copy)]
pub struct HullLine {
    pub ends: [DVec3; 2],
    pub half_width_m: f64,
    /// Colour, as in [`HullFacet::colour`].
    pub colour: u32,
}

/// Place on a sail as two 12-bit fractions: along the chord from the leading edge, and up from the foot. The upper 8
/// bits are free for [`in_shade`].
pub fn cloth_place([along, up]: [f64; 2]) -> u32 {
    let [along, up] = [along, up].map(|x| (4095.0 * x.clamp(0.0, 1.0)).round() as u32);
    along | up << 12
}

/// The detail of a corner from whose sunlight the fraction `shade` is taken; for a lamp, `shade` is its brightness.
pub fn in_shade(cloth: u32, shade: f64) -> u32 {
    cloth | ((255.0 * shade).round() as u32) << 24
}

/// How much a triangle stops a ray from a point that is at least 5 cm away: 1 within it, falling to 0 towards its
/// edges.
pub fn shade_of_triangle([a, b, c]: [DVec3; 3], from: DVec3, ray: DVec3) -> f64 {
    let (ab, ac) = (b - a, c - a);
    let turned = ray.cross(ac);
    let area = ab.dot(turned);
    let off = from - a;
    let crossed = off.cross(ab);
    let [u, v, distance_m] = [off.dot(turned), ray.dot(crossed), ac.dot(crossed)].map(|x| x / area);
    if distance_m > 0.05 { (u.min(v).min(1.0 - u - v) / 0.08).clamp(0.0, 1.0) } else { 0.0 }
}

/// Colour of yellow paint; the colour of each paint is as in [`HullFacet::colour`].
const YELLOW: u32 = 0x0014_b0e8;
pub const DARK_GREY: u32 = 0x0028_2828;
pub const WHITE: u32 = 0x00e8_ecec;
pub const RED: u32 = 0x0020_2ab0;
pub const WOOD: u32 = 0x0048_6a90;
const BLUE: u32 = 0x0070_4020;

/// Triangles of a surface of revolution around the y axis of a hull. `profile` has a ring of corners an entry, from
/// bottom to top: its radius (m), its height (m), and the paint of the band above it (0xBBGGRR).
pub fn surface_of_revolution(profile: &[(f64, f64, u32)]) -> Vec<HullFacet> {
    const LATHE_SIDES: usize = 20;
    let mut facets = Vec::new();
    for pair in profile.windows(2) {
        let ((r0, y0, colour), (r1, y1, _)) = (pair[0], pair[1]);
        let slope = DVec3::new(y1 - y0, r0 - r1, 0.0).normalize_or(DVec3::Y);
        let at = |r: f64, y: f64, i: usize| {
            let (sin, cos) = (TAU * i as f64 / LATHE_SIDES as f64).sin_cos();
            (DVec3::new(r * cos, y, r * sin), DVec3::new(slope.x * cos, slope.y, slope.x * sin))
        };
        for i in 0..LATHE_SIDES {
            let [a, b, c, d] = [at(r0, y0, i), at(r0, y0, i + 1), at(r1, y1, i + 1), at(r1, y1, i)];
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                facets.push(HullFacet { corners: [p.0, q.0, r.0], normals: [p.1, q.1, r.1], colour, cloth: [0; 3] });
            }
        }
    }
    facets
}

/// Triangles of a moored buoy: float, tower and lantern.
pub fn buoy_hull() -> Vec<HullFacet> {
    surface_of_revolution(&[
        (0.0, -0.6, DARK_GREY),
        (0.7, -0.45, DARK_GREY),
        (0.95, 0.0, YELLOW),
        (0.95, 0.42, YELLOW),
        (0.8, 0.55, YELLOW),
        (0.0, 0.6, YELLOW),
        (0.34, 0.6, YELLOW),
        (0.16, 1.5, RED),
        (0.13, 1.75, YELLOW),
        (0.1, 2.2, YELLOW),
        (0.2, 2.22, DARK_GREY),
        (0.2, 2.3, WHITE),
        (0.19, 2.55, WHITE),
        (0.1, 2.7, DARK_GREY),
        (0.0, 2.74, DARK_GREY),
    ])
}

/// Triangles of an open boat with benches: cross-sections from bow to stern, each from keel to gunwale, are joined.
pub fn boat_hull() -> Vec<HullFacet> {
    // Cross-sections: distance from the bow, half-width at the gunwale, height of the gunwale, height of the keel, m.
    const CROSS_SECTIONS: [[f64; 4]; 7] = [
        [0.0, 0.02, 1.05, -0.05],
        [0.7, 0.42, 0.92, -0.28],
        [1.8, 0.82, 0.78, -0.36],
        [3.2, 1.02, 0.66, -0.4],
        [4.8, 1.0, 0.6, -0.38],
        [6.2, 0.86, 0.6, -0.32],
        [7.0, 0.72, 0.64, -0.24],
    ];
    let point = |s: [f64; 4], side: f64, row: usize| {
        let [along, half, rail, keel] = s;
        let z = along - 3.4;
        match row {
            0 => DVec3::new(0.0, keel, z),
            1 => DVec3::new(side * 0.72 * half, 0.12 + 0.35 * keel, z),
            2 => DVec3::new(side * 0.95 * half, 0.45 * rail + 0.1, z),
            3 => DVec3::new(side * half, rail, z),
            // Inside: the inner edge of the gunwale, one plank thickness in, and the edge of the floor.
            4 => DVec3::new(side * (half - 0.06).max(0.0), rail, z),
            _ => DVec3::new(side * (0.62 * half - 0.05).max(0.0), 0.12, z),
        }
    };
    let colours = [BLUE, WHITE, WHITE, WOOD, WOOD];
    let mut facets = Vec::new();
    let mut quad = |[a, b, c, d]: [DVec3; 4], colour: u32| {
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            let normal = (q - p).cross(r - p);
            if normal.length_squared() > 1e-12 {
                facets.push(HullFacet { corners: [p, q, r], normals: [normal.normalize(); 3], colour, cloth: [0; 3] });
            }
        }
    };
    for pair in CROSS_SECTIONS.windows(2) {
        for side in [-1.0, 1.0] {
            for (row, colour) in colours.into_iter().enumerate() {
                let corners = [
                    point(pair[0], side, row),
                    point(pair[1], side, row),
                    point(pair[1], side, row + 1),
                    point(pair[0], side, row + 1),
                ];
                let [a, b, c, d] = corners;
                quad(if side > 0.0 { [a, d, c, b] } else { [a, b, c, d] }, colour);
            }
        }
        // The floor.
        let [a, b] = [pair[0], pair[1]].map(|s| point(s, -1.0, 5));
        let [c, d] = [pair[1], pair[0]].map(|s| point(s, 1.0, 5));
        quad([a, b, c, d], WOOD);
    }
    let stern = CROSS_SECTIONS[6];
    for row in 0..3 {
        let [a, b] = [point(stern, -1.0, row), point(stern, -1.0, row + 1)];
        let [c, d] = [point(stern, 1.0, row + 1), point(stern, 1.0, row)];
        quad([a, d, c, b], WHITE);
    }
    for along in [2.2, 3.8, 5.4] {
        let half = 0.86;
        let [z0, z1] = [along - 3.4 - 0.14, along - 3.4 + 0.14];
        quad(
            [
                DVec3::new(-half, 0.5, z0),
                DVec3::new(-half, 0.5, z1),
                DVec3::new(half, 0.5, z1),
                DVec3::new(half, 0.5, z0),
            ],
            WOOD,
        );
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hulls_face_outwards() {
        for hull in [buoy_hull(), boat_hull()] {
            let [mut out, mut inward] = [0, 0];
            for facet in &hull {
                // The bottom and the sides look away from the middle of the hull.
                let middle = (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
                if middle.y < 0.0 && facet.normals[0].z.abs() < 0.9 {
                    if facet.normals[0].dot(middle - DVec3::new(0.0, 0.3, middle.z)) > 0.0 {
                        out += 1;
                    } else {
                        inward += 1;
                    }
                }
            }
            assert!(out > 10 && inward == 0, "{out} {inward}");
        }
    }
}
