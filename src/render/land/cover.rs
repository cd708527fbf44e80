//! Draws stones and dune grass into the G-buffer, after the mesh of the land (shaders/land/cover.wgsl). The pass that
//! lights the land lights them as well.

use super::relief::{INNER, Relief};
use super::stones::{Block, LandStone, StoneTile, Stones, TILE_M};
use crate::coast::PlacedCoast;
use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::render::targets::{DEPTH_TEST_OPAQUE, G_BUFFER_FORMATS};
use crate::state::camera::View;
use glam::DVec3;
use std::ops::Range;

/// Distances from the eye up to which a tile of stones is drawn with all corners, with all stones, and at all, m; in the
/// lean tier nearer.
const STONES_UP_TO_M: [f64; 3] = [90.0, 240.0, 520.0];
const LEAN_STONES_UP_TO_M: [f64; 3] = [35.0, 110.0, 260.0];
/// Height above the still water around which stones lie, m.
const STONES_HEIGHT_M: f64 = 2.0;

/// Sides of the squares of the ground with one tuft of grass each, m: of dense tufts near the eye, and of sparse tufts
/// around them
/// (`COVER_TUFT_M` in shaders/land/cover.wgsl).
const TUFT_CELL_M: [f64; 2] = [0.45, 0.85];
/// Distances from the eye up to which dense and sparse tufts are drawn, m. The lean tier draws only sparse ones, and nearer.
const TUFTS_UP_TO_M: [f64; 2] = [14.0, 58.0];
const LEAN_TUFTS_UP_TO_M: f64 = 30.0;
/// Largest numbers of dense and of sparse tufts. With them, grass has 200,000 vertices.
const MAX_TUFTS: [u32; 2] = [1100, 4900];
/// Numbers of blades of a dense and of a sparse tuft, and of corners of a blade, which has three triangles or one.
const BLADES: [u32; 2] = [12, 9];
const BLADE_CORNERS: [u32; 2] = [5, 3];
const BLADE_TRIANGLES: [&[u32]; 2] = [&[0, 1, 2, 2, 1, 3, 2, 3, 4], &[0, 1, 2]];
/// Periods of the sway of grass, s.
const SWAY_S: [f64; 2] = [3.1, 1.7];
/// Height above the still water at which the first dune grass grows, m (`LAND_GRASS_M` in shaders/land/albedo.wgsl), and
/// by how much it may grow lower.
const GRASS_M: f32 = 3.2;
const GRASS_LOWER_M: f32 = 1.2;
/// Number of squares along each side of the coast's rectangle of which is known whether grass can grow there.
const MEADOWS: usize = 48;

gpu_struct! {
    /// WGSL `LandCover`: which tufts of grass are drawn, and how the wind bends them. The first component of a pair
    /// belongs to the dense tufts near the eye, the second to the sparse tufts around them.
    pub struct CoverUniform as "LandCover" {
        /// Column and row of the first square of the dense tufts, in the frame of the coast.
        first_near: [i32; 2],
        /// Column and row of the first square of the sparse tufts.
        first_far: [i32; 2],
        /// Numbers of columns of squares.
        columns: [u32; 2],
        /// Distances from the eye at which the last tufts stand, m.
        reach_m: [f32; 2],
        /// Horizontal lean of a blade's tip for each metre of its height, in the frame of the coast.
        lean: [f32; 2],
        /// Phases of two sways, in turns.
        sway: [f32; 2],
        /// Amplitude of the sway, as a part of the height.
        sway_gain: f32,
        /// Number of dense tufts.
        near_tufts: u32,
    }
}

/// Indices and instances of a draw.
type Draw = (Range<u32>, Range<u32>);

