//! How much of a sea a change of parameters invalidates.

use crate::state::Params;
use crate::state::params::{Foam, Sea};

/// The levels of a sea, from the cheapest to the most expensive one to change. A change of a level also changes the levels
/// before it: the foam's threshold depends on the surface, and the surface on the waves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SeaChange {
    /// How foam forms and fades: the foam's parameters follow.
    Foam,
    /// Chop or water level: uniforms and the heights on the CPU follow.
    Surface,
    /// The waves: a new [`Plan`](super::Plan), its tables, h0 and the theory follow.
    Waves,
}

impl SeaChange {
    /// The highest level in which the seas of two states differ; None if they are equal.
    pub fn between(a: &Params, b: &Params) -> Option<Self> {
        if a.grid == b.grid { Self::between_seas(&a.sea, &b.sea) } else { Some(Self::Waves) }
    }

    /// The highest level in which two seas on the same grid differ; None if they are equal.
    pub fn between_seas(a: &Sea, b: &Sea) -> Option<Self> {
        // A parameter that is not named here belongs to the waves.
        let without_foam = |sea: &Sea| Sea { foam: Foam::default(), ..sea.clone() };
        let waves = |sea: &Sea| Sea { chop: 0.0, chop_x: 0.0, chop_z: 0.0, level_m: 0.0, ..without_foam(sea) };
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

    /// The default state with one parameter changed to its largest, or else its smallest value.
    fn changed(key: &str) -> Params {
        let field = FIELDS.iter().find(|f| f.key == key).unwrap();
        let (low, high) = match field.kind {
            FieldKind::Number { min, max, .. } => (min, max),
            FieldKind::Integer { min, max } => (f64::from(min), f64::from(max)),
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
                ("chop" | "chopx" | "chopz" | "level", _) => Some(SeaChange::Surface),
                ("loop", _) | (_, Group::Sea | Group::Swell | Group::Water | Group::Grid) => Some(SeaChange::Waves),
                _ => None,
            };
            assert_eq!(change, expected, "{}", field.key);
        }
    }

    #[test]
    fn a_plan_of_another_surface_is_the_plan_of_its_state() {
        let plan = Plan::new(&Params::default());
        for key in ["chop", "chopz", "level", "foamdecay", "whitecaps", "foambias"] {
            let params = changed(key);
            assert_eq!(plan.with_surface(&params.sea), Plan::new(&params), "{key}");
        }
    }
}
