//! False-colour views that replace the picture: maps of the simulation, and quantities on the drawn water surface.

use super::field::FieldKind::Choice;
use super::field::{FieldValue, integer, parameters};

/// What the window shows: the picture or a false-colour view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DisplayedView {
    /// Picture of the sea as the camera sees it, without false colours.
    Picture,
    /// False-colour view of a map (texture) of the simulation, shown flat and texel by texel, with north up.
    Map(MapView),
    /// False-colour view of a quantity on the drawn water surface, seen by the camera.
    Surface(SurfaceView),
}

/// Map (texture) of the simulation that a false-colour view shows. In shaders/views/map.wgsl `view_kind` is 1 + its
/// discriminant; 0 is the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapView {
    /// Magnitude |h0(k)|, m, of the amplitude at time 0 of the wave of one cascade that travels along wave vector k.
    InitialSpectrum,
    /// Complex amplitude h(k, t), m, of one cascade at wave vector k and time t: brightness is magnitude, hue phase.
    Spectrum,
    /// Horizontal displacement of the surface to the east by one cascade, Dx, m, without the factor of choppiness.
    Dx,
    /// Elevation eta of the surface by the waves of one cascade (patch of sea with its own FFT), m.
    Height,
    /// Horizontal displacement of the surface to the south by one cascade, Dz, m, without the factor of choppiness.
    Dz,
    /// Shear dDx/dz = dDz/dx of the displacement Dx east and Dz south by one cascade, without the factor of choppiness.
    DxDz,
    /// Slope to the east, d eta/dx, of the elevation eta by one cascade (patch of sea with its own FFT).
    SlopeX,
    /// Slope to the south, d eta/dz, of the elevation eta by one cascade (patch of sea with its own FFT).
    SlopeZ,
    /// Derivative dDx/dx (x is east) of the eastward displacement Dx by one cascade, without the factor of choppiness.
    DxDx,
    /// Derivative dDz/dz (z south) of the southward displacement Dz by one cascade, without the factor of choppiness.
    DzDz,
    /// Squared slope to the east, (d eta/dx)^2, of the elevation eta by one cascade, averaged over 2 x 2 texels.
    MomentXx,
    /// Squared slope to the south, (d eta/dz)^2, of the elevation eta by one cascade, averaged over 2 x 2 texels.
    MomentZz,
    /// Product of the slopes to the east and south, d eta/dx d eta/dz, by one cascade, averaged over 2 x 2 texels.
    MomentXz,
    /// Jacobian determinant of the horizontal displacement by one cascade: 1 if undeformed, below 0 where it folds.
    Jacobian,
    /// Fraction of the water that foam covers, 0 to 1, on one foam level (square foam grid around the camera).
    Foam,
    /// Foam source, 0 to 1: how strongly crests break, on one foam level (square foam grid around the camera).
    Source,
}

/// Quantity on the drawn water surface that a false-colour view shows. In shaders/views/surface.wgsl its number is 1 +
/// its discriminant; 0 is the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceView {
    /// Unit normal of the surface; its east component is shown as red, north as green, up as blue.
    Normals,
    /// Jacobian determinant of the horizontal displacement by all cascades: 1 if undeformed, below 0 where it folds.
    Jacobian,
    /// Variance of the wave slopes that the pixel does not resolve: the sum of the variances to the east and south.
    Roughness,
    /// Mip level at which the pixel samples the maps of the chosen cascade (patch of sea with its own FFT).
    Mips,
    /// Fraction of the pixel that visible foam covers, 0 to 1.
    Foam,
    /// Edges of the triangles of the water mesh.
    Wireframe,
}

/// The picture and all false-colour views: word in the state string, view, and caption for the user, in the order in
/// which the key V steps through them.
pub const DISPLAYED_VIEWS: &[(&str, DisplayedView, &str)] = &[
    ("picture", DisplayedView::Picture, "Picture"),
    ("h0", DisplayedView::Map(MapView::InitialSpectrum), "Initial spectrum |h0(k)|"),
    ("spectrum", DisplayedView::Map(MapView::Spectrum), "Spectrum h(k, t), phase as hue"),
    ("dx", DisplayedView::Map(MapView::Dx), "Displacement east, Dx"),
    ("height", DisplayedView::Map(MapView::Height), "Elevation"),
    ("dz", DisplayedView::Map(MapView::Dz), "Displacement south, Dz"),
    ("dxdz", DisplayedView::Map(MapView::DxDz), "dDx/dz"),
    ("slopex", DisplayedView::Map(MapView::SlopeX), "Slope to the east"),
    ("slopez", DisplayedView::Map(MapView::SlopeZ), "Slope to the south"),
    ("dxdx", DisplayedView::Map(MapView::DxDx), "dDx/dx"),
    ("dzdz", DisplayedView::Map(MapView::DzDz), "dDz/dz"),
    ("momentxx", DisplayedView::Map(MapView::MomentXx), "Slope moment xx"),
    ("momentzz", DisplayedView::Map(MapView::MomentZz), "Slope moment zz"),
    ("momentxz", DisplayedView::Map(MapView::MomentXz), "Slope moment xz"),
    ("jacobian", DisplayedView::Map(MapView::Jacobian), "Jacobian of one cascade"),
    ("foam", DisplayedView::Map(MapView::Foam), "Foam"),
    ("source", DisplayedView::Map(MapView::Source), "Source of foam"),
    ("normals", DisplayedView::Surface(SurfaceView::Normals), "Normals"),
    ("folding", DisplayedView::Surface(SurfaceView::Jacobian), "Jacobian of all cascades"),
    ("roughness", DisplayedView::Surface(SurfaceView::Roughness), "Slope variance within the pixel"),
    ("mips", DisplayedView::Surface(SurfaceView::Mips), "Mip level"),
    ("coverage", DisplayedView::Surface(SurfaceView::Foam), "Share of foam"),
    ("wireframe", DisplayedView::Surface(SurfaceView::Wireframe), "Mesh"),
];

