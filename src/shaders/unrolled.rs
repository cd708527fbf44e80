//! Generates the WGSL of the unrolled FFT, which runs on software adapters: straight-line code without barriers,
//! because a software adapter stores and reloads the state of every thread at a barrier. Each half of an FFT is a
//! dispatch of its own, in which a thread holds all its points in variables.

use super::fft::{FftFactors, TWIDDLE_COUNT};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// One of the four compute kernels of the inverse FFT for software adapters, two along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnrolledKernel {
    /// Computes the waves' Fourier amplitudes at one time, and the first of two rounds of shorter FFTs along x.
    RowsFirst,
    /// Computes the second of two rounds of shorter FFTs along x, which completes the inverse FFT along x.
    RowsSecond,
    /// Computes the first of two rounds of shorter FFTs along z, which together make the inverse FFT along z.
    ColumnsFirst,
    /// Computes the second of two rounds of shorter FFTs along z, which completes the inverse FFT, and writes the maps.
    ColumnsSecond,
}

impl UnrolledKernel {
    /// All four kernels, in the order in which they are dispatched.
    pub const ALL: [Self; 4] = [Self::RowsFirst, Self::RowsSecond, Self::ColumnsFirst, Self::ColumnsSecond];

    /// Name of the shader module that contains the kernel, as in [`Shaders::all`](super::Shaders::all).
    pub fn module_name(self) -> &'static str {
        match self {
            Self::RowsFirst => "waves/unrolled_rows_first",
            Self::RowsSecond => "waves/unrolled_rows_second",
            Self::ColumnsFirst => "waves/unrolled_columns_first",
            Self::ColumnsSecond => "waves/unrolled_columns_second",
        }
    }

    /// Generates the WGSL function that does the kernel's part of the FFT for lines of `n` points. The entry point in
    /// the kernel's module calls it.
    pub fn function_text(self, n: u32) -> String {
        match self {
            Self::RowsFirst => rows_first(n),
            Self::RowsSecond => rows_second(n),
            Self::ColumnsFirst => columns_first(n),
            Self::ColumnsSecond => columns_second(n),
        }
    }
}

/// Generates the WGSL function of the kernel `RowsFirst`. Thread t transforms every `second`-th point of line z from
/// point t on, and every `second`-th point of line n - z from `second` - t on: these have the opposite wave vectors and
/// so the complex conjugate amplitudes. For t = 0 the twiddle factors undo the shift by `second`.
fn rows_first(n: u32) -> String {
    let FftFactors { first_round_points: first, second_round_points: second } = FftFactors::new(n);
    let mut code = FunctionWriter::begin("rows_first(c: u32, t: u32, z: u32)");
    code.add_line("let here = evolve_line(c, z);");
    code.add_line(&format!("let z_opposite = ({n}u - z) & {}u;", n - 1));
    // Loops, because they compile faster than straight-line code, and the first picture waits for this kernel.
    code.add_line(&format!("var waves: array<vec3f, {first}>;"));
    code.add_line(&format!("for (var i = 0u; i < {first}u; i++) {{"));
    code.add_line(&format!("waves[i] = evolve_wave(here, t + i * {second}u);"));
    code.add_line("}");
    code.add_line("for (var i = 0u; i < select(4u, 2u, z == z_opposite); i++) {");
    code.add_line("let pair = i & 1u;");
    code.add_line("let is_opposite = i > 1u;");
    code.add_line("let z_line = select(z, z_opposite, is_opposite);");
    code.add_line("let line = evolve_line(c, z_line);");
    code.add_line(&format!("let t_line = select(t, {second}u - t, is_opposite);"));
    let factors = code.add_twiddle_factors("t_line", first, n);
    let points = (0..first)
        .map(|i| {
            let wave = format!("rows_wave_or_opposite(waves[{i}], waves[{}], is_opposite)", first - 1 - i);
            let at = format!("(t_line + {}u) & {}u", i * second, n - 1);
            code.add_variable(&format!("evolve_packed_fields(pair, line, {at}, {wave})"))
        })
        .collect();
    code.add_line(&format!("let to = ((2u * c + pair) * {n}u + z_line) * {n}u + (t_line & {}u);", second - 1));
    for (k1, (v, factor)) in code.add_transform(points).into_iter().zip(factors).enumerate() {
        code.add_line(&format!("half_transforms[to + {}u] = fft_complex_mul({v}, {factor});", k1 as u32 * second));
    }
    code.add_line("}");
    code.finish()
}

fn rows_second(n: u32) -> String {
    let FftFactors { first_round_points: first, second_round_points: second } = FftFactors::new(n);
    let mut code = FunctionWriter::begin("rows_second(line: u32, k1: u32)");
    let points =
        (0..second).map(|n2| code.add_variable(&format!("half_transforms[line + k1 * {second}u + {n2}u]"))).collect();
    for (k2, v) in (0..).zip(code.add_transform(points)) {
        code.add_line(&format!("row_transforms[line + k1 + {}u] = {v};", k2 * first));
    }
    code.finish()
}