/// The cover of a coast's land, and what a frame draws of it.
pub struct Cover {
    pub stones: wgpu::Buffer,
    pub corners: wgpu::Buffer,
    pub uniform: Uniform<CoverUniform>,
    indices: wgpu::Buffer,
    /// Indices of a stone near and far, and of a tuft near and far.
    of_stone: [Range<u32>; 2],
    of_tuft: [Range<u32>; 2],
    tiles: Vec<StoneTile>,
    /// Whether grass can grow in each of [`MEADOWS`] x [`MEADOWS`] squares of the coast's rectangle.
    meadows: Vec<bool>,
    stone_draws: Vec<Draw>,
    grass_draws: Vec<Draw>,
}

impl Cover {
    /// Bindings of stones, corners of blocks and the uniform.
    pub fn bindings() -> [BindingType; 3] {
        [
            BindingType::StorageRead(size_of::<LandStone>()),
            BindingType::StorageRead(16),
            BindingType::Uniform(size_of::<CoverUniform>()),
        ]
    }

    /// Chooses and uploads what covers the land of a relief.
    pub fn new(gpu: &Gpu, relief: &Relief) -> Self {
        let all = Stones::new(relief);
        let (near, far) = (Block::near(), Block::far());
        let mut indices = near.indices.clone();
        indices.extend(far.indices.iter().map(|i| near.corners.len() as u32 + i));
        let of_stone = [0..near.indices.len() as u32, near.indices.len() as u32..indices.len() as u32];
        let of_tuft = [0, 1].map(|which: usize| {
            let start = indices.len() as u32;
            for blade in 0..BLADES[which] {
                indices.extend(BLADE_TRIANGLES[which].iter().map(|corner| BLADE_CORNERS[which] * blade + corner));
            }
            start..indices.len() as u32
        });
        let corners = [near.corners, far.corners].concat();
        let upload = |bytes: &[u8], least: usize, usage: wgpu::BufferUsages| {
            let bytes_needed = bytes.len().max(least) as u64;
            let buffer = gpu.buffer("cover", bytes_needed, usage | wgpu::BufferUsages::COPY_DST);
            gpu.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let storage = wgpu::BufferUsages::STORAGE;
        Self {
            stones: upload(bytemuck::cast_slice(&all.stones), size_of::<LandStone>(), storage),
            corners: upload(bytemuck::cast_slice(&corners), 16, storage),
            uniform: Uniform::new(gpu, "cover"),
            indices: upload(bytemuck::cast_slice(&indices), 4, wgpu::BufferUsages::INDEX),
            of_stone,
            of_tuft,
            tiles: all.tiles,
            meadows: meadows(relief),
            stone_draws: Vec::new(),
            grass_draws: Vec::new(),
        }
    }

    /// Decides what the next frame draws.
    pub fn prepare(&mut self, gpu: &Gpu, scene: &Scene, coast: &PlacedCoast) {
        let view = &scene.view;
        let placement = coast.placement();
        let eye = placement.in_frame_m([view.eye.x, view.eye.z]);
        let up_to_m = if scene.is_lean { LEAN_STONES_UP_TO_M } else { STONES_UP_TO_M };
        self.stone_draws.clear();
        for tile in &self.tiles {
            let [x, z] = placement.world_m(tile.middle_m);
            let off = DVec3::new(x, STONES_HEIGHT_M, z) - view.eye;
            let draw = tile_draw(tile, off.length(), up_to_m).filter(|_| is_seen(view, off, TILE_M));
            self.stone_draws.extend(draw.map(|(shape, stones)| (self.of_stone[shape].clone(), stones)));
        }
        self.grass_draws.clear();
        let up_to_m = if scene.is_lean { [0.0, LEAN_TUFTS_UP_TO_M] } else { TUFTS_UP_TO_M };
        if view.eye.y > up_to_m[1] || scene.dives() || !self.has_meadow_near(eye, coast.side_m(), up_to_m[1]) {
            return;
        }
        let to_coast = |vector: [f64; 2]| placement.turned_into_frame(vector);
        let fields: [TuftField; 2] = std::array::from_fn(|i| TuftField::new(view, eye, to_coast, up_to_m, i));
        let [near, far] = [fields[0].count(), fields[1].count()];
        let wind_m_s = scene.sea.wind_m_s;
        let lean = to_coast(scene.sea.downwind).map(|part| (part * (0.035 * wind_m_s).min(0.6)) as f32);
        self.uniform.write(
            gpu,
            &CoverUniform {
                first_near: fields[0].first,
                first_far: fields[1].first,
                columns: [fields[0].size[0], fields[1].size[0]],
                reach_m: [fields[0].reach_m as f32, fields[1].reach_m as f32],
                lean,
                sway: SWAY_S.map(|period_s| scene.moment(period_s).1),
                sway_gain: (0.012 * wind_m_s).min(0.12) as f32,
                near_tufts: near,
            },
        );
        let draws = [(self.of_tuft[0].clone(), 0..near), (self.of_tuft[1].clone(), near..near + far)];
        self.grass_draws.extend(draws.into_iter().filter(|(_, tufts)| !tufts.is_empty()));
    }

    /// Whether grass can grow in the coast's rectangle within `reach_m` of a place.
    fn has_meadow_near(&self, place_m: [f64; 2], side_m: [f64; 2], reach_m: f64) -> bool {
        let range = |axis: usize| {
            let at = |m: f64| m / side_m[axis] * MEADOWS as f64;
            let [from, to] = [at(place_m[axis] - reach_m), at(place_m[axis] + reach_m)];
            (from.max(0.0) as usize)..(to.ceil().clamp(0.0, MEADOWS as f64) as usize)
        };
        range(1).any(|j| range(0).any(|i| self.meadows[j * MEADOWS + i]))
    }

    /// Draws what [`Self::prepare`] has decided, with the bind groups of the land's mesh.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &CoverPipelines) {
        let parts = [(&pipelines.stones, &self.stone_draws), (&pipelines.grass, &self.grass_draws)];
        for (pipeline, draws) in parts {
            let Some(pipeline) = pipeline.as_ref().filter(|_| !draws.is_empty()) else { continue };
            pass.set_pipeline(pipeline);
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            draws.iter().for_each(|(indices, of)| pass.draw_indexed(indices.clone(), 0, of.clone()));
        }
    }
}

