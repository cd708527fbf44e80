//! Frequency spectra S(omega): one-sided variance density of the elevation, m^2 s. The integral of S over the angular
//! frequency omega (rad/s) is the elevation variance m0.
//!
//! Each family is a file with a function that makes a [`FrequencySpectrum`] from `SpectrumInputs`. A new family takes
//! three files: its own, this one (its `mod` line and its arm of `spectrum_of_family`), and `state/sea.rs` (its variant
//! and its word).

mod depth_limit;
mod donelan;
mod elfouhaily;
mod generalised_ab;
mod jonswap;
mod karaev;
mod marnero;
mod measured;
mod ochi_hubble;
mod phillips;
mod spectrum;
mod tessendorf;
#[cfg(test)]
mod tests;
mod torsethaugen;

use super::dispersion::Dispersion;
use crate::state::params::{Sea, SpectrumKind, WaveSystemParams};
use depth_limit::with_depth_factor;
use spectrum::SpectrumInputs;
use std::f64::consts::TAU;

pub use elfouhaily::elfouhaily_delta;
pub use spectrum::FrequencySpectrum;

/// Wind speed at 10 m height below which the wind makes no waves, m/s.
const MIN_WIND_M_S: f64 = 0.05;
/// Elevation variance, m^2, below which a spectrum is not scaled to the user's wave height but counts as calm.
const MIN_M0_M2: f64 = 1e-12;
/// Shortest peak period that the user can set, s; waves with this period are 14 cm long.
const MIN_PEAK_PERIOD_S: f64 = 0.3;

/// Makes the frequency spectrum of the wave system `system` of a sea, scaled to the user's wave height. It is 0 without
/// wind, unless the user has set height and period or has loaded a buoy's data.
pub fn spectrum_of_system(sea: &Sea, system: &WaveSystemParams) -> FrequencySpectrum {
    let (dispersion, gravity_m_s2) = (Dispersion::new(sea), sea.gravity_m_s2);
    let is_measured = system.spectrum == SpectrumKind::Measured;
    let needs_wind = !(system.hs_m > 0.0 && system.tp_s > 0.0 || is_measured && sea.measured.is_some());
    let mut spectrum = if system.height_factor == 0.0 || needs_wind && system.wind_m_s < MIN_WIND_M_S {
        FrequencySpectrum::calm()
    } else {
        let wind_m_s = system.wind_m_s.max(MIN_WIND_M_S);
        let fetch = 1000.0 * system.fetch_km * gravity_m_s2 / (wind_m_s * wind_m_s);
        let omega_p = (system.tp_s > 0.0).then(|| TAU / system.tp_s.max(MIN_PEAK_PERIOD_S));
        let inputs = SpectrumInputs {
            sea,
            system,
            dispersion,
            gravity_m_s2,
            wind_m_s,
            dimensionless_fetch: fetch,
            user_omega_p: omega_p,
        };
        let family = spectrum_of_family(&inputs);
        if sea.limits_by_depth(system.spectrum) { with_depth_factor(&inputs, family) } else { family }
    };
    if is_measured && sea.measured.is_none() {
        let notice = "spectrum=measured needs a buoy's file: drop one here or give it with --spectrum; until then \
                      jonswap is used";
        spectrum.notice = Some(notice.to_owned());
    }
    spectrum.short_wave_fade = (system.fade_m > 0.0).then_some((system.fade_m, dispersion));
    if system.hs_m > 0.0 && !spectrum.is_calm {
        let m0 = spectrum.variance_m2();
        if m0 < MIN_M0_M2 {
            let notice = "the short-wave fade removes all waves of a system whose height is set (hs)";
            let (omega_p, notice) = (spectrum.omega_p, Some(notice.to_owned()));
            spectrum = FrequencySpectrum { omega_p, notice, ..FrequencySpectrum::calm() };
        } else {
            spectrum = spectrum.scaled((system.hs_m / 4.0).powi(2) / m0);
        }
    }
    spectrum.scaled(system.height_factor * system.height_factor)
}

/// Makes the spectrum of the family (JONSWAP and others) selected in `inputs`, before it is scaled to the user's
/// height. JONSWAP replaces a measured spectrum without data.
fn spectrum_of_family(inputs: &SpectrumInputs<'_>) -> FrequencySpectrum {
    match inputs.system.spectrum {
        SpectrumKind::Phillips => phillips::spectrum(inputs),
        SpectrumKind::Tessendorf => tessendorf::spectrum(inputs),
        SpectrumKind::GeneralisedAb => generalised_ab::spectrum(inputs),
        SpectrumKind::PiersonMoskowitz => generalised_ab::pierson_moskowitz(inputs),
        SpectrumKind::Jonswap => jonswap::spectrum(inputs),
        SpectrumKind::Tma => jonswap::tma(inputs),
        SpectrumKind::Marnero => marnero::spectrum(inputs),
        SpectrumKind::Karaev => karaev::spectrum(inputs),
        SpectrumKind::Elfouhaily => elfouhaily::spectrum(inputs),
        SpectrumKind::Donelan => donelan::spectrum(inputs),
        SpectrumKind::OchiHubble => ochi_hubble::spectrum(inputs),
        SpectrumKind::Torsethaugen => torsethaugen::spectrum(inputs),
        SpectrumKind::Measured => {
            inputs.sea.measured.as_ref().map_or_else(|| jonswap::spectrum(inputs), measured::spectrum)
        }
    }
}
