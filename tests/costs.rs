//! Compares the costs of the picture's passes (src/bench/cost.rs) with the shaders: counts their expressions, each loop
//! with its largest number of iterations.

mod common;

use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{BinaryOperator, Expression, Function, MathFunction, Module, Override, Statement, TypeInner};
use seastate::bench::cost;
use seastate::waves::tiling::MEAN_BLENDED_COPIES;

/// Cost of a transcendental function, root or quotient in additions.
const SPECIAL: f64 = 4.0;

/// Iterations of the loops of a function, in their order. The sea has four cascades, one of them with ripples; the
/// pixel takes no slopes from the mesh, and its maps are neither magnified nor distant.
fn trips(function: &str) -> &'static [f64] {
    match function {
        "water_displacement" => &[4.0, MEAN_BLENDED_COPIES],
        "water_slope_with_carried" => &[5.0],
        "water_add_waves" => &[MEAN_BLENDED_COPIES],
        "water_gradient_mean" | "foam_level" => &[3.0],
        "water_slope_moments" => &[2.0],
        "water_mirror_among" => &[8.0],
        "water_glitter" => &[2.0],
        "foam_map_sample" | "foam_appearance" => &[4.0],
        _ => &[],
    }
}

/// Whether the branches of a function are those for maps that are magnified or distant.
fn branches_off(function: &str) -> bool {
    matches!(function, "water_gradient_mean" | "water_sampling")
}

/// Whether the default picture has a part.
fn has(part: &Override) -> bool {
    matches!(part.name.as_deref(), Some("WATER_FOAM" | "TONE_SMOOTH"))
}

#[derive(Clone, Copy, Default)]
struct Count {
    flops: f64,
    reads: f64,
}

impl Count {
    fn plus(self, other: Self, times: f64) -> Self {
        Self { flops: self.flops + times * other.flops, reads: self.reads + times * other.reads }
    }

    fn max(self, other: Self) -> Self {
        Self { flops: self.flops.max(other.flops), reads: self.reads.max(other.reads) }
    }
}

struct Counter<'a> {
    module: &'a Module,
    info: &'a naga::valid::ModuleInfo,
}

struct Body<'a> {
    function: &'a Function,
    info: &'a FunctionInfo,
    loops: std::slice::Iter<'static, f64>,
}

impl Counter<'_> {
    fn function(&self, function: &Function, info: &FunctionInfo) -> Count {
        let loops = trips(function.name.as_deref().unwrap_or_default()).iter();
        let mut body = Body { function, info, loops };
        let count = self.block(&function.body, &mut body);
        assert!(body.loops.next().is_none(), "{:?} has fewer loops than that", function.name);
        count
    }

    fn block(&self, block: &naga::Block, body: &mut Body<'_>) -> Count {
        block.iter().fold(Count::default(), |sum, statement| sum.plus(self.statement(statement, body), 1.0))
    }

    fn statement(&self, statement: &Statement, body: &mut Body<'_>) -> Count {
        match statement {
            Statement::Emit(range) => range.clone().fold(Count::default(), |sum, handle| {
                sum.plus(
                    self.expression(body, &body.function.expressions[handle], width(self.inner(body, handle))),
                    1.0,
                )
            }),
            Statement::Block(block) => self.block(block, body),
            Statement::If { condition, accept, reject } => {
                let branches = [accept, reject].map(|block| self.block(block, body));
                match body.function.expressions[*condition] {
                    Expression::Override(part) => branches[usize::from(!has(&self.module.overrides[part]))],
                    _ if branches_off(body.function.name.as_deref().unwrap_or_default()) => branches[1],
                    _ => branches[0].max(branches[1]),
                }
            }
            Statement::Switch { cases, .. } => {
                cases.iter().map(|case| self.block(&case.body, body)).fold(Count::default(), Count::max)
            }
            Statement::Loop { body: inner, continuing, .. } => {
                let times = *body.loops.next().unwrap_or_else(|| panic!("how often? {:?}", body.function.name));
                let once = self.block(inner, body);
                let next = self.block(continuing, body);
                Count::default().plus(once, times).plus(next, times)
            }
            Statement::Call { function, .. } => self.function(&self.module.functions[*function], &self.info[*function]),
            _ => Count::default(),
        }
    }

    fn inner<'b>(&'b self, body: &'b Body<'_>, handle: naga::Handle<Expression>) -> &'b TypeInner {
        body.info[handle].ty.inner_with(&self.module.types)
    }

    /// The cost of an expression whose value has `wide` components.
    fn expression(&self, body: &Body<'_>, expression: &Expression, wide: f64) -> Count {
        let of = |handle| width(self.inner(body, handle));
        let flops = match *expression {
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } => return Count { flops: 0.0, reads: 1.0 },
            Expression::Binary { op: BinaryOperator::Divide | BinaryOperator::Modulo, .. } => wide * (SPECIAL + 1.0),
            Expression::Binary { op: BinaryOperator::Multiply, left, right } => {
                match (self.inner(body, left), self.inner(body, right)) {
                    (TypeInner::Matrix { columns, rows, .. }, TypeInner::Vector { .. }) => {
                        f64::from(*columns as u8) * f64::from(*rows as u8) * 2.0
                    }
                    _ => wide,
                }
            }
            Expression::Binary { left, .. } => wide.max(of(left)),
            Expression::Select { .. } | Expression::As { .. } => wide,
            Expression::Derivative { .. } => 2.0 * wide,
            Expression::Relational { argument, .. } => of(argument),
            Expression::Math { fun, arg, .. } => math(fun, wide, of(arg)),
            _ => 0.0,
        };
        Count { flops, reads: 0.0 }
    }
}