/// Pipelines that draw the cover, each compiled for the first frame that needs it.
#[derive(Default)]
pub struct CoverPipelines {
    stones: Option<wgpu::RenderPipeline>,
    grass: Option<wgpu::RenderPipeline>,
}

impl CoverPipelines {
    /// Compiles those that the next frame of `cover` needs.
    pub fn compile(
        &mut self,
        gpu: &Gpu,
        module: &wgpu::ShaderModule,
        layouts: &[&wgpu::BindGroupLayout],
        cover: &Cover,
    ) {
        let make = |name, entry_points| {
            let program = RenderProgram { entry_points, ..RenderProgram::new(module) };
            let onto = AttachmentFormats { formats: &G_BUFFER_FORMATS, depth: Some(DEPTH_TEST_OPAQUE), blend: None };
            gpu.render_pipeline(name, &program, layouts, &onto)
        };
        if !cover.stone_draws.is_empty() {
            self.stones.get_or_insert_with(|| make("land/stones", ["stone_vertex", "stone_fragment"]));
        }
        if !cover.grass_draws.is_empty() {
            self.grass.get_or_insert_with(|| make("land/grass", ["grass_vertex", "grass_fragment"]));
        }
    }
}

/// The shape (0 near, 1 far) and the stones with which a tile at a distance of `far_m` from the eye is drawn.
fn tile_draw(tile: &StoneTile, far_m: f64, [near, all, last]: [f64; 3]) -> Option<(usize, Range<u32>)> {
    let nearest_m = far_m - 0.7 * TILE_M;
    let long = tile.stones.start..tile.stones.start + tile.long;
    (nearest_m < last)
        .then(|| (usize::from(nearest_m > near), if nearest_m > all { long } else { tile.stones.clone() }))
}