/// Words for the key `view` of a state string: one for the picture and each view, in the order of [`DISPLAYED_VIEWS`].
const WORDS: [&str; DISPLAYED_VIEWS.len()] = {
    let mut words = [""; DISPLAYED_VIEWS.len()];
    let mut i = 0;
    while i < words.len() {
        words[i] = DISPLAYED_VIEWS[i].0;
        i += 1;
    }
    words
};

impl DisplayedView {
    /// Index of this view in [`DISPLAYED_VIEWS`].
    fn index(self) -> usize {
        DISPLAYED_VIEWS.iter().position(|(_, displayed, _)| *displayed == self).unwrap_or(0)
    }
}

impl FieldValue for DisplayedView {
    fn to_f64(self) -> f64 {
        self.index() as f64
    }

    fn from_f64(value: f64) -> Self {
        DISPLAYED_VIEWS[value as usize].1
    }
}

parameters! {
    /// What the window shows: the picture or a false-colour view, and the cascade or foam level whose map a view shows.
    #[derive(Copy, Eq)]
    pub struct ViewChoice {
        /// View that replaces the picture (key V). Maps of the simulation, texel by texel: h0, the initial spectrum;
        /// spectrum, at this time; dx, height, dz, the displacement; dxdz, dxdx, dzdz, its derivatives; slopex, slopez,
        /// the slopes; momentxx, momentzz, momentxz, products of slopes; jacobian of one cascade; foam; source, where
        /// foam forms. On the drawn surface: normals; folding, the Jacobian of all cascades; roughness, the slope
        /// variance within the pixel; mips, the mip level; coverage of foam; wireframe of the mesh.
        displayed: DisplayedView = DisplayedView::Picture => ("view", "View", "", Choice(&WORDS)),
        /// Cascade that a view shows (1 has the longest waves); for the views foam and source, the foam level (1 is the
        /// finest). 0 shows all side by side; the view mips then shows the finest cascade.
        cascade: u32 = 0 => ("viewcascade", "View of cascade", "", integer(0, 4), "all"),
    }
}

impl ViewChoice {
    /// Caption for the user of what the window shows: "Picture", or a false-colour view such as "Slope to the east".
    pub fn name(self) -> &'static str {
        DISPLAYED_VIEWS[self.displayed.index()].2
    }

    /// This choice with the view that is `by` places further in [`DISPLAYED_VIEWS`] (negative: back); after the last
    /// comes the first. The chosen cascade is kept.
    #[must_use]
    pub fn cycled_by(self, by: isize) -> Self {
        let at = (self.displayed.index() as isize + by).rem_euclid(DISPLAYED_VIEWS.len() as isize);
        Self { displayed: DISPLAYED_VIEWS[at as usize].1, ..self }
    }

    /// Indices, from 0, of the layers that the view shows of a map (array texture) with `count` layers, one for each
    /// cascade or foam level: the layer that the user chose. Without a choice (0) a view of a map shows all layers, and
    /// a view of the water surface uses the last one (the finest cascade).
    pub fn shown_layers(self, count: usize) -> std::ops::Range<usize> {
        match (self.displayed, self.cascade as usize) {
            (DisplayedView::Map(_), 0) => 0..count,
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
        while seen.len() < DISPLAYED_VIEWS.len() {
            seen.push(seen[seen.len() - 1].cycled_by(1));
        }
        assert_eq!(seen[DISPLAYED_VIEWS.len() - 1].cycled_by(1), start);
        assert_eq!(start.cycled_by(-1), seen[DISPLAYED_VIEWS.len() - 1]);
        for (i, a) in seen.iter().enumerate() {
            assert!(seen[..i].iter().all(|b| a != b && a.name() != b.name()), "{a:?}");
        }
    }

    #[test]
    fn layers_exist() {
        for (_, displayed, _) in DISPLAYED_VIEWS {
            for cascade in 0..=4 {
                for most in 1..=4 {
                    let cascade_layers = ViewChoice { displayed: *displayed, cascade }.shown_layers(most);
                    assert!(
                        !cascade_layers.is_empty() && cascade_layers.end <= most,
                        "{displayed:?} {cascade} of {most}: {cascade_layers:?}"
                    );
                }
            }
        }
    }
}
