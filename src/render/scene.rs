//! What a picture shows.

use crate::point::afloat::Pose;
use crate::sim::maps::MAX_CASCADES;
use crate::state::camera::View;
use crate::state::look::Look;
use crate::waves::scale::Scale;
use crate::waves::slopes::SlopeVariance;

/// Everything that a picture depends on besides the maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Eye and projection.
    pub view: View,
    /// Whether the eye's height counts from the water below it.
    pub rides: bool,
    /// Light, sky and film.
    pub look: Look,
    /// What the maps do not tell of the sea.
    pub sea: SeaLook,
    /// What the colours of a view stand for, layer by layer of its maps; the picture has no use for it.
    pub scales: [Scale; MAX_CASCADES],
    /// What floats, in the world.
    pub floats: Vec<Pose>,
    /// Height of the still water in the world, m.
    pub level_m: f64,
}

/// What a picture must know of the sea besides the maps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaLook {
    /// Horizontal displacement along x and z.
    pub chop: [f32; 2],
    /// Significant wave height, m.
    pub hs_m: f32,
    /// Depth of the water, m.
    pub depth_m: f32,
    /// Wind 10 m above the sea, m/s.
    pub wind_m_s: f32,
    /// Unit vector (x, z) where the wind blows to.
    pub downwind: [f32; 2],
    /// Mean square slopes, along and across the wind, of the waves that no cascade holds.
    pub residual: SlopeVariance,
    /// And of those that the finest cascade holds.
    pub finest: SlopeVariance,
    /// The sea that it fades out of.
    pub fading: Option<Fading>,
    /// Waves shorter than this focus no light on the bed, m.
    pub focusing_m: f32,
    /// Foam beyond the foam levels.
    pub mean_foam: f32,
    /// Wavelength of the peak, m.
    pub lambda_p_m: f32,
    /// How far the clouds have drifted along x and z, m.
    pub cloud_drift_m: [f64; 2],
}

/// A sea that fades into the one that is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fading {
    /// Mean square slopes, along and across the wind, of the waves that its finest cascade holds.
    pub finest: SlopeVariance,
    /// What is left of it: its share of the variance.
    pub share: f64,
}
