//! The shape of the sailing yacht: a hull, a cabin, a crew of two, rigging, and two curved sails that let light through.

use super::hull_shapes::{DARK_GREY, HullFacet, HullLine, WHITE, WOOD, cloth_place, surface_of_revolution};
use super::yacht_crew::crew;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub const NAVY: u32 = 0x0058_3418;
const DECK: u32 = 0x00b4_c8d4;
/// White sailcloth of mainsail and jib, which lets a quarter of the sunlight through. The colours differ invisibly, to
/// tell the two sails apart.
const SAILS: [u32; 2] = [0x40e0_ecf0, 0x40e0_ebf0];
/// White paint just above the water line, which is wet and reflects less.
const WET_WHITE: u32 = 0x00d0_d6d4;
/// Weathered teak of the cockpit.
const TEAK: u32 = 0x0068_8094;
/// Grey-blue antifouling paint below the water line.
const ANTIFOULING: u32 = 0x0068_4838;
/// Distance of the mast's foot before the middle of the hull, m.
const MAST_AHEAD_M: f64 = 0.85;
/// Height of the top of the mast above the water, m.
const MAST_TOP_M: f64 = 15.0;

/// Cross-sections of the hull from bow to stern: position along z, half-width at the deck, height of the deck, and
/// height of the lowest point, m.
const CROSS_SECTIONS: [[f64; 4]; 9] = [
    [-5.6, 0.02, 1.36, 0.6],
    [-5.1, 0.32, 1.3, -0.15],
    [-4.0, 0.88, 1.2, -0.38],
    [-2.4, 1.42, 1.1, -0.54],
    [-0.6, 1.7, 1.02, -0.6],
    [1.4, 1.72, 0.98, -0.57],
    [3.2, 1.56, 0.98, -0.42],
    [4.6, 1.36, 1.0, -0.2],
    [5.4, 1.22, 1.04, -0.04],
];

/// Triangles, but for the mast, of a sailing yacht on the port tack: the wind comes from port ahead, and the sails stand to starboard.
pub fn yacht_hull() -> Vec<HullFacet> {
    let mut facets = Vec::new();
    hull_and_deck(&mut facets);
    cabin(&mut facets);
    cockpit(&mut facets);
    crew(&mut facets);
    sails(&mut facets);
    facets
}

/// Triangles of the yacht's mast, for pictures without lines. [`yacht_lines`] has it, too.
pub fn yacht_mast() -> Vec<HullFacet> {
    moved(surface_of_revolution(&[(0.085, 0.9, WHITE), (0.07, MAST_TOP_M, WHITE)]), -MAST_AHEAD_M * DVec3::Z).collect()
}

/// Adds the triangles of a sheet of points, rows of equal length, with normals that vary smoothly. They point to the
/// side of `across x along`, with `across` from row to row and `along` within a row. `colour` gives the paint of the
/// band between a row and the next, `cloth` the place on a sail of a row's point ([`HullFacet::cloth`]).
pub fn smooth_sheet(
    facets: &mut Vec<HullFacet>,
    rows: &[Vec<DVec3>],
    colour: impl Fn(usize) -> u32,
    cloth: impl Fn(usize, usize) -> u32,
) {
    let normal = |row: usize, i: usize| {
        let across = rows[(row + 1).min(rows.len() - 1)][i] - rows[row.saturating_sub(1)][i];
        let along = rows[row][(i + 1).min(rows[row].len() - 1)] - rows[row][i.saturating_sub(1)];
        across.cross(along).normalize_or(DVec3::Y)
    };
    for row in 0..rows.len() - 1 {
        for i in 0..rows[row].len() - 1 {
            let at = |(row, i): (usize, usize)| (rows[row][i], normal(row, i), cloth(row, i));
            let [a, b, c, d] = [(row, i), (row, i + 1), (row + 1, i + 1), (row + 1, i)].map(at);
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let (corners, normals) = ([p.0, q.0, r.0], [p.1, q.1, r.1]);
                facets.push(HullFacet { corners, normals, colour: colour(row), cloth: [p.2, q.2, r.2] });
            }
        }
    }
}

