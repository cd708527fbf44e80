//! `seastate record`: time series of the surface elevation, the velocity of the water and its dynamic pressure at points,
//! for codes that compute ships and platforms.

use super::write_file;
use crate::coast::transfer::TransferSolver;
use crate::coast::{PlacedCoast, Transfer};
use crate::files::netcdf::{self, Attribute, NewVariable, Values};
use crate::ocean::coast_task::solve_at_once;
use crate::point::StrongestWaves;
use crate::point::kinematics::{WaterMotion, depth_at_coast_m};
use crate::state::{Params, query};
use crate::waves::Plan;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

/// Largest number of samples, times times points.
const MAX_SAMPLES: f64 = 20e6;
/// Names of the columns of a point, and their units.
const COLUMNS: [(&str, &str); 5] = [("eta", "m"), ("u", "m_s"), ("v", "m_s"), ("w", "m_s"), ("p", "pa")];

/// Format of the file of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordFormat {
    /// Text with a column for each value.
    Csv,
    /// Classic NetCDF.
    NetCdf,
}

impl RecordFormat {
    /// Format that the ending of a file's name says: `.csv` or `.nc`.
    ///
    /// # Errors
    /// One sentence, if it is neither.
    pub fn for_path(path: &Path) -> Result<Self, String> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("nc") => Ok(Self::NetCdf),
            Some("csv") => Ok(Self::Csv),
            _ => Err(format!("{}: the name of a record ends in .csv or .nc", path.display())),
        }
    }
}

/// Points, length and sampling rate of a record of the sea.
#[derive(Clone, Debug)]
pub struct RecordSettings {
    /// Points: metres to the east and to the north, and the height from the still water; `None` for the surface.
    pub points: Vec<(f64, f64, Option<f64>)>,
    /// Length of the record, h.
    pub hours: f64,
    /// Samples per second, Hz.
    pub rate_hz: f64,
    /// Number of waves that are summed, the strongest of the sea.
    pub wave_count: usize,
}

/// A record: for each time and point the values of [`COLUMNS`].
pub struct Record {
    times_s: Vec<f64>,
    /// Values \[time\]\[point\]\[column\].
    values: Vec<[f32; 5]>,
    points: Vec<(f64, f64, Option<f64>)>,
    state: String,
    /// Rms height of the waves that were left out, m.
    pub residual_rms_m: f64,
}

/// Records the sea of `params`, from its time on. Points above the surface give NaN for all but the elevation.
///
/// The elevation is that of the drawn sea at the point. Velocity and dynamic pressure are those of linear theory at the
/// point; between the still water and a crest they are those at the still water. At the surface (no height given) the
/// velocity is that of the water particle, and the dynamic pressure is that of the elevation.
///
/// # Errors
/// One sentence, if a setting is out of range.
pub fn run(params: &Params, settings: &RecordSettings) -> Result<Record, String> {
    let plan = Plan::new(params);
    let count = (settings.hours * 3600.0 * settings.rate_hz).round();
    let is_positive = |v: f64| v > 0.0 && v.is_finite();
    if !is_positive(settings.hours) || !is_positive(settings.rate_hz) || count < 1.0 {
        return Err("the hours and the rate must be above 0".into());
    }
    if count * settings.points.len() as f64 > MAX_SAMPLES {
        return Err(format!("more than {MAX_SAMPLES} samples: record fewer hours or points, or with a lower rate"));
    }
    for &(x_m, y_m, height_m) in &settings.points {
        if ![x_m, y_m, height_m.unwrap_or_default()].iter().all(|v| v.abs() <= 1e7) {
            return Err("a point is more than 10,000 km away".into());
        }
    }
    let transfer = transfer(params)?;
    for &(x_m, y_m, height_m) in &settings.points {
        let depth_m = transfer.as_ref().map_or(plan.sea.depth_m, |t| depth_at_coast_m(&plan, t, [x_m, -y_m]));
        if height_m.is_some_and(|z| z < -depth_m) {
            return Err(format!("the point {x_m},{y_m} is below the bed, which is {depth_m} m deep there"));
        }
    }
    let mut surface = StrongestWaves::new(&plan, settings.wave_count);
    if let Some(transfer) = &transfer {
        surface = surface.with_coast(&plan, transfer);
    }
    let motion_at = |at: [f64; 2], height_m: f64| match &transfer {
        Some(transfer) => WaterMotion::at_coast(&plan, transfer, at, height_m, settings.wave_count),
        None => WaterMotion::new(&plan, at, height_m, settings.wave_count),
    };
    let times_s: Vec<f64> = (0..count as usize).map(|i| params.clock.t_s + i as f64 / settings.rate_hz).collect();
    let mut values = vec![[0.0; 5]; times_s.len() * settings.points.len()];
    for (i, &(x_m, y_m, height_m)) in settings.points.iter().enumerate() {
        // The world's z axis points south.
        let at = [x_m, -y_m];
        let motion = height_m.map(|z| (z, motion_at(at, z)));
        for (t, out) in times_s.iter().zip(values.iter_mut().skip(i).step_by(settings.points.len())) {
            let sample = surface.sample(at[0], at[1], *t);
            let eta = sample.height_m - plan.sea.still_water_level_m;
            let (velocity, pressure) = match &motion {
                None => (sample.velocity_m_s, plan.sea.density_kg_m3 * plan.sea.gravity_m_s2 * eta),
                Some((z, _)) if *z > eta => ([f64::NAN; 3], f64::NAN),
                Some((_, motion)) => {
                    let below = motion.sample(*t);
                    (below.velocity_m_s, below.dynamic_pressure_pa)
                }
            };
            *out = [eta, velocity[0], -velocity[2], velocity[1], pressure].map(|v| v as f32);
        }
    }
    Ok(Record {
        times_s,
        values,
        points: settings.points.clone(),
        state: query::write(params),
        residual_rms_m: surface.residual_rms_m(),
    })
}