/// Whether a ball of `radius_m` whose middle is at `off` from the eye, m, is in the picture, at least in part.
fn is_seen(view: &View, off: DVec3, radius_m: f64) -> bool {
    let ahead = off.dot(view.forward);
    let within = |side: f64, tan: f64| side.abs() < tan * ahead + radius_m * (1.0 + tan * tan).sqrt();
    let [x, y] = view.tan_half_fov;
    within(off.dot(view.right), x) && within(off.dot(view.up), y)
}

/// Whether grass can grow in each square: where its ground is high enough, as nature made it and not too steep.
fn meadows(relief: &Relief) -> Vec<bool> {
    let side = INNER / MEADOWS;
    (0..MEADOWS * MEADOWS)
        .map(|square| {
            let (i, j) = (square % MEADOWS * side, square / MEADOWS * side);
            (0..side * side).any(|point| {
                let index = Relief::inner_index(i + point % side, j + point / side);
                let [x, y] = relief.slope[index];
                relief.height_m[index] > GRASS_M - GRASS_LOWER_M && relief.kind[index] == 0.0 && x.hypot(y) < 0.7
            })
        })
        .collect()
}

/// The squares with tufts that are in the picture: a rectangle of columns and rows.
struct TuftField {
    first: [i32; 2],
    size: [u32; 2],
    reach_m: f64,
}

impl TuftField {
    /// The field of dense tufts (0) or of sparse ones (1). If too many are in the picture, the field ends nearer.
    fn new(
        view: &View,
        eye: [f64; 2],
        to_coast: impl Fn([f64; 2]) -> [f64; 2] + Copy,
        up_to_m: [f64; 2],
        which: usize,
    ) -> Self {
        let of = |share: f64| Self::within(view, eye, to_coast, share * up_to_m[which], TUFT_CELL_M[which]);
        let shares = [1.0, 0.9, 0.8, 0.7, 0.6];
        shares.into_iter().map(of).find(|field| field.count() <= MAX_TUFTS[which]).unwrap_or_else(|| of(0.5))
    }

    fn within(view: &View, eye: [f64; 2], to_coast: impl Fn([f64; 2]) -> [f64; 2], reach_m: f64, cell_m: f64) -> Self {
        let mut low = [-1.0_f64; 2];
        let mut high = [1.0_f64; 2];
        let [tan_x, tan_y] = view.tan_half_fov;
        // With the vertical in the picture, tufts stand on all sides of the eye.
        let is_all_around = view.forward.y.abs() > 1.0 / (1.0 + tan_x * tan_x + tan_y * tan_y).sqrt();
        for step in 0..18 {
            let across = f64::from(step % 9) / 4.0 - 1.0;
            let ray = if is_all_around {
                let (sin, cos) = (f64::from(step) * std::f64::consts::TAU / 18.0).sin_cos();
                [cos, sin]
            } else {
                let up = if step < 9 { -tan_y } else { tan_y };
                let ray = view.forward + view.right * tan_x * across + view.up * up;
                [ray.x, ray.z]
            };
            let off = to_coast(ray).map(|part| reach_m * part / ray[0].hypot(ray[1]));
            low = [0, 1].map(|i: usize| low[i].min(off[i]));
            high = [0, 1].map(|i: usize| high[i].max(off[i]));
        }
        let first = [0, 1].map(|i: usize| ((eye[i] + low[i]) / cell_m).floor());
        let last = [0, 1].map(|i: usize| ((eye[i] + high[i]) / cell_m).floor());
        let size = [0, 1].map(|i: usize| if reach_m > 0.0 { (last[i] - first[i] + 1.0) as u32 } else { 0 });
        Self { first: first.map(|at| at as i32), size, reach_m }
    }

