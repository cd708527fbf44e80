//! The water mesh before displacement: a log-polar lattice with the eye in the middle.
//!
//! Azimuths are multiples of a step, so that turning the camera moves no vertex. Rows are farther apart at larger
//! distances; by default the last one lies beyond the horizon. The mesh is one piece, so it has no cracks.

use crate::gpu::layout::gpu_struct;
use crate::render::scene::SeaAppearance;
use crate::state::camera::EARTH_RADIUS_M;
use crate::state::camera::View;
use std::f64::consts::{PI, TAU};

/// Number of columns (lines of vertices in one direction from the eye) of the water mesh at density 1.
const DEFAULT_COLUMNS: f64 = 240.0;
/// Number of rows (arcs of vertices at one distance from the eye) of the water mesh at density 1.
const DEFAULT_ROWS: f64 = 1120.0;
/// Number of vertices of the water mesh at density 1 (default mesh detail, picture of 1280 x 720 pixels).
pub const DEFAULT_VERTICES: f64 = DEFAULT_COLUMNS * DEFAULT_ROWS;
/// Number of columns of quads in a block. A block is drawn row by row, so that a row finds the vertices that it shares
/// with the row before in the GPU's cache.
pub const COLUMNS_PER_BLOCK: u32 = 8;
/// Step to whose multiples the logarithmic distance t (see [`MeshLattice`]) of the nearest row is rounded down, so that
/// a small change of the camera's pitch moves no row.
const FIRST_ROW_LOG_STEP: f64 = 0.25;

/// Number of pixels of a picture whose water mesh has the default number of vertices.
const DEFAULT_MESH_PIXELS: f64 = 1280.0 * 720.0;

gpu_struct! {
    /// WGSL `MeshLattice`: polar coordinates of the vertices around the point below the eye. Row i of column j has the
    /// azimuth `first_azimuth + j azimuth_step`, rad clockwise from north, and the distance `linear_radius_m` (exp(t) -
    /// 1), m, where t is `first_log_radius + i log_radius_step`.
    pub struct MeshLattice as "MeshLattice" {
        pub first_azimuth: f32,
        pub azimuth_step: f32,
        pub first_log_radius: f32,
        pub log_radius_step: f32,
        /// Distance from the point below the eye up to which rows are about evenly spaced, m; spacing grows beyond.
        pub linear_radius_m: f32,
        /// Number of rows, that is of vertices in a column.
        pub rows: u32,
        unused: [u32; 2],
    }
}

/// Layout of the water mesh for one view: the lattice of its undisplaced vertices, and how many columns are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Polar coordinates of the vertices before displacement, around the point below the eye. Near the eye, the shader
    /// shifts the vertices, so that the displaced mesh is centred on this point.
    pub lattice: MeshLattice,
    /// Number of columns of quads in the index buffer. It depends only on the density of the mesh, not on the view.
    pub index_buffer_columns: u32,
    /// Number of columns of quads that are drawn in this view, a multiple of [`COLUMNS_PER_BLOCK`].
    pub drawn_columns: u32,
}

