//! Each GPU pass against its f64 twin, for every FFT size and several seas, and that planted faults are found.

use seastate::cli::check::{self, Line};
use seastate::gpu::device::Gpu;
use seastate::gpu::shaders::Shaders;
use seastate::model::query;

fn run(state: &str, shaders: &Shaders) -> Vec<Line> {
    pollster::block_on(async {
        let gpu = Gpu::request().await.expect("a GPU adapter; install mesa-vulkan-drivers");
        check::run(&gpu, &query::parse(state).0, shaders).await.expect("read-back")
    })
}

fn assert_right(state: &str) {
    let lines = run(state, &Shaders::default());
    let table: Vec<String> = lines.iter().map(ToString::to_string).collect();
    eprintln!("{state}\n{}", table.join("\n"));
    assert!(lines.iter().all(Line::passes), "{state}\n{}", table.join("\n"));
}

#[test]
fn every_size_agrees_with_the_oracle() {
    for n in [64, 128, 256] {
        assert_right(&format!("wind=10&fetch=100&t=20&n={n}"));
    }
}

#[test]
fn large_sizes_agree_with_the_oracle() {
    for n in [512, 1024] {
        assert_right(&format!("wind=10&fetch=100&t=20&n={n}&cascades=1"));
    }
}

#[test]
fn other_seas_agree_with_the_oracle() {
    for state in [
        "spectrum=tma&depth=5&wind=15&t=3600&swell=0.5",
        "spread=hasselmann&wind=25&fetch=800&t=100000.25&dir=13",
        "spread=mitsuyasu&swell=1&loop=60&t=59.9&chop=0.7",
        "spread=isotropic&spectrum=pm&wind=3&g=3.71",
        "spectrum=elfouhaily&spread=elfouhaily&swell=0.4&dispersion=capillary&cascades=3&patch3=0.7&chopx=0.5&chopz=1.3",
        "spread=cos2-positive&blendto=hasselmann&blend=0.4&iso=0.2&scale2=1&hs2=2&tp2=12&dir2=310&overlap=1",
        "spectrum=measured&measured=0.05*0.5*250*251*0.8*0.5_0.1*3*240*241*0.7*0.4_0.2*1*200*230*0.5*0.2_0.4*0.1*190*190*0.4*0.1",
    ] {
        assert_right(&format!("{state}&n=64"));
    }
}

/// One fault of 1 % in each pass: where it stands, and which lines must turn red.
const FAULTS: &[(&str, &str, &str, &str)] = &[
    ("spectrum", "h = gauss * sqrt(variance)", "h = 1.01 * gauss * sqrt(variance)", "spectrum"),
    ("rows", "return forward + backward;", "return forward + 1.01 * backward;", "rows"),
    ("columns", "let value = select(v,", "let value = 1.01 * select(v,", "columns"),
    (
        "mips",
        "textureStore(moments_out, id.xy, layer, 0.25 * m)",
        "textureStore(moments_out, id.xy, layer, 0.2525 * m)",
        "mips moments",
    ),
    (
        "mips",
        "textureStore(gradients_out, id.xy, layer, 0.25 * g)",
        "textureStore(gradients_out, id.xy, layer, 0.2525 * g)",
        "mips gradients",
    ),
    ("foam", "let l = sea.chop;", "let l = 1.01 * sea.chop;", "foam"),
];

#[test]
fn a_planted_fault_of_one_per_cent_is_found() {
    let state = "wind=15&fetch=300&t=5&n=64";
    for (module, from, to, red) in FAULTS {
        let lines = run(state, &Shaders::default().patched(module, from, to));
        let found = lines.iter().filter(|l| !l.passes()).map(|l| l.what).collect::<Vec<_>>();
        assert!(found.iter().any(|what| what.starts_with(red)), "{module}: \"{to}\" went unseen: {found:?}");
    }
}