fn columns_first(n: u32) -> String {
    let FftFactors { first_round_points: first, second_round_points: second } = FftFactors::new(n);
    let mut code = FunctionWriter::begin("columns_first(column: u32, t: u32)");
    let factors = code.add_twiddle_factors("t", first, n);
    let points = (0..first)
        .map(|i| code.add_variable(&format!("row_transforms[column + (t + {}u) * {n}u]", i * second)))
        .collect();
    for (k1, (v, factor)) in code.add_transform(points).into_iter().zip(factors).enumerate() {
        let to = k1 as u32 * second;
        code.add_line(&format!("half_transforms[column + (t + {to}u) * {n}u] = fft_complex_mul({v}, {factor});"));
    }
    code.finish()
}

fn columns_second(n: u32) -> String {
    let FftFactors { first_round_points: first, second_round_points: second } = FftFactors::new(n);
    let mut code = FunctionWriter::begin("columns_second(layer: u32, layers: u32, x: u32, k1: u32)");
    code.add_line(&format!("let here = (layer * {n}u + k1 * {second}u) * {n}u + x;"));
    let points = (0..second).map(|n2| code.add_variable(&format!("half_transforms[here + {}u]", n2 * n))).collect();
    for (k2, v) in (0..).zip(code.add_transform(points)) {
        code.add_line(&format!("columns_store(layer, layers, x, k1 + {}u, {v});", k2 * first));
    }
    code.finish()
}

/// Builds the text of a WGSL function in which every intermediate value is a variable with its own name: `v1`, `v2` ...
struct FunctionWriter {
    text: String,
    values: u32,
}

impl FunctionWriter {
    fn begin(signature: &str) -> Self {
        Self { text: format!("fn {signature} {{\n"), values: 0 }
    }

    fn finish(self) -> String {
        self.text + "}\n"
    }

    fn add_line(&mut self, text: &str) {
        let _ = writeln!(self.text, "  {text}");
    }

    /// Adds to the function a WGSL variable with the value of `expression`, and returns the variable's name.
    fn add_variable(&mut self, expression: &str) -> String {
        self.values += 1;
        let name = format!("v{}", self.values);
        self.add_line(&format!("let {name} = {expression};"));
        name
    }

    /// Adds WGSL for the twiddle factors e^(2 pi i t k1 / n) of a thread for every k1 below `first`, and returns their
    /// variables' names. `t` is a WGSL expression of the thread's index in its line. From k1 = 2 on, each is a product
    /// of two earlier ones, so that rounding errors grow with log k1.
    fn add_twiddle_factors(&mut self, t: &str, first: u32, n: u32) -> Vec<String> {
        let mut factors = vec!["vec2f(1.0, 0.0)".to_owned()];
        factors.push(self.add_variable(&format!("twiddle_factors[{t} * {}u]", TWIDDLE_COUNT as u32 / n)));
        for k in 2..first as usize {
            let (a, b) = (&factors[k / 2], &factors[k - k / 2]);
            let product = format!("vec2f({a}.x * {b}.x - {a}.y * {b}.y, {a}.x * {b}.y + {a}.y * {b}.x)");
            factors.push(self.add_variable(&product));
        }
        factors
    }

    /// Adds WGSL for the inverse FFT of the values whose variables are named in `x`, vec4f of two complex numbers each.
    /// Returns the names of the variables with the results, in natural order.
    fn add_transform(&mut self, x: Vec<String>) -> Vec<String> {
        let n = x.len();
        match n {
            1 => x,
            2 => {
                let (a, b) = (&x[0], &x[1]);
                vec![self.add_variable(&format!("{a} + {b}")), self.add_variable(&format!("{a} - {b}"))]
            }
            4 => {
                let [a, b, c, d] = [&x[0], &x[1], &x[2], &x[3]];
                let (s0, s1) = (self.add_variable(&format!("{a} + {c}")), self.add_variable(&format!("{a} - {c}")));
                let (s2, e) = (self.add_variable(&format!("{b} + {d}")), self.add_variable(&format!("{b} - {d}")));
                let s3 = self.add_rotation(&e, 0.25);
                [(&s0, '+', &s2), (&s1, '+', &s3), (&s0, '-', &s2), (&s1, '-', &s3)]
                    .map(|(u, sign, w)| self.add_variable(&format!("{u} {sign} {w}")))
                    .to_vec()
            }
            _ => {
                // Four-point transforms of points n / 4 apart, twiddle factors, then transforms of n / 4 points.
                let m = n / 4;
                let mut rows: Vec<Vec<String>> = vec![Vec::new(); 4];
                for n2 in 0..m {
                    let quarter = (0..4).map(|i| x[n2 + m * i].clone()).collect();
                    for (k1, v) in self.add_transform(quarter).into_iter().enumerate() {
                        rows[k1].push(self.add_rotation(&v, (n2 * k1) as f64 / n as f64));
                    }
                }
                let parts: Vec<Vec<String>> = rows.into_iter().map(|row| self.add_transform(row)).collect();
                (0..n).map(|k| parts[k % 4][k / 4].clone()).collect()
            }
        }
    }

    /// Adds WGSL for the variable named `v` times e^(2 pi i turns), turns in \[0, 1). Returns the name of the product.
    fn add_rotation(&mut self, v: &str, turns: f64) -> String {
        if turns == 0.0 {
            return v.to_owned();
        }
        if turns == 0.25 {
            return self.add_variable(&format!("vec4f(-{v}.y, {v}.x, -{v}.w, {v}.z)"));
        }
        let (sin, cos) = (TAU * turns).sin_cos();
        self.add_variable(&format!("fft_complex_mul({v}, vec2f({cos:.9}, {sin:.9}))"))
    }
}
