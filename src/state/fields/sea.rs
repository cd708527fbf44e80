//! Rows of the sea: wave systems, water, whitecaps.

use super::spectrum::{SPECTRA, SPECTRUM_HELP, SPECTRUM_WORDS};
use super::{Field, Group, Kind, index_of, logarithmic, number};
use crate::state::params::{DepthFactor, DispersionKind, SpreadKind, Whitecaps};

words!(SPREADS, SPREAD_WORDS, SpreadKind,
    "isotropic" => SpreadKind::Isotropic,
    "cos2" => SpreadKind::Cos2,
    "cos2-positive" => SpreadKind::Cos2Positive,
    "mitsuyasu" => SpreadKind::Mitsuyasu,
    "hasselmann" => SpreadKind::Hasselmann,
    "donelan-banner" => SpreadKind::DonelanBanner,
    "elfouhaily" => SpreadKind::Elfouhaily,
);
words!(DISPERSIONS, DISPERSION_WORDS, DispersionKind,
    "deep" => DispersionKind::Deep,
    "finite" => DispersionKind::Finite,
    "capillary" => DispersionKind::Capillary,
);
words!(DEPTH_FACTORS, DEPTH_FACTOR_WORDS, DepthFactor,
    "exact" => DepthFactor::Exact,
    "branches" => DepthFactor::Branches,
);
words!(WHITECAPS, WHITECAP_WORDS, Whitecaps,
    "monahan" => Whitecaps::Monahan,
    "fixed" => Whitecaps::Fixed,
);

/// The rows of one wave system; the keys of the second end in 2.
macro_rules! system_rows {
    ($group:ident, $i:literal, $suffix:literal) => {
        [
            row!(concat!("spectrum", $suffix), "Spectrum", $group, SPECTRUM_WORDS of SPECTRA, [sea.systems[$i].spectrum],
                SPECTRUM_HELP),
            row!(concat!("scale", $suffix), "Scale", "", $group, number(0.0, 5.0), [sea.systems[$i].scale],
                "Scale on the height of this system: 1 is the physical one, 0 switches it off.").zero("off"),
            row!(concat!("wind", $suffix), "Wind", "m/s", $group, number(0.0, 60.0), [sea.systems[$i].wind_m_s],
                "Wind speed 10 m above the sea. Beaufort 4 is about 7, a gale (Beaufort 8) about 19, a hurricane above 33 m/s."),
            row!(concat!("fetch", $suffix), "Fetch", "km", $group, logarithmic(0.5, 2000.0), [sea.systems[$i].fetch_km],
                "Distance over which the wind has blown: longer fetch, longer and higher waves (Hasselmann et al. 1973)."),
            row!(concat!("dir", $suffix), "From", "deg", $group, Kind::Heading, [sea.systems[$i].from_deg],
                "Direction that wind and waves come from, clockwise from north, as in a forecast. They run the other way."),
            row!(concat!("hs", $suffix), "Height Hs", "m", $group, number(0.0, 30.0), [sea.systems[$i].hs_m],
                "Significant wave height of this system; 0 lets it follow from wind and fetch. marnero: sqrt(2) times its rms height.").zero("auto"),
            row!(concat!("tp", $suffix), "Period Tp", "s", $group, number(0.0, 30.0), [sea.systems[$i].tp_s],
                "Peak period of this system; 0 lets it follow from wind and fetch. marnero: 1.2 times its mean period.").zero("auto"),
            row!(concat!("gamma", $suffix), "Peak gamma", "", $group, number(1.0, 10.0), [sea.systems[$i].gamma],
                "Peak enhancement of jonswap, tma and karaev: 1 is a broad peak, 3.3 the mean of the JONSWAP experiment, 7 a young sea."),
            row!(concat!("coefa", $suffix), "Coefficient A", "", $group, number(0.0, 10.0), [sea.systems[$i].coefficient_a],
                "A of the spectrum ab, m2/s4 (pm has 0.78), or of tessendorf, without unit (0.0013); 0 takes pm's.").zero("auto"),
            row!(concat!("coefb", $suffix), "Coefficient B", "1/s4", $group, number(0.0, 1000.0), [sea.systems[$i].coefficient_b],
                "B of the spectrum ab: 1.25 times the fourth power of the peak frequency; 0 takes pm's.").zero("auto"),
            row!(concat!("fade", $suffix), "Short-wave fade", "m", $group, number(0.0, 20.0), [sea.systems[$i].fade_m],
                "Waves much shorter than 2 pi times this length are left out: the spectrum is multiplied by exp(-(k l)^2).").zero("none"),
            row!(concat!("spread", $suffix), "Spreading", $group, SPREAD_WORDS of SPREADS, [sea.systems[$i].spread],
                "How the energy spreads over directions: isotropic; cos2, as many waves against the wind as with it; cos2-positive, the half with the wind; mitsuyasu (1975), hasselmann (1980), donelan-banner (1985, 1990), elfouhaily (1997, as many against the wind)."),
            row!(concat!("blendto", $suffix), "Blend to", $group, SPREAD_WORDS of SPREADS, [sea.systems[$i].blend_to],
                "Second spreading, for a blend of two."),
            row!(concat!("blend", $suffix), "Blend", "", $group, number(0.0, 1.0), [sea.systems[$i].blend],
                "Share of the second spreading."),
            row!(concat!("iso", $suffix), "Agitation", "", $group, number(0.0, 1.0), [sea.systems[$i].isotropic],
                "Share of the energy that goes evenly into all directions."),
            row!(concat!("swell", $suffix), "Swell", "", $group, number(0.0, 1.0), [sea.systems[$i].swell],
                "Narrows the direction of the long waves into parallel swell; the height stays (Horvath 2015)."),
        ]
    };
}

