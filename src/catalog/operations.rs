//! Floating-point operations of a module, counted from its text.

use std::collections::BTreeMap;

use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{GlslStd450Op as G, Op};
use serde::{Deserialize, Serialize};

/// Operations of one evaluation: every component of a vector counts, a function as often as it is called, each loop's
/// body once and both sides of each branch. Sign changes, moves, comparisons and selections count nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Operations {
    /// Additions and multiplications; a multiply-add is two. Minimum, maximum and rounding are one each.
    pub flops: u64,
    pub divisions: u64,
    /// Square roots and their inverses.
    pub roots: u64,
    /// sin, cos, tan and their inverses.
    pub trigonometric: u64,
    /// exp, log and pow, to any base.
    pub exponential: u64,
    /// Loops in the text: with any, the count is too low by their turns.
    pub loops: u64,
    /// Branches in the text: with any, the count may be too high by the sides not taken.
    pub branches: u64,
}

impl Operations {
    fn add(&mut self, other: Operations) {
        self.flops += other.flops;
        self.divisions += other.divisions;
        self.roots += other.roots;
        self.trigonometric += other.trigonometric;
        self.exponential += other.exponential;
        self.loops += other.loops;
        self.branches += other.branches;
    }
}

/// Counts a module's operations from its entry point on.
pub(super) fn count(module: &Module) -> Operations {
    let counter = Counter::new(module);
    let entry = module.entry_points.first().and_then(|entry| entry.operands.get(1)?.id_ref_any());
    let Some(entry) = entry else {
        return Operations::default();
    };
    let mut total = counter.function(entry, &mut BTreeMap::new());
    // The generated main() returns early beyond the last configuration: no branch of the variant's.
    total.branches = total.branches.saturating_sub(1);
    total
}

/// Rows and columns of a value: a scalar is 1 x 1, a vector n x 1.
#[derive(Clone, Copy)]
struct Shape {
    rows: u64,
    columns: u64,
}

impl Shape {
    const SCALAR: Shape = Shape { rows: 1, columns: 1 };

    fn components(self) -> u64 {
        self.rows * self.columns
    }
}

struct Counter<'a> {
    functions: BTreeMap<u32, &'a Function>,
    shapes: BTreeMap<u32, Shape>,
    /// The type of every value.
    types: BTreeMap<u32, u32>,
}

impl<'a> Counter<'a> {
    fn new(module: &'a Module) -> Self {
        let mut shapes: BTreeMap<u32, Shape> = BTreeMap::new();
        for instruction in &module.types_global_values {
            let operand = |at: usize| match instruction.operands.get(at) {
                Some(Operand::IdRef(id) | Operand::LiteralBit32(id)) => *id,
                _ => 0,
            };
            let element = || shapes.get(&operand(0)).copied().unwrap_or(Shape::SCALAR);
            let shape = match instruction.class.opcode {
                Op::TypeVector => Shape { rows: u64::from(operand(1)), columns: 1 },
                Op::TypeMatrix => Shape { columns: u64::from(operand(1)), ..element() },
                _ => continue,
            };
            shapes.extend(instruction.result_id.map(|id| (id, shape)));
        }
        let types = module
            .all_inst_iter()
            .filter_map(|instruction| Some((instruction.result_id?, instruction.result_type?)))
            .collect();
        let functions = module
            .functions
            .iter()
            .filter_map(|function| Some((function.def.as_ref()?.result_id?, function)))
            .collect();
        Counter { functions, shapes, types }
    }

    /// GLSL has no recursion, so this ends; `known` keeps it from counting a function again at each call.
    fn function(&self, id: u32, known: &mut BTreeMap<u32, Operations>) -> Operations {
        if let Some(known) = known.get(&id) {
            return *known;
        }
        let mut total = Operations::default();
        let instructions = self.functions.get(&id).into_iter().flat_map(|function| function.all_inst_iter());
        for instruction in instructions {
            match instruction.class.opcode {
                Op::FunctionCall => {
                    let callee = instruction.operands.first().and_then(Operand::id_ref_any);
                    total.add(callee.map_or_else(Operations::default, |callee| self.function(callee, known)));
                }
                _ => total.add(self.instruction(instruction)),
            }
        }
        known.insert(id, total);
        total
    }

    fn shape_of_type(&self, id: Option<u32>) -> Shape {
        id.and_then(|id| self.shapes.get(&id)).copied().unwrap_or(Shape::SCALAR)
    }

    fn operand(&self, instruction: &Instruction, at: usize) -> Shape {
        let id = instruction.operands.get(at).and_then(Operand::id_ref_any);
        self.shape_of_type(id.and_then(|id| self.types.get(&id)).copied())
    }

    fn instruction(&self, instruction: &Instruction) -> Operations {
        let result = self.shape_of_type(instruction.result_type);
        let n = result.components();
        let flops = |flops| Operations { flops, ..Operations::default() };
        let dot = |n: u64| 2 * n - 1;
        match instruction.class.opcode {
            Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::OuterProduct => flops(n),
            Op::FDiv => Operations { divisions: n, ..Operations::default() },
            // x - y * floor(x / y)
            Op::FMod | Op::FRem => Operations { flops: 3 * n, divisions: n, ..Operations::default() },
            Op::Dot => flops(dot(self.operand(instruction, 0).rows)),
            Op::MatrixTimesVector | Op::MatrixTimesMatrix => {
                flops(n * dot(self.operand(instruction, 0).columns))
            }
            Op::VectorTimesMatrix => flops(n * dot(self.operand(instruction, 0).rows)),
            Op::LoopMerge => Operations { loops: 1, ..Operations::default() },
            Op::SelectionMerge => Operations { branches: 1, ..Operations::default() },
            Op::ExtInst => self.extended(instruction, n),
            _ => Operations::default(),
        }
    }