/// Heights at which the antifouling ends, the white of the side begins, and the white is dry, m; the line between the
/// first two is dark blue.
const SIDE_LEVELS_M: [f64; 3] = [-0.06, 0.06, 0.18];
/// Paints of the bands of the hull's side, from the lowest point to the deck.
const SIDE_PAINTS: [u32; 9] = [ANTIFOULING, ANTIFOULING, ANTIFOULING, NAVY, WET_WHITE, WHITE, WHITE, NAVY, WHITE];

fn hull_and_deck(facets: &mut Vec<HullFacet>) {
    for side in [-1.0, 1.0] {
        let row_points = |row: usize| {
            let mut row: Vec<DVec3> =
                CROSS_SECTIONS.into_iter().map(|section| side_point(section, side, row)).collect();
            // The order of the points decides which side is outside.
            if side < 0.0 {
                row.reverse();
            }
            row
        };
        let rows: [_; SIDE_PAINTS.len() + 1] = std::array::from_fn(row_points);
        smooth_sheet(facets, &rows, |row| SIDE_PAINTS[row], |_, _| 0);
    }
    let edge = |side: f64| CROSS_SECTIONS.map(|[z, half, deck, _]| DVec3::new(side * half, deck, z)).to_vec();
    let middle = CROSS_SECTIONS.map(|[z, _, deck, _]| DVec3::new(0.0, deck + 0.06, z)).to_vec();
    smooth_sheet(facets, &[edge(1.0), middle, edge(-1.0)], |_| DECK, |_, _| 0);
    let stern = CROSS_SECTIONS[CROSS_SECTIONS.len() - 1];
    let across = |side: f64| (0..=SIDE_PAINTS.len()).map(|row| side_point(stern, side, row)).collect::<Vec<_>>();
    smooth_sheet(facets, &[across(-1.0), across(1.0)], |_| WHITE, |_, _| 0);
}

/// Point of the hull's side at a cross-section. The rows follow level lines up to the paint's edge above the water line,
/// then the deck.
fn side_point([z, half, deck, low]: [f64; 4], side: f64, row: usize) -> DVec3 {
    let bottom = |share: f64| low + share * (SIDE_LEVELS_M[0] - low).max(0.0);
    let y = match row {
        0 => low,
        1 => bottom(0.12),
        2 => bottom(0.5),
        3..=5 => SIDE_LEVELS_M[row - 3].max(low),
        6 => SIDE_LEVELS_M[2].max(low).midpoint(deck - 0.2),
        7 => deck - 0.2,
        8 => deck - 0.12,
        _ => deck,
    };
    side_point_at([z, half, deck, low], side, y)
}

/// Point of the hull's side at a cross-section and at the height `y`, m.
fn side_point_at([z, half, deck, low]: [f64; 4], side: f64, y: f64) -> DVec3 {
    let up = ((y - low) / (deck - low)).clamp(0.0, 1.0);
    let out = (FRAC_PI_2 * up.powf(0.6)).sin();
    DVec3::new(side * out * half, y, z)
}

/// The line from bow to stern along which calm water meets a side of the hull, which heels by `heel_rad` to starboard.
/// Axes as those of the hull, but upright, m.
pub fn water_line(side: f64, heel_rad: f64) -> Vec<DVec3> {
    let (sin, cos) = heel_rad.sin_cos();
    let upright = |p: DVec3| DVec3::new(p.x * cos + p.y * sin, p.y * cos - p.x * sin, p.z);
    let meets = |section: [f64; 4]| {
        let [_, _, deck, low] = section;
        let (mut below, mut above) = (low, deck);
        for _ in 0..12 {
            let middle = below.midpoint(above);
            if upright(side_point_at(section, side, middle)).y < 0.0 { below = middle } else { above = middle }
        }
        DVec3 { y: 0.0, ..upright(side_point_at(section, side, above)) }
    };
    CROSS_SECTIONS.iter().filter(|[.., low]| *low < 0.0).map(|&section| meets(section)).collect()
}