impl Mesh {
    /// The mesh that covers the water visible in `view`. `density` is its number of vertices divided by
    /// [`DEFAULT_VERTICES`]; `extent_km` is the distance that it reaches, km, or 0 for the horizon.
    pub fn new(view: &View, sea: &SeaAppearance, density: f64, extent_km: f64) -> Self {
        let scale = density.clamp(0.015, 64.0).sqrt();
        let index_buffer_columns =
            ((DEFAULT_COLUMNS * scale / f64::from(COLUMNS_PER_BLOCK)).ceil() as u32) * COLUMNS_PER_BLOCK;
        let rows = (DEFAULT_ROWS * scale).ceil() as u32;
        let lift = 1.1 * sea.hs_m;
        let shift = 0.6 * sea.hs_m * sea.max_choppiness() + sea.surf_displacement_m;
        // From below, the surface is seen as far away as from the same height above it.
        let eye = view.eye.y.abs().max(0.1);
        let (lowest, widest) = lowest_elevation_and_largest_azimuth_rad(view);

        // Distances grow linearly with the row up to about `radius`, and exponentially beyond.
        let radius = (0.5 * (eye - lift)).max(0.04 * eye).max(0.25);
        let near = if lowest <= -0.5 * PI {
            0.0
        } else {
            ((eye - lift).max(0.0) / (-lowest).max(0.02).tan() - shift).max(0.0)
        };
        let far = 1.15 * ((2.0 * EARTH_RADIUS_M * (eye + lift)).sqrt() + (2.0 * EARTH_RADIUS_M * lift).sqrt()) + 500.0;
        let far = if extent_km > 0.0 { far.min((1e3 * extent_km).max(near + radius)) } else { far };
        let t = |r: f64| (1.0 + r / radius).ln();
        let first = (t(near) / FIRST_ROW_LOG_STEP).floor() * FIRST_ROW_LOG_STEP;
        let step = (t(far) - first) / f64::from(rows - 1);

        // Extra azimuth at both sides, because displaced waves lean into the picture from outside.
        let lean = 0.04 + 0.5 * (2.0 * shift / (near + 2.0 * shift + 1.0)).min(1.0);
        let half = (widest + lean).min(PI);
        let heading = view.right.z.atan2(view.right.x);
        let fits = |lines: f64| (2.0 * half * lines / TAU).ceil() + 2.0 <= f64::from(index_buffer_columns);
        let lines = (0..80).map(|i| (64.0 * 2f64.powf(0.25 * f64::from(i))).floor()).take_while(|&l| fits(l)).last();
        let turn = TAU / lines.unwrap_or(f64::from(index_buffer_columns) - 2.0);
        let start = ((heading - half) / turn).floor();
        let needed =
            ((2.0 * half / turn).ceil() as u32 + 1).next_multiple_of(COLUMNS_PER_BLOCK).min(index_buffer_columns);
        Self {
            lattice: MeshLattice {
                first_azimuth: (start * turn) as f32,
                azimuth_step: turn as f32,
                first_log_radius: first as f32,
                log_radius_step: step as f32,
                linear_radius_m: radius as f32,
                rows,
                unused: [0; 2],
            },
            index_buffer_columns,
            drawn_columns: needed,
        }
    }

    /// Vertex indices, three per triangle, for all columns of the index buffer in blocks of [`COLUMNS_PER_BLOCK`].
    pub fn indices(&self) -> Vec<u32> {
        let rows = self.lattice.rows;
        let mut out = Vec::with_capacity((self.index_buffer_columns * (rows - 1) * 6) as usize);
        for block in (0..self.index_buffer_columns).step_by(COLUMNS_PER_BLOCK as usize) {
            for row in 0..rows - 1 {
                for column in block..block + COLUMNS_PER_BLOCK {
                    let a = column * rows + row;
                    let b = a + rows;
                    out.extend([a, b, a + 1, a + 1, b, b + 1]);
                }
            }
        }
        out
    }

    /// Number of vertex indices that are drawn in this view, three per triangle.
    pub fn index_count(&self) -> u32 {
        self.drawn_columns * (self.lattice.rows - 1) * 6
    }
}

/// Number of vertices of the mesh for a picture of `pixels` pixels, divided by the default: powers of the square root
/// of two. Up to [`DEFAULT_MESH_PIXELS`] it is in proportion to the pixels, because triangles much smaller than a pixel
/// show nothing more. Above, it grows with the square root of their number, because waves are smooth. At an eighth of
/// the default a mesh costs little, and a coarser one would lose waves that a small picture still shows.
pub fn mesh_density(pixels: f64) -> f64 {
    let relative = pixels / DEFAULT_MESH_PIXELS;
    let density = relative.min(relative.sqrt()).clamp(0.125, 2.0);
    2f64.powf(0.5 * (2.0 * density.log2()).round())
}

