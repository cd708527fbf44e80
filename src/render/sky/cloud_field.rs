//! Parameters of the volumetric clouds of a scene, from their kind, cover and wind, for the passes that compute them.

use crate::gpu::layout::gpu_struct;
use crate::render::scene::Scene;
use crate::render::water::bed::normal_quantile;
use crate::state::camera::View;
use crate::state::look::CloudKind;

/// Standard deviation of the smooth noise of the clouds, whose mean is 1/2.
const NOISE_DEVIATION: f64 = 0.16;
/// Length of the longest path of sunlight through the layer of clouds, in thicknesses (its reciprocal is
/// WGSL `SKY_LOWEST_BEAM`).
const LONGEST_SHADOW: f64 = 12.0;

/// Step, degrees, of the direction at which the columns of the dome are narrowest: a paused picture that is turned needs
/// a new dome only after a step.
const AHEAD_STEP_DEG: f64 = 30.0;

gpu_struct! {
    /// WGSL `CloudField`: the clouds, for the passes that compute them. The field has its own axes, x along the wind.
    #[derive(Default)]
    pub struct CloudField as "CloudField" {
        /// Height of the cloud base above the sea, km.
        pub base_km: f32,
        /// Reciprocal of the thickness of the layer of clouds, 1/km.
        pub layers_per_km: f32,
        /// Reciprocal of the side of the tile with which the clouds repeat, 1/km.
        pub tiles_per_km: f32,
        /// Extinction coefficient of dense cloud, 1/km.
        pub extinction_per_km: f32,
        /// Reciprocal of the side of the noise that shapes the clouds, 1/km; a whole number of them fills the tile.
        pub shapes_per_km: f32,
        /// Reciprocal of the side of the fine noise, 1/km; a whole number of them fills the tile, too.
        pub details_per_km: f32,
        /// Height of the heads that the noise adds to the clouds and takes from them, km.
        pub shape_amplitude: f32,
        /// Height of the heads that the fine noise adds to the clouds and takes from them, km.
        pub detail_amplitude: f32,
        /// Reciprocal of the depth in which the cloud becomes dense, 1/km.
        pub sharpness: f32,
        /// Reciprocal of the height above the base in which the cloud becomes dense, 1/km.
        pub base_sharpness: f32,
        /// Height of a heap of cloud divided by its radius, both as fractions of the thickness and of the tile's side.
        pub steepness: f32,
        /// Fraction of the sky that the clouds cover.
        pub cover: f32,
        /// Shortest step of a viewing ray, km.
        pub step_km: f32,
        /// Factor on the steps of a viewing ray outside clouds.
        pub stride: f32,
        /// Number of the kind (`CLOUD_CUMULUS` and others in shaders/sky/cloud_kinds.wgsl).
        pub kind: u32,
        /// Layer of the dome texture that the dome pass fills.
        pub layer: u32,
        /// Unit vector (x, z) of the direction towards which the wind blows.
        pub downwind: [f32; 2],
        /// Position of the eye in the field, along and across the wind, km.
        pub eye_km: [f32; 2],
        /// Horizontal unit vector (x, z) in the axes of the world at which the columns of the dome are narrowest: the
        /// viewing direction to within half a step of [`AHEAD_STEP_DEG`].
        pub ahead: [f32; 2],
        /// First row that the dome pass fills, and the distance to the next.
        pub first_row: u32,
        pub row_step: u32,
        /// Height of the bumps of the base, km.
        pub base_bump_km: f32,
        /// Value of the smooth noise of the clouds above which shafts of rain fall.
        pub squall_edge: f32,
    }
}

/// Properties of a kind of clouds: lengths in km, then the others as in [`CloudField`].
struct Kind {
    base_km: f64,
    thickness_km: f64,
    tile_km: f64,
    extinction_per_km: f64,
    shape_km: f64,
    detail_km: f64,
    shape_amplitude_km: f64,
    detail_amplitude_km: f64,
    /// Depth in which the cloud becomes dense, and the height above its base, km. High heaps take about half of it, and
    /// low ones up to three times as much (`cloud_rough_depth` in shaders/sky/cloud_field.wgsl).
    soft_km: [f64; 2],
    base_bump_km: f64,
    /// Height of a heap divided by its radius.
    slope: f64,
    step_km: f64,
    stride: f64,
    /// Speed of the clouds divided by that of low clouds.
    speed: f64,
}

