//! How a line of n points is transformed on the GPU: in what steps, by which threads, and the WGSL of steps that are written out.
//!
//! There are three ways (shaders/waves/fft_common.wgsl has the formula). **Exchanged**: one dispatch for a line, whose threads pass
//! their halves on through workgroup memory; the least traffic through memory, for a GPU. **Straight**: two dispatches, each
//! thread by itself with all its points in registers, the transforms written out and without barriers; for adapters that are
//! CPUs, where a barrier means that every thread's state is put away and taken up again. **Merged**: the same, but the second
//! half along x and the first half along z are one dispatch, over a rectangle of points, so that numbers go through memory twice
//! instead of three times, and up to 64 points are a thread's; for llvmpipe, which reads and writes number by number, and compiles
//! 64 points in a moment, where SwiftShader takes 9 s. The rule is the adapter's kind, name and
//! features: browsers have no numbers of 64 bits, so it is llvmpipe in native programs that merges, up to 512 points.

use crate::gpu::Gpu;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Points of the table of twiddle factors: the longest line.
pub const TWIDDLES: usize = 1024;
/// Workgroup memory that a kernel may use, in vec4f: WebGPU's base limit.
const EXCHANGE_LIMIT: u32 = 1024;

/// How the halves of a transform follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// In one dispatch, through workgroup memory.
    Exchanged,
    /// In two.
    Straight,
    /// In two, of which the second along x is also the first along z.
    Merged,
}

impl Way {
    /// Without this a device cannot have [`Way::Merged`]: llvmpipe moves one long number in the time of a short one.
    pub const FEATURES: wgpu::Features = wgpu::Features::SHADER_INT64;

    /// What to ask an adapter for, if it has it: a device has the feature where merging is the faster way.
    pub fn features(adapter: &wgpu::AdapterInfo) -> wgpu::Features {
        if adapter.name.contains("llvmpipe") { Self::FEATURES } else { wgpu::Features::empty() }
    }

    /// The fastest one for a device.
    pub fn of(gpu: &Gpu) -> Self {
        match gpu.device.adapter_info().device_type {
            wgpu::DeviceType::Cpu if gpu.device.features().contains(Self::FEATURES) => Self::Merged,
            wgpu::DeviceType::Cpu => Self::Straight,
            _ => Self::Exchanged,
        }
    }

    /// The same, or the next best if lines of `n` points are too long for it.
    #[must_use]
    pub fn for_points(self, n: u32) -> Self {
        if self == Self::Merged && n > MERGED_LIMIT { Self::Straight } else { self }
    }
}

/// Longest line that is merged: a thread has 64 points of it at most.
const MERGED_LIMIT: u32 = 512;

/// How an axis of n points is split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factors {
    /// Points that a thread transforms first.
    pub first: u32,
    /// Points that it transforms second.
    pub second: u32,
}

/// The factorisations of n and how many lines share a workgroup.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transform {
    /// Points of a line.
    pub n: u32,
    /// How they are transformed.
    pub way: Way,
    /// Along x; where lines are exchanged, `second` is also the number of a line's threads.
    pub x: Factors,
    /// Along z.
    pub z: Factors,
    /// Lines of a workgroup, where they are exchanged.
    pub lines: u32,
}

impl Transform {
    /// The kernels for lines of `n` points, a power of two from 64 to 1024 (to 512 if they are merged).
    pub fn new(n: u32, way: Way) -> Self {
        let split = |second: u32| Factors { first: n / second, second };
        let even = split(1 << (n.ilog2() / 2));
        let (x, z) = if way == Way::Merged { (split(8), split(64)) } else { (even, even) };
        // At least a warp's worth of threads, as far as the workgroup memory reaches.
        let lines = (64 / even.second).clamp(1, EXCHANGE_LIMIT / n);
        Self { n, way, x, z, lines }
    }

