//! Rewrites a shader so that it counts what it executes: every stretch of statements adds its cost to counters of the
//! function that it stands in.

use super::counter::{Count, Counted};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{
    Arena, Binding, Block, BuiltIn, Expression, Function, GlobalVariable, Handle, Literal, Module, Range, Span,
    Statement, SwitchCase, Type, TypeInner,
};

/// Override constants that are on for software adapters alone.
const OFF: [&str; 1] = ["SOFTWARE_ADAPTER"];
/// A shader that counts what one entry point executes.
pub struct Instrumented {
    pub text: String,
    /// Functions that the entry point reaches; a counter's index is the function's. The last is the entry point.
    pub functions: Vec<String>,
}

/// The count that a pixel shows: of operations or of reads, of the whole shader or of one function alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Index of the function; None for the whole shader.
    pub function: Option<usize>,
    /// Whether it shows texture reads, not operations.
    pub reads: bool,
}

impl Shown {
    /// The count that the pixel (x, y) shows, of a shader with `count` functions. Half of all pixels show counts of the
    /// whole shader.
    pub fn of([x, y]: [u32; 2], count: usize) -> Self {
        let mut v = x.wrapping_mul(747_796_405).wrapping_add(y.wrapping_mul(2_891_336_453));
        v = (v ^ (v >> 16)).wrapping_mul(2_246_822_519);
        let k = (v ^ (v >> 13)) as usize % (4 * count);
        Self { function: (k / 2).checked_sub(count), reads: k % 2 == 1 }
    }
}

/// What a fragment returns instead of its colour: the number that [`Shown`] selects in red and green, `tag` in blue.
/// All are multiples of 1/255, which textures of bytes and of half floats hold.
fn pixel_text(count: usize, tag: u8) -> String {
    format!(
        "var<private> counted: array<vec2f, {count}>;
        fn counted_result(at: vec4f) -> vec4f {{
          let pixel = vec2u(at.xy);
          var v = pixel.x * 747796405u + pixel.y * 2891336453u;
          v = (v ^ (v >> 16u)) * 2246822519u;
          let k = (v ^ (v >> 13u)) % {}u;
          var sum = vec2f(0.0);
          for (var i = 0u; i < {count}u; i++) {{
            sum += select(vec2f(0.0), counted[i], k / 2u < {count}u || i == k / 2u - {count}u);
          }}
          let number = u32(min(select(sum.x, sum.y, k % 2u == 1u), 65535.0));
          return vec4f(f32(number >> 8u), f32(number & 255u), {tag}.0, 255.0) / 255.0;
        }}",
        4 * count
    )
}

/// What a compute shader does at its end: it adds its counters to a buffer, whose last entry is the dearest thread.
fn thread_text(count: usize) -> String {
    format!(
        "var<private> counted: array<vec2f, {count}>;
        @group(2) @binding(0) var<storage, read_write> counted_sums: array<atomic<u32>>;
        fn counted_result() {{
          var sum = vec2f(0.0);
          for (var i = 0u; i < {count}u; i++) {{
            atomicAdd(&counted_sums[2u * i], u32(counted[i].x));
            atomicAdd(&counted_sums[2u * i + 1u], u32(counted[i].y));
            sum += counted[i];
          }}
          atomicMax(&counted_sums[2u * {count}u], u32(sum.x));
          atomicMax(&counted_sums[2u * {count}u + 1u], u32(sum.y));
        }}"
    )
}

/// Rewrites the fragment shader `entry` of a module, which returns a colour: it returns its counts instead. `tag` tells
/// the fragments of two shaders in one picture apart.
pub fn fragment(text: &str, entry: &str, tag: u8) -> Instrumented {
    instrumented(text, entry, |count| pixel_text(count, tag))
}

/// Rewrites the compute shader `entry` of a module: threads that reach its end add their counts to `counted_sums`.
pub fn compute(text: &str, entry: &str) -> Instrumented {
    instrumented(text, entry, thread_text)
}

pub fn parse(text: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).expect("a valid module");
    (module, info)
}

