//! Part 2: the seven directional spreadings.

use super::figure::{Axis, Figure, Legend, Mark, Series, curve};
use super::lab::{Lab, Sea};
use super::page::{Page, deviation, measured, number, turned};
use super::words;
use crate::lab::stats::{Travelling, estimate, ratio};
use crate::waves::quadrature::{adaptive, panels};
use crate::waves::{Plan, statistics};
use std::f64::consts::{PI, TAU};

/// The sea of this part; the first spreading is `isotropic`.
const STATE: &str = "wind=10&fetch=100&dir=240&n=256";
/// Frequencies looked at, in units of the peak, and how far their bands reach on either side.
const RATIOS: [f64; 3] = [1.0, 2.0, 4.0];
const REACH: f64 = 0.1;
/// Bins of the angle.
const ANGLES: usize = 24;

/// Angle from the system's direction of travel, rad in (-pi, pi], positive clockwise seen from above.
fn angle(plan: &Plan, unit: [f64; 2]) -> f64 {
    let [x, z] = plan.downwind;
    (x * unit[1] - z * unit[0]).atan2(x * unit[0] + z * unit[1])
}

fn middle(bin: usize) -> f64 {
    (bin as f64 + 0.5) / ANGLES as f64 * TAU - PI
}

/// Theory of one band.
struct Band {
    integral: f64,
    r1: f64,
}

/// Mean of a quantity over the band around a frequency, weighted by S.
fn band_mean(plan: &Plan, omega: f64, f: impl Fn(f64) -> f64) -> f64 {
    let ends = [(1.0 - REACH) * omega, 0.95 * omega, omega, (1.0 + REACH) * omega];
    let s = |w: f64| plan.density(w);
    panels(|w| s(w) * f(w), &ends, 1) / panels(s, &ends, 1)
}

fn theory(plan: &Plan, ratio: f64) -> Band {
    let system = &plan.systems[0];
    let omega = ratio * plan.omega_p;
    let r1 = band_mean(plan, omega, |w| system.spreading.first_moment(w));
    let knots = [-PI, -0.5 * PI, -0.5, 0.0, 0.5, 0.5 * PI, PI];
    Band { integral: adaptive(|theta| system.spreading.density(omega, theta), &knots, 1e-10), r1 }
}

fn figure(name: &str, sea: &Sea, even: &Sea) -> Figure {
    let x = Axis::linear("angle from the wind's direction, degrees", -180.0, 180.0);
    let spreading = &sea.plan.systems[0].spreading;
    let mut curves = Vec::new();
    let mut points = Vec::new();
    for (i, ratio_p) in RATIOS.into_iter().enumerate() {
        let omega = ratio_p * sea.plan.omega_p;
        let label = if ratio_p == 1.0 { "at ω_p".to_owned() } else { format!("at {ratio_p} ω_p") };
        let line = curve(&x, 240, |deg| band_mean(&sea.plan, omega, |w| spreading.density(w, deg.to_radians())));
        curves.push(Series::new(&label, i, Mark::Line(line)));
        if sea.measured.is_some() {
            points.push(Series::new("", i, Mark::Points(seen(sea, even, i))));
        }
    }
    let highest = |mark: &Series| mark.highest();
    let top = curves.iter().chain(&points).map(highest).fold(0.0, f64::max);
    let y = Axis::linear("D(θ), 1/rad", 0.0, (1.12 * top).max(0.3));
    curves.into_iter().chain(points).fold(Figure::new(name, x, y, Legend::Right), Figure::with)
}

/// Measured D over the angle bins of a band: the variance of the waves in a bin over that of the same waves in an even sea,
/// whose D is 1 / (2 pi). So it does not matter how many waves of the lattice happen to lie in a bin.
fn seen(sea: &Sea, even: &Sea, band: usize) -> Vec<[f64; 3]> {
    let point = |i: usize| {
        let at = band * ANGLES + i;
        let part: Vec<f64> = sea.bins[at].seen.iter().map(|v| v[0]).collect();
        let d = estimate(&part).scaled(1.0 / (TAU * even.bins[at].expected[0]));
        [middle(i).to_degrees(), d.value, d.error.unwrap_or(0.0)]
    };
    (0..ANGLES).map(point).collect()
}

