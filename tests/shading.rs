//! Light and normals of the picture: the very functions of the water's module, called by `shading.wgsl`, against exact
//! optics and geometry in f64; and that the errata of the source texts would be found.

mod common;

use common::wgsl::{self, shaders};
use glam::{DMat2, DVec2, DVec3};
use half::f16;
use seastate::gpu::Gpu;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render::{self, LandUniform, MaterialUniform, NoiseTexture, no_land_map};
use seastate::shaders::Shaders;
use seastate::state::fields::linear_rgb;
use seastate::state::look::BedLook;
use seastate::waves::slopes;
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
use wgpu::util::DeviceExt;
use wgpu::{BindingResource, BufferUsages};

/// The module that is called.
const MODULE: &str = "water/light";

/// One cascade that repeats, so that a lattice over its patch sees the whole surface; the eye's foot lies on no texel
/// of its own. tests/surface.rs knows the blend of copies.
// First order: the differences over a lattice would be wrong for bound waves, which are up to half as long as the
// shortest wave of the lattice. tests/surface.rs compares their slopes.
const STATE: &str = "wind=12&fetch=200&t=20&n=64&cascades=1&untile=0&x=123.4&z=-56.7&order=1";

/// A number that is compared.
struct Line {
    what: &'static str,
    error: f64,
    tolerance: f64,
}

impl Line {
    /// Whether the error is within the tolerance; not-a-number is not.
    fn passes(&self) -> bool {
        self.error <= self.tolerance
    }
}

fn line(what: &'static str, error: f64, tolerance: f64) -> Line {
    Line { what, error, tolerance }
}

fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    // Unlike f64::max, keeps what is not a number.
    errors.into_iter().fold(0.0, |a, b| if a.is_nan() || b <= a { a } else { b })
}

// The harness.

type Case = [[f32; 4]; 4];

/// Distributions of slopes, by the shader's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Facets {
    Gaussian,
    Ggx,
    Phong,
}

impl Facets {
    fn code(self) -> [f32; 4] {
        [self as u8 as f32, 0.0, 0.0, 0.0]
    }
}

/// Schlick's when an exponent is given.
fn fresnel_case(cosine: f64, [water, air]: [f64; 2], schlick: Option<f64>, scale: f64) -> Case {
    let kind = [f32::from(u8::from(schlick.is_some())), schlick.unwrap_or(5.0) as f32, scale as f32, 0.0];
    [[cosine as f32, 0.0, 0.0, 0.0], kind, [0.0; 4], [0.0, water as f32, air as f32, 0.0]]
}

fn seen_case(view: DVec2, mean: f64, sigma: f64, facets: Facets) -> Case {
    [[view.y as f32, view.x as f32, mean as f32, 1.0], [sigma as f32, 0.0, 0.0, 0.0], [0.0; 4], facets.code()]
}

fn mirror_case(v: DVec3, sun: DVec3, slopes: &Slopes) -> Case {
    let (v, sun, mean, cov) = (v.as_vec3(), sun.as_vec3(), slopes.mean.as_vec2(), slopes.cov.as_mat2());
    [
        v.extend(2.0).into(),
        sun.extend(cov.x_axis.y).into(),
        [mean.x, mean.y, cov.x_axis.x, cov.y_axis.y],
        slopes.facets.code(),
    ]
}

/// Light mirrored twice over that mirrored once, by facets of this mean reflectance.
fn again_case(v: DVec3, slopes: &Slopes, reflectance: f64) -> Case {
    let mut case = mirror_case(v, DVec3::X * reflectance, slopes);
    case[0][3] = 6.0;
    case
}

fn place_case(question: f32, at: DVec2, size: f64) -> Case {
    [[at.x as f32, at.y as f32, size as f32, question], [0.0; 4], [0.0; 4], [0.0; 4]]
}

/// A simulated sea, and a made-up sky.
struct Bench {
    gpu: Gpu,
    ocean: Ocean,
    frame: wgpu::Buffer,
    material: wgpu::Buffer,
    mirrored_sky: wgpu::TextureView,
    sky: wgpu::Sampler,
    noise: NoiseTexture,
    /// Stands for the uniform and the map of the land, of which there is none.
    land: (wgpu::Buffer, wgpu::TextureView),
    foot: DVec2,
}

/// The module of the picture with the kernel.
struct Kernel<'a> {
    bench: &'a Bench,
    kernel: wgsl::Kernel<4, 1>,
}

impl Bench {
    fn new() -> Self {
        let gpu = common::gpu();
        let params = common::params(STATE);
        let mut ocean = Ocean::new(&gpu, wgpu::TextureFormat::Rgba8Unorm, OutputKind::Screen, &params);
        let mut encoder = gpu.encoder("test");
        ocean.simulation().encode_with_f32_maps(&gpu, &mut encoder, params.clock.t_s);
        gpu.submit(encoder);
        let size = [320, 200];
        let mut scene = ocean.scene(size);
        // Neither ripples nor roughness beyond the maps: the slopes are those of the displaced surface.
        scene.sea.unresolved_slope_variance = [0.0; 2];
        let frame = render::frame_uniform(&scene, ocean.simulation().maps(), size);
        let frame = wgsl::buffer(&gpu, bytemuck::bytes_of(&frame), BufferUsages::UNIFORM);
        let material = MaterialUniform::new(&scene);
        let material = wgsl::buffer(&gpu, bytemuck::bytes_of(&material), BufferUsages::UNIFORM);
        let mirrored_sky = mirrored_sky(&gpu);
        let modes = [wgpu::AddressMode::Repeat, wgpu::AddressMode::ClampToEdge];
        let sky = gpu.sampler("made-up sky", modes, wgpu::MipmapFilterMode::Nearest);
        let mut noise = NoiseTexture::new(&gpu);
        noise.fill_bed_once(&gpu);
        let no_land = vec![0; size_of::<LandUniform>()];
        let land = (wgsl::buffer(&gpu, &no_land, BufferUsages::UNIFORM), no_land_map(&gpu));
        let foot = DVec2::new(params.camera.x_m, params.camera.z_m);
        Self { gpu, ocean, frame, material, mirrored_sky, sky, noise, land, foot }
    }

