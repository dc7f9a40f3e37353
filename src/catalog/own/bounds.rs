//! Keeps what a shader indexes within its own arrays, and says so where it did not.
//!
//! An index that only running can tell is clamped, lest the driver reads or writes somebody else's memory, and the
//! invocation remembers which one it was: every result then is a NaN that no arithmetic makes
//! ([`trap_of`](crate::catalog::kernel::trap_of)), with that number in it.

use std::collections::BTreeMap;

use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Op, StorageClass, Word};

use crate::catalog::kernel::{MAX_TRAPS, trap_bits};

/// The module with its indices in bounds, and for each number the place in the source, as `file:line` where the module
/// tells. Unchanged if there is nothing to watch.
pub(super) fn watch(words: &[u32]) -> Result<(Vec<u32>, Vec<String>), String> {
    let mut module = rspirv::dr::load_words(words).map_err(|error| error.to_string())?;
    let mut watch = Watch::new(&module);
    let mut functions = std::mem::take(&mut module.functions);
    for function in &mut functions {
        let mut place = String::new();
        for block in &mut function.blocks {
            let mut guarded = Vec::with_capacity(block.instructions.len());
            for mut instruction in std::mem::take(&mut block.instructions) {
                watch.line(&instruction, &mut place);
                if matches!(instruction.class.opcode, Op::AccessChain | Op::InBoundsAccessChain) {
                    watch.guard(&mut instruction, &place, &mut guarded)?;
                }
                guarded.push(instruction);
            }
            block.instructions = guarded;
        }
    }
    if watch.places.is_empty() {
        return Ok((words.to_vec(), Vec::new()));
    }
    // Nothing but the generated part stores to memory outside.
    for block in functions.iter_mut().flat_map(|function| &mut function.blocks) {
        let mut stored = Vec::with_capacity(block.instructions.len());
        for mut instruction in std::mem::take(&mut block.instructions) {
            if instruction.class.opcode == Op::Store {
                watch.mark(&mut instruction, &mut stored);
            }
            stored.push(instruction);
        }
        block.instructions = stored;
    }
    module.functions = functions;
    module.types_global_values.extend(watch.declared);
    if let Some(header) = &mut module.header {
        header.bound = watch.next;
    }
    Ok((module.assemble(), watch.places))
}

/// What is known of a module, and what it is going to be given.
struct Watch {
    next: Word,
    declared: Vec<Instruction>,
    places: Vec<String>,
    /// By identifier: what declares a type or constant.
    globals: BTreeMap<Word, Instruction>,
    /// By identifier: its type.
    types: BTreeMap<Word, Word>,
    strings: BTreeMap<Word, String>,
    uint: Word,
    boolean: Word,
    float: Option<Word>,
    constants: BTreeMap<u32, Word>,
    /// The variable that holds the number of the last index out of bounds, from 1, or 0; declared when first needed.
    flag: Option<Word>,
}

impl Watch {
    fn new(module: &Module) -> Watch {
        let globals: BTreeMap<Word, Instruction> =
            module.types_global_values.iter().filter_map(|i| Some((i.result_id?, i.clone()))).collect();
        let types = module.all_inst_iter().filter_map(|i| Some((i.result_id?, i.result_type?))).collect();
        let strings = module.debug_string_source.iter().filter_map(|i| match i.operands.as_slice() {
            [Operand::LiteralString(text)] if i.class.opcode == Op::String => {
                Some((i.result_id?, text.clone()))
            }
            _ => None,
        });
        let mut watch = Watch {
            next: module.header.as_ref().map_or(0, |header| header.bound),
            declared: Vec::new(),
            places: Vec::new(),
            types,
            strings: strings.collect(),
            uint: 0,
            boolean: 0,
            float: None,
            constants: BTreeMap::new(),
            flag: None,
            globals,
        };
        let literal = |bits, sign| vec![Operand::LiteralBit32(bits), Operand::LiteralBit32(sign)];
        watch.float = watch.find(|i| {
            i.class.opcode == Op::TypeFloat && i.operands.first() == Some(&Operand::LiteralBit32(32))
        });
        let uint = watch.find(|i| i.class.opcode == Op::TypeInt && i.operands == literal(32, 0));
        watch.uint = uint.unwrap_or_else(|| watch.declare(Op::TypeInt, None, literal(32, 0)));
        let boolean = watch.find(|i| i.class.opcode == Op::TypeBool);
        watch.boolean = boolean.unwrap_or_else(|| watch.declare(Op::TypeBool, None, vec![]));
        watch
    }

