//! `seastate validate --all`: every spectrum with every spreading over thirteen sea states, measured on the GPU.

use super::lab::Lab;
use super::page::{Page, deviation, measured, number, turned};
use super::words;
use crate::gpu::Gpu;
use crate::lab::stats::Estimate;

/// Wind (m/s), fetch (km), depth (m): from calm to hurricane, from deep water to 3 m.
pub const STATES: [(f64, f64, f64); 13] = [
    (1.5, 2.0, 4000.0),
    (3.0, 10.0, 4000.0),
    (5.0, 20.0, 100.0),
    (7.0, 50.0, 30.0),
    (10.0, 100.0, 4000.0),
    (10.0, 100.0, 20.0),
    (10.0, 100.0, 5.0),
    (10.0, 300.0, 3.0),
    (15.0, 300.0, 4000.0),
    (20.0, 500.0, 50.0),
    (25.0, 50.0, 10.0),
    (32.0, 1000.0, 4000.0),
    (45.0, 800.0, 200.0),
];

/// The page of all seas whose state contains `only`.
///
/// # Errors
/// If none does, or the GPU does not give its memory back.
pub fn build(gpu: &Gpu, seeds: u32, only: &str) -> Result<Page, String> {
    let lab = Lab { gpu: Some(gpu), seeds };
    let mut rows = Vec::new();
    let mut far = Vec::new();
    let mut errors = Vec::new();
    for (spectrum, spread) in
        words("spectrum").into_iter().flat_map(|a| words("spread").into_iter().map(move |b| (a, b)))
    {
        for (wind, fetch, depth) in STATES {
            let state = format!("spectrum={spectrum}&spread={spread}&wind={wind}&fetch={fetch}&depth={depth}&n=128");
            if !state.contains(only) {
                continue;
            }
            let sea = lab.sea(&state, 0, &|_| None)?;
            let r = &sea.resolved;
            let mut cells = vec![format!("`{state}`"), number(sea.theory.hs_m, 3), number(r.hs_m, 3)];
            let mut compare = |seen: Option<Estimate>, expected: f64, digits: usize, expects: bool| {
                if expects {
                    cells.push(number(expected, digits));
                }
                cells.push(measured(seen.as_ref(), digits));
                cells.push(deviation(seen.as_ref(), expected));
                if let Some(Estimate { value, error: Some(error) }) = seen {
                    errors.push((value - expected) / error);
                    if (value - expected).abs() > 4.0 * error {
                        far.push(format!("`{state}`: {value:.5} ± {error:.5} against {expected:.5}"));
                    }
                }
            };
            compare(sea.get(|m| m.hs_m), r.hs_m, 3, false);
            compare(sea.get(|m| m.tm02_s), r.tm02_s, 3, true);
            compare(sea.get(|m| m.mss), r.mss, 5, true);
            compare(sea.get(|m| m.spread_deg), r.spread_deg, 2, true);
            let from = sea.measured.as_ref().and_then(|m| m.from_deg);
            let directed = r.mean_from_deg.is_some();
            cells.push(if directed { measured(from.as_ref(), 2) } else { "none".into() });
            cells.push(if directed {
                turned(from.as_ref(), r.mean_from_deg.unwrap_or_default())
            } else {
                "none".into()
            });
            rows.push(cells);
        }
    }
    if rows.is_empty() {
        return Err(format!("no state contains '{only}'"));
    }
    let mut page = Page::default();
    page.heading(1, "Validation: every spectrum with every spreading");
    page.prose(&format!(
        "`seastate validate --all`: {} seas over {seeds} seeds each. Of {} comparisons of measured with resolved numbers, \
         {} lie beyond 2 standard errors, {} beyond 3 and {} beyond 4; their root mean square is {:.2} standard errors. With \
         few seeds the standard errors are themselves uncertain, and these shares are larger than a Gaussian's.",
        rows.len(),
        errors.len(),
        beyond(&errors, 2.0),
        beyond(&errors, 3.0),
        beyond(&errors, 4.0),
        (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt(),
    ));
    for line in &far {
        page.prose(&format!("Beyond 4: {line}"));
    }
    let head = [
        "sea",
        "Hs, theory",
        "resolved",
        "measured",
        "deviation",
        "Tm02, resolved",
        "measured",
        "deviation",
        "mss, resolved",
        "measured",
        "deviation",
        "spread, resolved",
        "measured",
        "deviation",
        "from 240°, measured",
        "deviation",
    ];
    page.table(&head, &rows);
    Ok(page)
}

fn beyond(errors: &[f64], limit: f64) -> usize {
    errors.iter().filter(|e| e.abs() > limit).count()
}
