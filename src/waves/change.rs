//! Classification of parameter changes by how much of a sea has to be computed again.

use crate::state::Params;
use crate::state::params::{FoamSettings, Sea};

/// What a parameter change makes the program compute again, from the cheapest kind of change to the most expensive one.
/// Each kind includes the kinds before it: the foam threshold depends on the surface, and the surface on the waves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SeaChange {
    /// Formation or decay of foam: only the parameters of the foam pass are updated.
    Foam,
    /// Order of the wave theory, chop (horizontal displacement) or water level: uniform buffers and the sea heights computed on the CPU (for
    /// boats, buoys and the camera) are updated.
    Surface,
    /// The waves themselves: a new [`Plan`](super::Plan), the spectrum tables, the wave amplitudes at time 0 and the
    /// statistics of the sea are computed.
    Waves,
}

impl SeaChange {
    /// Most expensive kind of change from the sea and grid parameters in `a` to those in `b`; `None` if all are equal. A
    /// coast that comes or goes changes how the patch of the longest waves covers the sea; another coast does not.
    pub fn between(a: &Params, b: &Params) -> Option<Self> {
        if a.grid == b.grid && a.coast.is_on() == b.coast.is_on() {
            Self::between_seas(&a.sea, &b.sea)
        } else {
            Some(Self::Waves)
        }
    }

    /// Most expensive kind of change between two seas of the same grid (FFT size, cascades); `None` if all is equal.
    pub fn between_seas(a: &Sea, b: &Sea) -> Option<Self> {
        // A parameter of the sea that is not reset here counts as a change of the waves.
        let without_foam = |sea: &Sea| Sea { foam: FoamSettings::default(), ..sea.clone() };
        let waves = |sea: &Sea| Sea {
            wave_order: 1,
            chop: 0.0,
            chop_x: 0.0,
            chop_z: 0.0,
            still_water_level_m: 0.0,
            ..without_foam(sea)
        };
        if a == b {
            None
        } else if without_foam(a) == without_foam(b) {
            Some(Self::Foam)
        } else if waves(a) == waves(b) {
            Some(Self::Surface)
        } else {
            Some(Self::Waves)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::fields::{FIELDS, FieldKind, Group};
    use crate::waves::Plan;

    /// The default parameters with `key` at its largest value, or at its smallest if the largest is the default.
    fn changed(key: &str) -> Params {
        let field = FIELDS.iter().find(|f| f.key == key).unwrap();
        let (low, high) = match field.kind {
            FieldKind::Number { min, max, .. } => (min, max),
            FieldKind::Integer { min, max } => (f64::from(min), f64::from(max)),
            // The last coast is a file, without which the sea stays open.
            FieldKind::Choice(_) if key == "coast" => (0.0, 1.0),
            FieldKind::Choice(words) => (0.0, words.len() as f64 - 1.0),
            _ => (0.0, 1.0),
        };
        let mut params = Params::default();
        let value = if high == field.default_value() { low } else { high };
        (field.set)(&mut params, value);
        params
    }

    #[test]
    fn every_parameter_has_its_level() {
        for field in FIELDS.iter() {
            let change = SeaChange::between(&Params::default(), &changed(field.key));
            let expected = match (field.key, field.group) {
                ("whitecaps" | "foamthreshold" | "foambias" | "foamdecay" | "foamrate", _) => Some(SeaChange::Foam),
                ("order" | "chop" | "chopx" | "chopz" | "level", _) => Some(SeaChange::Surface),
                ("loop" | "coast", _) | (_, Group::Sea | Group::Water | Group::Grid) => Some(SeaChange::Waves),
                (_, group) if group.further_system_index().is_some() => Some(SeaChange::Waves),
                _ => None,
            };
            assert_eq!(change, expected, "{}", field.key);
        }
    }

    #[test]
    fn a_plan_of_another_surface_is_the_plan_of_its_state() {
        let plan = Plan::new(&Params::default());
        for key in ["order", "chop", "chopz", "level", "foamdecay", "whitecaps", "foambias"] {
            let params = changed(key);
            assert_eq!(plan.with_surface_and_foam_of(&params.sea), Plan::new(&params), "{key}");
        }
    }
}
