//! False-colour views that replace the picture: maps of the simulation (shaders/views/map.wgsl) and quantities of the
//! drawn surface (shaders/views/surface.wgsl). Compiled when a view is first shown; the picture pays nothing for them.

use super::scene::Scene;
use super::targets::Targets;
use super::targets::{DEPTH_TEST_BACKGROUND, DEPTH_TEST_OPAQUE, attachments};
use super::variants::switch_constant;
use super::water::light::WaterPass;
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, RenderProgram};
use crate::gpu::layout::gpu_struct;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::shaders::Shaders;
use crate::sim::maps::MAX_CASCADES;
use crate::sim::{MapCascade, Maps};
use crate::state::views::{DisplayedView, MapView};
use crate::waves::colour_scale::STOPS;
use std::cmp::Reverse;

/// Gap between neighbouring maps in a false-colour view, and least margin around them, pixels.
const MAP_GAP_PIXELS: u32 = 6;

gpu_struct! {
    /// WGSL `ViewTile`: a square of the picture in which a false-colour view shows one layer of a map. A view of the
    /// water surface has no squares; it uses only the colour range and the `layer` of the first tile.
    #[derive(Default)]
    pub struct ViewTile as "ViewTile" {
        /// Position (x, y) of the tile's top left corner: pixels to the right and down from the picture's top left.
        corner: [f32; 2],
        /// Column and row of the map texel that is drawn in the tile's top left corner. Texels to the right of it and
        /// below follow; after its last column or row the map continues with its first one.
        first_texel: [u32; 2],
        /// Side of the tile in the picture, pixels.
        side: f32,
        /// Index of what the tile shows: in a spectrum view a cascade, in a surface view an entry of `Frame.cascades`,
        /// in any other view a layer of the map texture.
        layer: u32,
        /// Lower end of the colour range: the value shown in the first colour, in the unit in which the map stores it.
        scale_low: f32,
        /// Upper end of the colour range: the value shown in the last colour, in the unit in which the map stores it.
        scale_high: f32,
    }
}

gpu_struct! {
    /// WGSL `View`: uniform buffer of the false-colour views.
    pub struct ViewUniform as "View" {
        /// Colours of the false-colour scale from low to high values, evenly spaced: sRGB, 0 to 1, with alpha 1.
        colour_stops: [[f32; 4]; STOPS],
        tiles: [ViewTile; MAX_CASCADES],
        /// Width and height of the picture, pixels.
        size: [f32; 2],
        /// Choppiness: factors by which the horizontal displacements along x and z are multiplied; 1 is linear theory.
        choppiness: [f32; 2],
        /// Number of the displayed view: 1 + discriminant of `MapView` or `SurfaceView`, which have separate shaders.
        view_kind: u32,
        /// Number of entries of `tiles` in use; one map layer is shown in each.
        tile_count: u32,
        /// 1 if the colour scale is logarithmic, 0 if it is linear.
        logarithmic: u32,
        /// Simulated time as a fraction of the period after which all waves repeat, in units of 2^-32.
        period_fraction_u32: u32,
    }
}

