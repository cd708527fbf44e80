//! A wave buoy's measured spectrum.

use super::spectrum::FrequencySpectrum;
use crate::files::measured::Measured;
use std::sync::Arc;

/// S(omega) of the buoy's bands. The bands themselves split the quadrature.
pub fn spectrum(measured: &Arc<Measured>) -> FrequencySpectrum {
    let (lowest, breakpoints) = (measured.support().0.max(1e-3), measured.breakpoints());
    let data = Arc::clone(measured);
    FrequencySpectrum {
        lowest,
        breakpoints,
        ..FrequencySpectrum::new(measured.omega_p(), move |omega| data.density(omega))
    }
}
