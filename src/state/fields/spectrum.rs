//! Families of the frequency spectrum: variants, words of the state string, help text. Their equations are in
//! `waves/spectra`.

/// Family of the frequency spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpectrumKind {
    /// Equilibrium range alone, Phillips 1958.
    Phillips,
    /// Phillips' spectrum in wave numbers as in Tessendorf 2001, with its own directional factor.
    Tessendorf,
    /// Generalised A, B spectrum.
    GeneralisedAb,
    /// Fully developed sea, Pierson and Moskowitz 1964.
    PiersonMoskowitz,
    /// Fetch-limited sea, Hasselmann et al. 1973.
    Jonswap,
    /// JONSWAP times the Kitaigorodskii depth factor, Bouws et al. 1985 as used by Horvath 2015.
    Tma,
    /// Black Sea, near the shore, Trusca 2007.
    Marnero,
    /// JONSWAP with a tail of several slopes down to ripples, Karaev and Balandina 2000.
    Karaev,
    /// Gravity and capillary waves in one, Elfouhaily et al. 1997.
    Elfouhaily,
    /// Fetch-limited with an omega^-4 range, Donelan, Hamilton and Hui 1985.
    Donelan,
    /// Swell and wind sea by six parameters, Ochi and Hubble 1976.
    OchiHubble,
    /// Swell and wind sea of the North Sea, Torsethaugen and Haver 2004.
    Torsethaugen,
    /// From a buoy's file.
    Measured,
}

words!(SPECTRA, SPECTRUM_WORDS, SpectrumKind,
    "phillips" => SpectrumKind::Phillips,
    "tessendorf" => SpectrumKind::Tessendorf,
    "ab" => SpectrumKind::GeneralisedAb,
    "pm" => SpectrumKind::PiersonMoskowitz,
    "jonswap" => SpectrumKind::Jonswap,
    "tma" => SpectrumKind::Tma,
    "marnero" => SpectrumKind::Marnero,
    "karaev" => SpectrumKind::Karaev,
    "elfouhaily" => SpectrumKind::Elfouhaily,
    "donelan" => SpectrumKind::Donelan,
    "ochi-hubble" => SpectrumKind::OchiHubble,
    "torsethaugen" => SpectrumKind::Torsethaugen,
    "measured" => SpectrumKind::Measured,
);

/// Help text of the parameter `spectrum`.
pub(super) const SPECTRUM_HELP: &str = "Frequency spectrum. \
    phillips: equilibrium range alone (1958); tessendorf: in wave numbers, with its own cos^2 in directions (2001); \
    ab: A w^-5 exp(-B w^-4); pm: fully developed (Pierson and Moskowitz 1964); \
    jonswap: fetch-limited (Hasselmann et al. 1973); tma: the same in shallow water (Bouws et al. 1985); \
    marnero: Black Sea (Trusca 2007); karaev: with ripples (2000); elfouhaily: gravity and capillary waves (1997); \
    donelan: w^-4 range (1985); ochi-hubble and torsethaugen: two peaks (1976, 2004); measured: a buoy's file.";