fn cabin(facets: &mut Vec<HullFacet>) {
    // Half-width and height above the deck of the rows from the deck's edge up to the roof, and the paint above each.
    const ROWS: [(f64, f64, u32); 5] =
        [(0.98, 0.0, WHITE), (0.95, 0.16, DARK_GREY), (0.88, 0.36, WHITE), (0.8, 0.46, DECK), (0.0, 0.54, DECK)];
    for side in [-1.0, 1.0] {
        let rows = ROWS.map(|(half, up, _)| {
            let mut row = [[-2.6, 0.5, 0.45], [-1.2, 0.9, 1.0], [0.6, 1.0, 1.0], [1.7, 0.95, 0.95]]
                .map(|[z, narrow, low]| DVec3::new(side * half * narrow, 0.98 + up * low, z))
                .to_vec();
            if side < 0.0 {
                row.reverse();
            }
            row
        });
        smooth_sheet(facets, &rows, |row| ROWS[row].2, |_, _| 0);
    }
    // The companionway, the after wall of the cabin.
    let wall = |side: f64| ROWS.map(|(half, up, _)| DVec3::new(side * 0.95 * half, 0.98 + 0.95 * up, 1.7)).to_vec();
    smooth_sheet(facets, &[wall(-1.0), wall(1.0)], |_| WOOD, |_, _| 0);
}

/// The hood of canvas over the companionway, and the seats of the cockpit around a floor of teak.
fn cockpit(facets: &mut Vec<HullFacet>) {
    const ARCH: usize = 10;
    let arch = |[z, half, high]: [f64; 3]| {
        let point = |i: usize| {
            let (sin, cos) = (PI * i as f64 / ARCH as f64).sin_cos();
            DVec3::new(half * cos.signum() * cos.abs().sqrt(), 1.42 + high * sin.sqrt(), z)
        };
        (0..=ARCH).map(point).collect::<Vec<_>>()
    };
    let hood = [[0.5, 0.75, 0.02], [1.0, 0.86, 0.42], [1.5, 0.94, 0.58], [2.15, 0.95, 0.56]].map(arch);
    smooth_sheet(facets, &hood, |row| if row == 0 { DARK_GREY } else { NAVY }, |_, _| 0);
    // Seats and backrests on each side: half-width and height above the deck, from outside to the floor.
    const ROWS: [(f64, f64, u32); 5] =
        [(1.16, 0.0, WHITE), (1.1, 0.38, WHITE), (0.98, 0.38, WHITE), (0.92, 0.12, TEAK), (0.0, 0.12, TEAK)];
    for side in [-1.0, 1.0] {
        let rows = ROWS.map(|(half, up, _)| {
            let mut row = [1.7, 3.2, 4.7].map(|z| DVec3::new(side * half * (1.05 - 0.02 * z), 0.99 + up, z)).to_vec();
            if side < 0.0 {
                row.reverse();
            }
            row
        });
        smooth_sheet(facets, &rows, |row| ROWS[row].2, |_, _| 0);
    }
}

fn moved(facets: Vec<HullFacet>, by: DVec3) -> impl Iterator<Item = HullFacet> {
    facets.into_iter().map(move |f| HullFacet { corners: f.corners.map(|c| c + by), ..f })
}

