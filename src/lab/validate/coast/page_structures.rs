//! The page's sections on structures: breakwater, gap, pile.

use super::structures::{self, AmplitudeFigure, GAP_WIDTHS, LEE_M, PILE_RADIUS_M, WALL_CELL_M, WALL_PERIOD_S};
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData};
use crate::lab::page::MarkdownPage;
use crate::lab::validate::cells::format_number;

/// Directions of the waves at the breakwater, degrees.
pub const BREAKWATER_DIRECTIONS_DEG: [f64; 3] = [0.0, 30.0, -30.0];
/// Period (s) and direction (degrees) of the waves at the pile.
pub const PILE_WAVES: [(f64, f64); 2] = [(8.0, 0.0), (5.5, 20.0)];
/// Distances behind a wall at which lines are drawn, wavelengths.
const LINES_BEHIND: [f64; 3] = [0.5, 1.0, 2.0];

/// Adds solved points (circles) and theory (line) along a line of a case to a figure. `scale_m` is the unit of the x axis.
pub fn with_line(
    mut figure: Figure,
    case: &AmplitudeFigure,
    (across, at_m): (usize, f64),
    scale_m: f64,
    (label, colour): (&str, usize),
) -> Figure {
    let line = case.line(across, at_m);
    let every = (line.len() / 40).max(1);
    let circles = line.iter().step_by(every).map(|p| [p[0] / scale_m, p[1], 0.0]).collect();
    let step_m = line.windows(2).map(|pair| (pair[1][0] - pair[0][0]).abs()).fold(f64::INFINITY, f64::min);
    // A structure on the line parts it.
    for (index, part) in line.chunk_by(|a, b| (b[0] - a[0]).abs() < 1.5 * step_m).enumerate() {
        let theory = part.iter().map(|p| [p[0] / scale_m, p[2]]).collect();
        let label = if index == 0 { label } else { "" };
        figure = figure.with_series(FigureSeries::new(label, colour, SeriesData::Line(theory)));
    }
    figure.with_series(FigureSeries::new("", colour, SeriesData::Points(circles)))
}

/// Cells of a table: largest and root mean square difference, and the highest amplitude.
pub fn error_cells(case: &AmplitudeFigure) -> [String; 3] {
    [case.largest_error(), case.rms_error(), case.highest()].map(|value| format_number(value, 3))
}

/// A figure of the amplitude along lines behind a wall, for the distances of [`LINES_BEHIND`].
fn behind_wall(title: &str, case: &AmplitudeFigure, reach: f64) -> Figure {
    let x = Axis::linear("along the wall, wavelengths", -reach, reach);
    let mut figure = Figure::new(title, x, Axis::linear("amplitude / arriving", 0.0, 1.4), LegendCorner::UpperRight);
    for (colour, wavelengths) in LINES_BEHIND.into_iter().enumerate() {
        let label = format!("{wavelengths} wavelengths behind");
        figure = with_line(figure, case, (0, wavelengths * case.wavelength_m), case.wavelength_m, (&label, colour));
    }
    figure
}

/// Adds the section on a breakwater and a gap.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn add_walls(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Breakwater and gap");
    page.paragraph(&format!(
        "Waves of {WALL_PERIOD_S:.0} s behind a thin, fully reflecting wall in 10 m of water, elliptic solution on points \
         {WALL_CELL_M} m apart. Theory behind a semi-infinite breakwater is Sommerfeld's (1896) solution in double precision, as \
         Penney and Price (1952) use it. Penney and Price's sum for a gap is an approximation; here theory is the exact \
         solution of the integral equation over the gap. All points from {LEE_M} m behind the wall are compared; the amplitude \
         of the arriving waves is 1."
    ));
    let (mut figures, mut rows) = (Vec::new(), Vec::new());
    let mut add = |name: String, title: String, reach: f64, case: &AmplitudeFigure| {
        let [largest, rms, highest] = error_cells(case);
        rows.push(vec![title.clone(), case.points.len().to_string(), highest, largest, rms]);
        figures.push((name, behind_wall(&title, case, reach)));
    };
    for direction_deg in BREAKWATER_DIRECTIONS_DEG {
        let case = structures::breakwater(direction_deg);
        let side = if direction_deg < 0.0 { "from-lee" } else { "from-sea" };
        let name = format!("coast-breakwater-{side}-{:.0}", direction_deg.abs());
        add(name, format!("Breakwater, waves at {direction_deg:.0}°"), 1.8, &case);
    }
    for widths in GAP_WIDTHS {
        let (case, exact_widths) = structures::gap(widths, 0.0);
        let title = format!("Gap of {exact_widths:.2} wavelengths, waves at 0°");
        add(format!("coast-gap-{widths:.0}"), title, 2.4, &case);
    }
    let (case, exact_widths) = structures::gap(2.0, 30.0);
    let title = format!("Gap of {exact_widths:.2} wavelengths, waves at 30°");
    add("coast-gap-2-oblique".to_owned(), title, 2.4, &case);
    page.figures(
        &figures,
        "Amplitude on lines behind a wall: theory (lines) and the elliptic solution (circles). The breakwater stands on \
         the positive side; the gap is in the middle.",
    )?;
    page.table("case | points | highest amplitude | largest difference | root mean square difference", &rows);
    Ok(())
}

/// Adds the section on the pile.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn add_pile(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Vertical pile");
    page.paragraph(&format!(
        "A round pile of {PILE_RADIUS_M:.0} m of radius in 10 m of water, points 0.8 m apart. Theory is the series of \
         MacCamy and Fuchs (1954). All points from one cell beside the pile are compared."
    ));
    let (mut figures, mut rows) = (Vec::new(), Vec::new());
    for (period_s, direction_deg) in PILE_WAVES {
        let case = structures::pile(period_s, direction_deg);
        let title = format!("Pile, waves of {period_s} s at {direction_deg:.0}°");
        let x = Axis::linear("distance from the middle, radii", -3.4, 3.4);
        let mut figure =
            Figure::new(&title, x, Axis::linear("amplitude / arriving", 0.0, 2.6), LegendCorner::UpperRight);
        for (colour, (label, line)) in [("along x", (1, 0.0)), ("along y", (0, 0.0))].into_iter().enumerate() {
            figure = with_line(figure, &case, line, PILE_RADIUS_M, (label, colour));
        }
        let [largest, rms, highest] = error_cells(&case);
        rows.push(vec![title, case.points.len().to_string(), highest, largest, rms]);
        figures.push((format!("coast-pile-{:.0}", 10.0 * period_s), figure));
    }
    page.figures(
        &figures,
        "Amplitude through the middle of the pile, towards the shore (x) and along it (y): theory (lines) and the \
         elliptic solution (circles).",
    )?;
    page.table("case | points | highest amplitude | largest difference | root mean square difference", &rows);
    Ok(())
}
