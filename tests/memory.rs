//! Hours of frames take no more memory than the first ones: a sea that runs, with a slider dragged and let go, another
//! size now and then. By hand, some minutes: `cargo test --test memory -- --ignored --nocapture`. Reads /proc, hence
//! Linux.

mod common;

use common::{gpu, params};
use seastate::ocean::still::{PICTURE_FORMAT, present_and_read_back};
use seastate::ocean::{Ocean, OutputKind};

const FRAMES: u32 = 10_000;
const WARM_UP: u32 = 2_000;
const SIZES: [[u32; 2]; 2] = [[64, 40], [48, 56]];
/// Growth after the warm-up that is allowed, of all there is: pages of the allocator.
const MOST: f64 = 0.01;

/// Resident memory of this program, bytes.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("/proc");
    let line = status.lines().find(|l| l.starts_with("VmRSS:")).expect("VmRSS");
    1024.0 * line.split_whitespace().nth(1).and_then(|kb| kb.parse::<f64>().ok()).expect("a number")
}

#[test]
#[ignore = "takes minutes"]
fn memory_is_constant_over_ten_thousand_frames() {
    let gpu = gpu();
    let mut p = params("n=64&mesh=0.1&t=20&wind=14&afloat=buoy*10*-30");
    let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &p);
    let mut seen = Vec::new();
    for i in 0..FRAMES {
        p.clock.t_s += 1.0 / 60.0;
        if i % 500 < 100 {
            p.sea.systems[0].wind_m_s = 10.0 + 0.05 * f64::from(i % 100);
        }
        let size = SIZES[(i / 250 % 2) as usize];
        ocean.transition_to(&p, 1.0 / 60.0);
        let mut encoder = gpu.encoder("test");
        ocean.record_frame(&mut encoder, size, 2);
        pollster::block_on(present_and_read_back(&gpu, encoder, size, |pass| ocean.present(pass))).expect("a picture");
        // Where it has the size and the wind of the others.
        if i % 500 == 499 {
            seen.push((i + 1, resident()));
        }
    }
    for (frame, bytes) in &seen {
        eprintln!("{frame:>6} frames: {:.2} MiB", bytes / f64::from(1 << 20));
    }
    let after = seen.iter().filter(|(frame, _)| *frame >= WARM_UP);
    let first = after.clone().next().expect("a warm-up").1;
    let most = after.map(|(_, bytes)| *bytes).fold(0.0, f64::max);
    assert!(most < first * (1.0 + MOST), "from {first} to {most} bytes");
}
