//! `seastate bench`: what each pass costs.

use crate::bench::{self, Options, Report, Row};
use crate::gpu::Gpu;
use crate::state::Params;
use serde_json::{Value, json};

/// Pictures of the matrix.
pub const MATRIX_SIZES: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];

/// Measures a state; the report as a table or as JSON.
///
/// # Errors
/// If there is no adapter, or waiting for it fails.
pub async fn run(params: &Params, options: &Options, as_json: bool) -> Result<String, String> {
    let gpu = Gpu::request().await?;
    let progress = |what: &str| eprintln!("seastate: measuring {what}");
    let report = bench::run(&gpu, params, options, progress).await?;
    Ok(if as_json { serde_json::to_string_pretty(&value(&report)).unwrap_or_default() } else { report.to_string() })
}

fn value(report: &Report) -> Value {
    let ceilings = &report.ceilings;
    json!({
        "state": report.state, "adapter": report.adapter, "timestamps": report.has_stamps, "submissions": report.repeat,
        "copy_gb_s": ceilings.copy_gb_s, "launch_ms": ceilings.launch_ms, "shading_gflop_s": ceilings.shading_gflop_s,
        "reads_g_s": ceilings.reads_g_s,
        "passes": report.rows.iter().map(row).collect::<Vec<_>>(), "comparisons": report.comparisons(),
    })
}

fn row(row: &Row) -> Value {
    let t = &row.timing;
    json!({
        "pass": row.pass, "n": row.sea.map(|s| s[0]), "cascades": row.sea.map(|s| s[1]), "size": row.size,
        "gpu_ms": t.gpu, "least_ms": t.least, "p10_ms": t.spread[0], "median_ms": t.spread[1], "p90_ms": t.spread[2],
        "least_cpu_ms": t.cpu, "bytes": row.cost.map(|c| c.bytes), "flops": row.cost.map(|c| c.flops),
        "dispatches": row.dispatches,
    })
}