/// The transfer functions of the waves over the coast of a state; `None` in the open sea. Solving them takes seconds.
fn transfer(params: &Params) -> Result<Option<Arc<Transfer>>, String> {
    let coast = PlacedCoast::of_state(&params.coast, None)?;
    Ok(coast.map(|coast| Arc::new(solve_at_once::<TransferSolver>(params, &coast))))
}

impl Record {
    /// Writes the record to a file.
    ///
    /// # Errors
    /// One sentence, if the file cannot be written.
    pub fn write(&self, path: &Path, format: RecordFormat) -> Result<(), String> {
        match format {
            RecordFormat::NetCdf => write_file(path, self.netcdf()),
            RecordFormat::Csv => write_file(path, self.csv()),
        }
    }

    fn csv(&self) -> String {
        let mut out = format!("# seastate record '{}'\n", self.state);
        out += "# x east, y north, z up from the still water; eta elevation, u v w velocity to x y z, p dynamic pressure\n";
        for (i, (x, y, z)) in self.points.iter().enumerate() {
            let z = z.map_or_else(|| "surface".to_owned(), |z| format!("{z} m"));
            let _ = writeln!(out, "# point {}: x {x} m, y {y} m, z {z}", i + 1);
        }
        out += "t_s";
        for i in 1..=self.points.len() {
            out.extend(COLUMNS.iter().map(|(name, unit)| format!(",{name}{i}_{unit}")));
        }
        out.push('\n');
        for (t, row) in self.times_s.iter().zip(self.values.chunks(self.points.len())) {
            let _ = write!(out, "{t}");
            for value in row.iter().flatten() {
                let _ = write!(out, ",{value}");
            }
            out.push('\n');
        }
        out
    }

