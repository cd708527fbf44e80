//! Seamarks: lighthouses, harbour lights and beacons, which stand on a built-in coast and guide ships past it.

/// A kind of seamark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeamarkKind {
    /// A lighthouse of masonry, with the house of its keeper.
    Lighthouse,
    /// The red light that ships leave to port when they enter a harbour (IALA's region A).
    PortLight,
    /// The green light that ships leave to starboard when they enter a harbour (IALA's region A).
    StarboardLight,
    /// The red beacon, a pile in the water, that ships leave to port when they come in through a channel.
    PortBeacon,
    /// The green beacon that they leave to starboard.
    StarboardBeacon,
}

/// A seamark at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seamark {
    /// Kind of the seamark.
    pub kind: SeamarkKind,
    /// Place of the middle of its tower in the frame of the coast, m.
    pub at_m: [f64; 2],
    /// Height of the ground there above the still water, m.
    pub ground_m: f64,
}

impl SeamarkKind {
    /// All kinds.
    pub const ALL: [Self; 5] =
        [Self::Lighthouse, Self::PortLight, Self::StarboardLight, Self::PortBeacon, Self::StarboardBeacon];

    /// How bright its lamp is at time `t_s`, s, relative to the flash of a lighthouse. The lens of the lighthouse turns,
    /// so it flashes white every 10 s. Red and green lamps are on and off for 2 s each (isophase).
    pub fn lamp_level(self, t_s: f64) -> f64 {
        let isophase = |delay_s: f64| if (t_s - delay_s).rem_euclid(4.0) < 2.0 { COLOURED_LAMP_LEVEL } else { 0.0 };
        match self {
            Self::Lighthouse => {
                let from_flash_s = (t_s + 5.0).rem_euclid(10.0) - 5.0;
                LENS_GLOW + (1.0 - LENS_GLOW) * (-(from_flash_s / FLASH_S).powi(2)).exp()
            }
            Self::PortLight | Self::PortBeacon => isophase(0.0),
            Self::StarboardLight | Self::StarboardBeacon => isophase(-1.0),
        }
    }
}

/// Time from the middle of a flash of the lighthouse until its light has fallen to 1/e, s, and the brightness of its
/// lens between two flashes.
const FLASH_S: f64 = 0.3;
const LENS_GLOW: f64 = 0.02;
/// Brightness of the red and green lamps of harbour lights and beacons.
const COLOURED_LAMP_LEVEL: f64 = 0.03;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_have_their_rhythm() {
        let light = |kind: SeamarkKind, t_s: f64| kind.lamp_level(t_s);
        for flash_s in [-20.0, 0.0, 70.0] {
            assert_eq!(light(SeamarkKind::Lighthouse, flash_s), 1.0);
            assert!([1.5, 5.0, 8.5].iter().all(|t| light(SeamarkKind::Lighthouse, flash_s + t) < 0.021));
        }
        for kind in SeamarkKind::ALL.into_iter().filter(|kind| *kind != SeamarkKind::Lighthouse) {
            let lit = (0..400).filter(|i| light(kind, 0.1 * f64::from(*i) + 0.05) > 0.0).count();
            assert!(lit == 200 && light(kind, 0.0) > 0.0, "{kind:?}: {lit}");
        }
    }
}