/// Mast, stays, shrouds, spreaders, guard rails and sheets.
pub fn yacht_lines() -> Vec<HullLine> {
    let mast = |y: f64| DVec3::new(0.0, y, -MAST_AHEAD_M);
    let mut lines = Vec::new();
    let mut line = |a: DVec3, b: DVec3, half_width_m: f64, colour: u32| {
        lines.push(HullLine { ends: [a, b], half_width_m, colour });
    };
    // As lines, the two parts of the mast keep smooth edges at any distance.
    line(mast(0.9), mast(7.6), 0.085, WHITE);
    line(mast(7.6), mast(MAST_TOP_M), 0.07, WHITE);
    line(mast(MAST_TOP_M - 0.1), DVec3::new(0.0, 1.05, 5.35), 0.006, DARK_GREY);
    line(mast(13.2), DVec3::new(0.0, 1.4, -5.5), 0.008, DARK_GREY);
    line(mast(MAST_TOP_M), mast(MAST_TOP_M + 0.7), 0.008, DARK_GREY);
    // The mainsheet, from the boom to the cockpit.
    line(DVec3::new(0.85, 2.0, 2.6), DVec3::new(0.2, 1.05, 2.9), 0.02, WHITE);
    // The wheel, and the rail around the stern.
    let rim = |i: i32| {
        let (sin, cos) = (TAU * f64::from(i) / 10.0).sin_cos();
        DVec3::new(0.5 * cos, 1.62 + 0.5 * sin, 3.7)
    };
    (0..10).for_each(|i| line(rim(i), rim(i + 1), 0.016, DARK_GREY));
    (0..5).for_each(|i| line(rim(i), rim(i + 5), 0.008, DARK_GREY));
    line(DVec3::new(0.0, 1.05, 3.8), DVec3::new(0.0, 1.65, 3.75), 0.07, WHITE);
    line(DVec3::new(-1.16, 1.64, 5.4), DVec3::new(1.16, 1.64, 5.4), 0.016, WHITE);
    for side in [-1.0, 1.0] {
        let chain_plate = DVec3::new(side * 1.66, 1.02, -0.6);
        let spreader = DVec3::new(side * 0.95, 7.6, -0.75);
        line(mast(7.6), spreader, 0.03, WHITE);
        line(chain_plate, spreader, 0.007, DARK_GREY);
        line(spreader, mast(14.0), 0.007, DARK_GREY);
        line(chain_plate + DVec3::Z * 0.4, mast(7.5), 0.007, DARK_GREY);
        // Guard rail on stanchions, from the bow to the stern.
        let posts = [1, 2, 3, 5, 6, 7, 8].map(|i| {
            let [z, half, deck, _]: [f64; 4] = CROSS_SECTIONS[i];
            DVec3::new(side * 0.95 * half, deck, z)
        });
        for pair in posts.windows(2) {
            line(pair[0] + DVec3::Y * 0.6, pair[1] + DVec3::Y * 0.6, 0.006, WHITE);
            line(pair[0] + DVec3::Y * 0.3, pair[1] + DVec3::Y * 0.3, 0.005, WHITE);
            line(pair[1], pair[1] + DVec3::Y * 0.6, 0.012, WHITE);
        }
        line(posts[0], posts[0] + DVec3::Y * 0.6, 0.016, WHITE);
        line(posts[0] + DVec3::Y * 0.6, DVec3::new(0.0, 1.95, -5.5), 0.016, WHITE);
    }
    lines
}

/// A sail between a straight leading edge and a free one. From its foot (0) to its head (1), the chord shortens and
/// turns to leeward.
struct Sail {
    /// Lower and upper end of the leading edge, m.
    tack: DVec3,
    head: DVec3,
    /// Length of the foot, m.
    foot_m: f64,
    /// Exponent of the chord's length over the height: 1 is a triangle, less gives a rounded free edge.
    chord_exponent: f64,
    /// Angles of the chord to the hull's middle line at foot and head, degrees.
    angles_deg: [f64; 2],
    /// Largest depth of the curve relative to the chord.
    camber: f64,
}

