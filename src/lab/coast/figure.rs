//! The figure of a sea over a coast: depth, wave height, surface with directions, and breaking.

use super::{CoastSea, compass_point};
use crate::coast::sea_maps::usual_largest;
use crate::lab::figure::map::{ColourScale, MapFigure, MapPanel, Palette};

/// Depths at which contours are drawn, m.
const DEPTH_CONTOURS_M: [f64; 6] = [2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Arrows along the longer side of a map.
const ARROWS: usize = 13;

impl CoastSea {
    /// The four maps.
    pub fn figure(&self) -> MapFigure {
        let grid = &self.coast.bathymetry;
        let from =
            self.open.from_deg.map_or_else(String::new, |deg| format!(", from {deg:.0}° ({})", compass_point(deg)));
        MapFigure {
            title: self.coast.title.clone(),
            subtitle: format!(
                "Open sea: Hs {:.2} m, Tp {:.1} s{from}. The land lies towards {:.0}° ({}).",
                self.open.hs_m,
                self.open.tp_s,
                self.coast.toward_deg,
                compass_point(self.coast.toward_deg)
            ),
            columns: grid.columns,
            rows: grid.rows,
            cell_m: grid.cell_m,
            depth_m: grid.depth_m.clone(),
            toward_deg: self.coast.toward_deg,
            marks_m: self.gauges.list.iter().map(|gauge| gauge.at_m).collect(),
            panels: vec![self.depth_panel(), self.height_panel(), self.surface_panel(), self.breaking_panel()],
        }
    }

    fn depth_panel(&self) -> MapPanel {
        let depth_m = &self.coast.bathymetry.depth_m;
        let deepest = f64::from(depth_m.iter().copied().fold(0.0, f32::max));
        MapPanel {
            title: "Depth (m)".into(),
            values: depth_m.clone(),
            scale: ColourScale::nice(0.0, deepest, 13, Palette::Water),
            contours: DEPTH_CONTOURS_M.into_iter().filter(|d| *d < 0.97 * deepest).collect(),
            depth_contours_m: Vec::new(),
            arrows: Vec::new(),
        }
    }

    fn height_panel(&self) -> MapPanel {
        let scale = ColourScale::nice(0.0, usual_largest(&self.maps.hs_m), 11, Palette::Heights);
        let contours = (1..scale.bands).filter(|band| band % 2 == 0).map(|band| scale.low + band as f64 * scale.step);
        MapPanel {
            title: "Significant wave height Hs (m)".into(),
            values: self.maps.hs_m.clone(),
            contours: contours.collect(),
            scale,
            depth_contours_m: Vec::new(),
            arrows: Vec::new(),
        }
    }

    fn surface_panel(&self) -> MapPanel {
        let (title, values) = if self.surface_m.is_empty() {
            ("Mean direction of the waves", vec![0.0; self.maps.hs_m.len()])
        } else {
            ("Surface (m) and mean direction of the waves", self.surface_m.clone())
        };
        let half = usual_largest(&self.surface_m.iter().map(|v| v.abs()).collect::<Vec<f32>>()).max(0.05);
        MapPanel {
            title: title.into(),
            values,
            scale: ColourScale {
                has_bar: !self.surface_m.is_empty(),
                ..ColourScale::nice(-half, half, 7, Palette::Surface)
            },
            contours: Vec::new(),
            depth_contours_m: Vec::new(),
            arrows: self.arrows(),
        }
    }

    fn breaking_panel(&self) -> MapPanel {
        let percent: Vec<f32> = self.maps.breaking_fraction.iter().map(|q| 100.0 * q).collect();
        let deepest = f64::from(self.coast.bathymetry.depth_m.iter().copied().fold(0.0, f32::max));
        MapPanel {
            title: "Breaking waves (% of the waves)".into(),
            values: percent,
            scale: ColourScale::nice(0.0, 100.0, 10, Palette::Breaking),
            contours: Vec::new(),
            depth_contours_m: DEPTH_CONTOURS_M.into_iter().filter(|d| *d < 0.97 * deepest).collect(),
            arrows: Vec::new(),
        }
    }

    /// Arrows of the mean direction, as long as the waves are high.
    fn arrows(&self) -> Vec<[f64; 4]> {
        let grid = &self.coast.bathymetry;
        let highest = f64::from(self.maps.hs_m.iter().copied().fold(0.0, f32::max)).max(1e-9);
        // In the middles of equal parts, so that none reaches beyond the map.
        let part = grid.columns.max(grid.rows) as f64 / ARROWS as f64;
        let along = |count: usize| {
            let parts = (count as f64 / part).round().max(1.0);
            (0..parts as usize).map(move |i| ((i as f64 + 0.5) / parts * count as f64) as usize)
        };
        let arrow = |(i, j): (usize, usize)| {
            let index = j * grid.columns + i;
            let (size, direction) =
                (f64::from(self.maps.hs_m[index]) / highest, f64::from(self.maps.direction_rad[index]));
            let at = [i, j].map(|index| index as f64 * grid.cell_m);
            (grid.at(i, j) > 0.3 && size > 0.02)
                .then(|| [at[0], at[1], size.sqrt() * direction.cos(), size.sqrt() * direction.sin()])
        };
        along(grid.columns).flat_map(|i| along(grid.rows).map(move |j| (i, j))).filter_map(arrow).collect()
    }
}
