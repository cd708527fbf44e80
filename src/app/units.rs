//! Units of the panel. Parameters are stored in metric units; the panel can show and accept nautical units.

use super::App;
use crate::app::language::local_number;
use crate::state::fields::{Field, Group};
use crate::state::params::Units;

/// A metric unit, its nautical counterpart, and the number of nautical units in one metric unit.
struct Unit {
    metric: &'static str,
    nautical: &'static str,
    factor: f64,
}

const NAUTICAL: [Unit; 3] = [
    Unit { metric: "m/s", nautical: "kn", factor: 3600.0 / 1852.0 },
    Unit { metric: "m", nautical: "ft", factor: 1.0 / 0.3048 },
    Unit { metric: "km", nautical: "nmi", factor: 1.0 / 1.852 },
];

/// Unit in which the panel shows a quantity (metric or nautical), and the conversion factor from the metric unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitScale {
    /// Symbol of the shown unit; empty for a dimensionless quantity.
    pub unit: &'static str,
    /// Conversion factor: the shown value divided by the metric value.
    pub factor: f64,
}

impl UnitScale {
    /// Shown unit and conversion factor for a quantity with the metric unit `unit`, if the user has chosen `units`
    /// (metric or nautical).
    pub fn for_unit(unit: &'static str, units: Units) -> Self {
        match NAUTICAL.iter().find(|u| units == Units::Nautical && u.metric == unit) {
            Some(u) => Self { unit: u.nautical, factor: u.factor },
            None => Self { unit: if unit == "deg" { "°" } else { unit }, factor: 1.0 },
        }
    }

    /// The unit and conversion factor with which a parameter is shown. Parameters of the FFT grid always stay metric.
    pub fn for_field(field: &Field, units: Units) -> Self {
        Self::for_unit(field.unit, if field.group == Group::Grid { Units::Metric } else { units })
    }

    /// Converts a metric value to the shown unit, and formats it with that unit and a number of decimals.
    pub fn format(self, value: f64, decimals: usize) -> String {
        let space = if self.unit.is_empty() || self.unit == "°" { "" } else { " " };
        format!("{}{space}{}", local_number(format!("{:.decimals$}", value * self.factor)), self.unit)
    }

    /// The unit as a suffix of a slider's number, with a space where one is usual.
    pub fn suffix(self) -> String {
        if self.unit.is_empty() || self.unit == "°" { self.unit.to_owned() } else { format!(" {}", self.unit) }
    }

    /// Parses a typed number without a unit, or with the metric or nautical unit of the quantity ("20 kn", "6ft", "3
    /// m"). Returns the value in the shown unit, or `None` if the text is no such number.
    pub fn parse(self, text: &str) -> Option<f64> {
        let text = text.trim().replace(',', ".");
        let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.').map_or(0, |i| i + 1);
        let (number, unit) = (text[..end].trim(), text[end..].trim());
        let number: f64 = number.parse().ok()?;
        let unit = if matches!(unit, "kt" | "kts" | "knots") { "kn" } else { unit };
        if unit.is_empty() || unit == self.unit {
            return Some(number);
        }
        let pair = NAUTICAL.iter().find(|u| [u.nautical, u.metric].contains(&self.unit))?;
        let metric = if unit == pair.nautical { number / pair.factor } else { number };
        let is_known = [pair.nautical, pair.metric].contains(&unit);
        is_known.then_some(round_to_significant_digits(metric * self.factor))
    }
}

/// Rounds a number to seven significant digits: converted from 25 kn, a wind is 12.86111 m/s in the link.
pub fn round_to_significant_digits(x: f64) -> f64 {
    format!("{x:.6e}").parse().unwrap_or(x)
}

impl App {
    /// The unit (metres or feet) and conversion factor with which lengths are shown.
    pub(super) fn length_scale(&self) -> UnitScale {
        UnitScale::for_unit("m", self.params.screen.units)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knots_feet_and_miles() {
        let scale = |unit| UnitScale::for_unit(unit, Units::Nautical);
        assert_eq!(scale("m/s").format(10.0, 1), "19.4 kn");
        assert_eq!(scale("m").format(3.0, 1), "9.8 ft");
        assert_eq!(scale("km").format(1.852, 1), "1.0 nmi");
        assert_eq!(scale("s").format(8.0, 1), "8.0 s");
        assert_eq!(UnitScale::for_unit("deg", Units::Metric).format(40.0, 0), "40°");
    }

    #[test]
    fn typed_units_are_understood() {
        let metric = UnitScale::for_unit("m/s", Units::Metric);
        assert!((metric.parse("20 kn").expect("knots") - 10.288_888).abs() < 1e-5);
        assert!((UnitScale::for_unit("m/s", Units::Nautical).parse("10m/s").expect("m/s") - 19.438_444).abs() < 1e-5);
        assert_eq!(UnitScale::for_unit("m", Units::Metric).parse("3,5"), Some(3.5));
        assert_eq!(metric.parse("25 kn"), Some(12.86111));
        assert_eq!(metric.parse("20 ft"), None);
        assert_eq!(metric.parse("fast"), None);
        assert_eq!(UnitScale::for_unit("deg", Units::Metric).parse("-4°"), Some(-4.0));
    }
}
