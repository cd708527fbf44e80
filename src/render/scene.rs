//! What a picture shows.

use crate::point::floating::HullPose;
use crate::sim::maps::MAX_CASCADES;
use crate::state::camera::View;
use crate::state::look::Look;
use crate::waves::Plan;
use crate::waves::colour_scale::ColourScale;
use crate::waves::slopes::{self, SlopeVariance};

/// Speed of low clouds over the wind speed at 10 m: the logarithmic profile up to the top of the boundary layer.
const CLOUDS_OVER_WIND: f64 = 1.4;

/// Everything that a picture depends on besides the maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Eye and projection.
    pub view: View,
    /// Whether the eye's height counts from the water below it.
    pub rides: bool,
    /// Light, sky and film.
    pub look: Look,
    /// The sea of the maps, or a blend of two seas during a transition.
    pub sea: SeaAppearance,
    /// The sea that fades out during a cross-fade.
    pub fading: Option<Fading>,
    /// Mean foam beyond the foam levels, 0 to 1.
    pub mean_foam: f64,
    /// Distance that the clouds have drifted along x and z, m.
    pub cloud_drift_m: [f64; 2],
    /// Colour scales of a view, one for each layer of its maps. The picture ignores them.
    pub scales: [ColourScale; MAX_CASCADES],
    /// Floating objects, in the world.
    pub floats: Vec<HullPose>,
}

/// What the picture takes from the plan of a sea.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaAppearance {
    /// Horizontal displacement factor along x and z.
    pub chop: [f64; 2],
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Depth of the water, m.
    pub depth_m: f64,
    /// Height of the still water in the world, m.
    pub level_m: f64,
    /// Wind speed 10 m above the sea, m/s.
    pub wind_m_s: f64,
    /// Unit vector (x, z) towards which the wind blows.
    pub downwind: [f64; 2],
    /// Velocity (x, z) of the clouds, m/s.
    pub clouds_m_s: [f64; 2],
    /// Slope variance along and across the wind of the waves that no cascade holds.
    pub residual: SlopeVariance,
    /// Slope variance along and across the wind of the finest cascade.
    pub finest: SlopeVariance,
    /// Shortest wavelength that focuses light on the bed, m.
    pub focusing_m: f64,
}

impl SeaAppearance {
    /// The appearance of a plan's sea, for the refractive indices of a look.
    pub fn new(plan: &Plan, look: &Look) -> Self {
        let wind_m_s = plan.sea.local().wind_m_s;
        Self {
            chop: plan.sea.lambda(),
            hs_m: plan.hs_m(),
            depth_m: plan.sea.depth_m,
            level_m: plan.sea.level_m,
            wind_m_s,
            downwind: plan.downwind,
            clouds_m_s: plan.downwind.map(|w| w * CLOUDS_OVER_WIND * wind_m_s),
            residual: slopes::residual(plan, slopes::resolved(plan)),
            finest: plan.cascades.last().map_or([0.0; 2], |c| slopes::between(plan, c.k_low, c.k_high)),
            focusing_m: Self::focusing_m(plan, look),
        }
    }

    /// Shortest wavelength that focuses light on the bed, m.
    pub fn focusing_m(plan: &Plan, look: &Look) -> f64 {
        let reflection = &look.surface.reflection;
        let reach_m = plan.sea.depth_m * (1.0 - reflection.index_air / reflection.index_water);
        slopes::focusing_m(plan, reach_m.max(0.0))
    }

    /// This appearance with the surface of a plan of the same waves.
    pub fn with_surface(&self, plan: &Plan) -> Self {
        Self { chop: plan.sea.lambda(), level_m: plan.sea.level_m, ..self.clone() }
    }

    /// Larger of the two horizontal displacement factors.
    pub fn most_chop(&self) -> f64 {
        self.chop[0].max(self.chop[1])
    }
}

/// A sea that fades out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fading {
    /// Slope variance along and across the wind of its finest cascade.
    pub finest: SlopeVariance,
    /// Its share of the variance, 0 to 1.
    pub share: f64,
}