const CUMULUS: Kind = Kind {
    base_km: 0.75,
    thickness_km: 1.1,
    tile_km: 32.0,
    extinction_per_km: 55.0,
    shape_km: 1.0,
    detail_km: 0.25,
    shape_amplitude_km: 0.6,
    detail_amplitude_km: 0.2,
    soft_km: [0.038, 0.11],
    base_bump_km: 0.08,
    slope: 1.0,
    step_km: 0.0072,
    stride: 0.6,
    speed: 1.0,
};
const STRATOCUMULUS: Kind = Kind {
    base_km: 1.0,
    thickness_km: 0.5,
    tile_km: 32.0,
    extinction_per_km: 45.0,
    shape_km: 1.6,
    detail_km: 0.25,
    shape_amplitude_km: 0.72,
    detail_amplitude_km: 0.2,
    soft_km: [0.068, 0.14],
    base_bump_km: 0.1,
    stride: 0.7,
    ..CUMULUS
};
const TOWERING: Kind = Kind {
    base_km: 0.8,
    thickness_km: 4.4,
    tile_km: 64.0,
    extinction_per_km: 45.0,
    shape_km: 2.0,
    detail_km: 0.5,
    shape_amplitude_km: 1.0,
    detail_amplitude_km: 0.35,
    soft_km: [0.06, 0.12],
    base_bump_km: 0.12,
    slope: 2.3,
    step_km: 0.012,
    stride: 0.6,
    speed: 1.3,
};
const CIRRUS: Kind = Kind {
    base_km: 8.6,
    thickness_km: 1.0,
    tile_km: 96.0,
    extinction_per_km: 0.8,
    shape_km: 4.0,
    detail_km: 1.0,
    shape_amplitude_km: 2.2,
    detail_amplitude_km: 1.5,
    soft_km: [1.6, 0.02],
    base_bump_km: 0.0,
    slope: 1.0,
    step_km: 0.072,
    stride: 0.25,
    speed: 2.5,
};
const STORM: Kind = Kind {
    base_km: 0.5,
    thickness_km: 2.2,
    tile_km: 48.0,
    extinction_per_km: 50.0,
    shape_km: 3.0,
    detail_km: 0.6,
    shape_amplitude_km: 1.2,
    detail_amplitude_km: 0.3,
    soft_km: [0.125, 0.19],
    base_bump_km: 0.2,
    slope: 1.0,
    step_km: 0.015,
    stride: 0.6,
    speed: 1.1,
};

impl Kind {
    fn of(kind: CloudKind) -> Option<&'static Self> {
        match kind {
            CloudKind::None => None,
            CloudKind::Cumulus => Some(&CUMULUS),
            CloudKind::Stratocumulus => Some(&STRATOCUMULUS),
            CloudKind::Towering => Some(&TOWERING),
            CloudKind::Cirrus => Some(&CIRRUS),
            CloudKind::Storm => Some(&STORM),
        }
    }
}

/// Value of the smooth noise of the clouds (blue in shaders/sky/cloud_noise.wgsl) above which the fraction `share` of it
/// lies, less half the width of a shaft's edge.
fn squall_edge(share: f64) -> f64 {
    0.5 + NOISE_DEVIATION * -normal_quantile(share.clamp(1e-3, 1.0 - 1e-3)) - 0.05
}

/// [`CloudField::ahead`] for a view.
fn ahead(view: &View) -> [f32; 2] {
    let heading_deg = view.right.z.atan2(view.right.x).to_degrees();
    // Common headings, which are whole multiples of 15 degrees, lie off the edges of the steps.
    let step = (heading_deg / AHEAD_STEP_DEG + 0.483).floor() * AHEAD_STEP_DEG;
    let heading = step.rem_euclid(360.0).to_radians();
    [heading.sin() as f32, -heading.cos() as f32]
}

/// The clouds of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clouds {
    /// Uniform of the passes that compute them, for a whole dome in its first layer.
    pub field: CloudField,
    /// Position (x, z) of the eye in the field, in the axes of the world, km.
    pub eye_km: [f64; 2],
}

