//! Sky, fog and film by the picture's own WGSL functions: colours of four wavelengths against spectra, fog against
//! quadrature, tone curves against their publications.

mod common;

use common::wgsl::{Kernel, ask, shaders};

type Case = [[f32; 4]; 2];

// Colours.

/// Wavelengths of the spectra, nm.
fn wavelengths() -> impl Iterator<Item = f64> {
    (0..=68).map(|i| 390.0 + 5.0 * f64::from(i))
}

/// Between the entries of a table, straight lines.
fn table(entries: &[(f64, f64)], x: f64) -> f64 {
    let i = entries.partition_point(|e| e.0 <= x).clamp(1, entries.len() - 1);
    let ((x0, y0), (x1, y1)) = (entries[i - 1], entries[i]);
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
}

/// Irradiance of the sun above the air, W/m2/nm: ASTM E-490 in steps of ten nanometres.
fn sunlight(nm: f64) -> f64 {
    const FROM_390: [f64; 35] = [
        1.20, 1.65, 1.72, 1.75, 1.60, 1.83, 2.03, 2.05, 2.02, 2.05, 1.95, 1.93, 1.92, 1.84, 1.89, 1.87, 1.86, 1.82,
        1.83, 1.83, 1.76, 1.76, 1.73, 1.70, 1.66, 1.63, 1.57, 1.55, 1.52, 1.49, 1.46, 1.43, 1.40, 1.36, 1.33,
    ];
    let entries: Vec<(f64, f64)> = FROM_390.iter().enumerate().map(|(i, y)| (390.0 + 10.0 * i as f64, *y)).collect();
    table(&entries, nm)
}

/// Optical depth of clean air at the sea, Bucholtz 1995 in the form of Hansen and Travis 1974.
fn rayleigh_depth(nm: f64) -> f64 {
    let u = (1000.0 / nm).powi(2);
    0.008_569 * u * u * (1.0 + 0.0113 * u + 0.000_13 * u * u)
}

/// Optical depth of 300 Dobson units of ozone: cross-sections in 1e-21 cm2 after Gorshelev et al. 2014.
fn ozone_depth(nm: f64) -> f64 {
    const CROSS: &[(f64, f64)] = &[
        (390.0, 0.008),
        (410.0, 0.022),
        (430.0, 0.07),
        (440.0, 0.13),
        (450.0, 0.18),
        (460.0, 0.36),
        (470.0, 0.40),
        (480.0, 0.72),
        (490.0, 0.83),
        (500.0, 1.24),
        (510.0, 1.62),
        (520.0, 1.86),
        (530.0, 2.75),
        (540.0, 2.95),
        (550.0, 3.35),
        (560.0, 3.95),
        (570.0, 4.75),
        (575.0, 4.82),
        (580.0, 4.6),
        (590.0, 4.55),
        (600.0, 5.15),
        (604.0, 5.25),
        (610.0, 4.65),
        (620.0, 4.0),
        (630.0, 3.45),
        (640.0, 2.8),
        (650.0, 2.4),
        (660.0, 2.05),
        (680.0, 1.35),
        (700.0, 0.85),
        (730.0, 0.45),
    ];
    table(CROSS, nm) * 1e-21 * 300.0 * 2.687e16
}

/// Linear sRGB of a spectrum, colour matching functions by Wyman, Sloan and Shirley 2013.
fn rgb(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let lobe = |x: f64, mean: f64, low: f64, high: f64| {
        let t = (x - mean) * if x < mean { low } else { high };
        (-0.5 * t * t).exp()
    };
    let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
    for nm in wavelengths() {
        let s = spectrum(nm);
        x += s
            * (0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323)
                - 0.065 * lobe(nm, 501.1, 0.0490, 0.0382));
        y += s * (0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322));
        z += s * (1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725));
    }
    [3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z, 0.0557 * x - 0.2040 * y + 1.0570 * z]
}

