//! What a picture shows: camera, settings, sea state and floating objects.

use crate::point::floating::HullPose;
use crate::sim::maps::MAX_CASCADES;
use crate::state::camera::View;
use crate::state::look::Look;
use crate::waves::Plan;
use crate::waves::colour_scale::ColourScale;
use crate::waves::slopes::{self, SlopeVariance};

/// Speed of low clouds divided by the wind speed at 10 m: logarithmic wind profile up to the top of the boundary layer.
const CLOUDS_OVER_WIND: f64 = 1.4;

/// Everything that determines a picture besides the maps of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Position, axes and field of view of the camera.
    pub view: View,
    /// Whether the eye's height counts from the moving water below it instead of the still water.
    pub rides: bool,
    /// Settings of sky, water surface, film and view.
    pub look: Look,
    /// Sea state that is drawn, interpolated during a transition between two seas.
    pub sea: SeaAppearance,
    /// The sea that fades out during a cross-fade; None otherwise.
    pub fading: Option<Fading>,
    /// Mean foam, 0 to 1, which is drawn outside the foam levels.
    pub mean_foam: f64,
    /// Distance that the clouds have drifted along x and z, m.
    pub cloud_drift_m: [f64; 2],
    /// Colour scales of a false-colour view, one for each cascade or foam level. The picture does not use them.
    pub scales: [ColourScale; MAX_CASCADES],
    /// World positions and orientations of the floating objects.
    pub floats: Vec<HullPose>,
}

/// Parameters of a sea that the renderer needs, derived from its [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct SeaAppearance {
    /// Choppiness: factors on the horizontal displacement along x and z; 1 is linear theory.
    pub chop: [f64; 2],
    /// Significant wave height, m.
    pub hs_m: f64,
    /// Water depth, m.
    pub depth_m: f64,
    /// Height of the still water in world coordinates, m.
    pub level_m: f64,
    /// Wind speed 10 m above the sea, m/s.
    pub wind_m_s: f64,
    /// Unit vector (x, z) towards which the wind blows.
    pub downwind: [f64; 2],
    /// Velocity (x, z) of the clouds, m/s.
    pub clouds_m_s: [f64; 2],
    /// Unresolved slope variance along and across the wind: that of Cox and Munk (1954) minus that of all cascades.
    pub residual: SlopeVariance,
    /// Slope variance along and across the wind of the waves in the finest cascade.
    pub finest: SlopeVariance,
    /// Half the shortest wavelength that focuses light into caustics on the bed, m.
    pub focusing_m: f64,
}

impl SeaAppearance {
    /// The appearance of the sea of a plan. `look` provides the refractive indices of air and water.
    pub fn new(plan: &Plan, look: &Look) -> Self {
        let wind_m_s = plan.sea.first_system().wind_m_s;
        Self {
            chop: plan.sea.choppiness(),
            hs_m: plan.hs_m(),
            depth_m: plan.sea.depth_m,
            level_m: plan.sea.level_m,
            wind_m_s,
            downwind: plan.downwind,
            clouds_m_s: plan.downwind.map(|w| w * CLOUDS_OVER_WIND * wind_m_s),
            residual: slopes::residual_slope_variance(plan, slopes::resolved_slope_variance(plan)),
            finest: plan.cascades.last().map_or([0.0; 2], |c| slopes::slope_variance_between(plan, c.k_low, c.k_high)),
            focusing_m: Self::focusing_m(plan, look),
        }
    }

    /// Half the shortest wavelength that focuses light into caustics on the bed, m.
    pub fn focusing_m(plan: &Plan, look: &Look) -> f64 {
        let reflection = &look.surface.reflection;
        let reach_m = plan.sea.depth_m * (1.0 - reflection.index_air / reflection.index_water);
        slopes::shortest_caustic_half_wavelength_m(plan, reach_m.max(0.0))
    }

    /// This appearance with the choppiness and still-water level of `plan`, whose waves must be the same.
    pub fn with_surface(&self, plan: &Plan) -> Self {
        Self { chop: plan.sea.choppiness(), level_m: plan.sea.level_m, ..self.clone() }
    }

    /// Larger of the two choppiness factors, along x and along z.
    pub fn most_chop(&self) -> f64 {
        self.chop[0].max(self.chop[1])
    }
}

/// The sea that fades out during a cross-fade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fading {
    /// Slope variance along and across the wind of the waves in its finest cascade.
    pub finest: SlopeVariance,
    /// Fraction of the drawn wave variance that this sea has, 0 to 1.
    pub share: f64,
}