    fn kernel(&mut self, shaders: Shaders, part: usize) -> Kernel<'_> {
        // What the questions set must be variables.
        let shaders = shaders
            .patched(
                MODULE,
                "var<uniform> frame: Frame;",
                "var<uniform> picture_frame: Frame;\nvar<private> frame: Frame;",
            )
            .patched(
                MODULE,
                "var<uniform> material: Material;",
                "var<uniform> picture_material: Material;\nvar<private> material: Material;",
            )
            .patched(MODULE, "@group(0) @binding(2) var<uniform> light: Light;", "var<private> light: Light;");
        let shaders = ["WATER_GGX", "WATER_PHONG", "WATER_SCHLICK"].into_iter().fold(shaders, |shaders, part| {
            let constant = format!("override {part}: bool");
            shaders.patched(MODULE, &constant, &format!("var<private> {part}: bool"))
        });
        let text = format!("const PART = {part}u;\n{}", include_str!("shading.wgsl"));
        let mut kernel = wgsl::Kernel::new(&self.gpu, &shaders, MODULE, &text);
        kernel.bind(
            0,
            &[
                (0, self.frame.as_entire_binding()),
                (5, BindingResource::Sampler(&self.sky)),
                (7, BindingResource::Sampler(&self.noise.sampler)),
                (9, self.material.as_entire_binding()),
                (10, BindingResource::TextureView(&self.mirrored_sky)),
                (6, BindingResource::TextureView(&self.noise.view)),
                (13, BindingResource::TextureView(&self.land.1)),
                (15, self.land.0.as_entire_binding()),
            ],
        );
        common::bind_maps(&mut kernel, &self.gpu, self.ocean.simulation());
        Kernel { bench: self, kernel }
    }
}

impl Kernel<'_> {
    fn ask(&self, cases: &[Case]) -> Vec<[f64; 4]> {
        self.kernel.ask(cases).into_iter().map(|[answer]| answer).collect()
    }
}

/// Blue of the made-up sky: tells every direction from its mirror images.
fn sky_blue(dir: DVec3) -> f64 {
    0.5 + 0.5 * dir.dot(DVec3::new(0.4, 0.6, -0.69))
}

