//! What can be shown instead of the picture: a map of the simulation, or a quantity of the drawn surface, in false colours.

/// What is shown instead of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The picture.
    Picture,
    /// A map of the simulation, texel by texel, north up.
    Map(Map),
    /// A quantity on the mesh, seen by the camera.
    Surface(Surface),
}

/// The maps; the discriminants are those of shaders/views/map.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// |h0(k)|.
    InitialSpectrum,
    /// h(k, t).
    Spectrum,
    /// East displacement.
    Dx,
    /// Elevation.
    Height,
    /// South displacement.
    Dz,
    /// dDx/dz = dDz/dx.
    Shear,
    /// d eta/dx.
    SlopeX,
    /// d eta/dz.
    SlopeZ,
    /// dDx/dx.
    StretchX,
    /// dDz/dz.
    StretchZ,
    /// Mean of (d eta/dx)^2 over two by two texels.
    MomentXx,
    /// Mean of (d eta/dz)^2.
    MomentZz,
    /// Mean of d eta/dx d eta/dz.
    MomentXz,
    /// Jacobian of one cascade alone.
    Jacobian,
    /// Foam of a level.
    Foam,
    /// Where foam forms on a level.
    Source,
}

/// What is shown on the mesh; the discriminants are those of shaders/views/surface.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Unit normal: east red, north green, up blue.
    Normals,
    /// Jacobian of the sum of all cascades.
    Jacobian,
    /// Variance of the slopes that the pixel does not resolve.
    Roughness,
    /// Level of the mips that a cascade is read from.
    Mips,
    /// Share of the pixel that is foam.
    Foam,
    /// The triangles.
    Wireframe,
}

/// A view: its word in the state string, what it is, and the name in its caption.
pub type Row = (&'static str, Shown, &'static str);

/// All views, in the order in which a key goes through them.
pub const VIEWS: &[Row] = &[
    ("picture", Shown::Picture, "Picture"),
    ("h0", Shown::Map(Map::InitialSpectrum), "Initial spectrum |h0(k)|"),
    ("spectrum", Shown::Map(Map::Spectrum), "Spectrum h(k, t), phase as hue"),
    ("dx", Shown::Map(Map::Dx), "Displacement east, Dx"),
    ("height", Shown::Map(Map::Height), "Elevation"),
    ("dz", Shown::Map(Map::Dz), "Displacement south, Dz"),
    ("dxdz", Shown::Map(Map::Shear), "dDx/dz"),
    ("slopex", Shown::Map(Map::SlopeX), "Slope to the east"),
    ("slopez", Shown::Map(Map::SlopeZ), "Slope to the south"),
    ("dxdx", Shown::Map(Map::StretchX), "dDx/dx"),
    ("dzdz", Shown::Map(Map::StretchZ), "dDz/dz"),
    ("momentxx", Shown::Map(Map::MomentXx), "Slope moment xx"),
    ("momentzz", Shown::Map(Map::MomentZz), "Slope moment zz"),
    ("momentxz", Shown::Map(Map::MomentXz), "Slope moment xz"),
    ("jacobian", Shown::Map(Map::Jacobian), "Jacobian of one cascade"),
    ("foam", Shown::Map(Map::Foam), "Foam"),
    ("source", Shown::Map(Map::Source), "Source of foam"),
    ("normals", Shown::Surface(Surface::Normals), "Normals"),
    ("folding", Shown::Surface(Surface::Jacobian), "Jacobian of all cascades"),
    ("roughness", Shown::Surface(Surface::Roughness), "Slope variance within the pixel"),
    ("mips", Shown::Surface(Surface::Mips), "Mip level"),
    ("coverage", Shown::Surface(Surface::Foam), "Share of foam"),
    ("wireframe", Shown::Surface(Surface::Wireframe), "Mesh"),
];

/// What stands instead of the picture, as a user sets it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What is shown.
    pub shown: Shown,
    /// Which cascade (or level of the foam), 1 to 4; 0 is all of them.
    pub cascade: u32,
}

impl Default for Choice {
    fn default() -> Self {
        Self { shown: Shown::Picture, cascade: 0 }
    }
}

impl Choice {
    fn place(self) -> usize {
        VIEWS.iter().position(|(_, shown, _)| *shown == self.shown).unwrap_or(0)
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        VIEWS[self.place()].2
    }

    /// The view that comes `by` places later, around the circle.
    #[must_use]
    pub fn turned(self, by: isize) -> Self {
        let at = (self.place() as isize + by).rem_euclid(VIEWS.len() as isize);
        Self { shown: VIEWS[at as usize].1, ..self }
    }

    /// Layers of the maps that are shown, from 0, of `most`.
    pub fn layers(self, most: usize) -> std::ops::Range<usize> {
        match (self.shown, self.cascade as usize) {
            (Shown::Map(_), 0) => 0..most,
            // On the mesh the finest cascade is the one whose mips are seen.
            (_, 0) => most.saturating_sub(1)..most,
            (_, one) => {
                let last = one.min(most);
                last.saturating_sub(1)..last
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_goes_around_all_views() {
        let start = Choice::default();
        let mut seen = vec![start];
        while seen.len() < VIEWS.len() {
            seen.push(seen[seen.len() - 1].turned(1));
        }
        assert_eq!(seen[VIEWS.len() - 1].turned(1), start);
        assert_eq!(start.turned(-1), seen[VIEWS.len() - 1]);
        for (i, a) in seen.iter().enumerate() {
            assert!(seen[..i].iter().all(|b| a != b && a.name() != b.name()), "{a:?}");
        }
    }

    #[test]
    fn layers_exist() {
        for (_, shown, _) in VIEWS {
            for cascade in 0..=4 {
                for most in 1..=4 {
                    let layers = Choice { shown: *shown, cascade }.layers(most);
                    assert!(!layers.is_empty() && layers.end <= most, "{shown:?} {cascade} of {most}: {layers:?}");
                }
            }
        }
    }
}
