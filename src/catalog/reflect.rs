//! Facts read from SPIR-V, and the NoContraction decoration.

use std::collections::BTreeMap;

use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module, Operand, load_words};
use rspirv::spirv::{Decoration, ExecutionMode, GlslStd450Op, Op};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::operations::{self, Operations};

/// What a module says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Facts {
    /// SHA-256 of the module's words in little-endian order, hexadecimal.
    pub sha256: String,
    pub words: usize,
    pub local_size: [u32; 3],
    pub capabilities: Vec<String>,
    /// Floating-point instructions in the text (not: executed), by name; extended instructions as `ext.Sqrt`.
    pub float_operations: BTreeMap<String, usize>,
    /// Arithmetic instructions that may not be contracted or rearranged, and how many there are in all.
    pub no_contraction: usize,
    pub arithmetic: usize,
    /// Operations of one evaluation, as far as the text tells.
    #[serde(default)]
    pub operations: Operations,
}

/// Reads the facts of a module that glslang made.
pub(super) fn facts(words: &[u32]) -> Result<Facts, String> {
    let module = load(words)?;
    let mut local_size = [1; 3];
    for mode in &module.execution_modes {
        if mode.operands.get(1) == Some(&Operand::ExecutionMode(ExecutionMode::LocalSize)) {
            for (size, operand) in local_size.iter_mut().zip(&mode.operands[2..]) {
                if let Operand::LiteralBit32(value) = operand {
                    *size = *value;
                }
            }
        }
    }
    let capabilities =
        module.capabilities.iter().filter_map(|instruction| match instruction.operands.first() {
            Some(Operand::Capability(capability)) => Some(format!("{capability:?}")),
            _ => None,
        });
    let mut float_operations = BTreeMap::new();
    let mut arithmetic = 0;
    for instruction in instructions(&module) {
        if let Some(name) = float_operation(instruction) {
            *float_operations.entry(name).or_insert(0) += 1;
        }
        arithmetic += usize::from(may_contract(instruction.class.opcode));
    }
    let no_contraction =
        module.annotations.iter().filter(|annotation| decorates_no_contraction(annotation)).count();
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    Ok(Facts {
        sha256: Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect(),
        words: words.len(),
        local_size,
        capabilities: capabilities.collect(),
        float_operations,
        no_contraction,
        arithmetic,
        operations: operations::count(&module),
    })
}

/// Decorates every floating-point arithmetic instruction NoContraction: what `precise` on every variable would do.
pub(super) fn forbid_contraction(words: &[u32]) -> Result<Vec<u32>, String> {
    let mut module = load(words)?;
    let decorated: Vec<u32> = module
        .annotations
        .iter()
        .filter(|annotation| decorates_no_contraction(annotation))
        .filter_map(|annotation| annotation.operands.first().and_then(Operand::id_ref_any))
        .collect();
    let results: Vec<u32> = instructions(&module)
        .filter(|instruction| may_contract(instruction.class.opcode))
        .filter_map(|instruction| instruction.result_id)
        .filter(|id| !decorated.contains(id))
        .collect();
    module.annotations.extend(results.into_iter().map(|id| {
        let operands = vec![Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)];
        Instruction::new(Op::Decorate, None, None, operands)
    }));
    Ok(module.assemble())
}

/// The module with its entry point of one name called by another.
pub(super) fn rename_entry_point(words: &[u32], from: &str, to: &str) -> Result<Vec<u32>, String> {
    let mut module = load(words)?;
    for operand in module.entry_points.iter_mut().flat_map(|entry| &mut entry.operands) {
        if *operand == Operand::LiteralString(from.to_owned()) {
            *operand = Operand::LiteralString(to.to_owned());
        }
    }
    Ok(module.assemble())
}

fn load(words: &[u32]) -> Result<Module, String> {
    load_words(words).map_err(|error| format!("SPIR-V: {error}"))
}

fn instructions(module: &Module) -> impl Iterator<Item = &Instruction> {
    module.functions.iter().flat_map(|function| function.all_inst_iter())
}

fn decorates_no_contraction(annotation: &Instruction) -> bool {
    annotation.operands.get(1) == Some(&Operand::Decoration(Decoration::NoContraction))
}

/// Instructions to which the SPIR-V specification lets NoContraction apply, among the floating-point ones.
fn may_contract(opcode: Op) -> bool {
    matches!(
        opcode,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::FDiv
            | Op::FRem
            | Op::FMod
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::VectorTimesMatrix
            | Op::MatrixTimesVector
            | Op::MatrixTimesMatrix
            | Op::OuterProduct
            | Op::Dot
    )
}

fn float_operation(instruction: &Instruction) -> Option<String> {
    if may_contract(instruction.class.opcode) {
        return Some(format!("{:?}", instruction.class.opcode));
    }
    if instruction.class.opcode == Op::ExtInst
        && let Some(Operand::LiteralExtInstInteger(number)) = instruction.operands.get(1)
    {
        return Some(
            GlslStd450Op::from_u32(*number)
                .map_or_else(|| format!("ext.{number}"), |op| format!("ext.{op:?}")),
        );
    }
    None
}
