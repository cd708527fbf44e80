//! Parameters of the sea state: wave systems, water, displacement and whitecaps.

use super::field::FieldKind::{Choice, Flag, Heading};
use super::field::{choice_enum, integer, logarithmic, number, parameters};
use crate::files::measured::MeasuredSpectrum;
use std::sync::Arc;

choice_enum! {
    /// Frequency spectrum of a wave system: a formula, or the data of a wave buoy.
    pub enum SpectrumKind {
        /// Spectrum of the equilibrium range only: zero below the peak, omega^-5 above it, Phillips 1958.
        Phillips = "phillips",
        /// Phillips' spectrum over wave vectors as used by Tessendorf 2001: its factor cos^2 of the angle to the wind
        /// replaces the directional spreading.
        Tessendorf = "tessendorf",
        /// Spectrum A omega^-5 exp(-B omega^-4) of angular frequency omega, with the parameters `coefa` and `coefb`.
        GeneralisedAb = "ab",
        /// Spectrum of a fully developed sea, Pierson and Moskowitz 1964.
        PiersonMoskowitz = "pm",
        /// JONSWAP spectrum of a fetch-limited sea, Hasselmann et al. 1973.
        Jonswap = "jonswap",
        /// TMA spectrum: JONSWAP times the Kitaigorodskii depth factor, Bouws et al. 1985 as used by Horvath 2015.
        Tma = "tma",
        /// MarNeRo spectrum of the Black Sea near the shore, Trusca 2007.
        Marnero = "marnero",
        /// JONSWAP with a tail of power laws down to capillary waves, Karaev and Balandina 2000.
        Karaev = "karaev",
        /// Unified spectrum of gravity and capillary waves, Elfouhaily et al. 1997.
        Elfouhaily = "elfouhaily",
        /// Spectrum of a fetch-limited sea with an omega^-4 range, Donelan, Hamilton and Hui 1985.
        Donelan = "donelan",
        /// Spectrum with two peaks, swell and wind sea, given by six parameters, Ochi and Hubble 1976.
        OchiHubble = "ochi-hubble",
        /// Spectrum with two peaks, swell and wind sea, of the North Sea, Torsethaugen and Haver 2004.
        Torsethaugen = "torsethaugen",
        /// Spectrum that a wave buoy measured, from a file.
        Measured = "measured",
    }
}

choice_enum! {
    /// Directional spreading of a wave system: formula for the distribution of wave energy over directions.
    pub enum SpreadKind {
        /// Spreading with the same energy in every direction.
        Isotropic = "isotropic",
        /// Spreading cos^2 of the angle to the wind, full circle: as much energy runs against the wind as with it.
        Cos2 = "cos2",
        /// Spreading cos^2 of the angle to the wind over the half circle downwind; no energy runs against the wind.
        Cos2Positive = "cos2-positive",
        /// Spreading cos^{2s}(theta/2), theta the angle to the wind, with the exponent s of Mitsuyasu et al. 1975.
        Mitsuyasu = "mitsuyasu",
        /// Spreading cos^{2s}(theta/2), theta the angle to the wind, with s of Hasselmann, Dunckel and Ewing 1980.
        Hasselmann = "hasselmann",
        /// Spreading sech^2(beta theta), theta the angle to the wind, with beta of Donelan, Hamilton and Hui 1985 and,
        /// at high frequencies, of Banner 1990.
        DonelanBanner = "donelan-banner",
        /// Spreading 1 + Delta cos(2 theta), theta the angle to the wind, Delta by Elfouhaily et al. 1997: as much
        /// energy runs against the wind as with it.
        Elfouhaily = "elfouhaily",
    }
}

choice_enum! {
    /// Dispersion relation between angular frequency omega and wave number k.
    pub enum DispersionKind {
        /// Dispersion relation omega^2 = g k (g: gravity) of waves in deep water, whatever the depth is set to.
        Deep = "deep",
        /// Dispersion relation omega^2 = g k tanh(k h) of waves in water of depth h; g is gravity.
        Finite = "finite",
        /// Dispersion relation omega^2 = (g k + sigma/rho k^3) tanh(k h) of gravity-capillary waves in water of depth
        /// h, with surface tension sigma, density rho and gravity g.
        Capillary = "capillary",
    }
}

