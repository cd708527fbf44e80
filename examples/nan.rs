use seastate::model::{Plan, query, table::Table};
fn main() {
    let plan = Plan::new(&query::parse(&std::env::args().nth(1).unwrap()).0);
    println!(
        "{:?} wp {} hs {} support {:?} {:?}",
        plan.notices,
        plan.omega_p,
        plan.hs_m(),
        plan.support(),
        plan.cascades
    );
    for (i, c) in plan.cascades.iter().enumerate() {
        let t = Table::new(&plan, c);
        if let Some(p) = t.values.iter().position(|v| v.iter().any(|x| !x.is_finite())) {
            println!("cascade {i} entry {} {:?} wave {:?}", p / t.stride, t.values[p], t.waves[p / t.stride]);
        }
        let m = t.values.iter().flatten().fold(0.0f64, |a, b| a.max(b.abs()));
        println!("{m} {:?}", t.terms);
    }
    scan(&plan);
    for s in &plan.systems {
        println!("{:?} {:?}", s.spectrum.omega_p, s.spreading.lobes(s.spectrum.omega_p));
    }
}
#[allow(dead_code)]
fn scan(plan: &Plan) {
    let (a, b) = plan.support();
    for i in 0..=1600 {
        let w = a * (b / a).powf(i as f64 / 1600.0);
        for (j, s) in plan.systems.iter().enumerate() {
            let d = s.spectrum.density(w);
            if !d.is_finite() {
                println!("system {j} w {w} {d} k {}", plan.dispersion.wave_number(w));
                return;
            }
        }
        if !plan.dispersion.wave_number(w).is_finite() {
            println!("k at {w}");
            return;
        }
    }
}
