//! Slopes along and across the wind: what the sea has, and what the cascades hold of it.

use super::plan::Plan;
use super::system::{Directions, WaveSystem, angle};
use std::f64::consts::{PI, TAU};

/// Mean square slopes along and across the local wind.
pub type SlopeVariance = [f64; 2];

/// Steps of the quadratures.
const STEPS: usize = 64;

/// The clean sea's, 0.00316 U and 0.003 + 0.00192 U (Cox and Munk 1954).
pub fn cox_munk(wind_m_s: f64) -> SlopeVariance {
    [0.00316 * wind_m_s, 0.003 + 0.00192 * wind_m_s]
}

/// What the waves of a plan between two wave numbers, rad/m, have.
pub fn between(plan: &Plan, low: f64, high: f64) -> SlopeVariance {
    let (first, last) = plan.support();
    let from = first.max(if low > 0.0 { plan.dispersion.omega(low) } else { 0.0 });
    let to = last.min(plan.dispersion.omega(high));
    if plan.is_calm() || from >= to {
        return [0.0; 2];
    }
    let step = (to / from).ln() / STEPS as f64;
    let mut sum = [0.0; 2];
    for i in 0..STEPS {
        let omega = from * (step * (i as f64 + 0.5)).exp();
        let weight = omega * step * plan.dispersion.wave_number(omega).powi(2);
        for system in &plan.systems {
            let along = cosine_square(system, omega, plan.downwind);
            let mss = weight * system.spectrum.density(omega);
            sum[0] += mss * along;
            sum[1] += mss * (1.0 - along);
        }
    }
    sum
}

/// What all cascades of a plan hold.
pub fn resolved(plan: &Plan) -> SlopeVariance {
    plan.resolved_bands()
        .into_iter()
        .map(|(low, high)| between(plan, low, high))
        .fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
}

/// What is left of Cox and Munk's slopes beyond the cascades; never below 0.
pub fn residual(plan: &Plan, resolved: SlopeVariance) -> SlopeVariance {
    let whole = cox_munk(plan.sea.local().wind_m_s);
    [(whole[0] - resolved[0]).max(0.0), (whole[1] - resolved[1]).max(0.0)]
}

/// Length below which waves focus light closer to the surface than `reach_m` (depth times 1 - 1/n), so that their images on
/// the bed overlap and even out: the waves longer than that have a strain of the refracted rays of some six tenths.
pub fn focusing_m(plan: &Plan, reach_m: f64) -> f64 {
    const STRAIN_VARIANCE: f64 = 0.4;
    let (low, high) = (plan.dispersion.wave_number(plan.support().0).max(1e-4), plan.k_max().max(2e-4));
    let step = (high / low).ln() / STEPS as f64;
    let mut variance = 0.0;
    for i in 0..STEPS {
        let (a, b) = (low * (step * i as f64).exp(), low * (step * (i + 1) as f64).exp());
        variance += plan.energy.mss_between(a, b) * a * b * reach_m * reach_m;
        if variance > STRAIN_VARIANCE {
            return PI / a;
        }
    }
    PI / high
}

/// Mean of cos^2 of the angle to `axis` over the directions of a system at a frequency.
fn cosine_square(system: &WaveSystem, omega: f64, axis: [f64; 2]) -> f64 {
    let at = |i: usize| {
        let (sin, cos) = (TAU * (i as f64 + 0.5) / STEPS as f64).sin_cos();
        [cos, sin]
    };
    let square = |k: [f64; 2]| (k[0] * axis[0] + k[1] * axis[1]).powi(2);
    let mean = |density: &dyn Fn([f64; 2]) -> f64| {
        let (mut sum, mut whole) = (0.0, 0.0);
        for k in (0..STEPS).map(at) {
            let d = density(k);
            sum += d * square(k);
            whole += d;
        }
        if whole > 0.0 { sum / whole } else { 0.5 }
    };
    match system.directions(omega) {
        Directions::Measured(mem) => mean(&|k| mem.density(k[1].atan2(k[0]))),
        Directions::Lobes(lobes) => {
            let directed =
                lobes.lobes.iter().map(|(share, lobe)| share * mean(&|k| lobe.shape(angle(system.travel, k))));
            directed.sum::<f64>() + 0.5 * lobes.isotropic
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    fn plan(state: &str) -> Plan {
        Plan::new(&query::parse(state).0)
    }

    #[test]
    fn both_axes_add_up_to_the_mean_square_slope() {
        for state in ["wind=14&fetch=300", "wind=7&spectrum=elfouhaily&spread=elfouhaily", "wind=9&scale2=1&iso=0.3"] {
            let plan = plan(state);
            let [along, across] = resolved(&plan);
            let mss = plan.slope_variance(f64::INFINITY);
            assert!(((along + across) / mss - 1.0).abs() < 0.02, "{state}: {along} + {across} against {mss}");
            assert!(along > across, "{state}: {along} {across}");
        }
        assert_eq!(resolved(&plan("wind=0")), [0.0; 2]);
    }

    #[test]
    fn an_even_sea_has_no_axis() {
        let [along, across] = resolved(&plan("spread=isotropic"));
        assert!((along / across - 1.0).abs() < 1e-9);
        // cos^2 over the circle has 3/4 along.
        let [along, across] = resolved(&plan("spread=cos2"));
        assert!((along / across - 3.0).abs() < 1e-2, "{along} {across}");
    }

    #[test]
    fn deeper_beds_see_longer_waves() {
        let plan = plan("wind=8");
        assert!(focusing_m(&plan, 0.5) < focusing_m(&plan, 2.5));
    }
}