/// Both wave systems.
pub(super) fn systems() -> Vec<Field> {
    [system_rows!(Sea, 0, ""), system_rows!(Swell, 1, "2")].concat()
}

/// Depth, physics and displacement.
#[rustfmt::skip]
pub(super) fn water() -> Vec<Field> { vec![
    row!("depth", "Depth", "m", Water, logarithmic(1.0, 11000.0), [sea.depth_m],
        "Water depth: slows and steepens long waves (omega^2 = g k tanh(k h)); with tma it also limits their energy."),
    row!("dispersion", "Dispersion", Water, DISPERSION_WORDS of DISPERSIONS, [sea.dispersion],
        "Speed of the waves: deep, w^2 = g k; finite, w^2 = g k tanh(k h); capillary, w^2 = (g k + sigma/rho k^3) tanh(k h)."),
    row!("tension", "Surface tension", "N/m", Water, number(0.0, 0.5), [sea.tension_n_m],
        "Surface tension of capillary waves: sea water 0.074, fresh water 0.072."),
    row!("density", "Density", "kg/m3", Water, number(500.0, 2000.0), [sea.density_kg_m3],
        "Density of the water, for capillary waves: sea water 1025, fresh water 1000, Black Sea 1012."),
    row!("g", "Gravity", "m/s2", Water, logarithmic(0.5, 30.0), [sea.gravity_m_s2],
        "Acceleration of gravity: Earth 9.81, Titan 1.35, Mars 3.71."),
    row!("tmafit", "TMA depth factor", Water, DEPTH_FACTOR_WORDS of DEPTH_FACTORS, [sea.depth_factor],
        "Kitaigorodskii's depth factor: exact, or the fit in three branches (Thompson and Vincent 1983)."),
    row!("bouws", "TMA alpha, gamma", Water, flag [sea.bouws],
        "tma takes alpha = 0.0078 kappa^0.49 and gamma = 2.47 kappa^0.39, kappa = U^2 k_p / g (Bouws et al. 1985), instead of jonswap's."),
    row!("karaevtma", "Karaev in the shallows", Water, flag [sea.karaev_tma],
        "The first branch of karaev carries the depth factor of tma."),
    row!("normsteps", "Quadrature steps", "", Water, Kind::Integer { min: 1, max: 64 },
        "Steps of the quadrature that normalises a spreading without a closed form, for each of its six pieces.",
        |p| f64::from(p.sea.norm_steps), |p, v| p.sea.norm_steps = v as u32),
    row!("chop", "Chop", "", Water, number(0.0, 2.0), [sea.chop],
        "Horizontal displacement: 1 is what linear theory gives and sharpens the crests, 0 leaves a sum of sines."),
    row!("chopx", "Chop east-west", "", Water, number(0.0, 2.0), [sea.chop_xz[0]],
        "Factor on the chop along x (east)."),
    row!("chopz", "Chop north-south", "", Water, number(0.0, 2.0), [sea.chop_xz[1]],
        "Factor on the chop along z (south)."),
    row!("height", "Height scale", "", Water, logarithmic(0.1, 4.0), [sea.height],
        "Scale on all displacements: 1 is the physical height. For those who want drama."),
    row!("level", "Water level", "m", Water, number(-100.0, 100.0), [sea.level_m],
        "Height of the still water in the world: the whole surface is lifted or lowered."),
    row!("seed", "Seed", "", Water, Kind::Integer { min: 0, max: 4_294_967_295 },
        "Chooses one sea among all those of the same statistics.",
        |p| f64::from(p.sea.seed), |p, v| p.sea.seed = v as u32),
]}

/// Whitecaps of the simulation.
#[rustfmt::skip]
pub(super) fn whitecaps() -> Vec<Field> { vec![
    row!("whitecaps", "Whitecaps", Foam, WHITECAP_WORDS of WHITECAPS, [sea.foam.whitecaps],
        "Where foam forms: monahan, so that the wind's whitecap coverage comes out (Monahan and O'Muircheartaigh 1980); fixed, below a Jacobian of your own."),
    row!("foamthreshold", "Foam threshold", "", Foam, number(-1.0, 1.0), [sea.foam.threshold],
        "Jacobian of the surface below which foam forms when whitecaps is fixed: 1 is unsqueezed water, 0 a folding crest."),
    row!("foambias", "Foam bias", "", Foam, number(-1.0, 1.0), [sea.foam.bias],
        "Added to the threshold, also to the one that follows from the wind: more foam (+) or less (-)."),
    row!("foamdecay", "Foam decay", "s", Foam, logarithmic(0.5, 30.0), [sea.foam.decay_s],
        "Time in which foam fades to 1/e. Whitecap patches last 2 to 10 s (Monahan 1971)."),
    row!("foamrate", "Foam growth", "1/s", Foam, logarithmic(0.1, 10.0), [sea.foam.rate_per_s],
        "How fast foam forms where a crest breaks."),
]}
