//! White water that a sailing yacht throws up: the curl of the bow wave, the foam along the water line, and the waves
//! behind the stern. These are sheets that stand in the water, so that an eye near the water sees them; the foam that
//! lies flat on the water is in shaders/water/wake.wgsl.

use super::yacht_shape::water_line;
use glam::DVec3;

/// A corner of a sheet of white water. Axes: x to starboard, y up, z to the stern, without the heel of the yacht.
#[derive(Clone, Copy)]
pub struct FoamCorner {
    pub at: DVec3,
    /// Distance along the sheet, m; place between its foot (0) and its crest (1); fraction that is white at the crest.
    pub pattern: [f64; 3],
}

/// Height below the water to which the sheets reach, so that no gap opens in a trough, m.
const FOOT_M: f64 = -0.4;

/// A sheet of white water: points of the water below its crest, with the height of the crest (m) and its whiteness.
type Crest = Vec<(DVec3, f64, f64)>;

/// How rough a sea is for a yacht, from 0 in a moderate breeze to 1 in a near gale: waves throw its white water higher.
pub fn roughness(wind_m_s: f64) -> f64 {
    ((wind_m_s - 6.0) / 9.0).clamp(0.0, 1.0)
}

/// Triangles of the white water around a yacht that heels by `heel_rad` to starboard and makes way. `rough` is
/// [`roughness`].
pub fn yacht_foam(speed_m_s: f64, heel_rad: f64, rough: f64) -> Vec<FoamCorner> {
    // The height to which water rises that the stem stops, and a little more, because it splashes.
    let rise_m = 1.3 * speed_m_s * speed_m_s / (2.0 * 9.81);
    let white = (speed_m_s / 2.6).powi(2).min(1.0);
    let mut corners = Vec::new();
    if white < 0.05 {
        return corners;
    }
    for side in [-1.0, 1.0] {
        // Leeward, the heeled hull presses down the water.
        let press = if side * heel_rad > 0.0 { 1.0 } else { 0.75 + 0.2 * rough };
        let line = water_line(side, heel_rad);
        let [stem, stern] = [line[0].z, line[line.len() - 1].z];
        let beside = |z: f64| {
            let i = line.partition_point(|p| p.z < z).clamp(1, line.len() - 1);
            let share = ((z - line[i - 1].z) / (line[i].z - line[i - 1].z)).clamp(0.0, 1.0);
            line[i - 1].lerp(line[i], share)
        };
        let bell = |z: f64, at: f64, width: f64| (-((z - at) / width).powi(2)).exp();
        // Along the hull.
        let crest = (0..=36).map(|i| {
            let z = stem - 0.15 + f64::from(i) * (stern - stem) / 36.0;
            let bow = bell(z, stem + 0.5, 0.5).max(0.8 * bell(z, stem + 1.1, 1.3));
            let high = (1.2 + 0.8 * rough) * bow + 0.3 + 0.3 * rough + 0.3 * bell(z, stern, 1.2);
            let shown = 0.6 + 0.2 * rough + 0.5 * bow + 0.2 * bell(z, stern, 1.5);
            // The sheet fades in, because its first edge is straight.
            let begun = (f64::from(i) / 2.0).min(1.0);
            (beside(z) + DVec3::X * (side * 0.03), press * rise_m * high, white * press * shown * begun)
        });
        sheet(&mut corners, &crest.collect(), side, Profile::Thrown);
        // The bow wave and the stern wave run away from the hull.
        for (from, height, reach) in [(stem + 0.9, 0.9, 2.6), (stern - 0.1, 0.5, 3.2)] {
            let start = beside(from);
            let crest = (0..=14).map(|i| {
                let behind_m = 0.5 * f64::from(i);
                let fade = (-behind_m / reach).exp();
                let at = start + DVec3::new(side * (0.02 + 0.4 * behind_m), 0.0, behind_m);
                (at, press * rise_m * height * fade, white * press * fade.sqrt())
            });
            sheet(&mut corners, &crest.collect(), side, Profile::Heaped);
        }
    }
    wake(&mut corners, rise_m, white);
    corners
}

