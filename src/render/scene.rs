//! The scene: camera, look settings, sea state and floating objects of a picture.

use crate::coast::PlacedCoast;
use crate::point::floating::HullPose;
use crate::sim::maps::MAX_CASCADES;
use crate::state::camera::View;
use crate::state::look::Look;
use crate::waves::Plan;
use crate::waves::colour_scale::ColourScale;
use crate::waves::slopes::{self, SlopeVariance};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Speed of low clouds divided by wind speed at 10 m, from a logarithmic wind profile up to the boundary layer's top.
const CLOUD_SPEED_PER_WIND_SPEED: f64 = 1.4;

/// Speed of the large breaking crests that throw spray, divided by the phase speed of the waves at the peak of the
/// spectrum. The mean of all fronts is slower (docs/design/foam.md).
const BREAKER_SPEED_RATIO: f64 = 0.7;

/// Everything that determines a picture besides the maps of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// View of the camera: position of the eye (its y is the height above the still water), axes and field of view.
    pub view: View,
    /// Whether the eye's height is measured from the moving water below it, as on a buoy, not from the still water.
    pub height_from_waves: bool,
    /// Settings of sky, water surface, film (exposure and tone curve) and false-colour view.
    pub look: Look,
    /// Properties of the drawn sea; during a transition, interpolated between those of the old and the new sea.
    pub sea: SeaAppearance,
    /// The old sea while it fades out in a cross-fade to a sea with other waves; None otherwise.
    pub fading_sea: Option<FadingSea>,
    /// Mean amount of foam, 0 (none) to 1 (full cover), that is expected for the sea state; drawn where no foam level
    /// (square foam grid around the camera) reaches.
    pub mean_foam: f64,
    /// Simulated time, s.
    pub t_s: f64,
    /// Distance that the clouds have drifted along x and z since time 0, m.
    pub cloud_drift_m: [f64; 2],
    /// Colour scales of a false-colour view, one for each cascade or, in a view of foam, each foam level; else unused.
    pub colour_scales: [ColourScale; MAX_CASCADES],
    /// Positions and orientations of the floating objects in world coordinates.
    pub hulls: Vec<HullPose>,
    /// The land that the sea runs up to; None in the open sea.
    pub land: Option<Arc<PlacedCoast>>,
    /// Whether the sea runs up to a coast, of which the maps tell.
    pub has_coast: bool,
    /// Whether the picture may be drawn with the pipelines of the picture before while others are being compiled. A
    /// running sea may, so that new fog or clouds do not stop it; a still may not.
    pub may_keep_pipelines: bool,
    /// Whether the water has the light of the lean tier, as a running sea on a slow GPU has (shaders/water/lean.wgsl).
    pub is_lean: bool,
}

impl Scene {
    /// The time counted in periods of `period_s`, s: the whole number, which seeds random numbers, and the fraction.
    pub fn moment(&self, period_s: f64) -> (u32, f32) {
        let periods = self.t_s / period_s;
        (periods.floor().rem_euclid(f64::from(u32::MAX)) as u32, periods.rem_euclid(1.0) as f32)
    }

    /// Whether the eye is below the still water, or on a buoy below the moving water. Waves do not lift it then, and
    /// parts of the picture may show air.
    pub fn dives(&self) -> bool {
        self.view.eye.y < 0.0
    }

    /// Whether the eye is so deep that no wave trough reaches it and all of the picture lies under water.
    pub fn is_submerged(&self) -> bool {
        let trough_m = if self.height_from_waves { 0.0 } else { 1.5 * self.sea.hs_m };
        self.view.eye.y < -(0.6 + trough_m)
    }
}

/// Properties of a sea that the renderer needs besides the maps, derived from its [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct SeaAppearance {
    /// Choppiness: factors by which the horizontal displacements along x and z are multiplied; 1 is linear theory.
    pub choppiness: [f64; 2],
    /// Significant wave height, m.
    pub hs_m: f64,
    /// How far surf moves the water near the eye to and fro besides, m; 0 in the open sea.
    pub surf_displacement_m: f64,
    /// Length in deep water of the waves at the peak of the spectrum, m.
    pub peak_wavelength_m: f64,
    /// Acceleration of gravity, m/s^2.
    pub gravity_m_s2: f64,
    /// Water depth, m.
    pub depth_m: f64,
    /// Height of the still water in world coordinates, m.
    pub still_water_level_m: f64,
    /// Wind speed 10 m above the sea, m/s.
    pub wind_m_s: f64,
    /// Direction towards which the wind blows: unit vector (x, z), x east and z south.
    pub downwind: [f64; 2],
    /// Speed of breaking crests, m/s.
    pub breaker_speed_m_s: f64,
    /// Velocity (x, z) of the clouds, m/s.
    pub cloud_velocity_m_s: [f64; 2],
    /// Slope variance along and across the wind of waves too short for any cascade: the total of Cox and Munk (1954)
    /// minus that of the waves in the cascades.
    pub unresolved_slope_variance: SlopeVariance,
    /// Slope variances, along and across the wind, of the waves in the finest cascade (the shortest waves). They tell
    /// how much of the unresolved variance ripples (shrunk copies of this cascade) can represent.
    pub finest_cascade_slope_variance: SlopeVariance,
    /// Slope variances, along and across the wind, of the waves in all cascades. They tell below which elevation of the
    /// sun waves shade each other.
    pub resolved_slope_variance: SlopeVariance,
    /// Half the shortest wavelength of waves that form distinct caustics on the bed, m; shorter detail is ignored.
    pub caustic_filter_m: f64,
}

