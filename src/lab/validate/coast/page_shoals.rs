//! The page's sections on beds that are not straight: island, slope, elliptic shoal.

use super::page_structures::{error_cells, with_line};
use super::shoals::{self, ISLAND_M, ISLAND_PERIOD_S, SLOPE_DEPTHS_M, SLOPE_PERIOD_S};
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::lab::validate::cells::format_number;

/// Lengths of the slopes that are solved, m: 1:0.75 to 1:20.
pub const SLOPE_WIDTHS_M: [f64; 5] = [0.3, 0.6, 1.2, 4.0, 8.0];

/// Adds the section on the island.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn add_island(page: &mut MarkdownPage) -> Result<(), String> {
    let [island_m, shoal_m, deep_m] = ISLAND_M;
    page.heading(3, "Island on a shoal");
    page.paragraph(&format!(
        "An island of {island_m:.0} m of radius with a vertical shore on a paraboloidal shoal of {shoal_m:.0} m, in \
         {deep_m:.0} m of water (the geometry of Homma 1950), waves of {ISLAND_PERIOD_S:.0} s, elliptic solution on \
         points 1 m apart. Homma's series holds for long waves; theory here holds for all: the mild-slope equation \
         separates in polar coordinates, and a Runge-Kutta method integrates each angular mode along the radius."
    ));
    let case = shoals::island();
    let x = Axis::linear("distance from the middle, radii of the island", -3.9, 3.9);
    let y = Axis::linear("amplitude / arriving", 0.0, 0.5 * (2.0 * case.highest()).ceil() + 0.5);
    let mut figure = Figure::new("Island", x, y, LegendCorner::UpperRight);
    for (colour, (label, line)) in [("along x", (1, 0.0)), ("along y", (0, 0.0))].into_iter().enumerate() {
        figure = with_line(figure, &case, line, island_m, (label, colour));
    }
    page.figure(
        "coast-island",
        &figure,
        "Amplitude through the middle of the island, towards the shore (x) and along it (y): angular modes (lines) and \
         the elliptic solution (circles).",
    )?;
    let [largest, rms, highest] = error_cells(&case);
    let of_highest = format!("{:.1} %", 100.0 * case.largest_error() / case.highest());
    page.table(
        "points | highest amplitude | largest difference | as a fraction of the highest | root mean square difference",
        &[vec![case.points.len().to_string(), highest, largest, of_highest, rms]],
    );
    Ok(())
}

/// Adds the section on the slope between two depths.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn add_slope(page: &mut MarkdownPage) -> Result<(), String> {
    let [deep_m, shallow_m] = SLOPE_DEPTHS_M;
    page.heading(3, "Slope between two depths");
    page.paragraph(&format!(
        "Waves of {SLOPE_PERIOD_S:.0} s come from {deep_m} m to {shallow_m} m of depth over a slope, the geometry in \
         which Booij (1983) found that the mild-slope equation holds up to a slope of 1:3. Theory is a fourth-order \
         Runge-Kutta integration of the same equation; Booij's numbers from the exact equations could not be had. The \
         elliptic solver finds waves over straight contours in layers of constant depth, 15 cm wide here."
    ));
    let drop_m = deep_m - shallow_m;
    let x = Axis::log("length of the slope / drop of the depth", 0.5, 25.0);
    let curve = sample_curve(&x, 80, |ratio| shoals::slope_reflection(ratio * drop_m));
    let (mut rows, mut circles) = (Vec::new(), Vec::new());
    for width_m in SLOPE_WIDTHS_M {
        let case = shoals::slope(width_m);
        let ratio = width_m / drop_m;
        circles.push([ratio, case.solved[0], 0.0]);
        rows.push(vec![
            format!("1:{ratio}"),
            format_number(case.expected[0], 4),
            format_number(case.solved[0], 4),
            format_number(case.expected[1], 4),
            format_number(case.solved[1], 4),
        ]);
    }
    let y = Axis::linear("amplitude of the reflected wave / arriving", 0.0, 0.2);
    let figure = Figure::new("Reflection by a slope", x, y, LegendCorner::UpperRight)
        .with_series(FigureSeries::new("Runge-Kutta", 0, SeriesData::Line(curve)))
        .with_series(FigureSeries::new("elliptic", 1, SeriesData::Points(circles)));
    page.figure(
        "coast-slope",
        &figure,
        "Reflection by a slope against its length: Runge-Kutta integration (line) and the elliptic solution (circles).",
    )?;
    page.table("slope | reflection, theory | solved | transmission, theory | solved", &rows);
    Ok(())
}