choice_enum! {
    /// Rule by which shallow water limits the energy of spectra that were made for deep water.
    pub enum DepthLimit {
        /// Multiplication by Kitaigorodskii's depth factor, as in the TMA spectrum.
        Kitaigorodskii = "tma",
        /// No limit but breaking: the spectrum of deep water, whatever the depth is set to.
        Ignored = "none",
    }
}

impl SpectrumKind {
    /// Whether the spectrum was made for deep water, so that a limit by depth acts on it. The others contain the depth:
    /// `tma` by its own factor, `tessendorf` and `elfouhaily` as spectra over wave numbers, `marnero` and `measured` as
    /// what was measured in place.
    pub fn is_for_deep_water(self) -> bool {
        match self {
            Self::Phillips
            | Self::GeneralisedAb
            | Self::PiersonMoskowitz
            | Self::Jonswap
            | Self::Karaev
            | Self::Donelan
            | Self::OchiHubble
            | Self::Torsethaugen => true,
            Self::Tessendorf | Self::Tma | Self::Marnero | Self::Elfouhaily | Self::Measured => false,
        }
    }
}

/// Depth from which on the sea counts as deep water, where no limit by depth acts, m: the default depth.
pub const DEEP_WATER_DEPTH_M: f64 = 4000.0;

choice_enum! {
    /// Formula for Kitaigorodskii's depth factor, 0 to 1, with which a spectrum is multiplied in shallow water.
    pub enum DepthFactor {
        /// Depth factor tanh^2(kh) / (1 + 2kh / sinh 2kh) of linear theory, with wave number k and water depth h.
        Exact = "exact",
        /// Approximation of the depth factor by three formulas for ranges of omega sqrt(h/g) (angular frequency omega,
        /// water depth h, gravity g), Thompson and Vincent 1983.
        Branches = "branches",
    }
}

choice_enum! {
    /// Rule that sets the foam threshold: foam forms where the Jacobian of the horizontal displacement is below it.
    pub enum WhitecapRule {
        /// Foam threshold at which foam covers, on average, the fraction of the sea that whitecaps cover at the wind
        /// speed, by Monahan and O'Muircheartaigh 1980.
        Monahan = "monahan",
        /// Foam threshold that the user sets (parameter `foamthreshold`).
        Fixed = "fixed",
    }
}