/// Mainsail and jib.
fn sail_plan() -> [Sail; 2] {
    let mast = |y: f64| DVec3::new(0.0, y, -MAST_AHEAD_M);
    // The mainsail runs in a groove at the back of the mast, so that the mast is seen from both sides, without a gap.
    let groove = DVec3::Z * 0.05;
    let main = Sail {
        tack: mast(2.3) + groove,
        head: mast(MAST_TOP_M - 0.4) + groove,
        foot_m: 4.4,
        chord_exponent: 0.72,
        angles_deg: [12.0, 28.0],
        camber: 0.12,
    };
    let jib = Sail {
        tack: DVec3::new(0.0, 1.5, -5.4),
        head: mast(13.2),
        foot_m: 4.9,
        chord_exponent: 1.04,
        angles_deg: [12.0, 34.0],
        camber: 0.16,
    };
    [main, jib]
}

fn sails(facets: &mut Vec<HullFacet>) {
    let plan = sail_plan();
    for (sail, colour) in plan.iter().zip(SAILS) {
        const STEPS: usize = 12;
        let rows: Vec<Vec<DVec3>> = (0..=STEPS)
            .map(|row| (0..=STEPS).map(|i| sail.point(row as f64 / STEPS as f64, i as f64 / STEPS as f64)).collect())
            .collect();
        let place = |row, i| cloth_place([i as f64 / STEPS as f64, (0.5 + row as f64) / (STEPS as f64 + 1.0)]);
        smooth_sheet(facets, &rows, |_| colour, place);
    }
    // The boom, along the foot of the mainsail.
    let boom = [-0.14, 0.0].map(|down| [0.0, 1.05].map(|along| plan[0].point(0.0, along) + DVec3::Y * down).to_vec());
    smooth_sheet(facets, &boom, |_| DARK_GREY, |_, _| 0);
}

/// Triangles that stand for the mainsail and the jib where they shade other parts, with the colours of these sails.
pub fn sail_shades() -> [([DVec3; 3], u32); 2] {
    let [main, jib] = sail_plan().map(|sail| [sail.tack, sail.head, sail.point(0.0, 1.0)]);
    [(main, SAILS[0]), (jib, SAILS[1])]
}

impl Sail {
    /// Point of the sail, m: `up` from foot (0) to head (1), `along` the chord from the leading edge (0) to the free one.
    fn point(&self, up: f64, along: f64) -> DVec3 {
        let chord_m = self.foot_m * (1.0 - up).powf(self.chord_exponent) + 0.08;
        let angle = (self.angles_deg[0] + up * (self.angles_deg[1] - self.angles_deg[0])).to_radians();
        let chord = DVec3::new(angle.sin(), 0.0, angle.cos());
        let leeward = DVec3::new(angle.cos(), 0.0, -angle.sin());
        // Deepest at 40 % of the chord, flatter towards the free edge.
        let depth = 4.2 * self.camber * chord_m * along * (1.0 - along) * (1.35 - 0.8 * along);
        self.tack.lerp(self.head, up) + chord * (chord_m * along) + leeward * depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_faces_outwards() {
        let hull: Vec<_> = yacht_hull().into_iter().filter(|f| f.colour == ANTIFOULING).collect();
        assert!(hull.len() > 50);
        for facet in hull {
            for (corner, normal) in facet.corners.iter().zip(facet.normals) {
                // At the keel, where both sides meet, the normal may point to either.
                assert!(corner.x.abs() < 0.05 || normal.x * corner.x > 0.0, "{corner} {normal}");
                assert!((normal.length() - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_sails_stand_to_leeward_and_reach_the_mast() {
        let sails: Vec<_> = yacht_hull().into_iter().filter(|f| SAILS.contains(&f.colour)).collect();
        let corners = || sails.iter().flat_map(|f| f.corners);
        assert!(corners().all(|c| c.x > -1e-9 && c.y < MAST_TOP_M));
        let area_m2: f64 =
            sails.iter().map(|f| 0.5 * (f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]).length()).sum();
        // A cruising yacht of this length carries 50 to 75 m2 close-hauled.
        assert!((50.0..75.0).contains(&area_m2), "{area_m2}");
    }
}
