//! The uniform of what water, foam and bed are made of. Depends on the look, the wind and where the eye stands.

use crate::gpu::layout::gpu_struct;
use crate::optics::water::Water;
use crate::render::scene::Scene;
use crate::state::fields::linear_rgb;
use crate::state::look::Body;

/// Layers of noise: four of foam, two of the bed.
const LAYERS: usize = 6;
/// A layer: sides of its tile along and across its axis, m; angle of the axis to the wind, degrees; how much longer it
/// gets along the axis in a storm.
type LayerShape = (f64, f64, f64, f64);
/// Windrows, patches, strands and bubbles of foam; sand in patches with ripples, and in grains. Sides and angles share no
/// period, so that the sum of the layers has none.
const SHAPES: [LayerShape; LAYERS] = [
    (430.0, 430.0, 0.0, 5.0),
    (71.0, 71.0, 7.0, 2.6),
    (10.7, 10.7, -9.0, 1.9),
    (1.63, 1.63, 41.0, 0.0),
    // The ripples of the sand have 38.6 periods to this tile (water_bed.wgsl).
    (12.35, 12.35, 63.0, 0.0),
    (0.97, 0.97, 11.0, 0.0),
];
/// The bed is out of sight where less than this share of vertical light comes back.
const BED_SEEN: f64 = 1e-3;

gpu_struct! {
    /// WGSL `Material`.
    pub struct MaterialUniform as "Material" {
        absorption: [f32; 3],
        ambient: f32,
        backscatter: [f32; 3],
        index_air: f32,
        scatter: [f32; 3],
        bubbles: f32,
        bubble_colour: [f32; 3],
        height_scatter: f32,
        foam_colour: [f32; 3],
        view_scatter: f32,
        bed_colour: [f32; 3],
        diffuse: f32,
        layers: [[f32; 4]; LAYERS],
        layer_feet: [[f32; 2]; LAYERS],
        index_water: f32,
        fresnel_shine: f32,
        fresnel_scale: f32,
        fresnel_normals: f32,
        shininess: f32,
        specular_scale: f32,
        specular_fresnel: f32,
        specular_cut: f32,
        rough_variance: f32,
        foam_roughness: f32,
        foam_relief: f32,
        reflection: f32,
        caustics: f32,
        caustic_m: f32,
        unused: [f32; 2],
    }
}

impl MaterialUniform {
    /// The material of a scene.
    pub fn new(scene: &Scene) -> Self {
        let surface = &scene.look.surface;
        let (body, mirror, foam, bed) = (&surface.body, &surface.mirror, &surface.foam, &surface.bed);
        let water = water(body);
        let colour = |c: f64| linear_rgb(c).map(|x| x as f32);
        let single = |c: [f64; 3]| c.map(|x| x as f32);
        let downwind = scene.sea.downwind.map(f64::from);
        let gale = ((f64::from(scene.sea.wind_m_s) - 8.0) / 16.0).clamp(0.0, 1.0);
        let foot = [scene.view.eye.x, scene.view.eye.z];
        let placed = SHAPES.map(|shape| place(shape, downwind, gale * gale * (3.0 - 2.0 * gale), foot));
        Self {
            absorption: single(water.absorption),
            ambient: body.ambient as f32,
            backscatter: single(water.backscatter),
            index_air: mirror.index_air as f32,
            scatter: single(water.scatter),
            bubbles: body.bubbles as f32,
            bubble_colour: colour(body.bubble_colour),
            height_scatter: body.height as f32,
            foam_colour: colour(foam.colour),
            view_scatter: body.view as f32,
            bed_colour: colour(bed.colour),
            diffuse: body.diffuse as f32,
            layers: placed.map(|(turn, _)| turn),
            layer_feet: placed.map(|(_, foot)| foot),
            index_water: mirror.index_water as f32,
            fresnel_shine: mirror.fresnel_shine as f32,
            fresnel_scale: mirror.fresnel_scale as f32,
            fresnel_normals: mirror.fresnel_normals as f32,
            shininess: mirror.shininess as f32,
            specular_scale: mirror.glitter as f32,
            specular_fresnel: mirror.glitter_fresnel as f32,
            specular_cut: mirror.glitter_cut as f32,
            // alpha^2 = 2 sigma^2, alpha = roughness^2.
            rough_variance: (0.5 * mirror.roughness.powi(4)) as f32,
            foam_roughness: foam.roughness as f32,
            foam_relief: foam.relief as f32,
            reflection: mirror.reflection as f32,
            caustics: bed.caustics as f32,
            caustic_m: scene.sea.focusing_m,
            unused: [0.0; 2],
        }
    }
}

/// What the water is made of.
fn water(body: &Body) -> Water {
    let water = Water::between(body.water, body.mix);
    if body.scatter_colour > 0.0 { water.coloured(linear_rgb(body.scatter_colour)) } else { water }
}

/// Whether enough light comes back from the bed.
pub fn bed_is_seen(scene: &Scene) -> bool {
    let back = water(&scene.look.surface.body).there_and_back(f64::from(scene.sea.depth_m));
    back.into_iter().any(|share| share > BED_SEEN)
}

/// Texture coordinates of a layer: matrix columns for metres beside the eye's foot, and those of the foot.
fn place(
    (along_m, across_m, turn_deg, longer): LayerShape,
    downwind: [f64; 2],
    gale: f64,
    foot: [f64; 2],
) -> ([f32; 4], [f32; 2]) {
    let (sin, cos) = turn_deg.to_radians().sin_cos();
    let axis = [cos * downwind[0] - sin * downwind[1], sin * downwind[0] + cos * downwind[1]];
    let u = axis.map(|x| x / (along_m * (1.0 + longer * gale)));
    let v = [-axis[1] / across_m, axis[0] / across_m];
    let at = |row: [f64; 2]| (row[0] * foot[0] + row[1] * foot[1]).rem_euclid(1.0) as f32;
    ([u[0], v[0], u[1], v[1]].map(|x| x as f32), [at(u), at(v)])
}
