//! The directional spectrum of a planned sea on a grid of frequencies and directions, for other programs.

use super::plan::Plan;
use crate::files::measured::{DirectionalSpectrum, MeasuredSpectrum};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Number of frequencies and of directions, unless the sea is a measured spectrum with its own.
const FREQUENCY_COUNT: usize = 72;
const DIRECTION_COUNT: usize = 72;
/// Lowest and highest frequency as multiples of the lowest and the highest peak frequency of the wave systems.
const FREQUENCY_RANGE: [f64; 2] = [0.4, 8.0];
/// Highest frequency that is written, Hz: the highest that is read.
const MAX_FREQUENCY_HZ: f64 = 2.0;

impl Plan {
    /// Densities E(f, direction) of the sea. The frequencies and the directions are those of its measured spectrum if it
    /// consists of one, else logarithmic and even steps around the peaks.
    ///
    /// The sum over the directions of a frequency times their step is the density S(f) of the sea exactly.
    pub fn directional_spectrum(&self, source: &str) -> DirectionalSpectrum {
        let measured = match &self.systems[..] {
            [only] => only.spectrum.measured.as_deref(),
            _ => None,
        };
        let frequencies_hz =
            measured.map_or_else(|| self.frequency_grid_hz(), |m| m.bands().iter().map(|b| b.0).collect());
        let table = measured.and_then(MeasuredSpectrum::directional_table);
        let (first_deg, count) = table.map_or((0.0, DIRECTION_COUNT), |t| (t.first_from_deg(), t.direction_count()));
        let step_deg = 360.0 / count as f64;
        let from_deg: Vec<f64> = (0..count).map(|i| first_deg + i as f64 * step_deg).collect();
        let mut density = Vec::with_capacity(count * frequencies_hz.len());
        for f in &frequencies_hz {
            let omega = TAU * f;
            let mut row = vec![0.0; count];
            for system in &self.systems {
                let shares: Vec<f64> = from_deg
                    .iter()
                    .map(|deg| {
                        let (sin, cos) = (deg.to_radians() + FRAC_PI_2).sin_cos();
                        system.direction_density(omega, [cos, sin])
                    })
                    .collect();
                let sum: f64 = shares.iter().sum();
                let per_degree = if sum > 0.0 { TAU * system.spectrum.density(omega) / (sum * step_deg) } else { 0.0 };
                row.iter_mut().zip(shares).for_each(|(e, share)| *e += share * per_degree);
            }
            density.extend(row);
        }
        DirectionalSpectrum { frequencies_hz, from_deg, density_m2_per_hz_deg: density, source: source.to_owned() }
    }

