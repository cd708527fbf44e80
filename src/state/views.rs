//! Views that replace the picture, in false colours: maps of the simulation, and quantities of the drawn surface.

use super::field::FieldKind::Choice;
use super::field::{FieldValue, integer, parameters};

/// The picture, or a view that replaces it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The picture.
    Picture,
    /// A map of the simulation, one texel beside the other, north up.
    Map(Map),
    /// A quantity of the drawn surface, seen by the camera.
    Surface(Surface),
}

/// A map of the simulation. The discriminants stand in shaders/views/map.wgsl too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// Initial spectrum, |h0(k)|.
    InitialSpectrum,
    /// Spectrum at the current time, h(k, t).
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
    /// Mean of (d eta/dz)^2 over two by two texels.
    MomentZz,
    /// Mean of d eta/dx d eta/dz over two by two texels.
    MomentXz,
    /// Jacobian of one cascade.
    Jacobian,
    /// Foam on one foam level.
    Foam,
    /// Source of foam on one foam level.
    Source,
}

/// A quantity of the drawn surface. The discriminants stand in shaders/views/surface.wgsl too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Unit normal: east red, north green, up blue.
    Normals,
    /// Jacobian of the sum of all cascades.
    Jacobian,
    /// Slope variance that the pixel does not resolve.
    Roughness,
    /// Mip level at which a cascade is sampled.
    Mips,
    /// Share of the pixel that foam covers.
    Foam,
    /// Triangles of the mesh.
    Wireframe,
}

/// Word in the state string and caption of every view, in the order in which a key goes through them.
pub const VIEWS: &[(&str, Shown, &str)] = &[
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

/// Words of [`VIEWS`].
const WORDS: [&str; VIEWS.len()] = {
    let mut words = [""; VIEWS.len()];
    let mut i = 0;
    while i < words.len() {
        words[i] = VIEWS[i].0;
        i += 1;
    }
    words
};

impl Shown {
    /// Place in [`VIEWS`].
    fn place(self) -> usize {
        VIEWS.iter().position(|(_, shown, _)| *shown == self).unwrap_or(0)
    }
}

impl FieldValue for Shown {
    fn to_f64(self) -> f64 {
        self.place() as f64
    }

    fn from_f64(value: f64) -> Self {
        VIEWS[value as usize].1
    }
}

parameters! {
    /// The chosen view.
    #[derive(Copy, Eq)]
    pub struct ViewChoice {
        /// View that replaces the picture (key V). Maps of the simulation, texel by texel: h0, the initial spectrum;
        /// spectrum, at this time; dx, height, dz, the displacement; dxdz, dxdx, dzdz, its derivatives; slopex, slopez,
        /// the slopes; momentxx, momentzz, momentxz, the slope moments; jacobian of one cascade; foam; source, where
        /// foam forms. On the surface: normals; folding, the Jacobian of all cascades; roughness, the slope variance
        /// within the pixel; mips, the mip level; coverage of foam; wireframe.
        shown: Shown = Shown::Picture => ("view", "View", "", Choice(&WORDS)),
        /// Cascade that a view shows, the longest waves first, or foam level, the finest first. 0 shows all side by
        /// side, and the mips of the finest cascade.
        cascade: u32 = 0 => ("viewcascade", "View of cascade", "", integer(0, 4), "all"),
    }
}

impl ViewChoice {
    /// Caption of the view.
    pub fn name(self) -> &'static str {
        VIEWS[self.shown.place()].2
    }

    /// The view `by` places further in [`VIEWS`], which is a circle.
    #[must_use]
    pub fn turned(self, by: isize) -> Self {
        let at = (self.shown.place() as isize + by).rem_euclid(VIEWS.len() as isize);
        Self { shown: VIEWS[at as usize].1, ..self }
    }

    /// Layers that are shown, from 0, of a map with `count` layers.
    pub fn layers(self, count: usize) -> std::ops::Range<usize> {
        match (self.shown, self.cascade as usize) {
            (Shown::Map(_), 0) => 0..count,
            // Views of the surface show the mips of one cascade: by default the finest.
            (_, 0) => count.saturating_sub(1)..count,
            (_, cascade) => {
                let end = cascade.min(count);
                end.saturating_sub(1)..end
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_goes_around_all_views() {
        let start = ViewChoice::default();
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
                    let layers = ViewChoice { shown: *shown, cascade }.layers(most);
                    assert!(!layers.is_empty() && layers.end <= most, "{shown:?} {cascade} of {most}: {layers:?}");
                }
            }
        }
    }
}
