//! The shape of the sailing yacht: a hull, a cabin, a helmsman, and two curved sails that let light through.

use super::hull_shapes::{DARK_GREY, HullFacet, RED, WHITE, WOOD, surface_of_revolution};
use glam::DVec3;

const NAVY: u32 = 0x0058_3418;
const DECK: u32 = 0x00b4_c8d4;
/// White sailcloth, which lets 0.45 of the sunlight through.
const SAIL: u32 = 0x73e4_eef0;
/// Dark red antifouling paint below the water line.
const ANTIFOULING: u32 = 0x0028_2c70;
const SKIN: u32 = 0x0078_98c8;
/// Distance of the mast's foot before the middle of the hull, m.
const MAST_AHEAD_M: f64 = 0.85;
/// Height of the top of the mast above the water, m.
const MAST_TOP_M: f64 = 15.0;

/// Cross-sections of the hull from bow to stern: position along z, half-width at the deck, height of the deck, and
/// height of the lowest point, m.
const CROSS_SECTIONS: [[f64; 4]; 9] = [
    [-5.6, 0.02, 1.36, 0.6],
    [-5.1, 0.32, 1.3, -0.2],
    [-4.0, 0.88, 1.2, -0.5],
    [-2.4, 1.42, 1.1, -0.72],
    [-0.6, 1.7, 1.02, -0.8],
    [1.4, 1.72, 0.98, -0.76],
    [3.2, 1.56, 0.98, -0.58],
    [4.6, 1.36, 1.0, -0.3],
    [5.4, 1.22, 1.04, -0.05],
];

/// Triangles of a sailing yacht on the port tack: the wind comes from port ahead, and the sails stand to starboard.
pub fn yacht_hull() -> Vec<HullFacet> {
    let mut facets = Vec::new();
    hull_and_deck(&mut facets);
    cabin(&mut facets);
    facets.extend(moved(surface_of_revolution(&[(0.1, 0.9, WHITE), (0.06, MAST_TOP_M, WHITE)]), -MAST_AHEAD_M));
    helmsman(&mut facets);
    sails(&mut facets);
    facets
}

/// Adds the triangles of a sheet of points, rows of equal length, with normals that vary smoothly. They point to the
/// side of `across x along`, with `across` from row to row and `along` within a row. `colour` gives the paint of the
/// band between a row and the next.
fn smooth_sheet(facets: &mut Vec<HullFacet>, rows: &[Vec<DVec3>], colour: impl Fn(usize) -> u32) {
    let normal = |row: usize, i: usize| {
        let across = rows[(row + 1).min(rows.len() - 1)][i] - rows[row.saturating_sub(1)][i];
        let along = rows[row][(i + 1).min(rows[row].len() - 1)] - rows[row][i.saturating_sub(1)];
        across.cross(along).normalize_or(DVec3::Y)
    };
    for row in 0..rows.len() - 1 {
        for i in 0..rows[row].len() - 1 {
            let at = |(row, i): (usize, usize)| (rows[row][i], normal(row, i));
            let [a, b, c, d] = [(row, i), (row, i + 1), (row + 1, i + 1), (row + 1, i)].map(at);
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let (corners, normals) = ([p.0, q.0, r.0], [p.1, q.1, r.1]);
                facets.push(HullFacet { corners, normals, colour: colour(row) });
            }
        }
    }
}

fn hull_and_deck(facets: &mut Vec<HullFacet>) {
    // Height of a row between the lowest point (0) and the deck (1), and half-width there relative to the deck's.
    const ROWS: [[f64; 2]; 7] =
        [[0.0, 0.0], [0.06, 0.42], [0.2, 0.7], [0.46, 0.88], [0.64, 0.96], [0.9, 1.0], [1.0, 1.0]];
    for side in [-1.0, 1.0] {
        let row_points = |[up, out]: [f64; 2]| {
            let point = |[z, half, deck, low]: [f64; 4]| DVec3::new(side * out * half, low + up * (deck - low), z);
            let mut row: Vec<DVec3> = CROSS_SECTIONS.into_iter().map(point).collect();
            // The order of the points decides which side is outside.
            if side < 0.0 {
                row.reverse();
            }
            row
        };
        let rows = ROWS.map(row_points);
        smooth_sheet(facets, &rows, |row| [ANTIFOULING, ANTIFOULING, ANTIFOULING, WHITE, WHITE, NAVY][row]);
    }
    let edge = |side: f64| CROSS_SECTIONS.map(|[z, half, deck, _]| DVec3::new(side * half, deck, z)).to_vec();
    let middle = CROSS_SECTIONS.map(|[z, _, deck, _]| DVec3::new(0.0, deck + 0.06, z)).to_vec();
    smooth_sheet(facets, &[edge(1.0), middle, edge(-1.0)], |_| DECK);
    let [z, half, deck, low] = CROSS_SECTIONS[CROSS_SECTIONS.len() - 1];
    let rim = ROWS.map(|[up, out]| (out * half, low + up * (deck - low)));
    let across = |side: f64| rim.iter().map(|&(x, y)| DVec3::new(side * x, y, z)).collect::<Vec<_>>();
    smooth_sheet(facets, &[across(-1.0), across(1.0)], |_| WHITE);
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
        smooth_sheet(facets, &rows, |row| ROWS[row].2);
    }
    // The companionway, the after wall of the cabin.
    let wall = |side: f64| ROWS.map(|(half, up, _)| DVec3::new(side * 0.95 * half, 0.98 + 0.95 * up, 1.7)).to_vec();
    smooth_sheet(facets, &[wall(-1.0), wall(1.0)], |_| WOOD);
}

