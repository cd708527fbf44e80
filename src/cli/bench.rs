//! `seastate bench`: formats the measured times as JSON.

use crate::bench::{BenchReport, PassTiming};
use serde_json::{Value, json};

/// Width and height, in pixels, of the pictures that `seastate bench --matrix` measures.
pub const MATRIX_SIZES: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];

/// Converts a benchmark report to JSON.
pub fn report_json(report: &BenchReport) -> Value {
    let ceilings = &report.ceilings;
    json!({
        "state": report.state, "adapter": report.adapter, "timestamps": report.has_stamps, "submissions": report.repeat,
        "copy_gb_s": ceilings.copy_gb_s, "launch_ms": ceilings.launch_ms, "shading_gflop_s": ceilings.shading_gflop_s,
        "reads_g_s": ceilings.reads_g_s,
        "passes": report.rows.iter().map(pass_json).collect::<Vec<_>>(), "comparisons": report.comparisons(),
    })
}

fn pass_json(row: &PassTiming) -> Value {
    let t = &row.timing;
    json!({
        "pass": row.pass, "n": row.sea.map(|s| s[0]), "cascades": row.sea.map(|s| s[1]), "size": row.size,
        "gpu_ms": t.gpu, "least_ms": t.least, "p10_ms": t.spread[0], "median_ms": t.spread[1], "p90_ms": t.spread[2],
        "least_cpu_ms": t.cpu, "bytes": row.cost.map(|c| c.bytes), "flops": row.cost.map(|c| c.flops),
        "dispatches": row.dispatches,
    })
}
