//! A wave buoy's measured spectrum.

use super::spectrum::FrequencySpectrum;
use crate::files::measured::MeasuredSpectrum;
use std::sync::Arc;

/// Makes the frequency spectrum S(omega) from a buoy's measured data. Integrals are split at the centres of the buoy's
/// frequency bands, between which the density is linear.
pub fn spectrum(data: &Arc<MeasuredSpectrum>) -> FrequencySpectrum {
    let (omega_min, breakpoints, measured) =
        (data.lowest_omega().max(1e-3), data.density_kinks_rad_s(), Some(Arc::clone(data)));
    let shape = Arc::clone(data);
    let spectrum = FrequencySpectrum::new(data.omega_p(), move |omega| shape.density(omega));
    FrequencySpectrum { omega_min, integration_breakpoints_rad_s: breakpoints, measured, ..spectrum }
}
