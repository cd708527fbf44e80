//! `seastate bench`: formats the measured times as JSON.

use crate::bench::budget::GPU_CLASSES;
use crate::bench::{BenchReport, PassTiming};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Width and height, in pixels, of the pictures that `seastate bench --matrix` measures.
pub const MATRIX_PICTURE_SIZES_PX: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];

/// Converts a benchmark report to JSON.
pub fn report_json(report: &BenchReport) -> Value {
    let ceilings = &report.peak_rates;
    json!({
        "state": report.state, "adapter": report.adapter, "timestamps": report.has_timestamps,
        "submissions": report.submissions_per_measurement,
        "copy_gb_s": ceilings.copy_gb_s, "launch_ms": ceilings.empty_dispatch_ms,
        "shading_gflop_s": ceilings.shading_gflop_s,
        "reads_g_s": ceilings.giga_texture_reads_per_s,
        "passes": report.rows.iter().map(pass_json).collect::<Vec<_>>(), "comparisons": report.comparisons(),
        "budgets": report.budgets().into_iter().map(budget_json).collect::<Vec<_>>(),
    })
}

fn budget_json((size, times): ([u32; 2], [(&'static str, f64); GPU_CLASSES.len()])) -> Value {
    json!({ "size": size, "predicted_ms": BTreeMap::from(times) })
}

fn pass_json(row: &PassTiming) -> Value {
    let t = &row.timing;
    json!({
        "pass": row.pass, "n": row.fft_size_and_cascades.map(|s| s[0]),
        "cascades": row.fft_size_and_cascades.map(|s| s[1]), "size": row.picture_size,
        "gpu_ms": t.gpu_ms, "least_ms": t.min_wall_ms, "p10_ms": t.wall_percentiles_ms[0],
        "median_ms": t.wall_percentiles_ms[1], "p90_ms": t.wall_percentiles_ms[2],
        "least_cpu_ms": t.cpu_ms, "bytes": row.cost.map(|c| c.bytes), "flops": row.cost.map(|c| c.flops),
        "reads": row.cost.map(|c| c.reads),
        "dispatches": row.dispatches,
    })
}