impl Clouds {
    /// The volumetric clouds of a scene; None if it has none.
    pub fn new(scene: &Scene) -> Option<Self> {
        let look = &scene.look.sky;
        let kind = Kind::of(look.drawn_clouds())?;
        let [x, z] = scene.sea.downwind;
        let eye_m = [scene.view.eye.x, scene.view.eye.z];
        let eye_km: [f64; 2] = std::array::from_fn(|i| 0.001 * (eye_m[i] - kind.speed * scene.cloud_drift_m[i]));
        let along = |p: [f64; 2]| [p[0] * x + p[1] * z, p[1] * x - p[0] * z];
        let field = CloudField {
            base_km: kind.base_km as f32,
            layers_per_km: kind.thickness_km.recip() as f32,
            tiles_per_km: kind.tile_km.recip() as f32,
            extinction_per_km: kind.extinction_per_km as f32,
            shapes_per_km: kind.shape_km.recip() as f32,
            details_per_km: kind.detail_km.recip() as f32,
            shape_amplitude: kind.shape_amplitude_km as f32,
            detail_amplitude: kind.detail_amplitude_km as f32,
            sharpness: kind.soft_km[0].recip() as f32,
            base_sharpness: kind.soft_km[1].recip() as f32,
            steepness: (kind.slope * kind.tile_km / kind.thickness_km) as f32,
            cover: look.cloud_cover as f32,
            step_km: kind.step_km as f32,
            stride: kind.stride as f32,
            kind: look.drawn_clouds() as u32,
            layer: 0,
            downwind: [x as f32, z as f32],
            eye_km: along(eye_km).map(|p| p.rem_euclid(kind.tile_km) as f32),
            ahead: ahead(&scene.view),
            first_row: 0,
            row_step: 1,
            base_bump_km: kind.base_bump_km as f32,
            squall_edge: squall_edge(look.drawn_squalls()) as f32,
        };
        Some(Self { field, eye_km })
    }

    /// The field without the view. The maps of weather and shadow depend on it, and on the sun.
    pub fn fixed(&self) -> CloudField {
        CloudField { eye_km: [0.0; 2], ahead: [0.0; 2], ..self.field }
    }

    /// How the shadows lie on the sea around the eye, when the unit vector `sun` points to the sun: two vectors whose
    /// products with a position (x, z) relative to the eye, m, are coordinates in the map of shadows, and an offset.
    pub fn shadow_axes(&self, sun: [f32; 3]) -> [[f32; 2]; 3] {
        let [x, z] = self.field.downwind;
        let per_m = 0.001 * self.field.tiles_per_km;
        let steep = sun[1].max(LONGEST_SHADOW.recip() as f32);
        let reach_km = [sun[0], sun[2]].map(|s| s / steep * self.field.base_km);
        let offset = [
            self.field.eye_km[0] + reach_km[0] * x + reach_km[1] * z,
            self.field.eye_km[1] + reach_km[1] * x - reach_km[0] * z,
        ];
        [[x * per_m, z * per_m], [-z * per_m, x * per_m], offset.map(|o| o * self.field.tiles_per_km)]
    }

    /// Height, km, that stands for the clouds where the dome is moved with them.
    pub fn height_km(&self) -> f32 {
        self.field.base_km + 0.25 / self.field.layers_per_km
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::params::Camera;

    /// The clouds repeat without a seam.
    #[test]
    fn whole_numbers_of_noises_fill_the_tile() {
        for kind in [CUMULUS, STRATOCUMULUS, TOWERING, CIRRUS, STORM] {
            for side_km in [kind.shape_km, kind.detail_km] {
                let count = kind.tile_km / side_km;
                assert!((count - count.round()).abs() < 1e-9, "{count} noises of {side_km} km");
            }
        }
    }

    fn ahead_of(heading_deg: f64) -> [f32; 2] {
        ahead(&View::new(&Camera { heading_deg, ..Camera::default() }, 1.5, 0.0))
    }

    /// The dome's columns are narrowest within about half a step of the heading: 15.51 degrees, because the edges of the
    /// steps are shifted. So common headings lie off the edges, where rounding errors would choose between two domes.
    #[test]
    fn narrow_columns_lie_ahead() {
        for i in 0..720 {
            let heading_deg = 0.5 * f64::from(i);
            let [x, z] = ahead_of(heading_deg).map(f64::from);
            let off_deg = x.atan2(-z).to_degrees() - heading_deg;
            assert!((off_deg + 180.0).rem_euclid(360.0) - 180.0 < 15.6, "{heading_deg}: {off_deg}");
            assert!((off_deg + 180.0).rem_euclid(360.0) - 180.0 > -15.6, "{heading_deg}: {off_deg}");
        }
        for i in 0..24 {
            let heading_deg = 15.0 * f64::from(i);
            let near = [heading_deg - 1e-9, heading_deg, heading_deg + 1e-9].map(ahead_of);
            assert_eq!(near, [near[1]; 3], "{heading_deg}");
        }
        assert_eq!(ahead_of(181.0), ahead_of(179.0));
    }
}