fn helmsman(facets: &mut Vec<HullFacet>) {
    let figure = surface_of_revolution(&[
        (0.2, 1.0, NAVY),
        (0.22, 1.35, RED),
        (0.24, 1.8, RED),
        (0.08, 1.95, SKIN),
        (0.12, 2.05, SKIN),
        (0.11, 2.15, WHITE),
        (0.0, 2.25, WHITE),
    ]);
    facets.extend(moved(figure, 3.6));
}

fn moved(facets: Vec<HullFacet>, z: f64) -> impl Iterator<Item = HullFacet> {
    facets.into_iter().map(move |f| HullFacet { corners: f.corners.map(|c| c + DVec3::Z * z), ..f })
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

fn sails(facets: &mut Vec<HullFacet>) {
    let mast = |y: f64| DVec3::new(0.0, y, -MAST_AHEAD_M);
    let main = Sail {
        tack: mast(2.15),
        head: mast(MAST_TOP_M - 0.4),
        foot_m: 4.4,
        chord_exponent: 0.8,
        angles_deg: [14.0, 30.0],
        camber: 0.1,
    };
    let jib = Sail {
        tack: DVec3::new(0.0, 1.5, -5.4),
        head: mast(13.2),
        foot_m: 4.9,
        chord_exponent: 1.0,
        angles_deg: [13.0, 34.0],
        camber: 0.14,
    };
    for sail in [&main, &jib] {
        const STEPS: usize = 12;
        let rows: Vec<Vec<DVec3>> = (0..=STEPS)
            .map(|row| (0..=STEPS).map(|i| sail.point(row as f64 / STEPS as f64, i as f64 / STEPS as f64)).collect())
            .collect();
        smooth_sheet(facets, &rows, |_| SAIL);
    }
    // The boom, along the foot of the mainsail.
    let boom = [-0.14, 0.0].map(|down| [0.0, 1.05].map(|along| main.point(0.0, along) + DVec3::Y * down).to_vec());
    smooth_sheet(facets, &boom, |_| DARK_GREY);
}

impl Sail {
    /// Point of the sail, m: `up` from foot (0) to head (1), `along` the chord from the leading edge (0) to the free one.
    fn point(&self, up: f64, along: f64) -> DVec3 {
        let chord_m = self.foot_m * (1.0 - up).powf(self.chord_exponent) + 0.08;
        let angle = (self.angles_deg[0] + up * (self.angles_deg[1] - self.angles_deg[0])).to_radians();
        let chord = DVec3::new(angle.sin(), 0.0, angle.cos());
        let leeward = DVec3::new(angle.cos(), 0.0, -angle.sin());
        let depth = 4.0 * self.camber * chord_m * along * (1.0 - along);
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
        let sails: Vec<_> = yacht_hull().into_iter().filter(|f| f.colour == SAIL).collect();
        let corners = || sails.iter().flat_map(|f| f.corners);
        assert!(corners().all(|c| c.x > -1e-9 && c.y < MAST_TOP_M));
        let area_m2: f64 =
            sails.iter().map(|f| 0.5 * (f.corners[1] - f.corners[0]).cross(f.corners[2] - f.corners[0]).length()).sum();
        // A cruising yacht of this length carries 50 to 75 m2 close-hauled.
        assert!((50.0..75.0).contains(&area_m2), "{area_m2}");
    }
}