/// A furnace in red; blue depends on the direction. The same mapping as the table of the mirrored sky; its layers, of
/// which rougher water takes later ones, are alike.
fn mirrored_sky(gpu: &Gpu) -> wgpu::TextureView {
    const SIZE: [u32; 3] = [256, 256, 6];
    let texel = |i: u32| {
        let [x, y] = [i % SIZE[0], i / SIZE[0] % SIZE[1]];
        // A stereographic projection from the nadir, whose sides lie 1.6 from its middle.
        let p = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) * (3.2 / f64::from(SIZE[0])) - 1.6;
        let dir = DVec3::new(2.0 * p.x, 1.0 - p.length_squared(), 2.0 * p.y) / (1.0 + p.length_squared());
        [1.0, 0.0, sky_blue(dir), 1.0].map(f16::from_f64)
    };
    let texels: Vec<[f16; 4]> = (0..SIZE.iter().product()).map(texel).collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("made-up sky"),
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: SIZE[2] },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(&texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

// Optics in f64.

const INDEX: f64 = 1.333;

/// Unpolarised reflectance by Snell's law and the two polarisations; total where no angle of refraction exists.
fn dielectric(cosine: f64, index: f64) -> f64 {
    let square = 1.0 - (1.0 - cosine * cosine) / (index * index);
    if square <= 0.0 {
        return 1.0;
    }
    let inside = square.sqrt();
    let s = (cosine - index * inside) / (cosine + index * inside);
    let p = (index * cosine - inside) / (index * cosine + inside);
    0.5 * (s * s + p * p)
}

fn fresnel(cosine: f64) -> f64 {
    dielectric(cosine, INDEX)
}

/// A distribution of slopes.
#[derive(Clone, Copy, PartialEq)]
struct Slopes {
    facets: Facets,
    mean: DVec2,
    cov: DMat2,
}

impl Slopes {
    fn isotropic(sigma: f64) -> Self {
        Self { facets: Facets::Gaussian, mean: DVec2::ZERO, cov: DMat2::from_diagonal(DVec2::splat(sigma * sigma)) }
    }

    /// Steeper in one direction, which is not an axis.
    fn turned() -> Self {
        let axes = DMat2::from_diagonal(DVec2::new(0.04, 0.01));
        let cov = DMat2::from_angle(0.6) * axes * DMat2::from_angle(-0.6);
        Self { cov, ..Self::isotropic(0.1) }
    }

    /// Nodes over the slopes: the slope, and its share of them all.
    fn nodes(&self) -> impl Iterator<Item = (DVec2, f64)> {
        const RINGS: u32 = 48;
        const SPOKES: u32 = 36;
        const REACH: f64 = 5.5;
        let [xx, xz, zz] = [self.cov.x_axis.x, self.cov.x_axis.y, self.cov.y_axis.y];
        // Cholesky.
        let (a, b) = (xx.sqrt(), xz / xx.sqrt());
        let (c, mean, facets) = ((zz - b * b).sqrt(), self.mean, self.facets);
        (0..RINGS * SPOKES).map(move |i| {
            let at = (f64::from(i / SPOKES) + 0.5) / f64::from(RINGS);
            let (sin, cos) = (TAU * (f64::from(i % SPOKES) + 0.5) / f64::from(SPOKES)).sin_cos();
            let (r, share) = if facets == Facets::Ggx {
                // alpha = sqrt(2) sigma: even steps of the angle whose tangent is slope over alpha.
                let angle = 0.5 * PI * at;
                (angle.tan() * 2f64.sqrt(), angle.sin() * angle.cos() * PI)
            } else {
                let r = REACH * at;
                (r, (-0.5 * r * r).exp() * r * REACH)
            };
            let (u, w) = (r * cos, r * sin);
            let share = share / f64::from(RINGS * SPOKES);
            (mean + DVec2::new(a * u, b * u + c * w), share)
        })
    }

    fn density(&self, slope: DVec2) -> f64 {
        let off = slope - self.mean;
        let square = off.dot(self.cov.inverse() * off);
        let peak = 1.0 / (TAU * self.cov.determinant().sqrt());
        if self.facets == Facets::Ggx { peak / (1.0 + 0.5 * square).powi(2) } else { peak * (-0.5 * square).exp() }
    }

    /// Reflectance over the slopes that are seen, by their projected areas.
    fn reflectance(&self, v: DVec3) -> f64 {
        let (mut sum, mut area) = (0.0, 0.0);
        for (slope, share) in self.nodes() {
            let facet = DVec3::new(-slope.x, 1.0, -slope.y);
            let seen = share * v.dot(facet).max(0.0);
            sum += seen * fresnel(v.dot(facet.normalize()).max(0.0));
            area += seen;
        }
        sum / area
    }
}

/// Smith's Lambda of slopes around the horizontal, `cosine` to the vertical.
fn lambda(cosine: f64, sigma: f64, facets: Facets) -> f64 {
    let a = cosine / ((1.0 - cosine * cosine).sqrt().max(1e-9) * sigma);
    if facets == Facets::Ggx {
        return 0.5 * ((1.0 + 2.0 / (a * a)).sqrt() - 1.0);
    }
    (-0.5 * a * a).exp() / (a * TAU.sqrt()) - 0.5 * libm::erfc(a * FRAC_1_SQRT_2)
}

/// The text-book microfacet model with height-correlated masking and shadowing (Ross, Dion and Potvin 2005), cosine
/// included: radiance per irradiance on a plane that faces the sun.
fn microfacets(v: DVec3, l: DVec3, sigma: f64, facets: Facets) -> f64 {
    if v.y <= 0.0 || l.y <= 0.0 {
        return 0.0;
    }
    let h = (l + v).normalize();
    let slope = DVec2::new(-h.x, -h.z) / h.y;
    // The sun's disc spreads the slopes that mirror it, so that its image in a mirror is as bright as itself.
    let disc = (0.5 * 0.53f64).to_radians().sin().powi(2);
    let slopes = Slopes { facets, ..Slopes::isotropic((sigma * sigma + disc / 8.0).sqrt()) };
    let d = slopes.density(slope) / h.y.powi(4);
    fresnel(v.dot(h)) * d / (4.0 * v.y * (1.0 + lambda(v.y, sigma, facets) + lambda(l.y, sigma, facets)))
}

const SIGMAS: [f64; 6] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.5];
const ANGLES: [f64; 9] = [0.0, 20.0, 40.0, 55.0, 65.0, 75.0, 80.0, 85.0, 88.0];

/// To the eye, so many degrees off the vertical.
fn towards(angle_deg: f64, azimuth: f64) -> DVec3 {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    DVec3::new(sin * azimuth.sin(), cos, -sin * azimuth.cos())
}

// The comparisons.

fn compare_fresnel(kernel: &Kernel<'_>) -> Vec<Line> {
    let cosines: Vec<f64> = (0..900).map(|i| (0.1 * f64::from(i)).to_radians().cos()).collect();
    let ask = |indices, schlick, scale| {
        kernel.ask(&cosines.iter().map(|&c| fresnel_case(c, indices, schlick, scale)).collect::<Vec<_>>())
    };
    let got = ask([INDEX, 1.0], None, 1.0);
    let off = |got: &[[f64; 4]], want: &dyn Fn(f64) -> f64| {
        largest(got.iter().zip(&cosines).map(|(g, &c)| (g[0] - want(c)).abs()))
    };
    // From the thicker medium: total reflection beyond 48.6 degrees.
    let out = ask([1.0, INDEX], None, 1.0);
    let other = ask([1.5, 1.2], None, 0.5);
    let schlick = ask([INDEX, 1.0], Some(4.0), 1.0);
    let r0 = ((INDEX - 1.0) / (INDEX + 1.0)).powi(2);
    vec![
        line("fresnel", off(&got, &fresnel), 1e-4),
        line("fresnel out of the thicker medium", off(&out, &|c| dielectric(c, 1.0 / INDEX)), 2e-3),
        line("fresnel with other indices, half", off(&other, &|c| 0.5 * dielectric(c, 1.25)), 1e-4),
        line("schlick", off(&schlick, &|c| r0 + (1.0 - r0) * (1.0 - c).powi(4)), 1e-4),
        line("fresnel at normal incidence", (got[0][0] - 0.0204).abs(), 5e-5),
        line("fresnel beyond 0..1", largest(got.iter().map(|g| (-g[0]).max(g[0] - 1.0))), 0.0),
    ]
}

