//! Writes a spectrum over frequency and direction as text or NetCDF, in formats that [`super::MeasuredSpectrum::read`]
//! reads, and that other programs read.

use std::fmt::Write as _;

/// Largest whole number in a SWAN file, which stands for the largest density.
const SWAN_LEVELS: f64 = 99_009_900.0;

/// Densities on a grid of frequencies and directions.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalSpectrum {
    /// Frequencies, Hz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Bearings that waves come from, degrees clockwise from north, evenly spaced over the circle.
    pub from_deg: Vec<f64>,
    /// Densities E, m^2/Hz/degree: for each frequency one for each direction.
    pub density_m2_per_hz_deg: Vec<f64>,
    /// Where the spectrum comes from, for the head of the file.
    pub source: String,
}

impl DirectionalSpectrum {
    /// Densities of each frequency.
    fn rows(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.frequencies_hz.iter().copied().zip(self.density_m2_per_hz_deg.chunks(self.from_deg.len()))
    }

    /// Writes a table: a line of directions, then for each frequency a line of densities.
    pub fn to_csv(&self) -> String {
        let mut out = format!(
            "# E(f, direction), m2/Hz/degree; directions are degrees clockwise from north that waves come from\n# {}\nf_hz",
            one_line(&self.source)
        );
        out.extend(self.from_deg.iter().map(|d| format!(",{}", short(*d))));
        for (f, row) in self.rows() {
            let _ = write!(out, "\n{}", short(f));
            out.extend(row.iter().map(|e| format!(",{}", short(*e))));
        }
        out + "\n"
    }

    /// Writes a spectral file of the wave model SWAN with directions, for one time and one place.
    pub fn to_swan(&self) -> String {
        let largest = self.density_m2_per_hz_deg.iter().copied().fold(0.0, f64::max);
        let mut out = format!(
            "SWAN   1                                Swan standard spectral file, version\n\
             $   {}\n\
             TIME                                    time-dependent data\n     1                                  time coding option\n\
             LONLAT                                  locations in spherical coordinates\n     1                                  number of locations\n  0.000000  0.000000\n\
             AFREQ                                   absolute frequencies in Hz\n{:6}                                  number of frequencies\n",
            one_line(&self.source),
            self.frequencies_hz.len()
        );
        out.extend(self.frequencies_hz.iter().map(|f| format!("{f:>12.6}\n")));
        let _ = write!(
            out,
            "NDIR                                    spectral nautical directions in degr\n{:6}                                  number of directions\n",
            self.from_deg.len()
        );
        out.extend(self.from_deg.iter().map(|d| format!("{d:>12.4}\n")));
        out += "QUANT\n     1                                  number of quantities in table\n\
                VaDens                                  variance densities in m2/Hz/degr\n\
                m2/Hz/degr                              unit\n   -0.9900E+02                          exception value\n\
                20000101.000000                         date and time\n";
        if largest == 0.0 {
            return out + "ZERO\n";
        }
        let factor = largest / SWAN_LEVELS;
        let _ = write!(out, "FACTOR\n{factor:>20.8E}\n");
        for (_, row) in self.rows() {
            out.extend(row.iter().map(|e| format!("{:>9}", (e / factor).round())));
            out.push('\n');
        }
        out
    }

    /// Writes a classic NetCDF file with the names of WAVEWATCH III's point spectra, for one time and one station.
    #[cfg(feature = "files")]
    pub fn to_netcdf(&self) -> Vec<u8> {
        use crate::files::netcdf::{Attribute, NewVariable, Values, write};
        let text = |name: &'static str, value: &str| (name, Attribute::Text(value.to_owned()));
        let names = |standard: &str, units: &str| {
            vec![text("long_name", &standard.replace('_', " ")), text("standard_name", standard), text("units", units)]
        };
        let travel_deg: Vec<f64> = self.from_deg.iter().map(|d| (d + 180.0) % 360.0).collect();
        let density: Vec<f64> = self.density_m2_per_hz_deg.iter().map(|e| e.to_degrees()).collect();
        let variable = |name, dimensions: &[usize], attributes, values| NewVariable {
            name,
            dimensions: dimensions.to_vec(),
            attributes,
            values,
        };
        let time = vec![
            text("long_name", "time"),
            text("standard_name", "time"),
            text("units", "days since 1990-01-01 00:00:00"),
            text("calendar", "standard"),
        ];
        let variables = [
            variable("time", &[0], time, Values::F64(&[3652.0])),
            variable("station", &[1], vec![text("long_name", "station id")], Values::F64(&[1.0])),
            variable("longitude", &[0, 1], names("longitude", "degree_east"), Values::F64(&[0.0])),
            variable("latitude", &[0, 1], names("latitude", "degree_north"), Values::F64(&[0.0])),
            variable("frequency", &[2], names("sea_surface_wave_frequency", "s-1"), Values::F64(&self.frequencies_hz)),
            variable("direction", &[3], names("sea_surface_wave_to_direction", "degree"), Values::F64(&travel_deg)),
            variable(
                "efth",
                &[0, 1, 2, 3],
                names("sea_surface_wave_directional_variance_spectral_density", "m2 s rad-1"),
                Values::F64(&density),
            ),
        ];
        let sizes = [self.frequencies_hz.len(), self.from_deg.len()];
        let dimensions = [("time", 1), ("station", 1), ("frequency", sizes[0]), ("direction", sizes[1])];
        let global = [("Conventions", "CF-1.6"), ("data_type", "OCO spectra 2D"), ("source", &one_line(&self.source))];
        write(&dimensions, &global, &variables)
    }
}

/// Number with six significant digits, as short as possible.
fn short(v: f64) -> String {
    let rounded: f64 = format!("{v:.5e}").parse().unwrap_or(v);
    let (plain, power) = (rounded.to_string(), format!("{rounded:e}"));
    if power.len() < plain.len() { power } else { plain }
}

/// Text without line breaks, cut to 200 characters.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(200).collect()
}
