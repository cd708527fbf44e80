//! A random sea over the built-in coasts: records at gauges over many seeds, beside the sum over the components.

use crate::coast::built_in::BUILT_IN;
use crate::coast::open_sea::{edge_depth_m, reflection};
use crate::coast::placed::PlacingOptions;
use crate::coast::{BuiltInCoast, Field, Incident, Options, PlacedCoast, elliptic, parabolic};
use crate::lab::estimate::EstimateWithError;
use crate::lab::validate::measurement::parse_params;
use crate::waves::Plan;
use crate::waves::crests::zero_up_crossing_waves;
use crate::waves::noise;
use crate::waves::statistics::{SpectrumStatistics, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use std::f64::consts::{PI, TAU};

/// The sea, without its depth, which is that of the edge of the coast.
pub const SEA: &str = "wind=12&fetch=200&dir=250&n=128&untile=0&order=1";
/// Number of seeds.
pub const SEEDS: u32 = 64;
/// Gauges on each coast.
pub const GAUGES: usize = 20;
/// Waves that are solved over a coast: the strongest of those that travel towards the land.
pub const WAVES: usize = 400;
/// Distance of the points of the grids, m.
const CELL_M: f64 = 12.0;
/// Shortest waves over a coast, m.
const MIN_WAVELENGTH_M: f64 = 25.0;
/// Least depth at a gauge, m.
const MIN_DEPTH_M: f64 = 1.0;
/// Records: samples, and the time between two, s.
const SAMPLES: usize = 1024;
const STEP_S: f64 = 0.8;
/// Fraction of the variance that the waves of the open sea's record hold.
const OPEN_SHARE: f64 = 0.99;

/// A wave of the lattice of a plan.
struct LatticeWave {
    /// Key of the random numbers of its cascade, and its indices.
    key: (u32, i32, i32),
    /// Standard deviation of the real and imaginary part of its amplitude h0, m.
    deviation_m: f64,
    /// The wave with its root mean square amplitude, in the world's axes.
    incident: Incident,
}

impl LatticeWave {
    /// Amplitude 2 h0 of the wave for a seed, over its root mean square: real and imaginary part.
    fn of_seed(&self, seed: u32) -> [f64; 2] {
        let (noise_key, ix, iz) = self.key;
        let scale = 2.0 * self.deviation_m / self.incident.amplitude_m;
        noise::complex_gaussian(noise::noise_words(seed, noise_key, ix, iz)).map(|v| v * scale)
    }
}

/// The waves of a plan with their root mean square amplitudes, strongest first.
fn lattice_waves(plan: &Plan) -> Vec<LatticeWave> {
    let mut waves = Vec::new();
    for cascade in &plan.cascades {
        let table = SpectrumTable::new(plan, cascade);
        for (ix, iz) in lattice_indices(plan.n) {
            let variance_m2 = 4.0 * table.variance(ix, iz);
            if variance_m2 > 0.0 {
                let incident = Incident {
                    amplitude_m: (2.0 * variance_m2).sqrt(),
                    phase_rad: 0.0,
                    omega_rad_s: table.waves[entry_index(ix, iz)].omega,
                    direction_rad: f64::from(iz).atan2(f64::from(ix)),
                };
                let deviation_m = table.variance(ix, iz).sqrt();
                waves.push(LatticeWave { key: (cascade.noise_key, ix, iz), deviation_m, incident });
            }
        }
    }
    waves.sort_by(|a, b| b.deviation_m.total_cmp(&a.deviation_m));
    waves
}

/// What records of one seed at one point say.
#[derive(Clone, Copy, Debug, Default)]
struct RecordStatistics {
    variance_m2: f64,
    /// Variance that the amplitudes of this seed have: the sum over the components, m^2.
    components_m2: f64,
    kurtosis: f64,
    /// Standard deviation of the squared envelope over its mean: 1 for a Gaussian sea of many waves, 0 for one wave.
    groupiness: f64,
    /// Correlation of the heights of successive waves.
    succession: f64,
}

impl RecordStatistics {
    /// Statistics of an analytic signal, whose real part is the elevation, with the variance of its components.
    fn new([re, im]: &[Vec<f64>; 2], components_m2: f64) -> Self {
        let count = re.len() as f64;
        let mean = |f: &dyn Fn(usize) -> f64| (0..re.len()).map(f).sum::<f64>() / count;
        let level = mean(&|n| re[n]);
        let variance_m2 = mean(&|n| (re[n] - level).powi(2));
        let kurtosis = mean(&|n| (re[n] - level).powi(4)) / (variance_m2 * variance_m2);
        let square = |n: usize| re[n] * re[n] + im[n] * im[n];
        let envelope = mean(&square);
        let groupiness = mean(&|n| (square(n) - envelope).powi(2)).sqrt() / envelope;
        let heights: Vec<f64> = zero_up_crossing_waves(re, STEP_S).iter().map(|w| w.height_m()).collect();
        Self { variance_m2, components_m2, kurtosis, groupiness, succession: succession(&heights) }
    }
}

/// Correlation of each value with the next.
fn succession(values: &[f64]) -> f64 {
    let pairs = values.windows(2);
    let count = pairs.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let product: f64 = pairs.map(|p| (p[0] - mean) * (p[1] - mean)).sum::<f64>() / count;
    let square: f64 = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len().max(1) as f64;
    if square > 0.0 { product / square } else { 0.0 }
}

/// Statistics over the seeds at one point.
#[derive(Clone, Debug)]
pub struct PointStatistics {
    /// Depth, m.
    pub depth_m: f64,
    /// Expected variance of the elevation, m^2: the sum over the components with their expected energy.
    pub expected_m2: f64,
    /// Variance of the records, m^2.
    pub variance_m2: EstimateWithError,
    /// Variance of each record minus the sum over the components with the amplitudes of its seed, m^2.
    pub difference_m2: EstimateWithError,
    /// Kurtosis of the records of each seed, 3 for a long Gaussian record.
    pub kurtosis: EstimateWithError,
    /// Groupiness of the records of each seed: standard deviation of the squared envelope over its mean.
    pub groupiness: EstimateWithError,
    /// Correlation of the heights of successive waves in the records.
    pub succession: EstimateWithError,
}

impl PointStatistics {
    fn new(depth_m: f64, expected_m2: f64, records: &[RecordStatistics]) -> Self {
        let mean =
            |of: fn(&RecordStatistics) -> f64| EstimateWithError::mean(&records.iter().map(of).collect::<Vec<_>>());
        Self {
            depth_m,
            expected_m2,
            variance_m2: mean(|r| r.variance_m2),
            difference_m2: mean(|r| r.variance_m2 - r.components_m2),
            kurtosis: mean(|r| r.kurtosis),
            groupiness: mean(|r| r.groupiness),
            succession: mean(|r| r.succession),
        }
    }

    /// Significant wave height of the component sum and of the records, with the latter's standard error, m.
    pub fn hs_m(&self) -> (f64, EstimateWithError) {
        let hs_m = 4.0 * self.variance_m2.value.sqrt();
        let derivative = if hs_m > 0.0 { 8.0 / hs_m } else { 0.0 };
        (4.0 * self.expected_m2.sqrt(), self.variance_m2.with_propagated_error(hs_m, derivative))
    }

    /// Mean difference of the records' variance from the component sums of their seeds, in standard errors.
    pub fn deviation(&self) -> f64 {
        self.difference_m2.value / self.difference_m2.standard_error.unwrap_or(f64::NAN)
    }
}

/// The records at the gauges of a coast.
#[derive(Clone, Debug)]
pub struct CoastRecords {
    /// Title of the coast.
    pub title: &'static str,
    /// Fraction of the variance of the open sea that the solved waves hold.
    pub share: f64,
    /// The gauges.
    pub gauges: Vec<PointStatistics>,
}

/// Records of waves at points, whose transfer functions `transfers` holds for each wave: statistics of each seed at each
/// point.
fn records(waves: &[LatticeWave], transfers: &[Vec<[f64; 2]>]) -> Vec<Vec<RecordStatistics>> {
    let threads = Options::default().threads.max(1);
    let seeds: Vec<u32> = (1..=SEEDS).collect();
    let work = |seeds: &[u32]| -> Vec<Vec<RecordStatistics>> {
        let mut signals = vec![vec![[vec![0.0; SAMPLES], vec![0.0; SAMPLES]]; transfers.len()]; seeds.len()];
        let mut components_m2 = vec![vec![0.0; transfers.len()]; seeds.len()];
        for (index, wave) in waves.iter().enumerate() {
            let phase = |n: usize| -wave.incident.omega_rad_s * STEP_S * n as f64;
            let turn: Vec<(f64, f64)> = (0..SAMPLES).map(|n| phase(n).sin_cos()).collect();
            for ((seed, signals), sums) in seeds.iter().zip(&mut signals).zip(&mut components_m2) {
                let h = wave.of_seed(*seed);
                for ((transfer, [re, im]), sum) in transfers.iter().zip(signals).zip(sums) {
                    let t = transfer[index];
                    let (a, b) = (t[0] * h[0] - t[1] * h[1], t[0] * h[1] + t[1] * h[0]);
                    *sum += 0.5 * (a * a + b * b);
                    for ((re, im), (sin, cos)) in re.iter_mut().zip(im).zip(&turn) {
                        *re += a * cos - b * sin;
                        *im += a * sin + b * cos;
                    }
                }
            }
        }
        let of_seed = |(signals, sums): (&Vec<[Vec<f64>; 2]>, &Vec<f64>)| {
            signals.iter().zip(sums).map(|(signal, sum)| RecordStatistics::new(signal, *sum)).collect()
        };
        signals.iter().zip(&components_m2).map(of_seed).collect()
    };
    std::thread::scope(|scope| {
        let shares = seeds.chunks(seeds.len().div_ceil(threads));
        let handles: Vec<_> = shares.map(|share| scope.spawn(move || work(share))).collect();
        handles.into_iter().flat_map(|handle| handle.join().unwrap_or_default()).collect()
    })
}

/// Statistics at each point from the records of all seeds.
fn statistics(points: &[(f64, Vec<[f64; 2]>)], waves: &[LatticeWave]) -> Vec<PointStatistics> {
    let transfers: Vec<Vec<[f64; 2]>> = points.iter().map(|p| p.1.clone()).collect();
    let by_seed = records(waves, &transfers);
    let point = |(index, (depth_m, transfer)): (usize, &(f64, Vec<[f64; 2]>))| {
        let expected_m2 = transfer.iter().map(|t| 0.5 * (t[0] * t[0] + t[1] * t[1])).sum();
        let list: Vec<RecordStatistics> = by_seed.iter().map(|points| points[index]).collect();
        PointStatistics::new(*depth_m, expected_m2, &list)
    };
    points.iter().enumerate().map(point).collect()
}

/// Records of the open sea in 12 m of water: the strongest waves of all directions and lengths, which hold 99 % of the
/// variance.
///
/// # Errors
/// If the state string is wrong.
pub fn open_sea() -> Result<PointStatistics, String> {
    let plan = Plan::new(&parse_params(&format!("{SEA}&depth=12"))?);
    let mut waves = lattice_waves(&plan);
    let all: f64 = waves.iter().map(|w| w.incident.variance_m2()).sum();
    let mut sum = 0.0;
    waves.retain(|wave| {
        let keeps = sum < OPEN_SHARE * all;
        sum += wave.incident.variance_m2();
        keeps
    });
    let transfer = waves.iter().map(|wave| [wave.incident.amplitude_m, 0.0]).collect();
    statistics(&[(12.0, transfer)], &waves).pop().ok_or_else(|| "no record".into())
}

/// Records at the gauges of a built-in coast.
///
/// # Errors
/// If the state string is wrong or the coast has no such grid.
pub fn coast_records(coast: &'static BuiltInCoast) -> Result<CoastRecords, String> {
    let options = PlacingOptions { cell_m: Some(CELL_M), ..PlacingOptions::default() };
    let placed = PlacedCoast::built_in(coast, &options)?;
    let params = parse_params(&format!("{SEA}&depth={:.2}", edge_depth_m(&placed)))?;
    let plan = Plan::new(&params);
    let mut waves = lattice_waves(&plan);
    let all: f64 = waves.iter().map(|w| w.incident.variance_m2()).sum();
    waves.retain_mut(|wave| {
        let direction = wave.incident.direction_rad - placed.turn_rad();
        wave.incident.direction_rad = (direction + PI).rem_euclid(TAU) - PI;
        let k = plan.dispersion.wave_number(wave.incident.omega_rad_s);
        wave.incident.direction_rad.abs() < parabolic::MAX_ANGLE_RAD && k * MIN_WAVELENGTH_M < TAU
    });
    waves.truncate(WAVES);
    let share = waves.iter().map(|w| w.incident.variance_m2()).sum::<f64>() / all;
    let field = solve(&placed, &plan, &waves);
    let points: Vec<(f64, Vec<[f64; 2]>)> = gauges(&placed, &field)
        .into_iter()
        .map(|[i, j]| {
            let transfer = (0..waves.len()).map(|c| field.amplitude(c, i, j)).map(|a| [a.re, a.im]).collect();
            (placed.bathymetry.at(i, j), transfer)
        })
        .collect();
    Ok(CoastRecords { title: coast.title, share, gauges: statistics(&points, &waves) })
}

/// Solves the waves over a coast: with the elliptic equation where there are structures.
fn solve(placed: &PlacedCoast, plan: &Plan, waves: &[LatticeWave]) -> Field {
    let incident: Vec<Incident> = waves.iter().map(|wave| wave.incident).collect();
    let gravity_m_s2 = plan.sea.gravity_m_s2;
    let options = Options { gravity_m_s2, ..Options::default() };
    let (field, dissipation) = parabolic::solve(&placed.bathymetry, &incident, &options);
    if placed.structures.is_empty() {
        return field;
    }
    let sea = SpectrumStatistics::new(plan);
    let walls = reflection(placed, sea.hs_m, sea.tp_s, gravity_m_s2);
    elliptic::solve(&placed.bathymetry, &incident, &dissipation, &walls, &options)
}

/// Points of the grid with at least [`MIN_DEPTH_M`] of water and a hundredth of the energy of the open sea, spread evenly
/// (by the additive recurrence of the plastic number).
fn gauges(placed: &PlacedCoast, field: &Field) -> Vec<[usize; 2]> {
    let grid = &placed.bathymetry;
    let variance = |i: usize, j: usize| -> f64 {
        (0..field.components.len()).map(|c| 0.5 * field.amplitude(c, i, j).norm_squared()).sum()
    };
    let open: f64 = field.components.iter().map(|c| c.incident.variance_m2()).sum();
    let mut found = Vec::new();
    for n in 1..2000 {
        let at = |share: f64, count: usize| ((share * f64::from(n)).fract() * (count - 1) as f64).round() as usize;
        let (i, j) = (at(0.754_877_666, grid.columns), at(0.569_840_291, grid.rows));
        if found.len() < GAUGES && grid.at(i, j) >= MIN_DEPTH_M && variance(i, j) > 0.01 * open {
            found.push([i, j]);
        }
    }
    found
}

/// Records of all built-in coasts.
///
/// # Errors
/// If the state string is wrong or a coast has no such grid.
pub fn all_coasts() -> Result<Vec<CoastRecords>, String> {
    BUILT_IN.iter().map(coast_records).collect()
}