/// Smith's visible area against the integral that it is, for faces turned away from the eye by up to 2.5 deviations.
fn compare_seen(kernel: &Kernel<'_>) -> Vec<Line> {
    let compare = |facets: Facets| {
        let mut cases = Vec::new();
        let mut want = Vec::new();
        for sigma in SIGMAS {
            for angle in ANGLES {
                for mean in [-2.5, -1.0, 0.0, 1.0].map(|m| m * sigma) {
                    let (across, height) = angle.to_radians().sin_cos();
                    const NODES: i32 = 4000;
                    let area = (0..NODES).map(|i| {
                        let at = (f64::from(i) + 0.5) / f64::from(NODES) - 0.5;
                        // GGX by the angle whose tangent is slope over alpha: its tails are long.
                        let (z, share) = if facets == Facets::Ggx {
                            (2f64.sqrt() * (PI * at).tan(), 0.5 * PI * (PI * at).cos())
                        } else {
                            (16.0 * at, 16.0 * (-128.0 * at * at).exp() / TAU.sqrt())
                        };
                        (height + across * (mean + sigma * z)).max(0.0) * share
                    });
                    want.push(area.sum::<f64>() / f64::from(NODES));
                    cases.push(seen_case(DVec2::new(across, height), mean, sigma, facets));
                }
            }
        }
        largest(kernel.ask(&cases).iter().zip(&want).map(|(g, w)| (g[0] / w - 1.0).abs()))
    };
    vec![line("area seen", compare(Facets::Gaussian), 2e-3), line("area seen, ggx", compare(Facets::Ggx), 1e-3)]
}

/// The mirrored sky under a white sky, and which part of the sky is mirrored.
fn compare_mirror(kernel: &Kernel<'_>) -> Vec<Line> {
    let no_sun = -DVec3::Y;
    let mut rough: Vec<Slopes> = SIGMAS.map(Slopes::isotropic).to_vec();
    rough.push(Slopes::turned());
    for mean in [DVec2::new(0.15, -0.1), DVec2::new(-0.15, 0.1), DVec2::new(0.0, 0.2)] {
        rough.push(Slopes { mean, ..Slopes::isotropic(0.1) });
    }
    rough.extend(rough.clone().into_iter().map(|s| Slopes { facets: Facets::Ggx, ..s }));
    let pairs: Vec<(Slopes, DVec3)> =
        rough.iter().flat_map(|s| ANGLES.map(|angle| (*s, towards(angle, 2.1)))).collect();
    let got = kernel.ask(&pairs.iter().map(|(s, v)| mirror_case(*v, no_sun, s)).collect::<Vec<_>>());
    let whole = largest(got.iter().map(|g| g[0] + (1.0 - g[3]) - 1.0));
    let mean = largest(pairs.iter().zip(&got).map(|((s, v), g)| (g[3] - s.reflectance(*v)).abs()));
    // A nearly smooth facet mirrors one direction.
    let facets: Vec<(DVec3, DVec3, DVec2)> = [DVec2::ZERO, DVec2::new(0.2, 0.1), DVec2::new(-0.1, 0.25)]
        .iter()
        .flat_map(|slope| {
            [(0.0, 0.0), (30.0, 1.0), (60.0, 2.5), (60.0, 4.4), (70.0, 5.5)].map(|(angle, azimuth)| {
                (towards(angle, azimuth), DVec3::new(-slope.x, 1.0, -slope.y).normalize(), *slope)
            })
        })
        .collect();
    let cases: Vec<Case> = facets
        .iter()
        .map(|(v, _, slope)| mirror_case(*v, no_sun, &Slopes { mean: *slope, ..Slopes::isotropic(1e-3) }))
        .collect();
    let got = kernel.ask(&cases);
    let one = facets.iter().zip(&got).map(|((v, n, _), g)| (g[3] - fresnel(v.dot(*n))).abs());
    let place = facets.iter().zip(&got).map(|((v, n, _), g)| (g[2] / g[3] - sky_blue(2.0 * v.dot(*n) * n - v)).abs());
    vec![
        line("white furnace, mirrored and let in", whole, 1e-5),
        line("mean reflectance", mean, 2e-2),
        line("reflectance of a facet", largest(one), 1e-3),
        line("mirrored direction", largest(place), 5e-3),
    ]
}

/// The eye's mirror images in all slopes: places of the sun, and their solid angles.
fn suns(v: DVec3, slopes: &Slopes) -> Vec<(DVec3, f64)> {
    // d sun = 4 v.h d h, d h = h.y^3 d slope.
    slopes
        .nodes()
        .filter_map(|(slope, share)| {
            let h = DVec3::new(-slope.x, 1.0, -slope.y).normalize();
            let solid = 4.0 * v.dot(h) * h.y.powi(3) * share / slopes.density(slope);
            (solid > 0.0).then(|| (2.0 * v.dot(h) * h - v, solid))
        })
        .collect()
}

/// Share of the light of a white sky of suns that is mirrored into the eye.
fn glitter(kernel: &Kernel<'_>, v: DVec3, slopes: &Slopes) -> f64 {
    let suns = suns(v, slopes);
    let got = kernel.ask(&suns.iter().map(|(sun, _)| mirror_case(v, *sun, slopes)).collect::<Vec<_>>());
    got.iter().zip(&suns).map(|(g, (_, solid))| g[1] * solid).sum()
}

