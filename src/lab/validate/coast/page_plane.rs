//! The page's sections on straight contours: flat bed, plane beach, surf zone.

use super::plane::{self, BEACH, BeachPoint, SWAN_BEACH, SWAN_HS_M};
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData};
use crate::lab::page::MarkdownPage;
use crate::lab::validate::cells::format_number;

/// Period (s) and direction (degrees) of the waves over the plane beach.
pub const BEACH_WAVES: [(f64, f64); 4] = [(10.0, 30.0), (10.0, 0.0), (6.0, -50.0), (14.0, 60.0)];
/// Significant height (m), period (s) and slope of the surf zones.
pub const SURF_ZONES: [(f64, f64, f64); 3] = [(1.0, 8.0, 0.02), (2.0, 10.0, 0.0125), (1.5, 6.0, 0.05)];
/// Every how many points a figure has a circle.
const EVERY: usize = 4;

/// Adds the section on the flat bed.
pub fn add_flat_bed(page: &mut MarkdownPage) {
    page.heading(3, "Flat bed");
    page.paragraph(
        "Plane waves over 12 m of water, 96 x 64 points of 8 m: over a flat bed both solvers return the open sea. The \
         largest difference of the complex amplitude over all points, as a fraction of the amplitude.",
    );
    let rows: Vec<Vec<String>> = (plane::flat_bed().iter())
        .map(|case| {
            let error = |value: f64| format!("{value:.0e}");
            let (period, direction) = (format_number(case.period_s, 0), format_number(case.direction_deg, 0));
            vec![period, direction, error(case.parabolic), error(case.elliptic)]
        })
        .collect();
    page.table("period, s | direction, ° | parabolic | elliptic", &rows);
}

/// Adds the section on the plane beach.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn add_plane_beach(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Plane beach");
    page.paragraph(&format!(
        "A beach of 1:100 from {:.0} m to {:.1} m of depth without losses, parabolic solution. Theory is Snell's law for \
         the direction and the conservation of the energy flux (Green's law) for the height, both from the dispersion \
         relation by bisection. The phase is compared with an integration of the wave number in ten thousand steps. Over \
         straight contours the marched equation is that theory, so that the deviations are those of rounding and of the \
         table of the dispersion relation.",
        BEACH.depth_m, BEACH.end_m
    ));
    let x = Axis::linear("depth, m", 0.0, BEACH.depth_m);
    let mut height =
        Figure::new("Shoaling", x.clone(), Axis::linear("height / height in 10 m", 0.8, 1.5), LegendCorner::UpperRight);
    let mut direction = Figure::new(
        "Refraction",
        x,
        Axis::linear("direction from shoreward, °", -60.0, 60.0),
        LegendCorner::LowerRight,
    );
    let mut rows = Vec::new();
    for (colour, (period_s, direction_deg)) in BEACH_WAVES.into_iter().enumerate() {
        let beach = plane::plane_beach(&BEACH, period_s, direction_deg);
        let middle = &beach.rows[1];
        let line = |of: fn(&BeachPoint) -> f64| SeriesData::Line(middle.iter().map(|p| [p.depth_m, of(p)]).collect());
        let circles = |of: fn(&BeachPoint) -> f64| {
            SeriesData::Points(middle.iter().step_by(EVERY).map(|p| [p.depth_m, of(p), 0.0]).collect())
        };
        let label = format!("{period_s:.0} s, {direction_deg:.0}°");
        height = height
            .with_series(FigureSeries::new(&label, colour, line(|p| p.expected_height)))
            .with_series(FigureSeries::new("", colour, circles(|p| p.height)));
        direction = direction
            .with_series(FigureSeries::new(&label, colour, line(|p| p.expected_direction_deg)))
            .with_series(FigureSeries::new("", colour, circles(|p| p.direction_deg)));
        let largest = |of: fn(&BeachPoint) -> f64| beach.rows.iter().flatten().map(of).fold(0.0, f64::max);
        rows.push(vec![
            format_number(period_s, 0),
            format_number(direction_deg, 0),
            format!("{:.0e}", largest(|p| (p.height / p.expected_height - 1.0).abs())),
            format!("{:.0e}", largest(|p| (p.direction_deg - p.expected_direction_deg).abs())),
            format!("{:.0e}", largest(|p| (p.flux - 1.0).abs())),
            format!("{:.0e}", beach.phase_error_rad.abs()),
        ]);
    }
    page.figures(
        &[("coast-shoaling".to_owned(), height), ("coast-refraction".to_owned(), direction)],
        "Height and direction of waves over a plane beach against the depth: theory (lines) and the parabolic solution \
         (circles).",
    )?;
    page.table(
        "period, s | direction in 10 m, ° | largest relative deviation of the height | of the direction, ° | relative, of the \
         energy flux | of the phase, rad",
        &rows,
    );
    let last = plane::plane_beach(&SWAN_BEACH, 10.0, 30.0).rows[1].last().copied().ok_or("a beach without points")?;
    page.paragraph(&format!(
        "SWAN's test A11 (refraction and shoaling alone) sends the wave of 10 s and 30°, 1 m high, from {:.0} m of depth up \
         a slope of 1:{:.0}. The table that comes with the test ends in 0.2 m of depth:",
        SWAN_BEACH.depth_m,
        1.0 / SWAN_BEACH.slope
    ));
    let cell = |value: f64| format_number(value, 3);
    page.table(
        "in 0.2 m of depth | SWAN 41.10 | theory | parabolic",
        &[
            vec!["height, m".into(), cell(SWAN_HS_M), cell(last.expected_height), cell(last.height)],
            vec!["direction, °".into(), "–".into(), cell(last.expected_direction_deg), cell(last.direction_deg)],
        ],
    );
    Ok(())
}