    fn find(&self, is: impl Fn(&Instruction) -> bool) -> Option<Word> {
        self.globals.iter().find(|(_, instruction)| is(instruction)).map(|(id, _)| *id)
    }

    fn fresh(&mut self) -> Word {
        self.next += 1;
        self.next - 1
    }

    fn declare(&mut self, opcode: Op, ty: Option<Word>, operands: Vec<Operand>) -> Word {
        let id = self.fresh();
        self.declared.push(Instruction::new(opcode, ty, Some(id), operands));
        id
    }

    fn constant(&mut self, value: u32) -> Word {
        if let Some(id) = self.constants.get(&value) {
            return *id;
        }
        let id = self.declare(Op::Constant, Some(self.uint), vec![Operand::LiteralBit32(value)]);
        self.constants.insert(value, id);
        id
    }

    fn flag(&mut self) -> Word {
        if let Some(flag) = self.flag {
            return flag;
        }
        let private = Operand::StorageClass(StorageClass::Private);
        let same = vec![private.clone(), Operand::IdRef(self.uint)];
        let known = self.find(|i| i.class.opcode == Op::TypePointer && i.operands == same);
        let pointer = known.unwrap_or_else(|| self.declare(Op::TypePointer, None, same));
        let zero = self.constant(0);
        let flag = self.declare(Op::Variable, Some(pointer), vec![private, Operand::IdRef(zero)]);
        self.flag = Some(flag);
        flag
    }

    /// Follows the source lines that the module tells.
    fn line(&self, instruction: &Instruction, place: &mut String) {
        if let (Op::Line, [Operand::IdRef(file), Operand::LiteralBit32(line), _]) =
            (instruction.class.opcode, instruction.operands.as_slice())
        {
            let file = self.strings.get(file).map_or("", String::as_str);
            *place = format!("{file}:{line}");
        }
    }

    /// Clamps the indices of one access into the shader's own variables.
    fn guard(
        &mut self,
        access: &mut Instruction,
        place: &str,
        before: &mut Vec<Instruction>,
    ) -> Result<(), String> {
        let Some(base) = access.operands.first().and_then(Operand::id_ref_any) else {
            return Ok(());
        };
        let pointer = self.types.get(&base).and_then(|ty| self.globals.get(ty));
        let mut pointee = match pointer.map(|pointer| pointer.operands.as_slice()) {
            Some(
                [Operand::StorageClass(StorageClass::Function | StorageClass::Private), Operand::IdRef(ty)],
            ) => *ty,
            _ => return Ok(()),
        };
        for position in 1..access.operands.len() {
            let Some(index) = access.operands[position].id_ref_any() else {
                return Ok(());
            };
            let constant = self.value(index);
            let Some(ty) = self.globals.get(&pointee).cloned() else {
                return Ok(());
            };
            let inner = |at: usize| ty.operands.get(at).and_then(Operand::id_ref_any);
            let length = match (ty.class.opcode, ty.operands.get(1)) {
                (Op::TypeStruct, _) => {
                    let member = constant.and_then(|member| inner(member as usize));
                    let Some(member) = member else {
                        return Ok(());
                    };
                    pointee = member;
                    continue;
                }
                (Op::TypeVector | Op::TypeMatrix, Some(Operand::LiteralBit32(length))) => Some(*length),
                (Op::TypeArray, Some(Operand::IdRef(length))) => self.value(*length),
                _ => None,
            };
            let (Some(length), Some(next)) = (length, inner(0)) else {
                return Ok(());
            };
            pointee = next;
            match constant {
                Some(index) if index >= length => {
                    return Err(format!("{place}: index {index} of an array of {length}"));
                }
                Some(_) => {}
                None => access.operands[position] = Operand::IdRef(self.clamp(index, length, place, before)),
            }
        }
        Ok(())
    }