    fn count(&self) -> u32 {
        self.size[0] * self.size[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coast::BuiltInCoast;
    use crate::coast::placed::PlacingOptions;
    use crate::state::params::Camera;

    /// A phone draws 150,000 triangles of stones, whose corners most of them share, in about 2 ms.
    #[test]
    fn no_view_of_the_harbour_has_too_many_triangles_of_stones() {
        let coast = BuiltInCoast::find("harbour").expect("a coast");
        let coast = PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("placed");
        let tiles = Stones::new(&Relief::new(&coast)).tiles;
        let triangles = [Block::near(), Block::far()].map(|block| block.indices.len() / 3);
        let mut most = 0;
        for i in 0..30_u32 {
            let eye = [760.0 + 20.0 * f64::from(i % 6), 440.0 + 110.0 * f64::from(i / 6)];
            for heading in 0..12 {
                let camera = Camera { heading_deg: 30.0 * f64::from(heading), fov_deg: 60.0, ..Camera::default() };
                let view = View::new(&camera, 16.0 / 9.0, 1.0);
                let seen = |tile: &StoneTile| {
                    let [x, y] = [tile.middle_m[0] - eye[0], tile.middle_m[1] - eye[1]];
                    let off = DVec3::new(x, -8.0, y);
                    let draw = tile_draw(tile, off.length(), STONES_UP_TO_M).filter(|_| is_seen(&view, off, TILE_M));
                    draw.map_or(0, |(shape, stones)| triangles[shape] * stones.len())
                };
                most = tiles.iter().map(seen).sum::<usize>().max(most);
            }
        }
        eprintln!("at most {most} triangles of stones");
        assert!((40_000..150_000).contains(&most), "{most}");
    }

    #[test]
    fn the_tufts_of_the_picture_are_in_the_field_and_bounded() {
        let eye = [700.0, 320.0];
        for (heading_deg, pitch_deg, fov_deg) in
            [(0.0, 0.0, 50.0), (135.0, -20.0, 50.0), (80.0, 5.0, 100.0), (20.0, -80.0, 60.0)]
        {
            let camera = Camera { heading_deg, pitch_deg, fov_deg, ..Camera::default() };
            let view = View::new(&camera, 16.0 / 9.0, 1.0);
            for which in 0..2 {
                let field = TuftField::new(&view, eye, |at| at, TUFTS_UP_TO_M, which);
                assert!((200..=MAX_TUFTS[which]).contains(&field.count()), "{} tufts", field.count());
                // Places on the ground that the picture shows.
                for step in 0..400 {
                    let (sin, cos) = (f64::from(step) * 0.7).sin_cos();
                    let far_m = field.reach_m * f64::from(step % 20) / 20.0;
                    let off = DVec3::new(far_m * cos, -1.7, far_m * sin);
                    let cell: [f64; 2] = std::array::from_fn(|i| {
                        (eye[i] + [off.x, off.z][i]) / TUFT_CELL_M[which] - f64::from(field.first[i])
                    });
                    let is_in = (0..2).all(|i| (0.0..f64::from(field.size[i])).contains(&cell[i]));
                    assert!(is_in || !is_seen(&view, off, 0.0), "{off} of {heading_deg} {pitch_deg} {fov_deg}");
                }
            }
        }
        let vertices: u32 = (0..2).map(|which| MAX_TUFTS[which] * BLADES[which] * BLADE_CORNERS[which]).sum();
        assert!(vertices <= 200_000, "{vertices}");
    }

    #[test]
    fn the_shader_knows_the_same_tufts() {
        let [cover, albedo] = ["cover", "albedo"].map(|name| {
            let path = format!("{}/shaders/land/{name}.wgsl", env!("CARGO_MANIFEST_DIR"));
            std::fs::read_to_string(path).expect("a shader")
        });
        let [near, far] = TUFT_CELL_M;
        assert!(cover.contains(&format!("const COVER_TUFT_M = vec2f({near}, {far});")));
        let [near, far] = BLADE_CORNERS;
        assert!(cover.contains(&format!("const COVER_BLADE_CORNERS = vec2u({near}u, {far}u);")));
        assert!(albedo.contains(&format!("const LAND_GRASS_M = {GRASS_M:?};")));
    }
}
