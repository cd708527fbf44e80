use seastate::model::{Plan, query, statistics::Theory, table::Table};
use std::time::Instant;
fn main() {
    for s in [
        "",
        "swell=0.5",
        "spectrum=tma&depth=10",
        "spectrum=elfouhaily&spread=elfouhaily",
        "scale2=1&swell=0.5&blend=0.5&blendto=cos2-positive",
        "spectrum=torsethaugen&fade=1&dispersion=capillary",
    ] {
        let p = query::parse(s).0;
        let t = Instant::now();
        let plan = Plan::new(&p);
        let a = t.elapsed();
        let t = Instant::now();
        for c in &plan.cascades {
            std::hint::black_box(Table::new(&plan, c));
        }
        let b = t.elapsed();
        let t = Instant::now();
        std::hint::black_box(Theory::new(&plan));
        let c = t.elapsed();
        println!("{s}: plan {a:?} tables {b:?} ({} cascades) theory {c:?}", plan.cascades.len());
    }
}
