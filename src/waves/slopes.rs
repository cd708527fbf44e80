//! Mean square slopes along and across the local wind: of a clean sea surface (Cox and Munk 1954), of the waves that
//! the cascades resolve, and the difference of the two, which only the shading uses.

use super::plan::Plan;
use super::system::{DirectionalDistribution, WaveSystem, angle_from_travel};
use std::f64::consts::{PI, TAU};

/// Mean square slopes of the sea surface, dimensionless: first along, then across the direction of the local wind.
pub type SlopeVariance = [f64; 2];

/// Number of steps of each numerical integral of this module, over frequency, wave number or direction.
const INTEGRATION_STEPS: usize = 64;

/// Mean square slopes of a clean sea at the wind speed U (m/s): 0.00316 U along the wind and 0.003 + 0.00192 U across
/// it (Cox and Munk 1954).
pub fn cox_munk_slope_variance(wind_m_s: f64) -> SlopeVariance {
    [0.00316 * wind_m_s, 0.003 + 0.00192 * wind_m_s]
}

/// Mean square slopes of all waves with wave numbers from `k_low` to `k_high` (rad/m), along and across the local wind:
/// the integral of k^2 S(omega) times the mean of cos^2 or sin^2 of the angle between wave and wind.
pub fn slope_variance_between(plan: &Plan, k_low: f64, k_high: f64) -> SlopeVariance {
    let (first, last) = plan.frequency_range();
    let from = first.max(if k_low > 0.0 { plan.dispersion.omega(k_low) } else { 0.0 });
    let to = last.min(plan.dispersion.omega(k_high));
    if plan.is_calm() || from >= to {
        return [0.0; 2];
    }
    let step = (to / from).ln() / INTEGRATION_STEPS as f64;
    let mut sum = [0.0; 2];
    for i in 0..INTEGRATION_STEPS {
        let omega = from * (step * (i as f64 + 0.5)).exp();
        let weight = omega * step * plan.dispersion.wave_number(omega).powi(2);
        for system in &plan.systems {
            let along = mean_cos2_from_axis(system, omega, plan.downwind);
            let mss = weight * system.spectrum.density(omega);
            sum[0] += mss * along;
            sum[1] += mss * (1.0 - along);
        }
    }
    sum
}

/// Mean square slopes along and across the local wind of the waves in the cascades of a plan.
pub fn resolved_slope_variance(plan: &Plan) -> SlopeVariance {
    plan.resolved_bands()
        .into_iter()
        .map(|(low, high)| slope_variance_between(plan, low, high))
        .fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
}

/// Mean square slopes of the waves too short for the cascades, which only the shading uses: those of Cox and Munk
/// (1954) minus `resolved`, those of the waves in the cascades, at least 0.
pub fn residual_slope_variance(plan: &Plan, resolved: SlopeVariance) -> SlopeVariance {
    let total = cox_munk_slope_variance(plan.sea.first_system().wind_m_s);
    [0, 1].map(|axis| (total[axis] - resolved[axis]).max(0.0))
}

/// Half of the shortest wavelength that forms distinct caustics on the sea bed, m. The picture computes its caustics
/// from wave slopes averaged over this length.
///
/// Refracted sunlight is compressed on the bed by a strain of `reach_m` times the curvature of the surface, where
/// `reach_m` is the water depth times 1 - n_air/n_water (refractive indices). Where longer waves alone cause a strain
/// variance of 0.4, the light patterns of shorter waves overlap and blur.
pub fn shortest_caustic_half_wavelength_m(plan: &Plan, reach_m: f64) -> f64 {
    const MAX_CAUSTIC_STRAIN_VARIANCE: f64 = 0.4;
    let (low, high) = (plan.dispersion.wave_number(plan.frequency_range().0).max(1e-4), plan.k_max().max(2e-4));
    let step = (high / low).ln() / INTEGRATION_STEPS as f64;
    let mut variance = 0.0;
    for i in 0..INTEGRATION_STEPS {
        let (a, b) = (low * (step * i as f64).exp(), low * (step * (i + 1) as f64).exp());
        variance += plan.spectrum_integrals.mss_between_wave_numbers(a, b) * a * b * reach_m * reach_m;
        if variance > MAX_CAUSTIC_STRAIN_VARIANCE {
            return PI / a;
        }
    }
    PI / high
}

/// Mean of cos^2 of the angle between `axis`, a unit vector (x, z), and the directions of travel of the waves of
/// `system` at angular frequency `omega` (rad/s), weighted by the directional spreading; 1/2 for isotropic waves.
fn mean_cos2_from_axis(system: &WaveSystem, omega: f64, axis: [f64; 2]) -> f64 {
    let mean = |density: &dyn Fn([f64; 2]) -> f64| {
        let (mut sum, mut total) = (0.0, 0.0);
        for i in 0..INTEGRATION_STEPS {
            let (sin, cos) = (TAU * (i as f64 + 0.5) / INTEGRATION_STEPS as f64).sin_cos();
            let d = density([cos, sin]);
            sum += d * (cos * axis[0] + sin * axis[1]).powi(2);
            total += d;
        }
        if total > 0.0 { sum / total } else { 0.5 }
    };
    match system.directional_distribution(omega) {
        DirectionalDistribution::Tabulated(table) => mean(&|k| table.density(k[1].atan2(k[0]))),
        DirectionalDistribution::Measured(mem) => mean(&|k| mem.density(k[1].atan2(k[0]))),
        DirectionalDistribution::Lobes(lobes) => {
            let directed = lobes.lobes.iter().map(|(share, lobe)| {
                share * mean(&|k| lobe.unnormalised_density(angle_from_travel(system.travel_direction, k)))
            });
            directed.sum::<f64>() + 0.5 * lobes.isotropic_fraction
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
            let [along, across] = resolved_slope_variance(&plan);
            let mss = plan.resolved_slope_variance_below(f64::INFINITY);
            assert!(((along + across) / mss - 1.0).abs() < 0.02, "{state}: {along} + {across} against {mss}");
            assert!(along > across, "{state}: {along} {across}");
        }
        assert_eq!(resolved_slope_variance(&plan("wind=0")), [0.0; 2]);
    }

    #[test]
    fn an_even_sea_has_no_axis() {
        let [along, across] = resolved_slope_variance(&plan("spread=isotropic"));
        assert!((along / across - 1.0).abs() < 1e-9);
        // For D = cos^2 / pi the mean of cos^2 is 3/4.
        let [along, across] = resolved_slope_variance(&plan("spread=cos2"));
        assert!((along / across - 3.0).abs() < 1e-2, "{along} {across}");
    }

    #[test]
    fn deeper_beds_see_longer_waves() {
        let plan = plan("wind=8");
        assert!(shortest_caustic_half_wavelength_m(&plan, 0.5) < shortest_caustic_half_wavelength_m(&plan, 2.5));
    }
}
