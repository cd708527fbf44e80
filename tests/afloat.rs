//! What the water shows of floating objects: their mirror image, where geometry puts it, and nothing of those that are
//! out of sight.

mod common;

use common::wgsl::{self, Kernel};
use common::{Pictures, gpu, params};
use seastate::gpu::Gpu;
use seastate::ocean::still::PICTURE_FORMAT;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render::{self, HullImages, MaterialUniform};
use wgpu::BufferUsages;

const SIZE: [u32; 2] = [320, 200];

/// Columns and rows of the pixels that differ between two pictures by more than `least` in any channel.
fn differing(a: &[[u8; 4]], b: &[[u8; 4]], least: u8) -> Vec<[u32; 2]> {
    let differs = |i: usize| (0..3).any(|c| a[i][c].abs_diff(b[i][c]) > least);
    (0..a.len()).filter(|i| differs(*i)).map(|i| [i as u32 % SIZE[0], i as u32 / SIZE[0]]).collect()
}

/// Calls `hull_image_mirrored` of the water's module for points of a mirror-flat sea that an eye above the origin sees,
/// and `hull_image_sunlight`. What the water mirrors besides is 1, and the hulls are black.
const ASK: &str = "
fn answer(question: Question) -> Answer {
  let place = vec3f(question[0].x, 0.0, question[0].y);
  let to_eye = vec3f(-place.x, question[0].z, -place.z);
  let mirror = WaterMirror(vec3f(1.0), 0.0);
  let seen = hull_image_mirrored(mirror, place, normalize(to_eye), length(to_eye), WaterSlope());
  return Answer(vec4f(1.0 - seen.radiance.x, hull_image_sunlight(place, 0.01), 0.0, 0.0));
}";

/// [`ASK`] with the floating objects of a state.
fn asked(gpu: &Gpu, state: &str) -> Kernel<1, 1> {
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, &params(state));
    // The objects have places once a frame was recorded.
    ocean.record_frame_with_complete_foam(&mut gpu.encoder("test"), [16, 16]);
    let scene = ocean.scene([4096, 4096]);
    let frame = render::frame_uniform(&scene, ocean.maps(), [4096, 4096]);
    let mut kernel = Kernel::<1, 1>::new(gpu, &wgsl::shaders(), "water/light", ASK);
    let uniform = |bytes: &[u8]| wgsl::buffer(gpu, bytes, BufferUsages::UNIFORM);
    let [frame, sky, light, material, hulls] = [
        uniform(bytemuck::bytes_of(&frame)),
        uniform(&[0; 512]),
        uniform(&[0; 512]),
        uniform(bytemuck::bytes_of(&MaterialUniform::new(&scene))),
        uniform(bytemuck::bytes_of(&HullImages::new(&scene))),
    ];
    kernel.bind(
        0,
        &[
            (0, frame.as_entire_binding()),
            (1, sky.as_entire_binding()),
            (2, light.as_entire_binding()),
            (9, material.as_entire_binding()),
            (14, hulls.as_entire_binding()),
        ],
    );
    kernel
}

/// The image of a point at the height h in the water is as deep below the water as the point is above it.
#[test]
fn a_flat_sea_mirrors_a_buoy_upside_down() {
    let (gpu, eye_m, far_m) = (gpu(), 3.0, 11.0);
    let kernel = asked(&gpu, "wind=0&n=64&y=3&heading=0&x=70&z=-30&afloat=buoy*70*-41");
    // The part of the buoy in the mirror image of a point with this height, this far to the side of the buoy's axis.
    let cover = |points: &[[f64; 2]]| -> Vec<f64> {
        let questions: Vec<_> = points
            .iter()
            .map(|[height_m, side_m]| {
                let share = eye_m / (eye_m + height_m);
                [[(share * side_m) as f32, (-share * far_m) as f32, eye_m as f32, 0.0]]
            })
            .collect();
        kernel.ask(&questions).iter().map(|answer| answer[0][0]).collect()
    };
    // The near edge of the lantern ends at 2.74 m, which covers 0.08 m of what lies behind; half way up, the tower has a radius of 0.16 m; the float has one of 0.95 m.
    let inside = cover(&[[2.7, 0.0], [2.6, 0.1], [1.5, 0.13], [1.5, -0.13], [0.3, 0.9], [0.3, -0.9]]);
    let outside = cover(&[[2.86, 0.0], [2.6, 0.2], [1.5, 0.2], [1.5, -0.2], [0.3, 1.02], [0.3, -1.02], [4.0, 0.0]]);
    assert!(inside.iter().all(|c| *c > 0.9) && outside.iter().all(|c| *c < 0.1), "{inside:?} {outside:?}");
}