fn width(inner: &TypeInner) -> f64 {
    match inner {
        TypeInner::Vector { size, .. } => f64::from(*size as u8),
        _ => 1.0,
    }
}

/// Operations of a function whose value has `wide` components and whose first argument has `of`.
fn math(fun: MathFunction, wide: f64, of: f64) -> f64 {
    use MathFunction as M;
    match fun {
        M::Saturate => 0.0,
        M::Clamp | M::Fma | M::Mix | M::Sign => 2.0 * wide,
        M::SmoothStep => (SPECIAL + 7.0) * wide,
        M::Exp | M::Exp2 | M::Log | M::Log2 | M::Sqrt | M::InverseSqrt | M::Sin | M::Cos => (SPECIAL + 1.0) * wide,
        M::Pow => (2.0 * SPECIAL + 1.0) * wide,
        M::Tan => 3.0 * SPECIAL * wide,
        M::Asin | M::Acos | M::Atan | M::Atan2 => (2.0 * SPECIAL + 8.0) * wide,
        M::Dot => 2.0 * of - 1.0,
        M::Length | M::Distance => 2.0 * of + SPECIAL,
        M::Normalize => 3.0 * of + SPECIAL,
        M::Cross => 9.0,
        M::Reflect => 4.0 * of,
        M::Refract => 6.0 * of + SPECIAL,
        _ => wide,
    }
}

fn count(module: &str, entry: &str) -> Count {
    let (_, text) = common::wgsl::shaders().all().find(|(name, _)| *name == module).expect("a module");
    let parsed = naga::front::wgsl::parse_str(&text).expect("a valid module");
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&parsed).expect("a valid module");
    let at = parsed.entry_points.iter().position(|e| e.name == entry).expect("an entry point");
    Counter { module: &parsed, info: &info }.function(&parsed.entry_points[at].function, info.get_entry_point(at))
}

#[test]
fn the_budget_of_the_picture_is_that_of_its_shaders() {
    let of = [
        ("water/displace", "main", cost::DISPLACE_VERTEX_COST),
        ("water/light", "mesh_vertex", cost::MESH_VERTEX_COST),
        ("water/light", "mesh_fragment", cost::MESH_FRAGMENT_COST),
        ("water/light", "light_fragment", cost::LIGHT_FRAGMENT_COST),
        ("sky/background", "fragment", cost::BACKGROUND_FRAGMENT_COST),
        ("film/tone", "fragment", cost::TONE_FRAGMENT_COST),
        ("film/present", "fragment", cost::PRESENT_FRAGMENT_COST),
    ];
    let mut wrong = Vec::new();
    for (module, entry, budget) in of {
        let Count { flops, reads } = count(module, entry);
        eprintln!("{module}, {entry}: {flops:.0} flops, {reads:.1} reads; the budget has {budget:?}");
        if (flops / budget.flops - 1.0).abs() > 0.05 || (reads - budget.texture_reads).abs() > 0.6 {
            wrong.push((module, entry));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