/// Skies and suns through much air and ozone: what the renderer makes of four wavelengths has the colour of the
/// spectrum.
#[test]
fn four_wavelengths_have_the_colours_of_spectra() {
    const FOUR: [f64; 4] = [630.0, 575.0, 510.0, 440.0];
    let light = |nm: f64, [a, air, ozone]: [f64; 3]| {
        (nm / 550.0).powf(-4.0 * a) * (-air * rayleigh_depth(nm) - ozone * ozone_depth(nm)).exp()
    };
    let mut skies = Vec::new();
    for a in [0.0, 1.0] {
        for air in [0.0, 1.0, 3.0, 10.0] {
            for ozone in [0.0, 1.0, 5.0, 12.0] {
                skies.push([a, air, ozone]);
            }
        }
    }
    let cases: Vec<Case> = skies.iter().map(|s| [FOUR.map(|nm| light(nm, *s) as f32), [0.0; 4]]).collect();
    let found = ask(&shaders(), "sky/background", "return vec4f(atm_linear_srgb(a), 0.0);", &cases);
    let white = rgb(sunlight);
    let mut worst = 0f64;
    for (sky, found) in skies.iter().zip(&found) {
        let exact = rgb(|nm| sunlight(nm) * light(nm, *sky));
        // The white balance of the film: the sun above the air is 19.4, 20, 20.8.
        let exact: Vec<f64> = (0..3).map(|i| exact[i] / white[i] * [19.4, 20.0, 20.8][i]).collect();
        let brightness = (exact[0] + exact[1] + exact[2]) / 3.0;
        // Colours that a screen does not have are cut off.
        let error = (0..3).map(|i| (found[i] - exact[i].max(0.0)).abs() / brightness).fold(0.0, f64::max);
        worst = worst.max(error);
    }
    eprintln!("largest error of a channel over the mean {worst:.4}");
    assert!(worst < 0.03, "{worst}");
    // The coefficients of the shader are those of these tables.
    let found = ask(
        &shaders(),
        "sky/background",
        "return select(ATM_OZONE_ABSORPTION, ATM_RAYLEIGH_SCATTERING, a.x > 0.0);",
        &[[[1.0; 4], [0.0; 4]], [[0.0; 4], [0.0; 4]]],
    );
    for i in 0..4 {
        let (rayleigh, ozone) = (rayleigh_depth(FOUR[i]) / 8.4, ozone_depth(FOUR[i]) / 15.0);
        assert!((found[0][i] / rayleigh - 1.0).abs() < 0.01, "{} {rayleigh}", found[0][i]);
        assert!((found[1][i] / ozone - 1.0).abs() < 0.02, "{} {ozone}", found[1][i]);
    }
}

// Fog.

const EARTH_M: f64 = 6_371_000.0;

/// Length of full density by quadrature in steps that resolve the fog.
fn fog_length([eye, mu, start, end]: [f64; 4], [falloff, top]: [f64; 2]) -> f64 {
    let density = |t: f64| {
        let y = eye + mu * t + t * t / (2.0 * EARTH_M);
        if y <= top { 1.0 } else { (-(y - top) / falloff).exp() }
    };
    let steps = 400_000;
    let dt = (end - start) / f64::from(steps);
    (0..steps).map(|i| density(start + (f64::from(i) + 0.5) * dt)).sum::<f64>() * dt
}

#[test]
fn fog_is_what_quadrature_gives() {
    let shaders =
        shaders().patched("sky/background", "@group(0) @binding(1) var<uniform> sky: Sky;", "var<private> sky: Sky;");
    let horizon = |eye: f64| -(2.0 * eye / EARTH_M).sqrt();
    let mut cases = Vec::new();
    for (falloff, top) in [(30.0, 20.0), (5.0, 0.0), (500.0, 100.0), (1.0, 1000.0)] {
        for eye in [2.0, 20.0, 200.0, 5000.0] {
            for (mu, end) in [
                (-0.5, 2.0 * eye),
                (-0.02, 50.0 * eye),
                (horizon(eye), -horizon(eye) * EARTH_M),
                (horizon(eye), 6e5),
                (0.0, 3e5),
                (0.01, 1e5),
                (0.6, 2e4),
                (0.0, 3.0),
            ] {
                for start in [0.0, 0.3 * end] {
                    cases.push(([eye, mu, start, end], [falloff, top]));
                }
            }
        }
    }
    let asked: Vec<Case> =
        cases.iter().map(|(ray, fog)| [ray.map(|v| v as f32), [0.0, 0.0, fog[0] as f32, fog[1] as f32]]).collect();
    let found = ask(
        &shaders,
        "sky/background",
        "sky.fog = Fog(b.x, b.y, b.z, b.w); return vec4f(fog_length(a.x, a.y, a.z, a.w));",
        &asked,
    );
    for ((ray, fog), found) in cases.iter().zip(&found) {
        let exact = fog_length(*ray, *fog);
        let error = (found[0] - exact).abs();
        // The error function is good to 0.4 %; a metre is nothing to the thickest fog.
        assert!(error < 0.012 * exact + 1.0, "{ray:?} in {fog:?}: {} for {exact}", found[0]);
    }
}