/// Writes the part.
///
/// # Errors
/// If the GPU does not give its memory back, or a figure cannot be drawn.
pub fn write(page: &mut Page, lab: &Lab<'_>) -> Result<(), String> {
    let names = words("spread");
    let mut seas = Vec::new();
    for name in &names {
        let state = format!("spread={name}&{STATE}");
        let plan = Plan::new(&super::lab::params(&state)?);
        let sort = |wave: &Travelling| {
            let near = |ratio: &f64| (wave.omega / (ratio * plan.omega_p) - 1.0).abs() <= REACH;
            let band = RATIOS.iter().position(near)?;
            let place = (angle(&plan, wave.unit) + PI) / TAU * ANGLES as f64;
            Some(band * ANGLES + (place as usize).min(ANGLES - 1))
        };
        seas.push(lab.sea(&state, RATIOS.len() * ANGLES, &sort)?);
    }
    page.heading(2, "2. Directional spreading");
    page.prose(
        "JONSWAP, wind 10 m/s over 100 km, from 240°. Measured: the variance of the waves within 10 % of the frequency, by \
         the angle of their travel, in bins of 15°, over that of the same waves in an even sea.",
    );
    let figures: Vec<_> =
        names.iter().zip(&seas).map(|(name, sea)| (format!("spread-{name}"), figure(name, sea, &seas[0]))).collect();
    page.gallery(
        &figures,
        "Directional distribution at one, two and four times the peak frequency, averaged over the bands: theory (lines) and measured on the GPU \
         (points with standard errors). Sources: Mitsuyasu et al. 1975; Hasselmann, Dunckel and Ewing 1980; Donelan et al. \
         1985 with Banner 1990; Elfouhaily et al. 1997; docs/sea.md lists the rest.",
    )?;
    page.prose(
        "The integral of D over the circle must be 1. Spread is sqrt(2 (1 - r1)), r1 the first directional moment of the \
         band; 81.03° means no direction at all.",
    );
    let mut rows = Vec::new();
    for (name, sea) in names.iter().zip(&seas) {
        for (i, ratio_p) in RATIOS.into_iter().enumerate() {
            rows.push(row(name, sea, i, ratio_p));
        }
    }
    let head = [
        "spread",
        "ω / ω_p",
        "∫D dθ",
        "spread, theory",
        "resolved",
        "measured",
        "deviation",
        "from, theory",
        "measured",
        "deviation",
    ];
    page.table(&head, &rows);
    Ok(())
}

fn row(name: &str, sea: &Sea, band: usize, ratio_p: f64) -> Vec<String> {
    let bins = &sea.bins[band * ANGLES..][..ANGLES];
    let whole = |part: &dyn Fn(&super::lab::Bin) -> [f64; 3]| {
        bins.iter().map(part).fold([0.0; 3], |a, b| std::array::from_fn(|i| a[i] + b[i]))
    };
    let theory = theory(&sea.plan, ratio_p);
    let [m, x, z] = whole(&|b| b.expected);
    let r1 = x.hypot(z) / m;
    let is_directed = r1 > statistics::NO_DIRECTION;
    let resolved_deg = statistics::spread_deg(r1);
    let (mut spread, mut from) = (None, None);
    if sea.measured.is_some() {
        let seeds: Vec<[f64; 3]> = (0..bins[0].seen.len()).map(|seed| whole(&|b| b.seen[seed])).collect();
        let variance: Vec<f64> = seeds.iter().map(|s| s[0]).collect();
        let [x, z] = sea.plan.downwind;
        // Along the wind where there is no direction, else along the mean.
        let along: Vec<f64> = seeds.iter().map(|s| x * s[1] + z * s[2]).collect();
        let across: Vec<f64> = seeds.iter().map(|s| x * s[2] - z * s[1]).collect();
        let r1 = ratio(&along, &variance);
        let deg = statistics::spread_deg(r1.value);
        spread = Some(r1.mapped(deg, 180.0 / PI / deg.to_radians().max(1e-9)));
        let off = ratio(&across, &along).scaled(180.0 / PI);
        from = Some(off.mapped(240.0 + off.value, 1.0));
    }
    let directed = |text: String| if is_directed { text } else { "none".to_owned() };
    vec![
        name.to_owned(),
        number(ratio_p, 0),
        number(theory.integral, 6),
        number(statistics::spread_deg(theory.r1), 2),
        number(resolved_deg, 2),
        measured(spread.as_ref(), 2),
        deviation(spread.as_ref(), resolved_deg),
        directed(number(240.0, 0)),
        directed(measured(from.as_ref(), 2)),
        directed(turned(from.as_ref(), 240.0)),
    ]
}
