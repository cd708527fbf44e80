//! Parameters without effect in the present state: the conditions, in one place, and what would wake each parameter.
//!
//! The panel greys such a row and says why. tests/fields.rs checks both directions: a parameter that is reported as
//! inactive changes nothing, and one that changes the picture is not reported.

use super::field::Group;
use super::fields::Field;
use super::look::{CloudKind, FresnelFormula, MicrofacetDistribution, SunPlacement};
use super::params::{DEEP_WATER_DEPTH_M, DepthLimit, DispersionKind, Params, SpectrumKind, WaveSystemParams};
use super::params::{MAX_WAVE_SYSTEMS, WhitecapRule};
use super::views::{DisplayedView, SurfaceView};

/// Why a parameter has no effect, and settings that give it one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inactive {
    /// One sentence for the user that says what would wake the parameter.
    pub reason: &'static str,
    /// Settings as in a state string with which the parameter acts; empty if no setting can give it an effect, such as
    /// when only another file could.
    pub waking: &'static str,
}

/// Parameters that have no effect under the same condition.
struct Rule {
    keys: &'static [&'static str],
    applies: fn(&Params) -> bool,
    inactive: Inactive,
}

/// Makes a [`Rule`]: the parameters `keys` have no effect while `applies` is true.
const fn rule(
    keys: &'static [&'static str],
    applies: fn(&Params) -> bool,
    reason: &'static str,
    waking: &'static str,
) -> Rule {
    Rule { keys, applies, inactive: Inactive { reason, waking } }
}

/// Rules for all parameters but those of the wave systems. The first rule that applies counts.
const RULES: &[Rule] = &[
    rule(
        &["sunby", "sun", "sunaz", "day", "hour", "lat", "daylight"],
        has_sky_file,
        "The sky from a file has its own sun: turn the sky, or go back to the computed sky.",
        "",
    ),
    rule(
        &["suncolour", "sunfalloff", "overcast", "clouds", "cloudcover", "squalls"],
        has_sky_file,
        // The size of the sun still widens its glitter, and haze still veils what is far away.
        "The sky from a file has its own light and clouds: change its brightness, or go back to the computed sky.",
        "",
    ),
    rule(&["skyturn", "skygain"], |p| !has_sky_file(p), "Acts on a sky from a file: open a .hdr or .exr image.", ""),
    rule(
        &["sun", "sunaz"],
        |p| p.look.sky.sun_placement == SunPlacement::Date,
        "The date places the sun: in Study, set Sun by to direction.",
        "sunby=direction",
    ),
    rule(
        &["day", "hour", "lat", "daylight"],
        |p| p.look.sky.sun_placement == SunPlacement::Direction,
        "The sun is placed by direction: set Sun by to date.",
        "sunby=date",
    ),
    rule(
        &["cloudcover"],
        |p| p.look.sky.clouds == CloudKind::None,
        "There are no clouds: choose a kind of clouds.",
        "clouds=cumulus",
    ),
    rule(
        &["squalls"],
        |p| matches!(p.look.sky.clouds, CloudKind::None | CloudKind::Cirrus),
        "Rain falls from clouds other than cirrus: choose such a kind of clouds.",
        "clouds=storm",
    ),
    rule(
        &["fogstart", "fogheight", "fogfalloff", "fogcolour"],
        |p| p.look.sky.fog_extinction_per_km == 0.0,
        "There is no fog: add some.",
        "fog=1",
    ),
    rule(
        &["foamthreshold"],
        |p| p.sea.foam.whitecaps == WhitecapRule::Monahan,
        "The wind sets the amount of foam: choose fixed under Whitecaps.",
        "whitecaps=fixed",
    ),
    rule(
        &["foamcolour", "foamroughness", "foamrelief"],
        |p| p.look.surface.foam.coverage_factor == 0.0,
        "No foam is shown: raise Foam shown.",
        "foam=1",
    ),
    rule(
        &["shininess"],
        |p| p.look.surface.reflection.specular != MicrofacetDistribution::BlinnPhong,
        "Only the microfacets of Blinn and Phong have a shininess: choose blinn-phong.",
        "specular=blinn-phong",
    ),
    rule(
        &["fresnelshine"],
        |p| p.look.surface.reflection.fresnel != FresnelFormula::Schlick,
        "Only Schlick's formula has this exponent: choose schlick under Fresnel.",
        "fresnel=schlick",
    ),
    rule(
        &["viewcascade"],
        |p| !matches!(p.look.view.displayed, DisplayedView::Map(_) | DisplayedView::Surface(SurfaceView::Mips)),
        "The picture shows all cascades: choose a view of a map.",
        "view=height",
    ),
    rule(
        &["tension", "density"],
        |p| p.sea.dispersion != DispersionKind::Capillary,
        "Only capillary waves depend on it: choose capillary under Dispersion.",
        "dispersion=capillary",
    ),
    rule(
        &["depthlimit"],
        |p| p.sea.depth_m >= DEEP_WATER_DEPTH_M,
        "The water is deep: make it shallower than 4000 m.",
        "depth=20",
    ),
    rule(
        &["depthlimit"],
        |p| !has_system(p, |s| s.spectrum.is_for_deep_water()),
        "The spectrum contains the depth already: choose one that was made for deep water, such as jonswap.",
        "spectrum=jonswap",
    ),
    rule(
        &["tmafit"],
        |p| {
            let limits = p.sea.depth_limit == DepthLimit::Kitaigorodskii && p.sea.depth_m < DEEP_WATER_DEPTH_M;
            !has_system(p, |s| {
                matches!(s.spectrum, SpectrumKind::Tma | SpectrumKind::Karaev)
                    || limits && s.spectrum.is_for_deep_water()
            })
        },
        "The depth does not limit this spectrum: choose tma.",
        "spectrum=tma",
    ),
    rule(
        &["bouws"],
        |p| !has_system(p, |s| s.spectrum == SpectrumKind::Tma),
        "It belongs to the spectrum tma: choose that.",
        "spectrum=tma",
    ),
    rule(
        &["karaevtma"],
        |p| !has_system(p, |s| s.spectrum == SpectrumKind::Karaev),
        "It belongs to the spectrum karaev: choose that.",
        "spectrum=karaev",
    ),
    rule(
        &["coastx", "coastz", "coastturn"],
        |p| !p.coast.is_on(),
        "The sea is open: choose a coast, or open the file of one.",
        "coast=beach",
    ),
];