// Film.

/// Screen values (0..1) of some linear colours under a tone curve.
fn tone(curve: u32, colours: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let cases: Vec<Case> =
        colours.iter().map(|c| [[c[0] as f32, c[1] as f32, c[2] as f32, curve as f32], [0.0; 4]]).collect();
    let body = "return vec4f(tone_encoded(u32(a.w), a.xyz), 0.0);";
    ask(&shaders(), "film/tone", body, &cases).into_iter().map(|a| [a[0], a[1], a[2]]).collect()
}

fn srgb(c: f64) -> f64 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

const FILM: u32 = 0;
const AGX: u32 = 1;
const ACES: u32 = 2;
const REINHARD: u32 = 3;
const NEUTRAL: u32 = 4;
const LINEAR: u32 = 5;

#[test]
fn tone_curves_are_monotonic_and_stay_on_the_screen() {
    let greys: Vec<[f64; 3]> = (0..200).map(|i| [2f64.powf(-14.0 + 0.14 * f64::from(i)); 3]).collect();
    let colours: Vec<[f64; 3]> = (0..64)
        .map(|i| [f64::from(i % 4), f64::from(i / 4 % 4), f64::from(i / 16)].map(|v| 0.001 * 40f64.powf(v)))
        .chain([[0.0; 3], [1e30; 3], [-1.0, 0.0, 1.0], [60000.0, 0.0, 0.0]])
        .collect();
    for curve in FILM..=LINEAR {
        let shown = tone(curve, &greys);
        for pair in shown.windows(2) {
            assert!(pair[1][1] >= pair[0][1] - 1e-4, "curve {curve}: {pair:?}");
        }
        for c in &shown {
            let spread = c.iter().fold(0.0f64, |m, v| m.max((v - c[1]).abs()));
            assert!(spread < 4e-3, "curve {curve}: grey stays grey: {c:?}");
        }
        assert!(shown[0][1] < 0.02 && shown[199][1] > 0.93, "curve {curve}: {:?} to {:?}", shown[0], shown[199]);
        for c in tone(curve, &colours).iter().chain(&shown) {
            assert!(c.iter().all(|v| (0.0..=1.0).contains(v)), "curve {curve}: {c:?}");
        }
    }
}

#[test]
fn tone_curves_are_those_of_the_publications() {
    let at = |curve: u32, c: [f64; 3]| tone(curve, &[c])[0];
    let grey = |curve: u32, v: f64| at(curve, [v; 3])[1];
    let close = |what: &str, a: f64, b: f64| assert!((a - b).abs() < 2e-3, "{what}: {a}, published {b}");
    close("linear grey", grey(LINEAR, 0.18), srgb(0.18));
    close("linear white", grey(LINEAR, 1.0), 1.0);
    close("linear over white", grey(LINEAR, 3.0), 1.0);
    close("reinhard grey", grey(REINHARD, 0.18), srgb(0.18 / 1.18));
    close("reinhard one", grey(REINHARD, 1.0), srgb(0.5));
    // Hill's fit by hand: white and grey through both matrices, whose rows sum to one.
    let aces = |v: f64| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081);
    close("aces grey", grey(ACES, 0.18), srgb(aces(0.18)));
    close("aces one", grey(ACES, 1.0), srgb(aces(1.0)));
    close("aces of much light", grey(ACES, 1e5), 1.0);
    // Khronos: base colours up to 0.8 are shown as they are, less the 4 % that a dielectric mirrors.
    close("neutral grey", grey(NEUTRAL, 0.18), srgb(0.14));
    close("neutral dark", grey(NEUTRAL, 0.04), srgb(6.25 * 0.04 * 0.04));
    let red = at(NEUTRAL, [0.5, 0.1, 0.08]);
    close("neutral red", red[0], srgb(0.46));
    close("neutral red's green", red[1], srgb(0.06));
    // Peak 0.96 squeezed: 1 - 0.24^2 / (0.96 + 0.24 - 0.76).
    close("neutral one", grey(NEUTRAL, 1.0), srgb(1.0 - 0.24 * 0.24 / 0.44));
    // The film curve shows sunlit foam bright, and still tells eight times as much light from it.
    let film = |v: f64| 255.0 * grey(FILM, v);
    let shown = [film(0.18), film(1.2), film(9.6)];
    assert!(shown[0] > 110.0 && shown[0] < 125.0 && shown[1] > 215.0 && shown[2] > shown[1] + 25.0, "{shown:?}");
    // AgX: ends of its log range, and middle grey a little below the middle of the screen after the look.
    assert!(grey(AGX, 0.0) < 0.01 && grey(AGX, 16.3) > 0.97);
    let log = (0.18f64.log2() + 12.47393) / (4.026_069 + 12.47393);
    let sigmoid = 15.5 * log.powi(6) - 40.14 * log.powi(5) + 31.96 * log.powi(4) - 6.868 * log.powi(3)
        + 0.4298 * log.powi(2)
        + 0.1191 * log
        - 0.002_32;
    close("agx grey", grey(AGX, 0.18), 1.09 * sigmoid.powf(1.25));
}