    fn netcdf(&self) -> Vec<u8> {
        let text = |name: &'static str, value: &str| (name, Attribute::Text(value.to_owned()));
        let about = |long: &str, units: &str| vec![text("long_name", long), text("units", units)];
        let positions: [Vec<f64>; 3] = [
            self.points.iter().map(|p| p.0).collect(),
            self.points.iter().map(|p| p.1).collect(),
            self.points.iter().map(|p| p.2.unwrap_or(f64::NAN)).collect(),
        ];
        let column = |i: usize| self.values.iter().map(|v| v[i]).collect::<Vec<f32>>();
        let columns: Vec<Vec<f32>> = (0..COLUMNS.len()).map(column).collect();
        let variable = |name, dimensions: &[usize], attributes, values| NewVariable {
            name,
            dimensions: dimensions.to_vec(),
            attributes,
            values,
        };
        let mut variables = vec![
            variable("time", &[0], about("time of the simulation", "s"), Values::F64(&self.times_s)),
            variable("x", &[1], about("position to the east", "m"), Values::F64(&positions[0])),
            variable("y", &[1], about("position to the north", "m"), Values::F64(&positions[1])),
            variable(
                "z",
                &[1],
                about("height from the still water, NaN for the moving surface", "m"),
                Values::F64(&positions[2]),
            ),
        ];
        let meanings = [
            ("sea surface elevation above the still water", "m"),
            ("velocity of the water to the east", "m s-1"),
            ("velocity of the water to the north", "m s-1"),
            ("upward velocity of the water", "m s-1"),
            ("dynamic pressure, less that of still water", "Pa"),
        ];
        for (((name, _), (long, units)), values) in COLUMNS.iter().zip(meanings).zip(&columns) {
            variables.push(variable(name, &[0, 1], about(long, units), Values::F32(values)));
        }
        let dimensions = [("time", self.times_s.len()), ("point", self.points.len())];
        netcdf::write(
            &dimensions,
            &[("Conventions", "CF-1.6"), ("source", &format!("seastate record '{}'", self.state))],
            &variables,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::netcdf::Dataset;

    #[test]
    fn a_record_is_the_sea_at_its_points() {
        let params = query::parse("wind=8&fetch=50&n=64&t=100&level=2").0;
        let points =
            vec![(0.0, 0.0, None), (10.0, 20.0, Some(-5.0)), (10.0, 20.0, Some(3.0)), (10.0, 20.0, Some(0.05))];
        let settings = RecordSettings { points, hours: 0.05, rate_hz: 2.0, wave_count: 800 };
        let record = run(&params, &settings).expect("a record");
        let plan = Plan::new(&params);
        let sea = StrongestWaves::new(&plan, 800);
        assert_eq!((record.times_s.len(), record.times_s[1]), (360, 100.5));
        for (i, t) in record.times_s.iter().enumerate() {
            let row = &record.values[4 * i..4 * i + 4];
            let want = sea.sample(0.0, 0.0, *t);
            assert!((f64::from(row[0][0]) - (want.height_m - 2.0)).abs() < 1e-6);
            assert!((f64::from(row[0][2]) + want.velocity_m_s[2]).abs() < 1e-6);
            assert_eq!((row[1][0], row[1][1].is_nan()), (row[2][0], false));
            assert!(row[2][1..].iter().all(|v| v.is_nan()), "3 m is above every crest");
            assert_eq!(row[3][1].is_nan(), row[3][0] < 0.05);
        }
        // Half the energy of the pressure at 5 m is lost for waves of some length; all of it stays below the surface's.
        let rms = |point: usize, column: usize| {
            let values = (0..360).map(|i| f64::from(record.values[4 * i + point][column]));
            (values.map(|v| v * v).sum::<f64>() / 360.0).sqrt()
        };
        let head_m = rms(1, 4) / (1025.0 * 9.81);
        assert!(head_m < 0.8 * rms(1, 0) && head_m > 0.05 * rms(1, 0), "{head_m} {}", rms(1, 0));

        let bytes = record.netcdf();
        let file = Dataset::open(&bytes).expect("a file");
        let eta = file.numbers(file.find("eta").expect("eta")).expect("values");
        assert!(eta.iter().zip(&record.values).all(|(a, b)| *a == f64::from(b[0])));
        let csv = record.csv();
        let rows: Vec<&str> = csv.lines().filter(|l| !l.starts_with('#')).collect();
        assert_eq!((rows.len(), rows[0].split(',').count(), rows[360].split(',').count()), (361, 21, 21));
        assert!(rows[0].starts_with("t_s,eta1_m,u1_m_s,v1_m_s,w1_m_s,p1_pa,eta2_m"));
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        let params = query::parse("depth=20").0;
        let settings = |point, hours, rate_hz| RecordSettings { points: vec![point], hours, rate_hz, wave_count: 10 };
        let on = (0.0, 0.0, None);
        for (settings, says) in [
            (settings(on, 0.0, 4.0), "above 0"),
            (settings(on, f64::NAN, 4.0), "above 0"),
            (settings(on, 1e6, 100.0), "samples"),
            (settings((f64::INFINITY, 0.0, None), 1.0, 4.0), "away"),
            (settings((0.0, 0.0, Some(-21.0)), 1.0, 4.0), "below the bed"),
        ] {
            assert!(run(&params, &settings).map(drop).expect_err(says).contains(says));
        }
    }
}