/// Adds the water that the hull has churned: low crests across its track and along it, which the waves hide in part.
fn wake(corners: &mut Vec<FoamCorner>, rise_m: f64, white: f64) {
    for (z, half, height, shown) in [(5.75, 1.1, 0.25, 0.75), (7.4, 1.3, 0.3, 0.6), (9.8, 1.6, 0.2, 0.45)] {
        let crest = (0..=8).map(|i| {
            let x = (f64::from(i) - 4.0) / 4.0;
            (DVec3::new(x * half, 0.0, z), rise_m * height * (1.0 - 0.6 * x * x), white * shown)
        });
        let crest: Crest = crest.collect();
        sheet(corners, &crest, 0.0, Profile::Heaped);
    }
    for side in [-1.0, 0.0, 1.0] {
        let crest = (0..=20).map(|i| {
            let behind_m = 1.2 * f64::from(i);
            let at = DVec3::new(side * (0.85 + 0.04 * behind_m), 0.0, 5.6 + behind_m);
            (at, 0.25 * rise_m, white * 0.6 * (-behind_m / 12.0).exp())
        });
        sheet(corners, &crest.collect(), side, Profile::Heaped);
    }
}

/// How a sheet of white water leans.
#[derive(Clone, Copy)]
enum Profile {
    /// A heap of water: the foot lies farther out than the crest, and the sheet is steeper at its crest.
    Heaped,
    /// Water that the hull throws away: the crest flies farther out than the foot.
    Thrown,
}

/// Adds a sheet on a side of the hull, -1 or 1, or astern of it, 0.
fn sheet(corners: &mut Vec<FoamCorner>, crest: &Crest, side: f64, profile: Profile) {
    let mut along_m = 0.0;
    let mut rows = Vec::new();
    for (i, &(at, high_m, white)) in crest.iter().enumerate() {
        along_m += if i > 0 { (at - crest[i - 1].0).length() } else { 0.0 };
        let outward = if side == 0.0 { DVec3::Z } else { DVec3::X * side };
        rows.push([0.0, 0.25, 0.5, 0.75, 1.0].map(|up: f64| {
            let out_m = match profile {
                Profile::Heaped => (0.2 + 0.8 * high_m) * (1.0 - up).powi(2),
                Profile::Thrown => 0.1 + high_m * up * (0.3 + 0.6 * up),
            };
            FoamCorner {
                at: at + outward * out_m + DVec3::Y * (FOOT_M + up * (high_m - FOOT_M)),
                pattern: [along_m, up, white],
            }
        }));
    }
    for pair in rows.windows(2) {
        for (near, far) in pair[0].windows(2).zip(pair[1].windows(2)) {
            let ([a, b], [d, c]) = ([near[0], near[1]], [far[0], far[1]]);
            corners.extend([a, b, c, a, c, d]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_water_needs_speed_and_stays_near_the_water() {
        assert!(yacht_foam(0.5, 0.0, 1.0).is_empty());
        let foam = yacht_foam(3.0, 0.3, 0.0);
        assert!(foam.len().is_multiple_of(3) && foam.iter().all(|c| (-0.5..1.0).contains(&c.at.y)));
        // The bow throws water out, and a wave that runs away from it is a heap with a wide foot.
        let row = |corners: &[FoamCorner], up: f64| {
            corners.iter().find(|c| c.pattern[1] == up).map(|c| c.at.x.abs()).expect("a corner")
        };
        assert!(row(&foam, 1.0) > row(&foam, 0.5) && row(&foam, 0.5) > row(&foam, 0.0));
        let mut heap = Vec::new();
        sheet(&mut heap, &vec![(DVec3::X, 0.5, 1.0), (DVec3::X + DVec3::Z, 0.5, 1.0)], 1.0, Profile::Heaped);
        assert!(row(&heap, 0.0) > row(&heap, 0.5) && row(&heap, 0.5) > row(&heap, 1.0));
        // A rough sea throws it higher.
        let highest = |foam: &[FoamCorner]| foam.iter().map(|c| c.at.y).fold(0.0, f64::max);
        let rough = highest(&yacht_foam(3.0, 0.3, roughness(15.0)));
        assert!((1.2..1.8).contains(&(rough / highest(&foam))) && rough < 2.0, "{rough}");
        // The heeled hull lies deeper to leeward.
        let widest = |side: f64| water_line(side, 0.3).iter().map(|p| side * p.x).fold(0.0, f64::max);
        assert!(widest(1.0) > widest(-1.0) + 0.2, "{} {}", widest(1.0), widest(-1.0));
    }
}