    /// Override constants of the kernels that exchange.
    pub fn exchanged_constants(&self) -> [(&'static str, f64); 5] {
        let exchange = self.lines * self.n;
        let Factors { first, second } = self.x;
        [("N", self.n), ("R1", first), ("R2", second), ("LINES", self.lines), ("EXCHANGE", exchange)]
            .map(|(name, value)| (name, f64::from(value)))
    }

    /// The constants of the kernels that are written out.
    pub fn straight_constants(&self) -> [(&'static str, f64); 1] {
        [("N", f64::from(self.n))]
    }

    /// What is written out of a module, by its name: the functions that its entry point calls.
    pub fn straight_code(&self, module: &str) -> Option<String> {
        let Self { n, x: along_x, z: along_z, .. } = *self;
        let is_row = module == "rows_first" || module == "lines_second";
        let Factors { first: r1, second: r2 } = if is_row { along_x } else { along_z };
        let mut code = Code::default();
        match module {
            "rows_first" => {
                // h(-k) is the conjugate of h(k), so the waves of a line are those of the line of the opposite waves too. There
                // they stand in reverse; t = r2 instead of 0 turns the spectrum by what the points are shifted.
                code.open("rows_first(c: u32, t: u32, z: u32)");
                code.line("let here = rows_line(c, z);");
                code.line(&format!("let z_opposite = ({n}u - z) & {}u;", n - 1));
                // In loops, because a first picture waits for this kernel to be compiled.
                code.line(&format!("var waves: array<vec3f, {r1}>;"));
                code.line(&format!("for (var i = 0u; i < {r1}u; i++) {{"));
                code.line(&format!("waves[i] = rows_wave(here, t + i * {r2}u);"));
                code.line("}");
                code.line("for (var i = 0u; i < select(4u, 2u, z == z_opposite); i++) {");
                code.line("let pair = i & 1u;");
                code.line("let is_opposite = i > 1u;");
                code.line("let z_line = select(z, z_opposite, is_opposite);");
                code.line("let line = rows_line(c, z_line);");
                code.line(&format!("let t_line = select(t, {r2}u - t, is_opposite);"));
                let factors = code.factors("t_line", r1, n);
                let x = (0..r1)
                    .map(|i| {
                        let wave = format!("rows_choose(waves[{i}], waves[{}], is_opposite)", r1 - 1 - i);
                        let at = format!("(t_line + {}u) & {}u", i * r2, n - 1);
                        code.value(&format!("rows_pack(pair, line, {at}, {wave})"))
                    })
                    .collect();
                let t = format!("(t_line & {}u)", r2 - 1);
                code.line(&format!("let to = ((2u * c + pair) * {n}u + z_line) * {n}u + {t};"));
                for (k1, v) in (0..).zip(code.transform(x)) {
                    code.line(&format!("halves[to + {}u] = fft_mul({v}, {});", k1 as u32 * r2, factors[k1]));
                }
                code.line("}");
            }
            "lines_second" => {
                code.open("lines_second(line: u32, k1: u32)");
                let x = (0..r2).map(|n2| code.value(&format!("halves[line + k1 * {r2}u + {n2}u]"))).collect();
                for (k2, v) in (0..).zip(code.transform(x)) {
                    code.line(&format!("lines[line + k1 + {}u] = {v};", k2 * r1));
                }
            }
            "columns_first" => {
                code.open("columns_first(column: u32, t: u32)");
                let factors = code.factors("t", r1, n);
                let x = (0..r1).map(|i| code.value(&format!("lines[column + (t + {}u) * {n}u]", i * r2))).collect();
                for (k1, v) in (0..).zip(code.transform(x)) {
                    let to = k1 as u32 * r2;
                    code.line(&format!("halves[column + (t + {to}u) * {n}u] = fft_mul({v}, {});", factors[k1]));
                }
            }
            "columns_second" | "columns_last" => {
                code.open("columns_second(layer: u32, layers: u32, x: u32, k1: u32)");
                let halves: Vec<String> = if self.way == Way::Merged {
                    code.line(&format!(
                        "let here = (layer * {n}u + k1 * {r2}u) * {n}u + x / 8u * {}u + x % 8u;",
                        8 * r2
                    ));
                    (0..r2).map(|n2| format!("long_unpack(halves[here + {}u])", n2 * 8)).collect()
                } else {
                    code.line(&format!("let here = (layer * {n}u + k1 * {r2}u) * {n}u + x;"));
                    (0..r2).map(|n2| format!("halves[here + {}u]", n2 * n)).collect()
                };
                let points = halves.iter().map(|half| code.value(half)).collect();
                for (k2, v) in (0..).zip(code.transform(points)) {
                    code.line(&format!("columns_store(layer, layers, x, k1 + {}u, {v});", k2 * r1));
                }
            }
            "middle" => {
                code.open("middle(layer: u32, k1: u32, t: u32)");
                code.line(&format!("let here = layer * {}u;", n * n));
                let factors = code.factors("t", r1, n);
                let lines = (0..r1).map(|i| {
                    code.line(&format!("let line_{i} = here + (t + {}u) * {n}u + k1 * {}u;", i * r2, along_x.second));
                    let points =
                        (0..along_x.second).map(|n2| code.value(&format!("long_unpack(lines[line_{i} + {n2}u])")));
                    let points = points.collect();
                    code.transform(points)
                });
                let lines: Vec<Vec<String>> = lines.collect();
                for k2 in 0..along_x.second {
                    let column = lines.iter().map(|line| line[k2 as usize].clone()).collect();
                    code.line(&format!(
                        "let tile_{k2} = here + (k1 + {}u) / 8u * {}u + t * 8u + k1 % 8u;",
                        k2 * along_x.first,
                        8 * r2
                    ));
                    for (k, v) in (0..).zip(code.transform(column)) {
                        let place = format!("tile_{k2} + {}u", k as u32 * n * r2);
                        code.line(&format!("halves[{place}] = long_pack(fft_mul({v}, {}));", factors[k]));
                    }
                }
            }
            _ => return None,
        }
        Some(code.close())
    }
}

/// A function of WGSL in the making; its values have names of their own.
#[derive(Default)]
struct Code {
    text: String,
    values: u32,
}

impl Code {
    fn open(&mut self, signature: &str) {
        let _ = writeln!(self.text, "fn {signature} {{");
    }

    fn close(self) -> String {
        self.text + "}\n"
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.text, "  {text}");
    }

    fn value(&mut self, expression: &str) -> String {
        self.values += 1;
        let name = format!("v{}", self.values);
        self.line(&format!("let {name} = {expression};"));
        name
    }

    /// W_n^(t k1) for a t and every k1, each a product of two before it, so that errors grow with the logarithm.
    fn factors(&mut self, t: &str, r1: u32, n: u32) -> Vec<String> {
        let mut factors = vec!["vec2f(1.0, 0.0)".to_owned()];
        if r1 > 1 {
            factors.push(self.value(&format!("twiddle[{t} * {}u]", TWIDDLES as u32 / n)));
        }
        for k in 2..r1 as usize {
            let (a, b) = (&factors[k / 2], &factors[k - k / 2]);
            let product = format!("vec2f({a}.x * {b}.x - {a}.y * {b}.y, {a}.x * {b}.y + {a}.y * {b}.x)");
            factors.push(self.value(&product));
        }
        factors
    }

    /// The inverse transform of some vec4f, each two complex numbers, in natural order.
    fn transform(&mut self, x: Vec<String>) -> Vec<String> {
        let n = x.len();
        match n {
            1 => x,
            2 => {
                let (a, b) = (&x[0], &x[1]);
                vec![self.value(&format!("{a} + {b}")), self.value(&format!("{a} - {b}"))]
            }
            4 => {
                let [a, b, c, d] = [&x[0], &x[1], &x[2], &x[3]];
                let (s0, s1) = (self.value(&format!("{a} + {c}")), self.value(&format!("{a} - {c}")));
                let (s2, e) = (self.value(&format!("{b} + {d}")), self.value(&format!("{b} - {d}")));
                let s3 = self.value(&format!("vec4f(-{e}.y, {e}.x, -{e}.w, {e}.z)"));
                [(&s0, '+', &s2), (&s1, '+', &s3), (&s0, '-', &s2), (&s1, '-', &s3)]
                    .map(|(u, sign, w)| self.value(&format!("{u} {sign} {w}")))
                    .to_vec()
            }
            _ => {
                // Over four points that lie n / 4 apart, a factor, and over what is left.
                let m = n / 4;
                let mut rows: Vec<Vec<String>> = vec![Vec::new(); 4];
                for n2 in 0..m {
                    let quarter = (0..4).map(|i| x[n2 + m * i].clone()).collect();
                    for (k1, v) in self.transform(quarter).into_iter().enumerate() {
                        rows[k1].push(self.turned(&v, (n2 * k1) as f64 / n as f64));
                    }
                }
                let parts: Vec<Vec<String>> = rows.into_iter().map(|row| self.transform(row)).collect();
                (0..n).map(|k| parts[k % 4][k / 4].clone()).collect()
            }
        }
    }

    /// A value times e^(2 pi i turns), for less than a turn.
    fn turned(&mut self, v: &str, turns: f64) -> String {
        if turns == 0.0 {
            return v.to_owned();
        }
        if turns == 0.25 {
            return self.value(&format!("vec4f(-{v}.y, {v}.x, -{v}.w, {v}.z)"));
        }
        let (sin, cos) = (TAU * turns).sin_cos();
        self.value(&format!("fft_mul({v}, vec2f({cos:.9}, {sin:.9}))"))
    }
}

/// e^(2 pi i j / 1024), rounded from f64.
pub fn twiddles() -> Vec<[f32; 2]> {
    (0..TWIDDLES)
        .map(|j| {
            let angle = TAU * j as f64 / TWIDDLES as f64;
            [angle.cos() as f32, angle.sin() as f32]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_fit_the_base_limits() {
        for n in [64, 128, 256, 512, 1024] {
            let t = Transform::new(n, Way::Exchanged);
            let Factors { first, second } = t.x;
            assert_eq!((t.x, first * second), (t.z, n));
            assert!(first >= second && [8, 16, 32].contains(&first) && [8, 16, 32].contains(&second));
            assert!(t.lines * t.n <= EXCHANGE_LIMIT && n % t.lines == 0 && t.lines * second <= 256);
        }
    }
}