/// Limits of the directions in the picture that may show water: lowest elevation (negative below the horizontal), and
/// largest azimuth to either side of the picture's middle, both rad; (-pi/2, pi) if the point below the eye is visible.
fn lowest_elevation_and_largest_azimuth_rad(view: &View) -> (f64, f64) {
    let dives = view.eye.y < 0.0;
    // A diving eye sees the water above it.
    let down = if dives { glam::DVec3::Y } else { -glam::DVec3::Y };
    let depth = down.dot(view.forward);
    let [tx, ty] = view.tan_half_fov.map(|t| 1.1 * t);
    let shows = |dir: glam::DVec3, depth: f64| {
        depth > 0.0 && dir.dot(view.right).abs() <= tx * depth && dir.dot(view.up).abs() <= ty * depth
    };
    if shows(down, depth) || dives && shows(-down, -depth) {
        return (-0.5 * PI, PI);
    }
    let ahead = glam::DVec3::new(view.right.z, 0.0, -view.right.x);
    let (mut lowest, mut widest) = (0.0f64, view.tan_half_fov[0].atan());
    const EDGE_SAMPLES: i32 = 12;
    for i in -EDGE_SAMPLES..=EDGE_SAMPLES {
        let at = f64::from(i) / f64::from(EDGE_SAMPLES);
        for ray in [view.ray(at, -1.0), view.ray(at, 1.0), view.ray(-1.0, at), view.ray(1.0, at)] {
            let elevation = ray.y.clamp(-1.0, 1.0).asin();
            lowest = lowest.min(elevation);
            if elevation < 0.15 || dives {
                widest = widest.max(ray.dot(view.right).atan2(ray.dot(ahead)).abs());
            }
        }
    }
    // Waves may cross the lens of a diving eye anywhere.
    (if dives { -0.5 * PI } else { lowest - 0.01 }, widest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::params::Camera;

    /// Every view ray that meets the sea, even at a wave crest, meets it inside the lattice.
    #[test]
    fn the_mesh_covers_the_picture() {
        for pitch in [-89.0, -60.0, -35.0, -10.0, 0.0, 20.0, 60.0] {
            for y_m in [1.0, 7.0, 60.0, 5000.0] {
                for hs in [0.1, 4.0, 12.0] {
                    for heading_deg in [0.0, 123.0, 359.0] {
                        let camera = Camera { pitch_deg: pitch, y_m, heading_deg, ..Camera::default() };
                        let view = View::new(&camera, 16.0 / 9.0, 0.0);
                        let mesh = Mesh::new(&view, &SeaAppearance::for_test(hs), 1.0, 0.0);
                        let case = format!("pitch {pitch} y {y_m} hs {hs} heading {heading_deg} {mesh:?}");
                        assert!(mesh.drawn_columns <= mesh.index_buffer_columns, "{case}");
                        let l = mesh.lattice;
                        let [a0, da, t0, dt, radius] =
                            [l.first_azimuth, l.azimuth_step, l.first_log_radius, l.log_radius_step, l.linear_radius_m]
                                .map(f64::from);
                        let near = radius * t0.exp_m1();
                        let far = radius * (t0 + dt * f64::from(l.rows - 1)).exp_m1();
                        assert!(far > (2.0 * EARTH_RADIUS_M * y_m).sqrt(), "{case}");
                        for (x, y) in [(-1.0, -1.0), (0.0, -1.0), (1.0, -1.0), (-1.0, 0.0), (1.0, 0.0), (1.0, 1.0)] {
                            let ray = view.ray(x, y);
                            if ray.y > -0.02 {
                                continue;
                            }
                            let crest = (y_m - hs).max(0.0) / -ray.y * ray.x.hypot(ray.z);
                            assert!(near <= crest + 1e-6, "{case}: {near} > {crest}");
                            let turns = ((ray.x.atan2(-ray.z) - a0) / TAU).rem_euclid(1.0);
                            assert!(turns * TAU <= da * f64::from(mesh.drawn_columns), "{case}: {turns}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn turning_keeps_the_lattice() {
        let mesh = |heading_deg| {
            let camera = Camera { heading_deg, ..Camera::default() };
            Mesh::new(&View::new(&camera, 1.5, 0.0), &SeaAppearance::for_test(2.0), 1.0, 0.0)
        };
        let (a, b) = (mesh(10.0).lattice, mesh(11.3).lattice);
        assert_eq!(a, MeshLattice { first_azimuth: a.first_azimuth, ..b });
        let steps = (b.first_azimuth - a.first_azimuth) / a.azimuth_step;
        assert!((steps - steps.round()).abs() < 1e-3, "{steps}");
    }

    #[test]
    fn mesh_density_follows_the_pixels_in_steps() {
        let density = |width: u32| mesh_density(f64::from(width * width) * 9.0 / 16.0);
        assert!((density(1280) - 1.0).abs() < 1e-12);
        assert!((density(640) - 0.25).abs() < 1e-12, "a quarter of the pixels has a quarter of the vertices");
        assert!((density(5120) - 2.0).abs() < 1e-12);
        assert!((density(160) - 0.125).abs() < 1e-12);
        // From 320 to 1280 pixels of width the density grows eight times, in steps of the root of two.
        let mut seen: Vec<f64> = (20..=80).map(|i| density(16 * i)).collect();
        assert!(seen.is_sorted());
        seen.dedup();
        assert_eq!(seen.len(), 7, "{seen:?}");
    }
}
