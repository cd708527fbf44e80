//! Points of a grid without data.

/// Depth, m, below which a gap beside it is water; a gap beside shallower water is the land that the file leaves out.
const SHORE_DEPTH_M: f32 = 3.0;
/// Slope of the land that a file leaves out, and its greatest height, m.
const LAND_SLOPE: f32 = 0.05;
const LAND_HEIGHT_M: f32 = 10.0;

/// Fills points without data (NaN) of elevations (m), and says so. `cell_m` is the distance of two points along a row and
/// between two rows. At least one point has data.
///
/// Each point takes the elevation of the nearest point with data. If no point of the file is land, and that nearest one is
/// less than 3 m deep, the point is land instead: files of soundings leave it out.
pub(super) fn fill(elevation_m: &mut [f32], columns: usize, cell_m: [f64; 2]) -> Option<String> {
    let missing = elevation_m.iter().filter(|v| v.is_nan()).count();
    if missing == 0 {
        return None;
    }
    let has_land = elevation_m.iter().any(|v| *v > 0.0);
    let rows = elevation_m.len() / columns;
    // Index of the nearest point with data, found by passing it on from neighbour to neighbour: down, then up.
    let mut nearest: Vec<u32> =
        elevation_m.iter().enumerate().map(|(i, v)| if v.is_nan() { u32::MAX } else { i as u32 }).collect();
    let place = |index: usize| [(index % columns) as f64 * cell_m[0], (index / columns) as f64 * cell_m[1]];
    let distance = |from: usize, to: u32| {
        let ([x, y], [u, v]) = (place(from), place(to as usize));
        (x - u).hypot(y - v)
    };
    // Two rounds reach around corners.
    for _ in 0..2 {
        for pass in 0..2 {
            for step in 0..rows * columns {
                let index = if pass == 0 { step } else { rows * columns - 1 - step };
                let mut best = nearest[index];
                if best as usize == index {
                    continue;
                }
                let (i, j) = ((index % columns) as isize, (index / columns) as isize);
                for (di, dj) in [(-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, 1), (1, -1), (-1, 1)] {
                    let (u, v) = (i + di, j + dj);
                    if u < 0 || v < 0 || u >= columns as isize || v >= rows as isize {
                        continue;
                    }
                    let offered = nearest[v as usize * columns + u as usize];
                    if offered != u32::MAX && (best == u32::MAX || distance(index, offered) < distance(index, best)) {
                        best = offered;
                    }
                }
                nearest[index] = best;
            }
        }
    }
    let mut land = 0;
    let known = elevation_m.to_vec();
    for (index, value) in elevation_m.iter_mut().enumerate().filter(|(_, v)| v.is_nan()) {
        *value = known[nearest[index] as usize];
        if !has_land && *value > -SHORE_DEPTH_M {
            let rise_m = LAND_SLOPE * distance(index, nearest[index]) as f32;
            *value = rise_m.clamp(0.5, LAND_HEIGHT_M);
            land += 1;
        }
    }
    let percent = 100.0 * missing as f64 / known.len() as f64;
    Some(match land {
        0 => format!("{missing} points without data ({percent:.1} %) take the value of the nearest point with data"),
        _ => format!(
            "{missing} points have no data ({percent:.1} %): {land} beside water of less than {SHORE_DEPTH_M} m are taken \
             for land, because the file holds none, and the others take the value of the nearest point with data"
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_take_the_nearest_value_and_shores_become_land() {
        let gap = f32::NAN;
        let mut sea = vec![-20.0, gap, -20.0, -8.0, gap, -8.0, 1.0, 1.0, 1.0];
        let said = fill(&mut sea, 3, [10.0, 15.0]).expect("a notice");
        assert!(said.contains("2 points") && said.contains("22.2 %"), "{said}");
        assert_eq!((sea[1], sea[4]), (-20.0, -8.0), "10 m to the side are nearer than 15 m along");
        // Soundings only: the gap behind the shallow water is land, the one in deep water is not.
        let mut soundings = vec![-30.0, gap, -10.0, -1.0, gap, gap, gap, gap];
        let said = fill(&mut soundings, 8, [40.0, 40.0]).expect("a notice");
        assert!(said.contains("4 beside water"), "{said}");
        assert_eq!(soundings[1], -30.0);
        assert_eq!(soundings[4..], [2.0, 4.0, 6.0, 8.0]);
        assert_eq!(fill(&mut [-1.0, 2.0, 3.0, 4.0], 2, [1.0; 2]), None);
    }
}
