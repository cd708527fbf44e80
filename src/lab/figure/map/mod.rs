//! Figures of maps: coloured bands over land and water with contours, arrows, colour bars, axes and a scale bar, as SVG
//! text or as a PNG picture.
//!
//! A map is drawn in the frame of a coast ([`crate::coast`]): the x axis, from the sea to the land, points up, and the y
//! axis to the right.

mod contours;
mod draw;
mod palette;
mod png;
mod raster;

pub use palette::{ColourScale, Palette};

/// A figure of one or several maps of the same area, two beside each other.
#[derive(Clone, Debug)]
pub struct MapFigure {
    /// Title.
    pub title: String,
    /// A line below it.
    pub subtitle: String,
    /// Number of points of the grid along x (up) and along y (to the right).
    pub columns: usize,
    /// Number of points along y.
    pub rows: usize,
    /// Distance of two points, m.
    pub cell_m: f64,
    /// Depth at the points, m, negative on land; point (i, j) has the index j `columns` + i.
    pub depth_m: Vec<f32>,
    /// Bearing of the x axis, degrees clockwise from north.
    pub toward_deg: f64,
    /// Points (x, y) with a number from 1, m.
    pub marks_m: Vec<[f64; 2]>,
    /// The maps.
    pub panels: Vec<MapPanel>,
}

/// One map of a figure.
#[derive(Clone, Debug)]
pub struct MapPanel {
    /// Title, with the unit.
    pub title: String,
    /// Values at the points, in the order of the depths. On land they are not looked at.
    pub values: Vec<f32>,
    /// Colours of the values.
    pub scale: ColourScale,
    /// Values at which contours are drawn, each with its number.
    pub contours: Vec<f64>,
    /// Depths, m, at which thin contours of the depth are drawn without numbers.
    pub depth_contours_m: Vec<f64>,
    /// Arrows: the middle (x, y; m), and the direction and length as (x, y), 1 for the longest.
    pub arrows: Vec<[f64; 4]>,
}

impl MapFigure {
    /// Draws the figure as the text of an SVG file.
    ///
    /// # Errors
    /// One sentence, if the crates for drawing fail.
    pub fn svg(&self) -> Result<String, String> {
        draw::svg(self)
    }

    /// Draws the figure as a PNG file of few colours.
    ///
    /// # Errors
    /// One sentence, if the crates for drawing fail.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        draw::png(self)
    }

    /// Lengths of the area along x and along y, m.
    fn side_m(&self) -> [f64; 2] {
        [self.columns, self.rows].map(|count| (count - 1) as f64 * self.cell_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope with the shore at 80 m of 100 m.
    fn figure() -> MapFigure {
        let (columns, rows) = (21, 31);
        let depth_m: Vec<f32> = (0..columns * rows).map(|i| 8.0 - 0.5 * (i % columns) as f32).collect();
        let panel = MapPanel {
            title: "Depth (m)".into(),
            values: depth_m.clone(),
            scale: ColourScale::nice(0.0, 8.0, 8, Palette::Water),
            contours: vec![2.0, 5.0],
            depth_contours_m: vec![],
            arrows: vec![[20.0, 40.0, 0.5, 0.5]],
        };
        MapFigure {
            title: "A <slope>".into(),
            subtitle: "for a test".into(),
            columns,
            rows,
            cell_m: 5.0,
            depth_m,
            toward_deg: 60.0,
            marks_m: vec![[30.0, 70.0]],
            panels: vec![panel.clone(), panel],
        }
    }

    #[test]
    fn a_figure_has_its_texts_and_pictures() {
        let svg = figure().svg().expect("a figure");
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
        for text in ["Depth (m)", "A &lt;slope&gt;", "for a test", "along the shore (m)"] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(svg.matches("<image ").count(), 2);
        let png = figure().png().expect("a figure");
        let picture = image::load_from_memory(&png).expect("a PNG").to_rgb8();
        assert_eq!(picture.width(), 880);
        // Water, sand and text are there: blue, yellow and dark pixels.
        let count = |is: &dyn Fn(&image::Rgb<u8>) -> bool| picture.pixels().filter(|p| is(p)).count();
        assert!(count(&|p| p[2] > p[0].saturating_add(60)) > 5000, "water");
        assert!(count(&|p| p[0] > p[2].saturating_add(25) && p[0] > 180) > 3000, "sand");
        assert!(count(&|p| p.0.iter().all(|c| *c < 90)) > 300, "text");
    }
}