    /// The value of an integer constant.
    fn value(&self, id: Word) -> Option<u32> {
        match self.globals.get(&id) {
            Some(constant) if constant.class.opcode == Op::Constant => match constant.operands.first() {
                Some(Operand::LiteralBit32(value)) => Some(*value),
                _ => None,
            },
            _ => None,
        }
    }

    /// The index, or the last one there is; then the flag is set.
    fn clamp(&mut self, index: Word, length: u32, place: &str, before: &mut Vec<Instruction>) -> Word {
        let known = self.places.iter().position(|known| known == place);
        let number = known.unwrap_or_else(|| {
            // What does not fit shares the last number.
            if self.places.len() < MAX_TRAPS {
                self.places.push(place.to_owned());
            }
            self.places.len() - 1
        });
        let (uint, boolean) = (self.uint, self.boolean);
        let (last, flag, number) = (self.constant(length - 1), self.flag(), self.constant(number as u32 + 1));
        let mut emit = |watch: &mut Self, opcode, ty, operands: &[Word]| {
            let id = watch.fresh();
            let operands = operands.iter().map(|id| Operand::IdRef(*id)).collect();
            before.push(Instruction::new(opcode, Some(ty), Some(id), operands));
            id
        };
        let signed = self.types.get(&index).copied() != Some(uint);
        let index = if signed { emit(self, Op::Bitcast, uint, &[index]) } else { index };
        let beyond = emit(self, Op::UGreaterThan, boolean, &[index, last]);
        let safe = emit(self, Op::Select, uint, &[beyond, last, index]);
        let old = emit(self, Op::Load, uint, &[flag]);
        let new = emit(self, Op::Select, uint, &[beyond, number, old]);
        before.push(Instruction::new(Op::Store, None, None, vec![Operand::IdRef(flag), Operand::IdRef(new)]));
        safe
    }

    /// Lets a store of a float to memory outside store the trap's bits instead, if the flag is set.
    fn mark(&mut self, store: &mut Instruction, before: &mut Vec<Instruction>) {
        let [Operand::IdRef(pointer), Operand::IdRef(value), ..] = store.operands.as_slice() else {
            return;
        };
        let (pointer, value) = (*pointer, *value);
        let class = self.types.get(&pointer).and_then(|ty| self.globals.get(ty)?.operands.first().cloned());
        let outside = [StorageClass::StorageBuffer, StorageClass::Uniform].map(Operand::StorageClass);
        let Some(float) = self.float.filter(|float| self.types.get(&value) == Some(float)) else {
            return;
        };
        if !class.is_some_and(|class| outside.contains(&class)) {
            return;
        }
        let (uint, boolean, flag) = (self.uint, self.boolean, self.flag());
        let (zero, trap) = (self.constant(0), self.constant(trap_bits(0)));
        let mut emit = |watch: &mut Self, opcode, ty, operands: &[Word]| {
            let id = watch.fresh();
            let operands = operands.iter().map(|id| Operand::IdRef(*id)).collect();
            before.push(Instruction::new(opcode, Some(ty), Some(id), operands));
            id
        };
        let number = emit(self, Op::Load, uint, &[flag]);
        let trapped = emit(self, Op::INotEqual, boolean, &[number, zero]);
        let marker = emit(self, Op::BitwiseOr, uint, &[number, trap]);
        let bits = emit(self, Op::Bitcast, uint, &[value]);
        let bits = emit(self, Op::Select, uint, &[trapped, marker, bits]);
        let marked = emit(self, Op::Bitcast, float, &[bits]);
        store.operands[1] = Operand::IdRef(marked);
    }
}
