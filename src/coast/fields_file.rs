//! The fields of a sea over a coast as NetCDF, by the CF conventions.

use super::sea_maps::bearing_from_deg;
use super::{Bathymetry, SeaMaps};
use crate::files::netcdf::{self, Attribute, NewVariable, Values};

/// Maps of a sea over a coast, to be written as a file.
#[derive(Clone, Copy, Debug)]
pub struct CoastFields<'a> {
    /// Name of the coast.
    pub title: &'a str,
    /// Name of the program that made the maps, with the state string of the sea.
    pub source: &'a str,
    /// Bearing of the direction from the sea to the land, degrees clockwise from north.
    pub toward_deg: f64,
    /// The depths.
    pub bathymetry: &'a Bathymetry,
    /// The sea at their points.
    pub maps: &'a SeaMaps,
    /// Elevation of the surface at the time of the state, m, at the same points; empty if it is not known.
    pub surface_m: &'a [f32],
}

impl CoastFields<'_> {
    /// Writes depth, wave height, direction, period, breaking fraction and surface as a classic NetCDF file. Points on land
    /// are NaN.
    pub fn netcdf(&self) -> Vec<u8> {
        let grid = self.bathymetry;
        let text = |name: &'static str, value: &str| (name, Attribute::Text(value.to_owned()));
        let about = |long: &str, units: &str, standard: &str| {
            let mut list = vec![text("long_name", long), text("units", units)];
            if !standard.is_empty() {
                list.push(text("standard_name", standard));
            }
            list
        };
        let along = |count: usize| (0..count).map(|i| i as f64 * grid.cell_m).collect::<Vec<f64>>();
        let (x, y) = (along(grid.columns), along(grid.rows));
        // East and north of the middle of the coast.
        let (sin, cos) = self.toward_deg.to_radians().sin_cos();
        let [wide, long] = [grid.columns, grid.rows].map(|count| (count - 1) as f64 * grid.cell_m);
        let world = |index: usize| {
            let (u, v) = (x[index % grid.columns] - 0.5 * wide, y[index / grid.columns] - 0.5 * long);
            [(u * sin + v * cos) as f32, (u * cos - v * sin) as f32]
        };
        let points = grid.depth_m.len();
        let east: Vec<f32> = (0..points).map(|i| world(i)[0]).collect();
        let north: Vec<f32> = (0..points).map(|i| world(i)[1]).collect();
        let in_water = |values: &dyn Fn(usize) -> f32| -> Vec<f32> {
            (0..points).map(|i| if grid.depth_m[i] > 0.0 { values(i) } else { f32::NAN }).collect()
        };
        let hs = in_water(&|i| self.maps.hs_m[i]);
        let from = in_water(&|i| bearing_from_deg(self.toward_deg, f64::from(self.maps.direction_rad[i])) as f32);
        let period = in_water(&|i| self.maps.peak_period_s[i]);
        let breaking = in_water(&|i| self.maps.breaking_fraction[i]);
        let surface = if self.surface_m.is_empty() { Vec::new() } else { in_water(&|i| self.surface_m[i]) };
        let variable = |name, dimensions: &[usize], attributes, values| NewVariable {
            name,
            dimensions: dimensions.to_vec(),
            attributes,
            values,
        };
        let mut variables = vec![
            variable("y", &[0], about("position along the shore", "m", ""), Values::F64(&y)),
            variable("x", &[1], about("position from the sea to the land", "m", ""), Values::F64(&x)),
            variable("east", &[0, 1], about("position east of the middle of the coast", "m", ""), Values::F32(&east)),
            variable(
                "north",
                &[0, 1],
                about("position north of the middle of the coast", "m", ""),
                Values::F32(&north),
            ),
        ];
        let fields: [(&str, &str, &str, &str, &[f32]); 6] = [
            (
                "depth",
                "depth below the still water, negative on land",
                "m",
                "sea_floor_depth_below_mean_sea_level",
                &grid.depth_m,
            ),
            ("hs", "significant wave height", "m", "sea_surface_wave_significant_height", &hs),
            (
                "from_direction",
                "direction that the energy comes from, clockwise from north",
                "degree",
                "sea_surface_wave_from_direction",
                &from,
            ),
            ("tp", "peak period", "s", "sea_surface_wave_period_at_variance_spectral_density_maximum", &period),
            ("breaking", "fraction of the waves that break", "1", "", &breaking),
            ("eta", "elevation of the surface at the time of the state", "m", "", &surface),
        ];
        for (name, long_name, units, standard, values) in fields {
            if !values.is_empty() {
                let mut attributes = about(long_name, units, standard);
                attributes.push(text("coordinates", "east north"));
                variables.push(variable(name, &[0, 1], attributes, Values::F32(values)));
            }
        }
        let toward = format!("{} degrees clockwise from north", self.toward_deg);
        let global = [("Conventions", "CF-1.8"), ("title", self.title), ("source", self.source), ("x_axis", &toward)];
        netcdf::write(&[("y", grid.rows), ("x", grid.columns)], &global, &variables)
    }
}
