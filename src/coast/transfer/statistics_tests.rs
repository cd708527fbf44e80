use super::*;
use crate::coast::open_sea::edge_depth_m;
use crate::coast::placed::{PlacedCoast, PlacingOptions};
use crate::coast::transfer::{TransferLimits, TransferSolver};
use crate::coast::{BuiltInCoast, Losses};
use crate::state::query;

fn plan(state: &str) -> Plan {
    Plan::new(&query::parse(state).0)
}

fn statistics(plan: &Plan, coast: &PlacedCoast, limits: &TransferLimits) -> TransferStatistics {
    let transfer = Arc::new(TransferSolver::new(plan, coast, limits).finish());
    StatisticsSolver::new(transfer, plan).expect("the same lattice").finish()
}

fn flat() -> PlacedCoast {
    PlacedCoast {
        title: "flat".into(),
        built_in: None,
        about: "A flat bed.".into(),
        bathymetry: Bathymetry::from_fn(61, 61, 20.0, |_, _| 20.0),
        structures: Vec::new(),
        toward_deg: 50.0,
        middle_m: [123.0, -45.0],
        notices: Vec::new(),
    }
}

#[test]
fn measure() {
    for coast in &crate::coast::built_in::BUILT_IN {
        let placed = PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("a place");
        let depth_m = edge_depth_m(&placed);
        let from = (placed.toward_deg + 180.0) % 360.0;
        let sea = plan(&format!("depth={depth_m:.1}&hs=1.5&tp=9&dir={from}&n=128"));
        let now = std::time::Instant::now();
        let transfer = Arc::new(TransferSolver::new(&sea, &placed, &TransferLimits::default()).finish());
        let solved_s = now.elapsed().as_secs_f64();
        let now = std::time::Instant::now();
        let solver = StatisticsSolver::new(transfer.clone(), &sea).expect("the same lattice");
        let prepared_s = now.elapsed().as_secs_f64();
        let now = std::time::Instant::now();
        let found = solver.finish();
        let took_s = now.elapsed().as_secs_f64();
        let cascade = &sea.cascades[0];
        let table = SpectrumTable::new(&sea, cascade);
        let m0: f64 = found.sea.bands.iter().map(|b| b.open_m2).sum();
        let sum = |f: &dyn Fn([i32; 2]) -> f64| transfer.waves.iter().map(|w| f(w.lattice_index)).sum::<f64>() / m0;
        let plain = sum(&|[ix, iz]| 4.0 * table.variance(ix, iz));
        let drawn = sum(&|[ix, iz]| {
            let [a, b] = initial_amplitude(&sea, cascade, &table, ix, iz);
            2.0 * (a * a + b * b)
        });
        let hs: Vec<f64> = [0.1, 0.5, 0.8]
            .iter()
            .map(|x| {
                f64::from(
                    found.maps.hs_m[transfer.rows / 2 * transfer.columns + (x * transfer.columns as f64) as usize],
                )
            })
            .collect();
        eprintln!(
            "{}: solve {solved_s:.2} s, prepare {prepared_s:.3}, maps {took_s:.3}; {} waves; of m0 plain {plain:.3} expected {:.3} drawn {drawn:.3}; open {:.3} hs {hs:?} bands {}",
            coast.name,
            transfer.waves.len(),
            found.held_share(),
            found.open_hs_m(),
            found.sea.bands.len()
        );
    }
}
