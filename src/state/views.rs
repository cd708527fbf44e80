//! False-colour views that replace the picture: maps of the simulation, and quantities on the drawn water surface.

use super::field::FieldKind::Choice;
use super::field::{FieldValue, integer, parameters};

/// What the window shows: the picture or a false-colour view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Picture of the sea.
    Picture,
    /// Map of the simulation, shown flat and texel by texel, with north up.
    Map(Map),
    /// Quantity on the drawn water surface, seen by the camera.
    Surface(Surface),
}

/// Map of the simulation that a view can show. shaders/views/map.wgsl knows each as 1 + its discriminant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Map {
    /// Magnitude |h0(k)| of the initial spectrum at each wave vector k.
    InitialSpectrum,
    /// Spectrum h(k, t) at the current time t: magnitude as brightness, phase as hue.
    Spectrum,
    /// Horizontal displacement to the east, Dx.
    Dx,
    /// Elevation of the surface, eta.
    Height,
    /// Horizontal displacement to the south, Dz.
    Dz,
    /// Shear dDx/dz = dDz/dx of the horizontal displacement (Dx, Dz); x is east, z south.
    Shear,
    /// Slope of the elevation eta to the east, d eta/dx.
    SlopeX,
    /// Slope of the elevation eta to the south, d eta/dz.
    SlopeZ,
    /// Derivative dDx/dx of the eastward displacement Dx to the east.
    StretchX,
    /// Derivative dDz/dz of the southward displacement Dz to the south.
    StretchZ,
    /// Squared slope to the east, (d eta/dx)^2 with the elevation eta, averaged over 2 x 2 texels.
    MomentXx,
    /// Squared slope to the south, (d eta/dz)^2 with the elevation eta, averaged over 2 x 2 texels.
    MomentZz,
    /// Product of the slopes to the east and south, d eta/dx d eta/dz, averaged over 2 x 2 texels.
    MomentXz,
    /// Jacobian determinant of the horizontal displacement of one cascade.
    Jacobian,
    /// Amount of foam on one level of the foam map.
    Foam,
    /// Foam source (how strongly crests break) on one level of the foam map.
    Source,
}

/// Quantity on the drawn water surface that a view can show. shaders/views/surface.wgsl knows each as 1 + its
/// discriminant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Unit normal of the surface; its east component is shown as red, north as green, up as blue.
    Normals,
    /// Jacobian determinant of the horizontal displacement, all cascades together.
    Jacobian,
    /// Variance of the wave slopes that the pixel does not resolve.
    Roughness,
    /// Mip level at which the pixel samples the maps of a cascade.
    Mips,
    /// Fraction of the pixel that foam covers.
    Foam,
    /// Edges of the triangles of the water mesh.
    Wireframe,
}

/// All views with word in the state string and caption, in the order in which the key V steps through them.
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

/// Words of all views in the state string, in the order of [`VIEWS`].
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
    /// Index of this view in [`VIEWS`].
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
    /// Choice of the picture or a view, and of the cascade that a view shows.
    #[derive(Copy, Eq)]
    pub struct ViewChoice {
        /// View that replaces the picture (key V). Maps of the simulation, texel by texel: h0, the initial spectrum;
        /// spectrum, at this time; dx, height, dz, the displacement; dxdz, dxdx, dzdz, its derivatives; slopex, slopez,
        /// the slopes; momentxx, momentzz, momentxz, products of slopes; jacobian of one cascade; foam; source, where
        /// foam forms. On the drawn surface: normals; folding, the Jacobian of all cascades; roughness, the slope
        /// variance within the pixel; mips, the mip level; coverage of foam; wireframe of the mesh.
        shown: Shown = Shown::Picture => ("view", "View", "", Choice(&WORDS)),
        /// Cascade that a view shows (1 has the longest waves), or level of the foam map (1 is the finest). 0 shows all
        /// side by side; the view mips then shows the finest cascade.
        cascade: u32 = 0 => ("viewcascade", "View of cascade", "", integer(0, 4), "all"),
    }
}

impl ViewChoice {
    /// Caption of the chosen view.
    pub fn name(self) -> &'static str {
        VIEWS[self.shown.place()].2
    }

    /// Choice of the view that is `by` places further in [`VIEWS`]; after the last comes the first.
    #[must_use]
    pub fn turned(self, by: isize) -> Self {
        let at = (self.shown.place() as isize + by).rem_euclid(VIEWS.len() as isize);
        Self { shown: VIEWS[at as usize].1, ..self }
    }

    /// Indices of the layers of a map that the view shows; the map has `count` layers, one per cascade or foam level.
    pub fn layers(self, count: usize) -> std::ops::Range<usize> {
        match (self.shown, self.cascade as usize) {
            (Shown::Map(_), 0) => 0..count,
            // Views of the surface use one cascade, for mip levels: by default the finest.
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