    fn extended(&self, instruction: &Instruction, n: u64) -> Operations {
        let Some(Operand::LiteralExtInstInteger(number)) = instruction.operands.get(1) else {
            return Operations::default();
        };
        let none = Operations::default();
        let flops = |flops| Operations { flops, ..none };
        // The first argument's components: what length and normalize sum over.
        let m = self.operand(instruction, 2).components();
        match G::from_u32(*number) {
            Some(G::FMin | G::FMax | G::NMin | G::NMax | G::Floor | G::Ceil | G::Trunc | G::Round) => {
                flops(n)
            }
            Some(G::RoundEven | G::Fract | G::Step | G::Radians | G::Degrees | G::Ldexp) => flops(n),
            Some(G::FClamp | G::NClamp | G::Fma) => flops(2 * n),
            // x (1 - a) + y a
            Some(G::FMix) => flops(4 * n),
            // t = clamp((x - e0) / (e1 - e0)), t t (3 - 2 t)
            Some(G::SmoothStep) => Operations { flops: 8 * n, divisions: n, ..none },
            Some(G::Cross) => flops(9),
            Some(G::Reflect) => flops(4 * m),
            Some(G::Sqrt | G::InverseSqrt) => Operations { roots: n, ..none },
            Some(G::Length) => Operations { flops: 2 * m - 1, roots: 1, ..none },
            Some(G::Distance) => Operations { flops: 3 * m - 1, roots: 1, ..none },
            Some(G::Normalize) => Operations { flops: 3 * m - 1, roots: 1, ..none },
            // Of 3 x 3: a triple product; its inverse: nine cofactors and a scaling.
            Some(G::Determinant) => flops(14),
            Some(G::MatrixInverse) => Operations { flops: 41, divisions: 1, ..none },
            Some(
                G::Sin
                | G::Cos
                | G::Tan
                | G::Asin
                | G::Acos
                | G::Atan
                | G::Atan2
                | G::Sinh
                | G::Cosh
                | G::Tanh
                | G::Asinh
                | G::Acosh
                | G::Atanh,
            ) => Operations { trigonometric: n, ..none },
            Some(G::Exp | G::Exp2 | G::Log | G::Log2 | G::Pow) => Operations { exponential: n, ..none },
            _ => none,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{Field, Signature, Type, Variant};

    fn operations(body: &str) -> Operations {
        let signature = Signature {
            function: "f",
            parameters: vec![Field::new("m", Type::Mat3), Field::new("v", Type::Vec3)],
            results: vec![Field::new("r", Type::Vec3)],
        };
        Variant::generated("f", "test", "test", body.to_owned())
            .compile(&signature, false)
            .unwrap()
            .facts
            .operations
    }

    /// Counted by hand.
    #[test]
    fn components_count() {
        let none = Operations::default();
        for (body, expected) in [
            ("return v;", none),
            ("return -v;", none),
            ("return v + v;", Operations { flops: 3, ..none }),
            ("return v * 2.0;", Operations { flops: 3, ..none }),
            ("return v / v.x;", Operations { divisions: 3, ..none }),
            ("return vec3(dot(v, v));", Operations { flops: 5, ..none }),
            ("return m * v;", Operations { flops: 15, ..none }),
            ("return v * m;", Operations { flops: 15, ..none }),
            ("return (m * m)[0];", Operations { flops: 45, ..none }),
            ("return vec3(length(v.xy));", Operations { flops: 3, roots: 1, ..none }),
            ("return normalize(v);", Operations { flops: 8, roots: 1, ..none }),
            ("return fma(v, v, v);", Operations { flops: 6, ..none }),
            ("return cross(v, m[0]);", Operations { flops: 9, ..none }),
            ("return sin(v) + pow(v, v);", Operations { flops: 3, trigonometric: 3, exponential: 3, ..none }),
            ("return sqrt(v) * inversesqrt(v.x);", Operations { flops: 3, roots: 4, ..none }),
        ] {
            assert_eq!(operations(&format!("vec3 f(mat3 m, vec3 v) {{ {body} }}")), expected, "{body}");
        }
    }

    #[test]
    fn functions_count_as_often_as_they_are_called() {
        let counted = operations(
            "float g(float x) { return x * x + 1.0; }\n\
             float h(float x) { return g(x) * g(x + 1.0); }\n\
             float unused(float x) { return sin(x); }\n\
             vec3 f(mat3 m, vec3 v) { return vec3(h(v.x), h(v.y), g(v.z)); }",
        );
        assert_eq!(counted, Operations { flops: 2 * (2 * 2 + 2) + 2, ..Operations::default() });
    }

    #[test]
    fn loops_and_branches_are_told() {
        let counted = operations(
            "vec3 f(mat3 m, vec3 v) { for (int k = 0; k < 9; ++k) v += m[0]; if (v.x > 1.0) v = v / v.x; return v; }",
        );
        assert_eq!(
            counted,
            Operations { flops: 3, divisions: 3, loops: 1, branches: 1, ..Operations::default() }
        );
    }
}
