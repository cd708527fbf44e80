//! Heights, slopes and velocities of the sea under a moving boat, on the CPU and without a GPU.
//!
//! `cargo run --release --example boat --no-default-features`

#![expect(clippy::print_stdout, reason = "the example prints its results")]

use seastate::point::StrongestWaves;
use seastate::state::query;
use seastate::waves::Plan;

fn main() {
    let (params, _) = query::parse("wind=12&fetch=200&n=128");
    let plan = Plan::new(&params);

    // The strongest waves of the sea that the GPU draws: so many that the rms error of a height is at most 2 % of Hs.
    let heights = StrongestWaves::for_height_error(&plan, 0.02 * plan.hs_m());
    println!("Hs {:.2} m, rms error of a height {:.3} m", plan.hs_m(), heights.residual_rms_m());

    // The boat runs east at 5 m/s. Axes: +x east, +y up, -z north.
    println!("{:>6} {:>8} {:>9} {:>12} {:>12}", "t, s", "x, m", "height, m", "pitch, deg", "heave, m/s");
    let half_length_m = 3.5;
    for step in 0..20 {
        let t_s = 0.5 * f64::from(step);
        let x_m = 5.0 * t_s;
        let middle = heights.sample(x_m, 0.0, t_s);
        let bow = heights.sample(x_m + half_length_m, 0.0, t_s);
        let stern = heights.sample(x_m - half_length_m, 0.0, t_s);
        let pitch = ((bow.height_m - stern.height_m) / (2.0 * half_length_m)).atan().to_degrees();
        println!("{t_s:6.1} {x_m:8.1} {:9.2} {pitch:12.1} {:12.2}", middle.height_m, middle.velocity_m_s[1]);
    }
}
