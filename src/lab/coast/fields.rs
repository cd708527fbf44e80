//! The fields of a sea over a coast as NetCDF.

use super::CoastSea;
use crate::coast::fields_file::CoastFields;

impl CoastSea {
    /// Writes depth, wave height, direction, period, breaking fraction and surface as a classic NetCDF file. Points on land
    /// are NaN.
    pub fn netcdf(&self) -> Vec<u8> {
        let fields = CoastFields {
            title: &self.coast.title,
            source: &format!("seastate coast '{}'", self.state),
            toward_deg: self.coast.toward_deg,
            bathymetry: &self.coast.bathymetry,
            maps: &self.maps,
            surface_m: &self.surface_m,
        };
        fields.netcdf()
    }
}