impl SeaAppearance {
    /// Derives the properties of a sea from its plan. `look` provides the refractive indices, for the caustics.
    pub fn new(plan: &Plan, look: &Look) -> Self {
        let wind_m_s = plan.sea.first_system().wind_m_s;
        let resolved_slope_variance = slopes::resolved_slope_variance(plan);
        Self {
            choppiness: plan.sea.choppiness_xz(),
            hs_m: plan.hs_m(),
            surf_displacement_m: 0.0,
            peak_wavelength_m: TAU * plan.sea.gravity_m_s2 / (plan.omega_p * plan.omega_p).max(1e-6),
            gravity_m_s2: plan.sea.gravity_m_s2,
            depth_m: plan.sea.depth_m,
            still_water_level_m: plan.sea.still_water_level_m,
            wind_m_s,
            downwind: plan.downwind,
            breaker_speed_m_s: BREAKER_SPEED_RATIO * plan.omega_p / plan.dispersion.wave_number(plan.omega_p).max(1e-6),
            cloud_velocity_m_s: plan.downwind.map(|w| w * CLOUD_SPEED_PER_WIND_SPEED * wind_m_s),
            unresolved_slope_variance: slopes::residual_slope_variance(plan, resolved_slope_variance),
            resolved_slope_variance,
            finest_cascade_slope_variance: plan
                .cascades
                .last()
                .map_or([0.0; 2], |c| slopes::slope_variance_between(plan, c.k_low, c.k_high)),
            caustic_filter_m: Self::caustic_filter_m(plan, look),
        }
    }

    /// A deep sea of the significant wave height `hs_m`, m, in a wind of 10 m/s.
    #[cfg(test)]
    pub fn for_test(hs_m: f64) -> Self {
        Self {
            choppiness: [1.0; 2],
            hs_m,
            surf_displacement_m: 0.0,
            peak_wavelength_m: 60.0,
            gravity_m_s2: 9.81,
            depth_m: 4000.0,
            wind_m_s: 10.0,
            downwind: [1.0, 0.0],
            breaker_speed_m_s: 7.0,
            unresolved_slope_variance: [0.005; 2],
            resolved_slope_variance: [0.02; 2],
            finest_cascade_slope_variance: [0.005; 2],
            caustic_filter_m: 1.0,
            still_water_level_m: 0.0,
            cloud_velocity_m_s: [0.0; 2],
        }
    }

    /// Half the shortest wavelength of waves that form distinct caustics on the bed, m, for the refractive indices in
    /// `look`; detail of the surface shorter than this is left out of the caustics.
    pub fn caustic_filter_m(plan: &Plan, look: &Look) -> f64 {
        let reflection = &look.surface.reflection;
        let reach_m = plan.sea.depth_m * (1.0 - reflection.index_air / reflection.index_water);
        slopes::shortest_caustic_half_wavelength_m(plan, reach_m.max(0.0))
    }

    /// A copy with the choppiness and still-water level of `plan`, a plan of the same waves; the rest stays as it is.
    pub fn with_surface_of(&self, plan: &Plan) -> Self {
        Self { choppiness: plan.sea.choppiness_xz(), still_water_level_m: plan.sea.still_water_level_m, ..self.clone() }
    }

    /// Larger of the choppiness factors (on horizontal displacements) along x and along z.
    pub fn max_choppiness(&self) -> f64 {
        self.choppiness[0].max(self.choppiness[1])
    }
}

/// Properties of the old sea during a cross-fade, for its ripples (shrunk copies of its finest cascade).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FadingSea {
    /// Slope variances, along the wind and across it, of the waves in the fading sea's finest cascade.
    pub finest_cascade_slope_variance: SlopeVariance,
    /// Old sea's fraction of the sum of both elevation variances, from 1 at the cross-fade's start to 0 at its end.
    pub variance_fraction: f64,
}