/// Local exposure: what the tone pass reads between the cells is the cubic B-spline through them, and bright areas are
/// exposed less, dark ones as before.
#[test]
fn bright_areas_of_a_picture_are_exposed_less() {
    const CELLS: [u32; 2] = [16, 9];
    let gpu = common::gpu();
    let text = "fn answer(q: Question) -> Answer {
        tone_test_share = q[1].x;
        return Answer(vec4f(tone_brightness_around(q[0].xy), tone_local_gain(q[0].xy, q[0].z), 0.0, 0.0));
    }
    var<private> tone_test_share: f32;";
    let shaders = shaders().patched("film/tone", "tone.local_exposure * bright", "tone_test_share * bright");
    let mut kernel = Kernel::<2, 1>::new(&gpu, &shaders, "film/tone", text);
    let cell = |x: i64, y: i64| {
        let [x, y] = [x.clamp(0, 15), y.clamp(0, 8)];
        f64::from(half::f16::from_f64(3.0 * (1.7 * x as f64 + 0.9 * (y * y) as f64).sin()))
    };
    let texels: Vec<[half::f16; 4]> = (0..144).map(|i| [half::f16::from_f64(cell(i % 16, i / 16)); 4]).collect();
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    let map = gpu.texture("test", [CELLS[0], CELLS[1], 1], 1, wgpu::TextureFormat::Rgba16Float, usage);
    gpu.write_texture(&map, 0, bytemuck::cast_slice(&texels));
    let map = map.create_view(&wgpu::TextureViewDescriptor::default());
    let sampler = gpu.sampler("test", [wgpu::AddressMode::ClampToEdge; 2], wgpu::MipmapFilterMode::Nearest);
    kernel.bind(0, &[(3, wgpu::BindingResource::Sampler(&sampler)), (5, wgpu::BindingResource::TextureView(&map))]);
    let places: Vec<[f64; 2]> =
        (0..200).map(|i| [(f64::from(i) * 0.618).fract(), (f64::from(i) * 0.414).fract()]).collect();
    let spline = |[u, v]: [f64; 2]| {
        let weights = |f: f64| {
            let g = 1.0 - f;
            let near = |f: f64| (4.0 + 3.0 * f * f * (f - 2.0)) / 6.0;
            [g * g * g / 6.0, near(f), near(g), f * f * f / 6.0]
        };
        let [p, q] = [u * 16.0 - 0.5, v * 9.0 - 0.5];
        let [wx, wy] = [weights(p - p.floor()), weights(q - q.floor())];
        let at = |i: usize, j: usize| cell(p.floor() as i64 + i as i64 - 1, q.floor() as i64 + j as i64 - 1);
        (0..16).map(|k| wx[k % 4] * wy[k / 4] * at(k % 4, k / 4)).sum::<f64>()
    };
    for share in [0.0, 0.5, 1.0] {
        let questions: Vec<_> =
            places.iter().map(|[u, v]| [[*u as f32, *v as f32, 0.5, 0.0], [share as f32, 0.0, 0.0, 0.0]]).collect();
        for (place, found) in places.iter().zip(kernel.ask(&questions)) {
            let [around, gain, ..] = found[0];
            let expected = spline(*place);
            assert!((around - expected).abs() < 0.03, "{place:?}: {around} for {expected}");
            // Areas count as bright from an exposed luminance of 0.5, which is the exposure here.
            let over = around;
            let held = -gain.log2();
            let least = share * over.max(0.0);
            assert!((least - 1e-4..=least + share * 0.31).contains(&held), "{place:?}: {held} for {over}");
        }
    }
}

