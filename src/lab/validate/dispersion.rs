//! Part 3 of the validation page: the phase speed of single waves.

use super::cells::{PENDING_CELL, format_number};
use super::measurement::{MeasurementSetup, lattice_waves, parse_params};
use crate::lab::ensemble::fourier_transform_of_heights;
use crate::lab::figure::{Axis, Figure, FigureSeries, LegendCorner, SeriesData, sample_curve};
use crate::lab::page::MarkdownPage;
use crate::waves::Plan;
use std::f64::consts::TAU;

/// The seas whose phase speeds are measured: name in the table and label in the figure of part 3, with the state string
/// between them. No wave runs against the wind, so that each Fourier coefficient of a map belongs to one wave.
const MEASURED_SEAS: [(&str, &str, &str); 6] = [
    ("deep", "dispersion=deep&wind=12&fetch=300", "deep"),
    ("2 m", "depth=2&wind=12&fetch=300", "2 m of water"),
    ("5 m", "depth=5&wind=12&fetch=300", "5 m of water"),
    ("20 m", "depth=20&wind=12&fetch=300", "20 m of water"),
    ("100 m", "depth=100&wind=20&fetch=500", "100 m of water"),
    (
        "capillary",
        "dispersion=capillary&spectrum=elfouhaily&wind=8&fetch=50&cascades=4&patch3=1.5&patch4=0.2",
        "with surface tension",
    ),
];
const COMMON_STATE_STRING: &str = "spread=cos2-positive&dir=270&n=128&seed=1";
/// Smallest amplitude of a wave whose phase speed is measured, relative to the largest amplitude in its cascade. f32
/// rounding disturbs weaker waves.
const MIN_AMPLITUDE_FRACTION: f64 = 5e-3;
/// Phase advance of a cascade's wave of highest frequency between two read-backs, rad: below 2 pi, so unambiguous.
const MAX_PHASE_ADVANCE_RAD: f64 = 2.5;
/// Number of wave-number bins per decade. The figure of phase speeds shows the strongest measured wave of each bin.
const WAVE_NUMBER_BINS_PER_DECADE: f64 = 8.0;

/// A measured wave: wave number (rad/m), phase speed (m/s), and amplitude relative to the largest in its cascade.
type MeasuredWave = [f64; 3];

/// Measures the phase speeds of a plan's waves that travel within 60 degrees of downwind. The phase advance of a wave's
/// Fourier coefficient between two times gives its phase speed. `None` without a GPU.
fn measured_phase_speeds(lab: &MeasurementSetup<'_>, plan: &Plan) -> Result<Option<Vec<MeasuredWave>>, String> {
    // The clock counts ticks of 2^-32 periods, so it represents multiples of a tick exactly.
    let tick = plan.repeat_period_s / 4_294_967_296.0;
    let mut all = Vec::new();
    let n = plan.n as usize;
    for (c, cascade) in plan.cascades.iter().enumerate() {
        let ticks = (MAX_PHASE_ADVANCE_RAD / plan.dispersion.omega(cascade.k_high) / tick).floor().max(1.0);
        let Some(maps) = lab.read_maps(plan, &[0.0, ticks * tick])? else { return Ok(None) };
        let [before, after] = [0, 1].map(|i| fourier_transform_of_heights(n, maps[i].displacement(c)));
        let mut found = Vec::new();
        for (ix, iz, k) in lattice_waves(plan, cascade) {
            // Only waves within 60 degrees of the wind count. The wind blows towards +x.
            if f64::from(ix) * cascade.dk() < 0.5 * k {
                continue;
            }
            let at = iz.rem_euclid(n as i32) as usize * n + ix as usize;
            let (a, b) = (before[at], after[at]);
            // The coefficients are complex conjugates, so their phase grows with omega t.
            let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).rem_euclid(TAU);
            found.push([k, turn / (ticks * tick) / k, a[0].hypot(a[1])]);
        }
        let largest = found.iter().map(|f| f[2]).fold(0.0, f64::max);
        all.extend(found.into_iter().map(|[k, c, a]| [k, c, a / largest]).filter(|f| f[2] > MIN_AMPLITUDE_FRACTION));
    }
    Ok(Some(all))
}

