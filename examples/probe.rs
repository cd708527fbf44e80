use seastate::model::{
    Plan, query,
    table::{Table, index},
};
fn main() {
    let state = std::env::args().nth(1).unwrap();
    let plan = Plan::new(&query::parse(&state).0);
    println!("notices {:?} captured {}", plan.notices, plan.captured());
    let w = |k: f64| plan.dispersion.omega(k);
    for c in &plan.cascades {
        let t = Table::new(&plan, c);
        let half = plan.n as i32 / 2;
        let mut m0 = 0.0;
        let mut cnt = 0;
        let mut nyq = 0.0;
        for iz in -half..=half {
            for ix in -half..=half {
                let v = 4.0 * t.variance(ix, iz);
                if ix.abs() == half || iz.abs() == half {
                    nyq += v;
                    continue;
                }
                m0 += v;
                if t.waves[index(ix, iz)].k > 0.0 {
                    cnt += 1
                }
            }
        }
        let (a, b) = (w(c.k_low.max(1e-9)).max(plan.support().0), w(c.k_high));
        let n = 20000;
        let mut th = 0.0;
        for i in 0..n {
            let x = (i as f64 + 0.5) / n as f64;
            let o = a * (b / a).powf(x);
            th += plan.density(o) * o * (b / a).ln() / n as f64;
        }
        println!(
            "patch {:.1} k {:.4}..{:.4} waves {cnt} ({:.1} at low, {:.1} at high) lattice {m0:.6} theory {th:.6} ratio {:.4} nyq {nyq:.2e}",
            c.patch_m,
            c.k_low,
            c.k_high,
            c.k_low / c.dk(),
            c.k_high / c.dk(),
            m0 / th
        );
    }
}