    fn frequency_grid_hz(&self) -> Vec<f64> {
        let peaks = self.systems.iter().map(|s| s.spectrum.omega_p / TAU);
        let (low, high) = peaks.fold((f64::INFINITY, 0.0_f64), |(low, high), f| (low.min(f), high.max(f)));
        let (low, high) = if low.is_finite() { (low, high) } else { (0.1, 0.1) };
        let high = (FREQUENCY_RANGE[1] * high).clamp(1e-6, MAX_FREQUENCY_HZ);
        let low = (FREQUENCY_RANGE[0] * low).min(0.5 * high);
        let ratio = (high / low).ln() / (FREQUENCY_COUNT - 1) as f64;
        // Four digits, which every format keeps.
        let rounded = |f: f64| format!("{f:.3e}").parse().unwrap_or(f);
        (0..FREQUENCY_COUNT).map(|i| rounded(low * (ratio * i as f64).exp())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::query;

    /// Reads a file back and compares the energy and the direction of each frequency.
    fn compare(name: &str, bytes: Vec<u8>, want: &DirectionalSpectrum) {
        let read = MeasuredSpectrum::read(&[(name.to_owned(), bytes)]).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read.notices, [""; 0], "{name}");
        let (bands, n) = (read.spectrum.bands(), want.from_deg.len());
        let table = read.spectrum.directional_table().expect("directions");
        assert_eq!((bands.len(), table.direction_count()), (want.frequencies_hz.len(), n), "{name}");
        let largest = want.density_m2_per_hz_deg.iter().copied().fold(0.0, f64::max);
        for (i, (f, s)) in bands.iter().enumerate() {
            let row = &want.density_m2_per_hz_deg[i * n..(i + 1) * n];
            let (sum, step_deg) = (row.iter().sum::<f64>(), 360.0 / n as f64);
            assert!((f / want.frequencies_hz[i] - 1.0).abs() < 1e-4, "{name}: {f} Hz");
            // The whole numbers of a SWAN file end at 1e-8 of the peak.
            let floor = 1e-8 * largest * step_deg * n as f64;
            assert!(
                (s - sum * step_deg).abs() < 1e-3 * sum * step_deg + floor,
                "{name}: {s} at {f} Hz, not {}",
                sum * step_deg
            );
            if sum * step_deg > 1e3 * floor {
                // Straight lines between the directions smear the moment a little.
                let half = 0.5 * step_deg.to_radians();
                let [x, z] =
                    table.between([(i, 1.0), (i, 0.0)]).first_moment().map(|m| m * (half / half.sin()).powi(2));
                let moment = row.iter().zip(&want.from_deg).fold([0.0; 2], |[x, z], (e, deg)| {
                    let (sin, cos) = (deg.to_radians() + FRAC_PI_2).sin_cos();
                    [x + e / sum * cos, z + e / sum * sin]
                });
                assert!(
                    (x - moment[0]).abs() < 2e-3 && (z - moment[1]).abs() < 2e-3,
                    "{name}: {x} {z}, not {moment:?}"
                );
            }
        }
    }

    #[test]
    fn every_format_brings_the_spectrum_back() {
        for state in [
            "wind=12&fetch=200",
            "wind=6&fetch=30&dir=13&scale2=1&dir2=200&hs2=3&tp2=14",
            "wind=20&spectrum=tma&depth=15&spread=hasselmann",
            "spectrum=measured&measured=d*4*20_.05*1*--AAggAA_.1*3*ABAD--CC_.2*1*AAAA--QQ",
            "spectrum=measured&measured=0.05*0.5*250*251*0.8*0.5_0.1*3*240*241*0.7*0.4_0.2*1*200*230*0.5*0.2",
        ] {
            let plan = Plan::new(&query::parse(state).0);
            let spectrum = plan.directional_spectrum(state);
            for (i, f) in spectrum.frequencies_hz.iter().enumerate() {
                let n = spectrum.from_deg.len();
                let sum: f64 = spectrum.density_m2_per_hz_deg[i * n..(i + 1) * n].iter().sum();
                let want = TAU * plan.density(TAU * f);
                assert!((sum * 360.0 / n as f64 - want).abs() <= 1e-9 * want, "{state}");
            }
            compare("a.csv", spectrum.to_csv().into_bytes(), &spectrum);
            compare("a.sp2", spectrum.to_swan().into_bytes(), &spectrum);
            #[cfg(feature = "files")]
            compare("a.nc", spectrum.to_netcdf(), &spectrum);
        }
    }

    /// The variance of a sea is that of its file, by the trapezium rule over the file's frequencies.
    #[test]
    fn the_file_holds_the_energy_of_the_sea() {
        for state in ["", "wind=5&fetch=20", "wind=25&fetch=1000", "scale2=1", "spectrum=pm&wind=15", "wind=0"] {
            let plan = Plan::new(&query::parse(state).0);
            let file = MeasuredSpectrum::read(&[("a.csv".into(), plan.directional_spectrum("").to_csv().into_bytes())]);
            match file {
                Ok(file) => {
                    let ratio = file.spectrum.hs_m() / plan.hs_m();
                    assert!((ratio - 1.0).abs() < 0.01, "{state}: {ratio}");
                }
                Err(reason) => assert!(plan.is_calm() && reason.contains("waves"), "{state}: {reason}"),
            }
        }
    }
}