/// Adds the section on the elliptic shoal.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn add_elliptic_shoal(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Elliptic shoal");
    page.paragraph(
        "The laboratory shoal of Berkhoff, Booij and Radder (1982): waves of 1 s over an elliptic hill on a slope of \
         1:50 that is turned by 20°. The parabolic solution on points 25 cm apart is compared in the eight measured \
         sections with the elliptic one on points half as far apart, and both with the measurements as the benchmark \
         cases of FUNWAVE-TVD give them. x is the distance behind the middle of the shoal, y that along the crests. The \
         index of agreement is Willmott's (1981), 1 for equal curves. The waves are 4.64 cm high and in the focus twice \
         as high, in 20 cm of water: the linear equation leaves out that high waves are faster, which defocuses them. The \
         last column repeats the parabolic solution with the speed that the dispersion relation of Kirby and Dalrymple \
         (1986) gives for the height of the round before. It explains the difference in sections 2 to 7; sections 1 and \
         8 keep theirs. The program's seas are sums of linear waves and stay without it.",
    );
    let (mut figures, mut rows) = (Vec::new(), Vec::new());
    let places = ["x = 1 m", "x = 3 m", "x = 5 m", "x = 7 m", "x = 9 m", "y = -2 m", "y = 0 m", "y = 2 m"];
    for (section, place) in shoals::elliptic_shoal().iter().zip(places) {
        let across = place.starts_with('x');
        let (label, low, high) = if across { ("y, m", -5.0, 5.0) } else { ("x, m", 0.0, 11.0) };
        let title = format!("Section {}: {place}", section.number);
        let y = Axis::linear("amplitude / arriving", 0.0, 3.0);
        let line = section.points.iter().map(|p| [p[0], p[2]]).collect();
        let dashes = section.points.iter().map(|p| [p[0], p[1]]).collect();
        let faster = section.points.iter().map(|p| [p[0], p[3]]).collect();
        let measured = section.measured.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let figure = Figure::new(&title, Axis::linear(label, low, high), y, LegendCorner::UpperRight)
            .with_series(FigureSeries::new("elliptic, 12.5 cm", 0, SeriesData::Line(line)))
            .with_series(FigureSeries::new("parabolic, 25 cm", 1, SeriesData::Dashes(dashes)))
            .with_series(FigureSeries::new("with the speed of high waves", 2, SeriesData::Line(faster)))
            .with_series(FigureSeries::new("measured", 6, SeriesData::Points(measured)));
        figures.push((format!("coast-shoal-{}", section.number), figure));
        let highest = |of: usize| section.points.iter().map(|p| p[of]).fold(0.0, f64::max);
        rows.push(vec![
            section.number.to_string(),
            place.to_owned(),
            format_number(highest(2), 3),
            format_number(highest(1), 3),
            format_number(section.agreement(), 4),
            format_number(section.agreement_with_measured(2), 3),
            format_number(section.agreement_with_measured(1), 3),
            format_number(section.agreement_with_measured(3), 3),
        ]);
    }
    page.figures(
        &figures,
        "Amplitude in the eight sections of Berkhoff, Booij and Radder 1982: fine elliptic solution (lines), parabolic \
         solution (dashed) and measurements (circles).",
    )?;
    page.table("section | place | highest amplitude, elliptic | parabolic | agreement of both | elliptic with measured | parabolic with measured \
         | with the speed of high waves", &rows);
    Ok(())
}