/// The sine of an elevation may exceed 1 by rounding; a NaN there would drive the exposure.
#[test]
fn airglow_is_finite_beyond_the_zenith() {
    let above = f32::from_bits(1.0f32.to_bits() + 1);
    let sines = [above, 1.0, 0.5, 0.0, -1.0];
    let cases: Vec<[[f32; 4]; 2]> = sines.iter().map(|&mu| [[mu, 0.0, 0.0, 0.0], [0.0; 4]]).collect();
    let found = ask(&shaders(), "sky/view", "return vec4f(view_night_sky_brightness(a.x), 0.0, 0.0, 0.0);", &cases);
    for (mu, found) in sines.iter().zip(found) {
        let expected = 1.0 + 1.2 * (1.0 - f64::from(mu.clamp(0.0, 1.0))).powi(3);
        assert!((found[0] - expected).abs() < 1e-6, "{mu}: {} instead of {expected}", found[0]);
    }
}

/// The dome of clouds has a column for every direction: the texture coordinate of a column's heading is the column, the
/// columns are as wide as they say, and narrowest ahead. The heading straight behind, where the columns meet, is finite.
#[test]
fn columns_of_the_dome_of_clouds_cover_all_headings() {
    const ANSWER: &str = "
        let heading = cloud_map_heading(a.x, a.yz);
        let u = cloud_map_uv(3.0 * heading.xy, 0.3, vec2f(64.0, 64.0), a.yz).x;
        return vec4f(heading, u);";
    for ahead_deg in [0.0_f64, 90.0, 210.0] {
        let ahead = [ahead_deg.to_radians().sin(), -ahead_deg.to_radians().cos()];
        let columns = 2000;
        let middle = |i: usize| (i as f64 + 0.5) / columns as f64;
        let questions: Vec<_> =
            (0..columns).map(|i| [[middle(i) as f32, ahead[0] as f32, ahead[1] as f32, 0.0], [0.0; 4]]).collect();
        let answers = ask(&shaders(), "sky/cloud_dome", ANSWER, &questions);
        // Angle clockwise from `ahead`.
        let turn = |[x, z, ..]: [f64; 4]| (ahead[0] * z - ahead[1] * x).atan2(ahead[0] * x + ahead[1] * z);
        for (i, answer) in answers.iter().enumerate() {
            assert!((answer[3] - middle(i)).abs() < 1e-6, "{ahead_deg} {i}: {answer:?}");
        }
        for (i, pair) in answers.windows(2).enumerate() {
            let width = turn(pair[1]) - turn(pair[0]);
            let said = 0.5 * (pair[0][2] + pair[1][2]) / columns as f64;
            assert!((width / said - 1.0).abs() < 2e-3, "{ahead_deg} {i}: {width} {said}");
        }
        let widths = answers.iter().map(|answer| answer[2]);
        let narrowest = widths.clone().fold(f64::INFINITY, f64::min);
        assert!((answers[columns / 2][2] / narrowest - 1.0).abs() < 1e-3);
        assert!((narrowest / (0.35 * std::f64::consts::TAU) - 1.0).abs() < 1e-3, "{narrowest}");
        assert!((widths.sum::<f64>() / columns as f64 / std::f64::consts::TAU - 1.0).abs() < 1e-3);
    }
    // Directions straight behind, or nearly, lie at either end of the dome, and the zenith has a finite place.
    let text = "let uv = cloud_map_uv(a.yz, 0.3, vec2f(64.0, 64.0), b.yz); return vec4f(uv, 0.0, 0.0);";
    let mut questions = Vec::new();
    for i in 0..600 {
        let ahead = f64::from(i % 12).to_radians() * 30.0;
        let heading = ahead + std::f64::consts::PI + [0.0, 1e-7, -1e-7, 1e-4, -1e-4][i as usize % 5];
        let length = 0.01 + 0.37 * f64::from(i);
        let of = |turn: f64, length: f64| [0.0, length * turn.sin(), -length * turn.cos(), 0.0].map(|x| x as f32);
        questions.push([of(heading, length), of(ahead, 1.0)]);
    }
    questions.push([[0.0; 4], [0.0, 0.6, 0.8, 0.0]]);
    let answers = ask(&shaders(), "sky/cloud_dome", text, &questions);
    let (above, behind) = answers.split_last().expect("answers");
    assert!((above[0] - 0.5).abs() < 1e-6, "straight up: {above:?}");
    for (question, [u, ..]) in questions.iter().zip(behind) {
        assert!((-1e-6..=1.0 + 1e-6).contains(u) && u.min(1.0 - u) < 5e-4, "{question:?}: {u}");
    }
}