/// Adds the section on the surf zone.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn add_surf(page: &mut MarkdownPage) -> Result<(), String> {
    page.heading(3, "Surf zone");
    page.paragraph(
        "Seas of a narrow spectrum that come straight to plane beaches and break. Theory integrates the energy balance \
         of Battjes and Janssen (1978), d(Cg m0)/dx = -f Q Hm² / 4 with γ = 0.73, by a Runge-Kutta method in steps of \
         2 cm, and finds the fraction Q of breaking waves by bisection. Measurements of a laboratory beach could not be \
         had.",
    );
    let x = Axis::linear("depth, m", 0.0, 5.0);
    let y = Axis::linear("significant wave height Hs, m", 0.0, 2.5);
    let mut figure = Figure::new("Surf", x, y, LegendCorner::UpperLeft);
    let mut rows = Vec::new();
    for (colour, (hs_m, period_s, slope)) in SURF_ZONES.into_iter().enumerate() {
        let points = plane::surf(hs_m, period_s, slope);
        let inner = || points.iter().filter(|p| p.depth_m < 5.0);
        let every = (inner().count() / 24).max(1);
        let line = SeriesData::Line(inner().map(|p| [p.depth_m, p.expected_hs_m]).collect());
        let circles = SeriesData::Points(inner().step_by(every).map(|p| [p.depth_m, p.hs_m, 0.0]).collect());
        let label = format!("{hs_m} m, {period_s:.0} s, 1:{:.0}", 1.0 / slope);
        figure = figure
            .with_series(FigureSeries::new(&label, colour, line))
            .with_series(FigureSeries::new("", colour, circles));
        let largest = points.iter().map(|p| (p.hs_m / p.expected_hs_m - 1.0).abs()).fold(0.0, f64::max);
        let last = points.last().ok_or("a surf zone without points")?;
        rows.push(vec![
            format_number(hs_m, 1),
            format_number(period_s, 0),
            format!("1:{:.0}", 1.0 / slope),
            format_number(last.depth_m, 2),
            format_number(last.expected_hs_m, 3),
            format_number(last.hs_m, 3),
            format_number(last.breaking_fraction, 2),
            format!("{:.2} %", 100.0 * largest),
        ]);
    }
    page.figure(
        "coast-surf",
        &figure,
        "Significant wave height across the surf zone: direct integration (lines) and the marched components (circles).",
    )?;
    page.table(
        "Hs in 10 m, m | period, s | slope | last depth, m | Hs there, theory, m | solved, m | breaking there | largest \
         deviation",
        &rows,
    );
    Ok(())
}
