//! The land that a sea runs up to, and the heights between which it leaves the camera.

use super::Ocean;
use crate::coast::PlacedCoast;
use crate::render::SeaAppearance;
use crate::state::camera::deepest_dive_m;
use crate::state::coast::CoastName;
use crate::state::params::{Camera, Params};
use std::sync::Arc;

/// Least height of the eye above the ground, m.
const ABOVE_GROUND_M: f64 = 1.2;

impl Ocean {
    /// Shows the land of a coast, or with None the open sea, from the next recorded frame on. [`Self::set_params`] places
    /// built-in coasts by itself; a coast from a file must be set with this method.
    pub fn set_land(&mut self, land: Option<Arc<PlacedCoast>>) {
        self.land = land;
    }

    /// The land that is shown; None in the open sea.
    pub fn land(&self) -> Option<&Arc<PlacedCoast>> {
        self.land.as_ref()
    }

    /// Places the coast of new parameters if it is another one than before. A coast from a file stays as it was set.
    pub(super) fn place_land(&mut self, params: &Params) {
        if params.coast != self.params.coast && params.coast.name != CoastName::File {
            self.land = built_in_land(params);
        }
    }
}

/// The land of parameters with a built-in coast; None in the open sea, and for a file.
pub(super) fn built_in_land(params: &Params) -> Option<Arc<PlacedCoast>> {
    PlacedCoast::of_state(&params.coast, None).ok().flatten().map(Arc::new)
}

/// A copy of the camera whose height counts from the still water of `sea`, because the renderer draws still water at
/// height 0. The eye stays above the ground of the land, and a diving one above the bed.
pub(super) fn relative_to_still_water(camera: &Camera, sea: &SeaAppearance, land: Option<&PlacedCoast>) -> Camera {
    let y_m = camera.y_m - sea.still_water_level_m;
    let Some(land) = land else {
        return Camera { y_m, dive_m: camera.dive_m.min(deepest_dive_m(sea.depth_m)), ..camera.clone() };
    };
    let depth_m = land.depth_at_m([camera.x_m, camera.z_m]);
    let dive_m = if depth_m > 0.6 { camera.dive_m.min(deepest_dive_m(depth_m)) } else { 0.0 };
    Camera { y_m: y_m.max(ABOVE_GROUND_M - depth_m), dive_m, ..camera.clone() }
}