/// A yacht that heels shades the water on the side away from the sun as far as its rail is high, the water on the side of
/// the sun not at all, and nowhere takes more sunlight than there is.
#[test]
fn a_yacht_shades_the_water_behind_it() {
    let gpu = gpu();
    // The wind blows from 50 degrees to the left of the yacht's bow, so that it sails to the north, with the sun at 45
    // degrees on its port side.
    let kernel = asked(&gpu, "wind=9&hs=0.01&n=64&y=3&dir=310&sun=45&sunaz=270&x=0&z=30&afloat=yacht*0*0");
    let at = |places: &[[f64; 2]]| -> Vec<f64> {
        let questions: Vec<_> = places.iter().map(|[x, z]| [[*x as f32, (*z - 30.0) as f32, 3.0, 0.0]]).collect();
        kernel.ask(&questions).iter().map(|answer| answer[0][1]).collect()
    };
    let around: Vec<_> =
        (-40..=40).flat_map(|x| (-40..=40).map(move |z| [f64::from(x) * 0.25, f64::from(z) * 0.25])).collect();
    let least = at(&around).into_iter().fold(1.0, f64::min);
    let sunny = at(&[[-2.6, 0.0], [-3.5, 2.0], [-3.5, -2.0], [-6.0, 0.0], [-4.0, 5.0]]);
    let shaded = at(&[[2.0, 0.0], [2.0, 1.0], [2.0, -1.0]]);
    let astern = at(&[[0.0, 8.0], [0.0, -8.0], [1.0, 8.0]]);
    eprintln!("least {least:.3}, on the sun's side {sunny:.2?}, behind {shaded:.2?}, astern {astern:.2?}");
    assert!(least >= 0.0, "{least}");
    assert!(sunny.iter().all(|s| *s > 0.97) && shaded.iter().all(|s| *s < 0.1), "{sunny:?} {shaded:?}");
    assert!(astern.iter().all(|s| *s > 0.9), "{astern:?}");
}

#[test]
fn what_floats_out_of_sight_changes_nothing() {
    let mut pictures = Pictures::default();
    let state = "wind=9&n=64&t=20&sun=25&sunaz=10&heading=0";
    let empty = pictures.render(&params(state), SIZE);
    let behind = pictures.render(&params(&format!("{state}&afloat=yacht*0*400_buoy*20*300")), SIZE);
    assert_eq!(differing(&empty, &behind, 1), Vec::<[u32; 2]>::new());
}

/// Against the sun, a yacht shades the glitter between it and the camera.
#[test]
fn a_yacht_shades_the_glitter() {
    let mut pictures = Pictures::default();
    let state = "wind=7&n=64&t=20&sun=12&sunaz=0&heading=0&pitch=-6&y=4&foam=0&bloom=0&exposure=-3";
    let mean = |pixels: &[[u8; 4]]| {
        let [x, y] = [SIZE[0] / 2 - 8, SIZE[1] / 2];
        let glitter = (0..16 * 60).map(|i| pixels[((y + i / 16) * SIZE[0] + x + i % 16) as usize][1]);
        glitter.map(f64::from).sum::<f64>() / (16.0 * 60.0)
    };
    let empty = mean(&pictures.render(&params(state), SIZE));
    let shaded = mean(&pictures.render(&params(&format!("{state}&afloat=yacht*0*-45")), SIZE));
    assert!(shaded < 0.85 * empty, "{shaded}, without the yacht {empty}");
}

/// Stripes of paint are edges without a step in distance. They are smoothed as outlines are: the picture is nearer to the
/// mean of 16 samples a pixel than one of these samples is.
#[test]
fn stripes_on_a_hull_are_smooth() {
    const FINER: u32 = 4;
    let mut pictures = Pictures::default();
    let state = "wind=9&hs=0.01&n=64&y=2&dir=310&sun=40&sunaz=110&x=18&heading=270&fov=40&foam=0&afloat=yacht*0*0";
    let linear = |p: [u8; 4]| [0, 1, 2].map(|c| (f64::from(p[c]) / 255.0).powf(2.2));
    let picture = pictures.render(&params(state), SIZE);
    let fine = pictures.render(&params(state), SIZE.map(|n| FINER * n));
    let mut squares = [0.0; 2];
    // The side of the hull, within its outline.
    for (x, y) in (104..112).flat_map(|y| (90..230).map(move |x| (x, y))) {
        let sample = |i: u32, j: u32| linear(fine[((FINER * y + j) * FINER * SIZE[0] + FINER * x + i) as usize]);
        let samples = (0..FINER * FINER).map(|i| sample(i % FINER, i / FINER));
        let sum = samples.fold([0.0; 3], |sum: [f64; 3], s| std::array::from_fn(|c| sum[c] + s[c]));
        let shown = [linear(picture[(y * SIZE[0] + x) as usize]), sample(FINER / 2, FINER / 2)];
        for (square, shown) in squares.iter_mut().zip(shown) {
            *square += (0..3).map(|c| (shown[c] - sum[c] / f64::from(FINER * FINER)).powi(2)).sum::<f64>();
        }
    }
    let [smoothed, sampled] = squares.map(f64::sqrt);
    eprintln!("error of the picture {smoothed:.2}, of one sample {sampled:.2}");
    assert!(smoothed < 0.85 * sampled, "{smoothed} {sampled}");
}