impl ViewUniform {
    fn new(scene: &Scene, maps: &Maps, size: [u32; 2]) -> Self {
        let view = scene.look.view;
        // The shaders number the kinds of view from 1.
        let kind = match view.displayed {
            DisplayedView::Picture => 0,
            DisplayedView::Map(map) => 1 + map as u32,
            DisplayedView::Surface(surface) => 1 + surface as u32,
        };
        let foam = matches!(view.displayed, DisplayedView::Map(MapView::Foam | MapView::Source));
        // During a cross-fade only the new sea is shown.
        let cascades: Vec<&MapCascade> = maps.current_ordinary_cascades().collect();
        let most = if foam { maps.foam_levels.len() } else { cascades.len() };
        let cascade_layers = view.shown_layers(most);
        let (corners, side) = largest_squares(cascade_layers.len() as u32, size);
        let mut tiles = [ViewTile::default(); MAX_CASCADES];
        for ((tile, layer), corner) in tiles.iter_mut().zip(cascade_layers.clone()).zip(corners) {
            let scale = scene.colour_scales[layer];
            // The moments map stores slope moments in the unit `moment_unit`.
            let unit = match view.displayed {
                DisplayedView::Map(MapView::MomentXx | MapView::MomentZz | MapView::MomentXz) => {
                    cascades[layer].moment_unit
                }
                _ => 1.0,
            };
            let first = match view.displayed {
                DisplayedView::Map(MapView::InitialSpectrum | MapView::Spectrum) => [maps.n / 2; 2],
                DisplayedView::Map(MapView::Foam | MapView::Source) => {
                    // North-western cell of the level. A cell is stored at its world index modulo the number of cells.
                    let level = maps.foam_levels[layer];
                    let cells = f64::from(maps.foam_cells_per_side);
                    level.centre_m.map(|x| (x / level.cell_m - 0.5 * cells).round().rem_euclid(cells) as u32)
                }
                _ => [0; 2],
            };
            // A spectrum is chosen by cascade, a surface view by drawn cascade, any other map by texture layer.
            let source = match view.displayed {
                DisplayedView::Map(MapView::InitialSpectrum | MapView::Spectrum) => layer,
                DisplayedView::Surface(_) => maps.cascades.len() - cascades.len() + layer,
                _ if foam => layer,
                _ => cascades[layer].layer as usize,
            };
            *tile = ViewTile {
                corner: corner.map(|x| x as f32),
                first_texel: first,
                side: side as f32,
                layer: source as u32,
                scale_low: scale.low as f32 / unit,
                scale_high: scale.high as f32 / unit,
            };
        }
        let scale = scene.colour_scales[cascade_layers.start.min(MAX_CASCADES - 1)];
        Self {
            colour_stops: scale.palette.stops().map(|[r, g, b]| [r, g, b, 1.0]),
            tiles,
            size: size.map(|s| s as f32),
            choppiness: scene.sea.choppiness.map(|l| l as f32),
            view_kind: kind,
            tile_count: cascade_layers.len() as u32,
            logarithmic: u32::from(scale.logarithmic),
            period_fraction_u32: maps.period_fraction_u32,
        }
    }
}

/// Places `count` equal squares, as large as possible, in a picture of `width` x `height` pixels. Returns their top
/// left corners (x, y), row by row, and the side of a square, all in pixels.
fn largest_squares(count: u32, [width, height]: [u32; 2]) -> (Vec<[u32; 2]>, u32) {
    let fit = |columns: u32| {
        let rows = count.div_ceil(columns);
        let room = |pixels: u32, squares: u32| pixels.saturating_sub((squares + 1) * MAP_GAP_PIXELS) / squares;
        (room(width, columns).min(room(height, rows)).max(1), Reverse(columns))
    };
    let (side, Reverse(columns)) = (1..=count.max(1)).map(fit).max().unwrap_or((1, Reverse(1)));
    let rows = count.div_ceil(columns);
    let start = |pixels: u32, squares: u32| pixels.saturating_sub(squares * side + (squares - 1) * MAP_GAP_PIXELS) / 2;
    let [left, top] = [start(width, columns), start(height, rows.max(1))];
    let corner = |i: u32| [left + i % columns * (side + MAP_GAP_PIXELS), top + i / columns * (side + MAP_GAP_PIXELS)];
    ((0..count).map(corner).collect(), side)
}

/// Render passes that draw a false-colour view: maps, or the coloured water surface.
pub struct FalseColourPass {
    uniform: Uniform<ViewUniform>,
    map_layout: wgpu::BindGroupLayout,
    map_pipeline: wgpu::RenderPipeline,
    surface_pipeline: wgpu::RenderPipeline,
    surface_group: wgpu::BindGroup,
    /// Whether the surface runs up to a coast.
    pub has_coast: bool,
}