parameters! {
    /// One wave system: waves with a frequency spectrum, wind and directional spreading of their own. The default is
    /// the local wind sea.
    pub struct WaveSystemParams {
        /// Frequency spectrum over w in rad/s. phillips: equilibrium range only (1958); tessendorf: Phillips' spectrum
        /// over wave vectors, with its own cos^2 spreading (2001); ab: A w^-5 exp(-B w^-4); pm: fully developed sea
        /// (Pierson and Moskowitz 1964); jonswap: fetch-limited sea (Hasselmann et al. 1973); tma: jonswap in shallow
        /// water (Bouws et al. 1985); marnero: Black Sea (Trusca 2007); karaev: jonswap with a tail to capillary waves
        /// (2000); elfouhaily: gravity and capillary waves (1997); donelan: fetch-limited with a w^-4 range (1985);
        /// ochi-hubble, torsethaugen: two peaks (1976, 2004); measured: a buoy's file.
        spectrum: SpectrumKind = SpectrumKind::Jonswap => ("spectrum", "Spectrum", "", Choice(SpectrumKind::WORDS)),
        /// Factor on the wave height of this system: 1 is the physical height, 0 switches the system off. Programs whose
        /// scale is a factor on the spectrum have the square of this number there: their 4 is 2 here.
        height_factor: f64 = 1.0 => ("scale", "Scale", "", number(0.0, 5.0), "off"),
        /// Wind speed 10 m above the sea: Beaufort 4 is about 7, a gale (Beaufort 8) about 19, a hurricane above 33.
        wind_m_s: f64 = 12.0 => ("wind", "Wind", "m/s", number(0.0, 60.0)),
        /// Fetch, the distance that the wind has blown over: more makes longer, higher waves (Hasselmann 1973).
        fetch_km: f64 = 150.0 => ("fetch", "Fetch", "km", logarithmic(0.5, 2000.0)),
        /// Direction that wind and waves come from, clockwise from north, as in a forecast.
        from_deg: f64 = 240.0 => ("dir", "From", "deg", Heading),
        /// Significant wave height; 0 derives it from wind and fetch. For marnero: sqrt(2) times the rms wave height.
        hs_m: f64 = 0.0 => ("hs", "Height Hs", "m", number(0.0, 30.0), "auto"),
        /// Peak period; 0 derives it from wind and fetch. For marnero it is 1.2 times the mean period.
        tp_s: f64 = 0.0 => ("tp", "Period Tp", "s", number(0.0, 30.0), "auto"),
        /// Peak enhancement factor of jonswap, tma and karaev: 1 is a broad peak, 3.3 the JONSWAP mean, 7 a young sea.
        gamma: f64 = 3.3 => ("gamma", "Peak gamma", "", number(1.0, 10.0)),
        /// Coefficient A of the spectrum ab, S = A w^-5 exp(-B w^-4), in m2/s4, or of tessendorf, without unit. 0 takes
        /// the default: 0.78 for ab, as in pm, and 0.0013 for tessendorf.
        coefficient_a: f64 = 0.0 => ("coefa", "Coefficient A", "", number(0.0, 10.0), "auto"),
        /// Coefficient B of the spectrum ab, 1.25 times the fourth power of the peak frequency in rad/s; 0 takes the
        /// value of pm.
        coefficient_b: f64 = 0.0 => ("coefb", "Coefficient B", "1/s4", number(0.0, 1000.0), "auto"),
        /// Length l of the short-wave fade: the spectrum is multiplied by exp(-(k l)^2) at wave number k, which removes
        /// waves much shorter than 2 pi l.
        fade_m: f64 = 0.0 => ("fade", "Short-wave fade", "m", number(0.0, 20.0), "none"),
        /// Directional spreading of the wave energy. isotropic: even; cos2: as much against the wind as with it;
        /// cos2-positive: only with the wind; mitsuyasu (1975); hasselmann (1980); donelan-banner (1985, 1990);
        /// elfouhaily (1997): as much against the wind as with it.
        spread: SpreadKind = SpreadKind::DonelanBanner => ("spread", "Spreading", "", Choice(SpreadKind::WORDS)),
        /// Second directional spreading, which can be blended with the first.
        blend_to: SpreadKind = SpreadKind::Isotropic => ("blendto", "Blend to", "", Choice(SpreadKind::WORDS)),
        /// Weight of the second directional spreading in the blend; the first has the rest.
        blend_weight: f64 = 0.0 => ("blend", "Blend", "", number(0.0, 1.0)),
        /// Fraction of the wave energy that is spread evenly over all directions.
        isotropic_fraction: f64 = 0.0 => ("iso", "Agitation", "", number(0.0, 1.0)),
        /// Horvath's swell parameter (2015): 0 keeps the directional spreading, 1 narrows that of the long waves most,
        /// to parallel swell; the wave height does not change.
        swell: f64 = 0.0 => ("swell", "Swell", "", number(0.0, 1.0)),
    }
}

impl WaveSystemParams {
    /// Default of the second wave system: swell of a distant storm, switched off. It is lower and longer than the sea
    /// inside that storm.
    fn default_second_system() -> Self {
        Self {
            height_factor: 0.0,
            wind_m_s: 15.0,
            fetch_km: 300.0,
            from_deg: 300.0,
            hs_m: 1.5,
            tp_s: 12.0,
            gamma: 5.0,
            fade_m: 2.0,
            spread: SpreadKind::Hasselmann,
            swell: 0.5,
            ..Self::default()
        }
    }

    /// Default of the third wave system: long, low swell of a gale in another ocean, switched off.
    fn default_third_system() -> Self {
        Self {
            wind_m_s: 20.0,
            fetch_km: 800.0,
            from_deg: 200.0,
            hs_m: 1.0,
            tp_s: 16.0,
            gamma: 7.0,
            fade_m: 4.0,
            swell: 0.8,
            ..Self::default_second_system()
        }
    }

    /// Default of the fourth wave system: what is left of yesterday's wind sea after a turn of the wind, switched off.
    fn default_fourth_system() -> Self {
        Self {
            wind_m_s: 9.0,
            fetch_km: 120.0,
            from_deg: 340.0,
            hs_m: 0.8,
            tp_s: 8.0,
            gamma: 3.3,
            fade_m: 1.0,
            swell: 0.3,
            ..Self::default_second_system()
        }
    }