/// The sun's glitter over all places of the sun.
fn compare_glitter(kernel: &Kernel<'_>) -> Vec<Line> {
    let (mut over_one, mut over_mean, mut unmasked, mut model) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let tilted = Slopes { mean: DVec2::new(0.2, -0.15), ..Slopes::isotropic(0.1) };
    let gaussian: Vec<Slopes> = SIGMAS.map(Slopes::isotropic).into_iter().chain([tilted, Slopes::turned()]).collect();
    let ggx = gaussian.iter().map(|s| Slopes { facets: Facets::Ggx, ..*s });
    for slopes in gaussian.iter().copied().chain(ggx) {
        let sigma = slopes.cov.x_axis.x.max(slopes.cov.y_axis.y).sqrt();
        for angle in ANGLES {
            let v = towards(angle, 0.7);
            let suns = suns(v, &slopes);
            let got = kernel.ask(&suns.iter().map(|(sun, _)| mirror_case(v, *sun, &slopes)).collect::<Vec<_>>());
            let albedo: f64 = got.iter().zip(&suns).map(|(g, (_, solid))| g[1] * solid).sum();
            let mean = slopes.reflectance(v);
            over_one.push(albedo - 1.0);
            over_mean.push(albedo / mean - 1.0);
            // No slope to speak of hides another from the eye or from the sun.
            let steep = slopes.mean.length() + 3.0 * sigma;
            if slopes.facets == Facets::Gaussian && 2.0 * steep.atan() + angle.to_radians() < 0.45 * PI {
                unmasked.push((albedo / mean - 1.0).abs());
            }
            if slopes.mean == DVec2::ZERO && slopes.cov.x_axis.y == 0.0 {
                let twice = 1.0 + kernel.ask(&[again_case(v, &slopes, mean)])[0][0];
                let want = suns.iter().map(|(sun, solid)| twice * microfacets(v, *sun, sigma, slopes.facets) * solid);
                let want: Vec<f64> = want.collect();
                let off = got.iter().zip(&suns).zip(&want).map(|((g, (_, solid)), want)| (g[1] * solid - want).abs());
                model.push(off.sum::<f64>() / want.iter().sum::<f64>());
            }
        }
    }
    assert!(unmasked.len() > 10);
    vec![
        line("glitter over 1", largest(over_one), 0.0),
        line("glitter over the mean reflectance", largest(over_mean), 5e-3),
        line("glitter where nothing is masked", largest(unmasked), 5e-3),
        line("glitter against microfacets", largest(model), 2e-3),
    ]
}

/// What is mirrored and what is let in, for the sky and for a sky of suns, over roughness and angle.
fn compare_furnace(kernel: &Kernel<'_>) -> Vec<Line> {
    let (mut over, mut over_again, mut under, mut phong) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for facets in [Facets::Gaussian, Facets::Ggx] {
        for roughness in [0.1f64, 0.2, 0.3, 0.6, 0.9] {
            let slopes = Slopes { facets, ..Slopes::isotropic(roughness.powi(2) / 2f64.sqrt()) };
            for angle in ANGLES {
                let v = towards(angle, 0.7);
                let sky = kernel.ask(&[mirror_case(v, -DVec3::Y, &slopes)])[0];
                let mirrored = [sky[0], glitter(kernel, v, &slopes)];
                // What is mirrored onto other waves enters there or is mirrored again.
                let again = kernel.ask(&[again_case(v, &slopes, sky[3])])[0][0];
                let onto_others = sky[3] - mirrored[1] / (1.0 + again);
                let let_in = [1.0 - sky[3], (1.0 - sky[3]) * (1.0 + onto_others)];
                over.extend(mirrored.map(|m| m + let_in[0] - 1.0));
                over_again.push(mirrored[1] + let_in[1] - 1.0);
                if roughness <= 0.3 {
                    under.extend([0, 1].map(|i| 1.0 - mirrored[i] - let_in[i]));
                }
            }
        }
    }
    // Of the shininess in the kernel; the Fresnel factor's mean over the lobe is all but that of the middle.
    let lobe = Slopes { facets: Facets::Phong, ..Slopes::isotropic((1f64 / 122.0).sqrt()) };
    for angle in ANGLES {
        phong.push(glitter(kernel, towards(angle, 0.7), &lobe) - fresnel(angle.to_radians().cos()));
    }
    // Under an even sky still water mirrors the hemispherical reflectance: 0.0658 at 1.333.
    let still = Slopes::isotropic(1e-3);
    const STEPS: u32 = 200;
    let even = |f: &dyn Fn(f64) -> f64| {
        let at = (0..STEPS).map(|i| (f64::from(i) + 0.5) / f64::from(STEPS));
        at.map(|s| f((1.0 - s).sqrt())).sum::<f64>() / f64::from(STEPS)
    };
    let from_eye = |c: f64| kernel.ask(&[mirror_case(towards(c.acos().to_degrees(), 1.0), -DVec3::Y, &still)])[0][0];
    let (got, want) = (even(&from_eye), even(&fresnel));
    assert!((0.065..0.067).contains(&want), "{want}");
    vec![
        line("white furnace over 1", largest(over), 1e-3),
        line("white furnace under 1, smooth", largest(under), 2e-2),
        line("white furnace over 1, with other waves", largest(over_again), 1e-3),
        line("blinn-phong over the reflectance", largest(phong), 1e-3),
        line("hemispherical reflectance", (got / want - 1.0).abs(), 2e-2),
    ]
}