impl FalseColourPass {
    /// Compiles the passes of false-colour views. Views of the water surface draw the mesh of `water`, of a sea that runs
    /// up to a coast if `has_coast`.
    pub fn new(gpu: &Gpu, shaders: &Shaders, water: &WaterPass, has_coast: bool) -> Self {
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let uniform = Uniform::<ViewUniform>::new(gpu, "view");
        let slot = BindingType::Uniform(size_of::<ViewUniform>());
        let bindings = [
            slot,
            BindingType::TextureArray,
            BindingType::TextureArray,
            BindingType::TextureArray,
            BindingType::TextureArray,
            BindingType::StorageRead(8),
            BindingType::StorageRead(8),
        ];
        let map_layout = gpu.bind_group_layout("view/map", fragment, &bindings);
        let module = shaders.module(gpu, "views/map");
        let output = &water.scene.output;
        let map_pipeline = gpu.render_pipeline(
            "view/map",
            &RenderProgram::new(&module),
            &[&map_layout],
            &attachments(&output.format(), DEPTH_TEST_BACKGROUND),
        );
        let surface_layout = gpu.bind_group_layout("view/surface", fragment, &[slot]);
        let surface_group = gpu.bind_group("view/surface", &surface_layout, &[uniform.buffer.as_entire_binding()]);
        let module = shaders.module(gpu, "views/surface");
        let [scene, maps, mesh] = water.mesh_layouts();
        let layouts = [scene, maps, mesh, &surface_layout];
        let constants = [switch_constant("WATER_COAST", has_coast)];
        let surface_pipeline = gpu.render_pipeline(
            "view/surface",
            &RenderProgram { constants: &constants, ..RenderProgram::new(&module) },
            &layouts,
            &attachments(&output.format(), DEPTH_TEST_OPAQUE),
        );
        Self { uniform, map_layout, map_pipeline, surface_pipeline, surface_group, has_coast }
    }

    /// Records the pass that draws the false-colour view selected in the scene's look into the HDR target.
    pub fn draw(
        &self,
        gpu: &Gpu,
        (encoder, timer): (&mut wgpu::CommandEncoder, &Timer),
        (maps, scene): (&Maps, &Scene),
        water: &WaterPass,
        targets: &Targets,
    ) {
        use wgpu::BindingResource::TextureView;
        self.uniform.write(gpu, &ViewUniform::new(scene, maps, targets.size));
        let mut pass = targets.begin_alone(encoder, timer.render_pass("view"));
        if let DisplayedView::Surface(_) = scene.look.view.displayed {
            pass.set_pipeline(&self.surface_pipeline);
            pass.set_bind_group(3, &self.surface_group, &[]);
            water.draw_mesh(&mut pass);
        } else {
            let resources = [
                self.uniform.buffer.as_entire_binding(),
                TextureView(&maps.displacement),
                TextureView(&maps.gradients),
                TextureView(&maps.slope_moments),
                TextureView(&maps.foam),
                maps.h0.as_entire_binding(),
                maps.wave_table.as_entire_binding(),
            ];
            pass.set_pipeline(&self.map_pipeline);
            pass.set_bind_group(0, &gpu.bind_group("view/map", &self.map_layout, &resources), &[]);
            pass.draw(0..3, 0..1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_fit_side_by_side() {
        for (count, size, columns) in
            [(1, [1280, 720], 1), (4, [1280, 720], 2), (4, [2000, 300], 4), (3, [300, 900], 1)]
        {
            let (corners, side) = largest_squares(count, size);
            assert_eq!(corners.len(), count as usize);
            for (i, a) in corners.iter().enumerate() {
                assert!((0..2).all(|axis| a[axis] + side <= size[axis]), "{count} in {size:?}: {corners:?} {side}");
                for b in &corners[..i] {
                    assert!((0..2).any(|axis| a[axis].abs_diff(b[axis]) >= side + MAP_GAP_PIXELS), "{corners:?}");
                }
            }
            let in_first_row = corners.iter().filter(|c| c[1] == corners[0][1]).count();
            assert_eq!(in_first_row, columns, "{count} in {size:?}: as large as fits");
        }
        assert_eq!(largest_squares(4, [1, 1]).1, 1);
    }
}