    /// Whether the wave system has waves: its height factor is not 0.
    pub fn is_on(&self) -> bool {
        self.height_factor > 0.0
    }
}

/// Largest number of wave systems of a sea: the local wind sea and up to three others.
pub const MAX_WAVE_SYSTEMS: usize = 4;
/// Names of the wave systems, in the order of [`Sea::systems`].
pub const WAVE_SYSTEM_NAMES: [&str; MAX_WAVE_SYSTEMS] = ["first", "second", "third", "fourth"];

parameters! {
    /// Sea state: wave systems, water, displacement and foam.
    pub struct Sea {
        /// Wave systems: the local wind sea, and up to three others such as swell. Their spectra add.
        systems: [WaveSystemParams; MAX_WAVE_SYSTEMS] = [
            WaveSystemParams::default(),
            WaveSystemParams::default_second_system(),
            WaveSystemParams::default_third_system(),
            WaveSystemParams::default_fourth_system(),
        ],
        /// Spectrum that a wave buoy measured, for wave systems with the spectrum `measured`; `None` if there is none.
        measured: Option<Arc<MeasuredSpectrum>> = None,
        /// Water depth. Shallow water slows and steepens long waves, and limits their energy (depthlimit, tma).
        depth_m: f64 = DEEP_WATER_DEPTH_M => ("depth", "Depth", "m", logarithmic(1.0, 11000.0)),
        /// How water of less than 4000 m limits the energy of the spectra made for deep water: phillips, ab, pm, jonswap,
        /// karaev, donelan, ochi-hubble and torsethaugen. tma: they are multiplied by Kitaigorodskii's depth factor
        /// (1975), which makes jonswap the spectrum tma; none: they stay as in deep water. The other spectra contain
        /// the depth already. A height that is set (hs) stays as it is.
        depth_limit: DepthLimit = DepthLimit::Kitaigorodskii
            => ("depthlimit", "Depth limit", "", Choice(DepthLimit::WORDS)),
        /// Dispersion relation of angular frequency w and wave number k. deep: w^2 = g k; finite, at depth h: w^2 = g k
        /// tanh(k h); capillary, with surface tension sigma and density rho: w^2 = (g k + sigma/rho k^3) tanh(k h).
        dispersion: DispersionKind = DispersionKind::Finite
            => ("dispersion", "Dispersion", "", Choice(DispersionKind::WORDS)),
        /// Surface tension for capillary waves: sea water 0.074, fresh water 0.072.
        tension_n_m: f64 = 0.074 => ("tension", "Surface tension", "N/m", number(0.0, 0.5)),
        /// Density of the water for capillary waves: sea water 1025, fresh water 1000, Black Sea 1012.
        density_kg_m3: f64 = 1025.0 => ("density", "Density", "kg/m3", number(500.0, 2000.0)),
        /// Acceleration of gravity: Earth 9.81, Titan 1.35, Mars 3.71.
        gravity_m_s2: f64 = 9.81 => ("g", "Gravity", "m/s2", logarithmic(0.5, 30.0)),
        /// Formula for the depth factor of tma and of depthlimit=tma: exact, or the fit in three branches (Thompson and
        /// Vincent 1983).
        depth_factor: DepthFactor = DepthFactor::Exact
            => ("tmafit", "TMA depth factor", "", Choice(DepthFactor::WORDS)),
        /// Computes alpha and gamma of tma from kappa = U^2 k_p / g (wind speed U, peak wave number k_p), as alpha =
        /// 0.0078 kappa^0.49 and gamma = 2.47 kappa^0.39 (Bouws et al. 1985), instead of taking those of jonswap.
        tma_bouws_parameters: bool = false => ("bouws", "TMA alpha, gamma", "", Flag),
        /// Multiplies the spectrum karaev by the depth factor of tma at frequencies up to 1.2 times the peak frequency,
        /// instead of at all frequencies as depthlimit=tma does.
        karaev_tma: bool = false => ("karaevtma", "Karaev in the shallows", "", Flag),
        /// Precision of the integral that normalises a directional spreading without a closed form: number of 15-point
        /// quadrature panels in each of its pieces, of which there are up to six.
        spreading_norm_panels: u32 = 2 => ("normsteps", "Quadrature steps", "", integer(1, 64)),
        /// Order of the wave theory. 1: independent waves, linear in Lagrangian form. 2: adds the bound waves of all pairs
        /// of waves, which sharpen crests and flatten troughs (Longuet-Higgins 1963; Sharma and Dean 1981).
        wave_order: u32 = 2 => ("order", "Order", "", integer(1, 2)),
        /// Choppiness, the factor on the horizontal displacement: 1 is linear theory, 0 a sum of sines without sharp
        /// crests.
        chop: f64 = 1.0 => ("chop", "Chop", "", number(0.0, 2.0)),
        /// Factor on the horizontal displacement along x (east), in addition to the factor chop.
        chop_x: f64 = 1.0 => ("chopx", "Chop east-west", "", number(0.0, 2.0)),
        /// Factor on the horizontal displacement along z (south), in addition to the factor chop.
        chop_z: f64 = 1.0 => ("chopz", "Chop north-south", "", number(0.0, 2.0)),
        /// Factor on all displacements of the surface; 1 is the physical height.
        displacement_factor: f64 = 1.0 => ("height", "Height scale", "", logarithmic(0.1, 4.0)),
        /// Height of the still water in the world: the whole surface is raised or lowered.
        still_water_level_m: f64 = 0.0 => ("level", "Water level", "m", number(-100.0, 100.0)),
        /// Seed of the random phases and amplitudes: another seed gives another sea with the same statistics.
        seed: u32 = 1 => ("seed", "Seed", "", integer(0, u32::MAX)),
        /// Period after which the sea repeats, s; 0 means a day. Its key in a state string is `loop`.
        repeat_period_s: f64 = 0.0,
        /// Formation and decay of whitecap foam.
        foam: FoamSettings = FoamSettings::default(),
    }
}