/// Slopes, normals and Jacobian against differences of the displaced surface.
fn compare_surface(kernel: &Kernel<'_>) -> Vec<Line> {
    let plan = kernel.bench.ocean.plan();
    let (n, patch) = (plan.n as usize, plan.cascades[0].patch_m);
    let texel = patch / n as f64;
    let rest: Vec<DVec2> = (0..n * n).map(|i| DVec2::new((i % n) as f64, (i / n) as f64) * texel).collect();
    let ask = |question: f32| {
        kernel.ask(&rest.iter().map(|r| place_case(question, *r - kernel.bench.foot, 0.01 * texel)).collect::<Vec<_>>())
    };
    let got = ask(3.0);
    let moved: Vec<DVec3> = ask(4.0).iter().map(|d| DVec3::new(d[0], d[1], d[2])).collect();
    // Central differences over all texels of a row: exact for waves that the lattice can hold.
    let weights: Vec<f64> = (1..n)
        .map(|d| (if d % 2 == 0 { 0.5 } else { -0.5 }) / (PI * d as f64 / n as f64).tan() * TAU / patch)
        .collect();
    let difference = |at: usize, step: usize, row: usize| -> DVec3 {
        // moved(at - d) counts weights[d - 1]: the matrix is odd and periodic.
        let place = (at - row) / step;
        (1..n).map(|d| moved[row + step * ((place + n - d) % n)] * weights[d - 1]).sum()
    };
    let normals: Vec<DVec3> = (0..n * n)
        .map(|i| {
            let along_x = DVec3::X + difference(i, 1, i - i % n);
            let along_z = DVec3::Z + difference(i, n, i % n);
            along_z.cross(along_x)
        })
        .collect();
    // Where the surface all but folds the shader bounds the slope.
    let open: Vec<usize> = (0..n * n).filter(|&i| normals[i].y > 0.3).collect();
    let slope = |i: usize| DVec2::new(-normals[i].x, -normals[i].z) / normals[i].y;
    let rms = |values: &dyn Fn(usize) -> f64| (open.iter().map(|&i| values(i)).sum::<f64>() / open.len() as f64).sqrt();
    let got_slope = |i: usize| DVec2::new(got[i][0], got[i][1]);
    let slope_error = rms(&|i| (got_slope(i) - slope(i)).length_squared()) / rms(&|i| slope(i).length_squared());

    let got_normals = kernel.ask(&got.iter().map(|g| place_case(5.0, DVec2::new(g[0], g[1]), 0.0)).collect::<Vec<_>>());
    let got_normal = |i: usize| DVec3::new(got_normals[i][0], got_normals[i][1], got_normals[i][2]);
    let lean = |normal: DVec3| normal.angle_between(DVec3::Y).powi(2);
    let normal_error = rms(&|i| got_normal(i).angle_between(normals[i]).powi(2)) / rms(&|i| lean(normals[i]));
    // A side that falls towards the viewer faces him.
    let viewer = DVec2::new(0.8, -0.6);
    let facing: Vec<usize> = open.iter().copied().filter(|&i| slope(i).dot(viewer) < -0.02).collect();
    let away = facing.iter().filter(|&&i| DVec2::new(got_normal(i).x, got_normal(i).z).dot(viewer) <= 0.0).count();

    let stretch: Vec<f64> = normals.iter().map(|n| n.y - 1.0).collect();
    let jacobian_error = rms(&|i| (got[i][2] - normals[i].y).powi(2)) / rms(&|i| stretch[i].powi(2));
    let mean = got.iter().map(|g| g[2]).sum::<f64>() / got.len() as f64;
    let mut by_height: Vec<usize> = (0..n * n).collect();
    by_height.sort_by(|&a, &b| moved[a].y.total_cmp(&moved[b].y));
    let mean_of = |set: &[usize]| set.iter().map(|&i| got[i][2]).sum::<f64>() / set.len() as f64;
    let tenth = n * n / 10;
    let (troughs, crests) = (mean_of(&by_height[..tenth]), mean_of(&by_height[n * n - tenth..]));
    vec![
        line("slope against differences", slope_error, 5e-3),
        line("normal against differences", normal_error, 5e-3),
        line("share of facing sides that lean away", away as f64 / facing.len() as f64, 0.0),
        line("jacobian against differences", jacobian_error, 5e-3),
        line("mean jacobian off 1", (mean - 1.0).abs(), 1e-3),
        line("jacobian at crests over 0.95", crests - 0.95, 0.0),
        line("jacobian in troughs under 1.05", 1.05 - troughs, 0.0),
    ]
}

/// Light on the bed: the waves move it about, and neither add to it nor take from it.
fn compare_caustics(kernel: &Kernel<'_>) -> Vec<Line> {
    let plan = kernel.bench.ocean.plan();
    const SIDE: u32 = 96;
    let step = plan.cascades[0].patch_m / f64::from(SIDE);
    let (mut off, mut contrast) = (0.0f64, f64::INFINITY);
    // The waves of the bench are long: so must their focal lengths be.
    for depth_m in [200.0, 600.0, 1500.0] {
        let focusing_m = slopes::shortest_caustic_half_wavelength_m(plan, depth_m * (1.0 - 1.0 / INDEX));
        let cases: Vec<Case> = (0..SIDE * SIDE)
            .map(|i| {
                let at = DVec2::new(f64::from(i % SIDE), f64::from(i / SIDE)) * step;
                let mut case = place_case(7.0, at, focusing_m);
                case[1][0] = depth_m as f32;
                case
            })
            .collect();
        let got: Vec<f64> = kernel.ask(&cases).iter().map(|a| a[0]).collect();
        let mean = got.iter().sum::<f64>() / got.len() as f64;
        let deviation = (got.iter().map(|g| (g - mean).powi(2)).sum::<f64>() / got.len() as f64).sqrt();
        eprintln!("{depth_m} m: waves over {focusing_m:.2} m, mean {mean:.3}, deviation {deviation:.3}");
        off = off.max((mean - 1.0).abs());
        contrast = contrast.min(deviation);
    }
    vec![
        line("mean light under caustics off 1", off, 5e-2),
        line("contrast of caustics under 0.05", 0.05 - contrast, 0.0),
    ]
}