fn instrumented(text: &str, entry: &str, result: impl Fn(usize) -> String) -> Instrumented {
    let functions = reached(&parse(text).0, entry);
    let (mut module, info) = parse(&format!("{text}\n{}", result(functions.len())));
    let index = |name: Option<&str>| functions.iter().position(|known| Some(known.as_str()) == name);
    let globals = Globals::new(&module);
    for (handle, function) in module.functions.clone().iter() {
        if let Some(slot) = index(function.name.as_deref()) {
            let of = Counted { module: &module, function, info: &info[handle] };
            module.functions[handle] = Rewriter::new(of, &globals, slot, None).function();
        }
    }
    let at = module.entry_points.iter().position(|e| e.name == entry).expect("an entry point");
    let function = module.entry_points[at].function.clone();
    let of = Counted { module: &module, function: &function, info: info.get_entry_point(at) };
    let pixel = function.result.as_ref().map(|_| position_path(&module, &function));
    module.entry_points[at].function = Rewriter::new(of, &globals, functions.len() - 1, Some(pixel)).function();
    // Under other names, the structs are not declared once more when the text is completed.
    let structs = module.types.iter().filter(|(_, ty)| matches!(ty.inner, TypeInner::Struct { .. }));
    for (handle, ty) in structs.map(|(handle, ty)| (handle, ty.clone())).collect::<Vec<_>>() {
        if let Some(name) = ty.name.as_ref().filter(|name| !name.starts_with("__")) {
            module.types.replace(handle, Type { name: Some(format!("{name}Counted")), ..ty });
        }
    }
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module);
    let info = info.unwrap_or_else(|e| panic!("{e:?}"));
    let text = naga::back::wgsl::write_string(&module, &info, naga::back::wgsl::WriterFlags::empty()).expect("WGSL");
    Instrumented { text, functions }
}

/// Names of the functions that an entry point calls, directly or not, then its own.
fn reached(module: &Module, entry: &str) -> Vec<String> {
    fn visit(module: &Module, block: &Block, found: &mut Vec<String>) {
        for statement in block {
            match statement {
                Statement::Block(block) => visit(module, block, found),
                Statement::If { accept, reject, .. } => {
                    [accept, reject].into_iter().for_each(|b| visit(module, b, found));
                }
                Statement::Switch { cases, .. } => cases.iter().for_each(|case| visit(module, &case.body, found)),
                Statement::Loop { body, continuing, .. } => {
                    [body, continuing].into_iter().for_each(|b| visit(module, b, found));
                }
                Statement::Call { function, .. } => {
                    let name = module.functions[*function].name.clone().expect("a name");
                    if !found.contains(&name) {
                        found.push(name);
                        visit(module, &module.functions[*function].body, found);
                    }
                }
                _ => (),
            }
        }
    }
    let mut found = Vec::new();
    let entry = module.entry_points.iter().find(|e| e.name == entry).expect("an entry point");
    visit(module, &entry.function.body, &mut found);
    found.push(entry.name.clone());
    found
}

/// Where an entry point gets its pixel: the index of an argument, and of its member if it is a struct.
type PositionPath = (u32, Option<u32>);

fn position_path(module: &Module, function: &Function) -> PositionPath {
    let is_position = |binding: &Option<Binding>| matches!(binding, Some(Binding::BuiltIn(BuiltIn::Position { .. })));
    let path = (0..).zip(&function.arguments).find_map(|(i, argument)| match &module.types[argument.ty].inner {
        _ if is_position(&argument.binding) => Some((i, None)),
        TypeInner::Struct { members, .. } => {
            let member = members.iter().position(|member| is_position(&member.binding))?;
            Some((i, Some(member as u32)))
        }
        _ => None,
    });
    path.expect("a fragment shader with its position")
}

struct Globals {
    counted: Handle<GlobalVariable>,
    vec2f: Handle<Type>,
    result: Handle<Function>,
}

impl Globals {
    fn new(module: &Module) -> Self {
        let (counted, variable) =
            module.global_variables.iter().find(|(_, v)| v.name.as_deref() == Some("counted")).expect("the counters");
        let TypeInner::Array { base: vec2f, .. } = module.types[variable.ty].inner else { panic!("no array") };
        let result = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some("counted_result"));
        Self { counted, vec2f, result: result.expect("the result").0 }
    }
}

struct Rewriter<'a> {
    of: Counted<'a>,
    globals: &'a Globals,
    slot: usize,
    /// For an entry point: where it gets its pixel from; None inside for a compute shader.
    entry: Option<Option<PositionPath>>,
    expressions: Arena<Expression>,
}