impl Sea {
    /// First wave system: the local wind sea, whose wind also sets the amount of whitecaps.
    pub fn first_system(&self) -> &WaveSystemParams {
        &self.systems[0]
    }

    /// Stores a buoy's spectrum and selects it as the frequency spectrum of the local wind sea (first wave system).
    pub fn set_measured_spectrum(&mut self, measured: MeasuredSpectrum) {
        self.measured = Some(Arc::new(measured));
        self.systems[0].spectrum = SpectrumKind::Measured;
    }

    /// Whether water of this depth limits the energy of a spectrum by Kitaigorodskii's depth factor, beside what the
    /// spectrum contains of it already.
    pub fn limits_by_depth(&self, spectrum: SpectrumKind) -> bool {
        let has_own_rule = spectrum == SpectrumKind::Karaev && self.karaev_tma;
        self.depth_limit == DepthLimit::Kitaigorodskii
            && self.depth_m < DEEP_WATER_DEPTH_M
            && spectrum.is_for_deep_water()
            && !has_own_rule
    }

    /// Choppiness along x (east) and z (south), the products of `chop` with `chopx` and `chopz`: factors on the
    /// horizontal displacement; 1 is linear theory.
    pub fn choppiness_xz(&self) -> [f64; 2] {
        [self.chop_x * self.chop, self.chop_z * self.chop]
    }
}

parameters! {
    /// Formation and decay of whitecap foam.
    pub struct FoamSettings {
        /// How the foam threshold is set. monahan: so that the mean foam is the whitecap coverage of the wind (Monahan
        /// and O'Muircheartaigh 1980); fixed: by the parameter foamthreshold.
        whitecaps: WhitecapRule = WhitecapRule::Monahan => ("whitecaps", "Whitecaps", "", Choice(WhitecapRule::WORDS)),
        /// With whitecaps=fixed: Jacobian below which foam forms; 1 is an undeformed surface, 0 a folding crest.
        threshold: f64 = 0.5 => ("foamthreshold", "Foam threshold", "", number(-1.0, 1.0)),
        /// Offset that is added to the foam threshold: more foam (+) or less (-).
        bias: f64 = 0.0 => ("foambias", "Foam bias", "", number(-1.0, 1.0)),
        /// Time constant in which foam fades to 1/e. Whitecap patches last 2 to 10 s (Monahan 1971).
        decay_s: f64 = 4.0 => ("foamdecay", "Foam decay", "s", logarithmic(0.5, 30.0)),
        /// Rate at which foam grows towards full cover where a crest breaks.
        rate_per_s: f64 = 2.0 => ("foamrate", "Foam growth", "1/s", logarithmic(0.1, 10.0)),
    }
}