/// The light of separate glints has the mean of all glints, and the variance of a Poisson number of exponential ones.
fn compare_glints(kernel: &Kernel<'_>) -> Vec<Line> {
    let (mut off, mut spread) = (0.0_f64, 0.0_f64);
    for expected in [0.05, 0.5, 3.9, 4.1, 30.0] {
        let side = 200;
        let case = |i: i32| place_case(11.0, DVec2::new(f64::from(i % side), f64::from(i / side)), expected);
        let cases: Vec<Case> = (0..side * side).map(case).collect();
        let got: Vec<f64> = kernel.ask(&cases).iter().map(|a| a[0]).collect();
        let n = got.len() as f64;
        let mean = got.iter().sum::<f64>() / n;
        let variance = got.iter().map(|g| (g - mean).powi(2)).sum::<f64>() / n;
        let deviations = (mean - 1.0) / (2.0 / expected / n).sqrt();
        eprintln!("{expected} glints: mean {mean:.4}, {deviations:.1} deviations off; variance {variance:.3}");
        // The distributions are approximated to some thousandths.
        off = off.max(((mean - 1.0).abs() - 0.006).max(0.0) / (2.0 / expected / n).sqrt());
        spread = spread.max((0.5 * expected * variance - 1.0).abs());
    }
    vec![line("mean of glints, deviations off 1", off, 4.0), line("variance of glints", spread, 0.15)]
}

/// What covers the bed has its share at every distance, and so has the light that comes from it.
fn compare_bed(kernel: &Kernel<'_>) -> Vec<Line> {
    // The largest tile of the bed's noise is 1,130 m long.
    let places: Vec<DVec2> = (0..30_000u32)
        .map(|i| 5650.0 * DVec2::new((0.754_877_67 * f64::from(i)).fract(), (0.569_840_29 * f64::from(i)).fract()))
        .collect();
    let mean = |question: f32, size: f64, variance: f32| {
        let cases = places.iter().map(|&at| {
            let mut case = place_case(question, at, size);
            case[1][0] = variance;
            case
        });
        let got = kernel.ask(&cases.collect::<Vec<_>>());
        DVec3::from_array([0, 1, 2].map(|c| got.iter().map(|g| g[c]).sum::<f64>() / got.len() as f64))
    };
    let off = |got: DVec3, want: DVec3| (got / want - 1.0).abs().max_element();
    let look = BedLook::default();
    let albedo = |of: f64| DVec3::from_slice(&kernel.ask(&[place_case(10.0, DVec2::new(of, 0.0), 0.0)])[0]);
    let (seagrass, coral) = (albedo(0.0), albedo(1.0));
    let bare = 1.0 - look.cover;
    let want = bare * DVec3::from_array(linear_rgb(look.colour)) + look.cover * (0.7 * seagrass + 0.3 * coral);
    let fine = mean(9.0, 0.02, 0.0);
    let sizes = [0.3, 2.0, 9.0, 30.0];
    vec![
        line("mean albedo of the bed", off(mean(8.0, 0.02, 0.0), want), 4e-2),
        line("mean albedo of the bed from afar", largest(sizes.map(|s| off(mean(8.0, s, 0.0), want))), 4e-2),
        line("mean light of the bed from afar", largest(sizes.map(|s| off(mean(9.0, s, 0.0), fine))), 4e-2),
        line("mean light of the bed in wavelets", off(mean(9.0, 0.02, 1.0), fine), 4e-2),
    ]
}