/// Parameters of one wave system, without its number in their keys, and when they have no effect. The system's number
/// is appended to the keys in `waking`.
struct SystemRule {
    keys: &'static [&'static str],
    applies: fn(&WaveSystemParams) -> bool,
    reason: &'static str,
    /// Waking settings, one for each wave system.
    waking: [&'static str; MAX_WAVE_SYSTEMS],
}

const SYSTEM_RULES: &[SystemRule] = &[
    SystemRule {
        keys: &["gamma"],
        applies: |s| !matches!(s.spectrum, SpectrumKind::Jonswap | SpectrumKind::Tma | SpectrumKind::Karaev),
        reason: "This spectrum has no peak factor to set: choose jonswap, tma or karaev.",
        waking: ["spectrum=jonswap", "spectrum2=jonswap", "spectrum3=jonswap", "spectrum4=jonswap"],
    },
    SystemRule {
        keys: &["coefa"],
        applies: |s| !matches!(s.spectrum, SpectrumKind::GeneralisedAb | SpectrumKind::Tessendorf),
        reason: "It belongs to the spectra ab and tessendorf: choose one of them.",
        waking: ["spectrum=ab", "spectrum2=ab", "spectrum3=ab", "spectrum4=ab"],
    },
    SystemRule {
        keys: &["coefb"],
        applies: |s| s.spectrum != SpectrumKind::GeneralisedAb,
        reason: "It belongs to the spectrum ab: choose that.",
        waking: ["spectrum=ab", "spectrum2=ab", "spectrum3=ab", "spectrum4=ab"],
    },
    SystemRule {
        keys: &["blendto"],
        applies: |s| s.blend_weight == 0.0,
        reason: "The second spreading has no weight: raise Blend.",
        waking: ["blend=0.5", "blend2=0.5", "blend3=0.5", "blend4=0.5"],
    },
    SystemRule {
        keys: &["spread"],
        applies: |s| s.blend_weight == 1.0,
        reason: "The second spreading has all the weight: lower Blend.",
        waking: ["blend=0", "blend2=0", "blend3=0", "blend4=0"],
    },
];

/// Why a parameter of a wave system that is switched off has no effect, for each system.
const SYSTEM_IS_OFF: [Inactive; MAX_WAVE_SYSTEMS] = {
    const REASON: &str = "This wave system is off: raise its Scale.";
    [
        Inactive { reason: REASON, waking: "scale=1" },
        Inactive { reason: REASON, waking: "scale2=1" },
        Inactive { reason: REASON, waking: "scale3=1" },
        Inactive { reason: REASON, waking: "scale4=1" },
    ]
};