/// Picks the strongest wave in each bin of the wave number. Returns points for the figure of phase speeds: wave number
/// (rad/m), phase speed (m/s) and an error bar of 0.
fn strongest_per_bin(waves: &[MeasuredWave]) -> Vec<[f64; 3]> {
    let bin = |wave: &MeasuredWave| (wave[0].log10() * WAVE_NUMBER_BINS_PER_DECADE).floor();
    let mut sorted = waves.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let strongest = |bin: &[MeasuredWave]| bin.iter().copied().reduce(|a, b| if b[2] > a[2] { b } else { a });
    sorted.chunk_by(|a, b| bin(a) == bin(b)).filter_map(strongest).map(|[k, c, _]| [k, c, 0.0]).collect()
}

/// Adds part 3 to the validation page: the phase speed of single waves.
///
/// # Errors
/// If reading back from the GPU fails, or a figure cannot be drawn.
pub fn add_part(page: &mut MarkdownPage, lab: &MeasurementSetup<'_>) -> Result<(), String> {
    let x = Axis::log("wave number k, rad/m", 0.01, 6000.0);
    let y = Axis::log("phase speed ω/k, m/s", 0.1, 40.0);
    let mut figure = Figure::new("Phase speed", x.clone(), y, LegendCorner::UpperRight);
    let mut rows = Vec::new();
    let mut points = Vec::new();
    for (i, (name, state, label)) in MEASURED_SEAS.into_iter().enumerate() {
        let plan = Plan::new(&parse_params(&format!("{state}&{COMMON_STATE_STRING}"))?);
        let speed = |k: f64| plan.dispersion.omega(k) / k;
        figure = figure.with_series(FigureSeries::new(label, i, SeriesData::Line(sample_curve(&x, 120, speed))));
        let held = plan.resolved_bands();
        let (low, high) = (plan.cascades[0].dk(), held.last().map_or(0.0, |h| h.1));
        let mut cells = vec![PENDING_CELL.to_owned(); 4];
        if let Some(waves) = measured_phase_speeds(lab, &plan)? {
            let errors: Vec<f64> = waves.iter().map(|[k, c, _]| c / speed(*k) - 1.0).collect();
            let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
            let worst = errors.iter().map(|e| e.abs()).fold(0.0, f64::max);
            let (low, high) = waves.iter().fold((f64::MAX, 0.0), |(a, b): (f64, f64), s| (a.min(s[0]), b.max(s[0])));
            cells = vec![
                waves.len().to_string(),
                format!("{low:.3} to {high:.1}"),
                format_per_cent(rms),
                format_per_cent(worst),
            ];
            points.push(FigureSeries::new("", i, SeriesData::Points(strongest_per_bin(&waves))));
        }
        let row = vec![
            name.to_owned(),
            format_number(speed(0.05), 4),
            format_number(speed(1.0), 4),
            format_number(speed(370.0), 4),
        ];
        rows.push([row, vec![format!("{low:.3} to {high:.1}")], cells].concat());
    }
    figure = points.into_iter().fold(figure, Figure::with_series);
    page.heading(2, "3. Dispersion");
    page.paragraph(
        "All waves of these seas run with the wind (`cos2-positive`). The f32 maps are transformed at two times. The \
         angle between the two coefficients of a wave is its phase advance; divided by k Δt it is the phase speed. \
         From theory, only the direction of the waves enters. The program rounds frequencies to multiples of 2π per \
         day, at most 0.01 % of the frequency of a wave of 17 s. This explains most of the worst deviations; in \
         ripples it is the f32 rounding of weak waves.",
    );
    page.figure(
        "dispersion",
        &figure,
        "Phase speed against wave number: ω² = (g k + σ/ρ k³) tanh(k h) (lines), and the strongest wave measured on \
         the GPU in each eighth of a decade (points). Theory: Airy 1845; with surface tension Kelvin 1871; σ = 0.074 \
         N/m, ρ = 1025 kg/m³.",
    )?;
    page.paragraph(
        "The table compares measured with theoretical phase speeds over all waves within 60° of the wind whose \
         amplitude is at least 1/200 of the largest in their cascade.",
    );
    page.table(
        "water | c at 0.05 rad/m, m/s | c at 1 rad/m | c at 370 rad/m | cascades hold, rad/m | waves measured \
         | from k to k, rad/m | rms deviation | worst deviation",
        &rows,
    );
    Ok(())
}

fn format_per_cent(x: f64) -> String {
    format!("{:.4} %", 100.0 * x)
}