type Comparison = fn(&Kernel<'_>) -> Vec<Line>;

/// The parts of shading.wgsl, by number, each with the comparisons that ask it. Each part is a kernel of its own: the
/// driver's cache has the parts that an erratum does not touch, and compiles four small kernels faster than one large one.
const PARTS: [&[Comparison]; 4] = [
    &[compare_fresnel, compare_seen, compare_mirror, compare_glitter, compare_furnace],
    &[compare_surface],
    &[compare_caustics, compare_bed],
    &[compare_glints],
];

fn compare(bench: &mut Bench, shaders: &Shaders) -> Vec<Line> {
    let mut lines = Vec::new();
    for (part, comparisons) in PARTS.iter().enumerate() {
        let kernel = bench.kernel(shaders.clone(), part);
        lines.extend(comparisons.iter().flat_map(|comparison| comparison(&kernel)));
    }
    lines
}

fn table(lines: &[Line]) -> String {
    let row = |l: &Line| {
        let verdict = if l.passes() { "ok" } else { "WRONG" };
        format!("{:<40} {:>10.2e} {:>8.0e}  {verdict}\n", l.what, l.error, l.tolerance)
    };
    lines.iter().map(row).collect()
}

#[test]
fn light_and_normals_are_right() {
    let lines = compare(&mut Bench::new(), &shaders());
    eprintln!("{}", table(&lines));
    assert!(lines.iter().all(Line::passes), "{}", table(&lines));
}

/// An erratum: its name and what it says, where it would stand in the water
/// module, and a line that must turn red.
struct Fault(&'static str, &'static [(&'static str, &'static str)], &'static str);

const FAULTS: &[Fault] = &[
    Fault(
        "F1: Fresnel's fractions upside down",
        &[
            (
                "return 0.5 * across * across * (1.0 + along * along);",
                "return 0.5 * (1.0 + 1.0 / (along * along)) / (across * across);",
            ),
            (
                "saturate(material.fresnel_scale * water_dielectric(cosine, material.index_contrast))",
                "water_dielectric(cosine, material.index_contrast)",
            ),
        ],
        "fresnel",
    ),
    Fault(
        "F3: half vector not normalised",
        &[("let h = normalize(between);\n  var f", "let h = between;\n  var f")],
        "glitter where nothing is masked",
    ),
    Fault(
        "F4: Smith's masking as 1 / (1 + a Lambda)",
        &[(
            "return scale * max(density * (1.0 - abs(a) * tail) + max(a, 0.0), 1e-7);",
            "let area = density * (1.0 - abs(a) * tail) + max(a, 0.0);
             return scale * (a + a * (area - a));",
        )],
        "area seen",
    ),
    Fault(
        "F4b: masking by the angle to the half vector",
        &[(
            "let seen = water_tilt_projected_area(eye);",
            "let seen = vec2f(water_projected_area(dot(v, h), eye.across, eye.mean, eye.sigma), \
             water_tilt_projected_area(eye).y);",
        )],
        "glitter against microfacets",
    ),
    Fault(
        "F5: the sun's cosine left out",
        &[("facets / (4.0 * h2 * h2)", "facets / (4.0 * h2 * h2 * max(l.y, 1e-3))")],
        "glitter over 1",
    ),
    Fault("G1: no cross terms", &[("sums.shear + weight.x", "sums.shear + 0.0")], "slope against differences"),
    Fault(
        "G2: the normal without its minus",
        &[("normalize(vec3f(-slope.x, 1.0, -slope.y))", "normalize(vec3f(slope.x, 1.0, slope.y))")],
        "share of facing sides that lean away",
    ),
    Fault(
        "G2: in the glitter",
        &[("let off = mirror_slope - part.mean;", "let off = -mirror_slope - part.mean;")],
        "glitter where nothing is masked",
    ),
    Fault("G2: in the mirrored sky", &[("t.mean = -dot(", "t.mean = dot(")], "reflectance of a facet"),
    Fault(
        "N3b: derivatives of the other sign",
        &[("sums.stretch + weight.x", "sums.stretch - weight.x")],
        "jacobian at crests over 0.95",
    ),
    Fault(
        "G3: no horizontal displacement",
        &[("sums.stretch + weight.x", "sums.stretch + 0.0")],
        "slope against differences",
    ),
    Fault(
        "J1: J_xz = 1 + dDx/dz",
        &[(
            "waves.sums = carried;\n  var gains",
            "waves.sums = carried;\n  waves.sums.shear += vec2f(1.0);\n  var gains",
        )],
        "mean jacobian off 1",
    ),
    Fault(
        "no Fresnel on the mirrored sky",
        &[("reflected * water_mirrored_sky", "node.weight * water_mirrored_sky")],
        "white furnace, mirrored and let in",
    ),
    Fault("Schlick's exponent fixed", &[("1e-6), material.schlick_exponent)", "1e-6), 5.0)")], "schlick"),
    Fault(
        "the indices exchanged",
        &[(
            "water_dielectric(cosine, material.index_contrast)",
            "water_dielectric(cosine, vec2f(material.inverse_relative_index * material.inverse_relative_index - 1.0, \
             1.0 / (material.inverse_relative_index * material.inverse_relative_index - 1.0)))",
        )],
        "hemispherical reflectance",
    ),
    Fault(
        "GGX's alpha without its factor",
        &[("facing * facing + 2.0 * scale * scale", "facing * facing + scale * scale")],
        "area seen, ggx",
    ),
    Fault(
        "light mirrored twice is lost",
        &[("brightness *= 1.0 + water_second_bounce(eye, reflectance);", "")],
        "white furnace under 1, smooth",
    ),
    Fault(
        "Blinn and Phong without their norm",
        &[("(material.shininess + 2.0) / (8.0 * ATM_PI)", "(material.shininess + 2.0)")],
        "blinn-phong over the reflectance",
    ),
    Fault(
        "light focused where it enters",
        &[("at = entry - reach * bed_focusing_slope(at, foot);", "at = entry;")],
        "mean light under caustics off 1",
    ),
    Fault(
        "rays bent a tenth",
        &[("let reach = depth_m *", "let reach = 0.1 * depth_m *")],
        "contrast of caustics under 0.05",
    ),
    Fault("a tenth of the glints left out", &[("count += 1.0;", "count += 0.9;")], "mean of glints, deviations off 1"),
    Fault(
        "reefs below the seagrass",
        &[("mix(mix(sand, seagrass, meadow), coral, reef)", "mix(sand, seagrass, meadow)")],
        "mean albedo of the bed",
    ),
    Fault(
        "edges of meadows sharp from afar",
        &[("BED_SOFTNESS * BED_SOFTNESS + 1.0 - resolved", "BED_SOFTNESS * BED_SOFTNESS")],
        "mean albedo of the bed from afar",
    ),
    Fault("the light's way back mirrored", &[("let uv = 0.5 - over", "let uv = 0.5 + over")], "mirrored direction"),
];

#[test]
fn the_errata_would_be_found() {
    let mut bench = Bench::new();
    let mut unproved: BTreeSet<&str> = compare(&mut bench, &shaders()).iter().map(|l| l.what).collect();
    for Fault(what, patches, red) in FAULTS {
        let shaders = patches.iter().fold(shaders(), |s, (from, to)| s.patched(MODULE, from, to));
        let lines = compare(&mut bench, &shaders);
        let line = lines.iter().find(|l| l.what == *red).expect("a line of that name");
        assert!(!line.passes(), "{what} went unseen:\n{}", table(&lines));
        for l in lines.iter().filter(|l| !l.passes()) {
            unproved.remove(l.what);
        }
    }
    assert!(unproved.is_empty(), "no fault turns these red: {unproved:?}");
}
