//! The cost of a shader's expressions: operations and texture reads.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, Statement, TypeInner};

/// Cost of a transcendental function, root or quotient in additions.
const SPECIAL: f64 = 4.0;

/// Operations and texture reads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    pub ops: f64,
    pub reads: f64,
}

impl std::ops::Add for Count {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { ops: self.ops + other.ops, reads: self.reads + other.reads }
    }
}

impl From<[f64; 2]> for Count {
    fn from([ops, reads]: [f64; 2]) -> Self {
        Self { ops, reads }
    }
}

impl Count {
    pub fn max(self, other: Self) -> Self {
        Self { ops: self.ops.max(other.ops), reads: self.reads.max(other.reads) }
    }
}

/// The cost of an entry point of a module without loops; of branches, that of the dearest.
pub fn without_loops(module: &Module, info: &ModuleInfo, entry: &str) -> Count {
    fn block(of: Counted<'_>, all: &ModuleInfo, statements: &Block) -> Count {
        let count = |inner| block(of, all, inner);
        statements.iter().fold(Count::default(), |sum, statement| match statement {
            Statement::Emit(range) => range.clone().fold(sum, |sum, handle| sum + of.cost(handle)),
            Statement::Block(inner) => sum + count(inner),
            Statement::If { accept, reject, .. } => sum + count(accept).max(count(reject)),
            Statement::Switch { cases, .. } => {
                sum + cases.iter().fold(Count::default(), |most, case| most.max(count(&case.body)))
            }
            Statement::Loop { .. } => panic!("{:?} has a loop", of.function.name),
            Statement::Call { function, .. } => {
                let callee = &of.module.functions[*function];
                sum + block(Counted { function: callee, info: &all[*function], ..of }, all, &callee.body)
            }
            _ => sum,
        })
    }
    let at = module.entry_points.iter().position(|e| e.name == entry).expect("an entry point");
    let function = &module.entry_points[at].function;
    block(Counted { module, function, info: info.get_entry_point(at) }, info, &function.body)
}

/// A function of a module, whose expressions can be counted.
#[derive(Clone, Copy)]
pub struct Counted<'a> {
    pub module: &'a Module,
    pub function: &'a Function,
    pub info: &'a FunctionInfo,
}

impl Counted<'_> {
    fn inner(&self, handle: Handle<Expression>) -> &TypeInner {
        self.info[handle].ty.inner_with(&self.module.types)
    }

    /// Whether an expression has its value when the pipeline is compiled.
    fn is_fixed(&self, handle: Handle<Expression>) -> bool {
        match self.function.expressions[handle] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::Override(_) | Expression::ZeroValue(_) => {
                true
            }
            Expression::Unary { expr, .. } => self.is_fixed(expr),
            Expression::Binary { left, right, .. } => self.is_fixed(left) && self.is_fixed(right),
            _ => false,
        }
    }

    /// The cost of one expression, without that of its operands.
    pub fn cost(&self, handle: Handle<Expression>) -> Count {
        let wide = width(self.inner(handle));
        let of = |handle| width(self.inner(handle));
        let ops = match self.function.expressions[handle] {
            _ if self.is_fixed(handle) => 0.0,
            Expression::ImageSample { .. } | Expression::ImageLoad { .. } => return Count { ops: 0.0, reads: 1.0 },
            Expression::Binary { op: BinaryOperator::Divide | BinaryOperator::Modulo, .. } => wide * (SPECIAL + 1.0),
            Expression::Binary { op: BinaryOperator::Multiply, left, right } => {
                match (self.inner(left), self.inner(right)) {
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
        Count { ops, reads: 0.0 }
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