impl<'a> Rewriter<'a> {
    fn new(of: Counted<'a>, globals: &'a Globals, slot: usize, entry: Option<Option<PositionPath>>) -> Self {
        let mut expressions = of.function.expressions.clone();
        for (_, expression) in expressions.iter_mut() {
            if let Expression::Override(handle) = *expression
                && of.module.overrides[handle].name.as_deref().is_some_and(|name| OFF.contains(&name))
            {
                *expression = Expression::Literal(Literal::Bool(false));
            }
        }
        Self { of, globals, slot, entry, expressions }
    }

    fn function(mut self) -> Function {
        let mut body = self.block(&self.of.function.body);
        if self.entry == Some(None) {
            let end = body.len() - usize::from(matches!(body.last(), Some(Statement::Return { .. })));
            let call = Statement::Call { function: self.globals.result, arguments: Vec::new(), result: None };
            body.splice(end..end, Block::from_vec(vec![call]));
        }
        Function { body, expressions: self.expressions, ..self.of.function.clone() }
    }

    fn block(&mut self, old: &Block) -> Block {
        let mut new = Block::new();
        let mut cost = Count::default();
        for (statement, span) in old.span_iter() {
            if let Statement::Emit(range) = statement {
                cost = range.clone().fold(cost, |sum, handle| sum + self.of.cost(handle));
            }
            let ends_stretch = matches!(
                statement,
                Statement::Block(_)
                    | Statement::If { .. }
                    | Statement::Switch { .. }
                    | Statement::Loop { .. }
                    | Statement::Return { .. }
                    | Statement::Break
                    | Statement::Continue
                    | Statement::Kill
            );
            if ends_stretch {
                self.add(std::mem::take(&mut cost), &mut new);
            }
            let statement = match statement {
                Statement::Block(block) => Statement::Block(self.block(block)),
                Statement::If { condition, accept, reject } => {
                    Statement::If { condition: *condition, accept: self.block(accept), reject: self.block(reject) }
                }
                Statement::Switch { selector, cases } => {
                    let case = |case: &SwitchCase| SwitchCase { body: self.block(&case.body), ..case.clone() };
                    Statement::Switch { selector: *selector, cases: cases.iter().map(case).collect() }
                }
                Statement::Loop { body, continuing, break_if } => {
                    Statement::Loop { body: self.block(body), continuing: self.block(continuing), break_if: *break_if }
                }
                Statement::Return { value: Some(_) } => match self.entry {
                    Some(Some(pixel)) => Statement::Return { value: Some(self.counts(pixel, &mut new)) },
                    _ => statement.clone(),
                },
                _ => statement.clone(),
            };
            new.push(statement, *span);
        }
        self.add(cost, &mut new);
        new
    }

    /// Adds statements that add `cost` to the function's counters.
    fn add(&mut self, cost: Count, to: &mut Block) {
        if cost == Count::default() {
            return;
        }
        let counted = self.append(Expression::GlobalVariable(self.globals.counted));
        let [ops, reads] =
            [cost.ops, cost.reads].map(|number| self.append(Expression::Literal(Literal::F32(number as f32))));
        let cost = self.append(Expression::Compose { ty: self.globals.vec2f, components: vec![ops, reads] });
        let pointer = self.append(Expression::AccessIndex { base: counted, index: self.slot as u32 });
        let before = self.append(Expression::Load { pointer });
        let op = naga::BinaryOperator::Add;
        let value = self.append(Expression::Binary { op, left: before, right: cost });
        to.push(Statement::Emit(Range::new_from_bounds(cost, value)), Span::UNDEFINED);
        to.push(Statement::Store { pointer, value }, Span::UNDEFINED);
    }

    /// The counts that a pixel shows.
    fn counts(&mut self, (argument, member): PositionPath, to: &mut Block) -> Handle<Expression> {
        let mut at = self.append(Expression::FunctionArgument(argument));
        if let Some(index) = member {
            at = self.append(Expression::AccessIndex { base: at, index });
            to.push(Statement::Emit(Range::new_from_bounds(at, at)), Span::UNDEFINED);
        }
        let result = self.append(Expression::CallResult(self.globals.result));
        let call = Statement::Call { function: self.globals.result, arguments: vec![at], result: Some(result) };
        to.push(call, Span::UNDEFINED);
        result
    }

    fn append(&mut self, expression: Expression) -> Handle<Expression> {
        self.expressions.append(expression, Span::UNDEFINED)
    }
}