fn has_sky_file(p: &Params) -> bool {
    p.look.sky.panorama().is_some()
}

/// Whether a wave system that is on has the property `has`.
fn has_system(p: &Params, has: impl Fn(&WaveSystemParams) -> bool) -> bool {
    p.sea.systems.iter().any(|s| s.is_on() && has(s))
}

/// All reasons why a parameter may have no effect, for lists of the texts of the interface.
pub fn reasons() -> impl Iterator<Item = &'static str> {
    RULES.iter().map(|rule| rule.inactive.reason).chain(SYSTEM_RULES.iter().map(|rule| rule.reason))
}

impl Field {
    /// Why this parameter has no effect on the sea and the picture in the state `params`, and what would wake it; `None`
    /// if it has an effect.
    pub fn inactive_because(&self, params: &Params) -> Option<Inactive> {
        if self.group == Group::Sea || self.group.further_system_index().is_some() {
            return self.inactive_in_system(params, self.group.further_system_index().unwrap_or(0));
        }
        RULES.iter().find(|r| r.keys.contains(&self.key) && (r.applies)(params)).map(|r| r.inactive)
    }

    /// As [`Self::inactive_because`], for a parameter of the wave system with this index.
    fn inactive_in_system(&self, params: &Params, index: usize) -> Option<Inactive> {
        let system = &params.sea.systems[index];
        let key = self.key.trim_end_matches(|c: char| c.is_ascii_digit());
        // Wind and direction of the first system also set foam, gusts and drift of the clouds.
        let acts_without_waves = key == "scale" || index == 0 && matches!(key, "wind" | "dir");
        if !system.is_on() && !acts_without_waves {
            return Some(SYSTEM_IS_OFF[index]);
        }
        let rule = SYSTEM_RULES.iter().find(|r| r.keys.contains(&key) && (r.applies)(system))?;
        Some(Inactive { reason: rule.reason, waking: rule.waking[index] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::fields::{self, FIELDS};
    use crate::state::query;

    fn inactive(key: &str, state: &str) -> Option<Inactive> {
        fields::find(key).expect("a parameter").inactive_because(&query::parse(state).0)
    }

    #[test]
    fn rules_name_parameters_that_exist_once_and_speak_in_sentences() {
        let sentences = reasons();
        for sentence in sentences {
            assert!(sentence.ends_with('.') && sentence.starts_with(char::is_uppercase), "{sentence}");
        }
        let keys = RULES.iter().flat_map(|r| r.keys).chain(SYSTEM_RULES.iter().flat_map(|r| r.keys));
        for key in keys {
            assert!(fields::find(key).is_some(), "{key}");
        }
    }

    /// A setting that is said to wake a parameter wakes it, also where two things stand in its way.
    #[test]
    fn what_is_said_to_wake_a_parameter_wakes_it() {
        for state in ["", "scale2=1&hs2=1", "sunby=date", "foam=0", "spectrum=pm&blend=1", "depth=9"] {
            for field in FIELDS.iter() {
                let mut state = state.to_owned();
                for _ in 0..3 {
                    match inactive(field.key, &state) {
                        Some(why) if !why.waking.is_empty() => state = format!("{state}&{}", why.waking),
                        _ => break,
                    }
                }
                let left = inactive(field.key, &state).filter(|why| !why.waking.is_empty());
                assert_eq!(left, None, "{} in {state}", field.key);
            }
        }
    }

    #[test]
    fn the_state_decides() {
        let reason = |key, state| inactive(key, state).map(|why| why.waking);
        assert_eq!(reason("shininess", ""), Some("specular=blinn-phong"));
        assert_eq!(reason("shininess", "specular=blinn-phong"), None);
        assert_eq!((reason("hour", ""), reason("hour", "sunby=date")), (Some("sunby=date"), None));
        assert_eq!((reason("sun", ""), reason("sun", "sunby=date")), (None, Some("sunby=direction")));
        assert_eq!((reason("dir2", ""), reason("dir2", "scale2=1")), (Some("scale2=1"), None));
        assert_eq!((reason("wind", "scale=0"), reason("fetch", "scale=0")), (None, Some("scale=1")));
        assert_eq!((reason("skyturn", ""), reason("scale3", "")), (Some(""), None));
        assert_eq!((reason("coastx", ""), reason("coastx", "coast=bar")), (Some("coast=beach"), None));
        assert_eq!((reason("coastturn", "coast=file"), reason("coast", "")), (Some("coast=beach"), None));
    }
}
