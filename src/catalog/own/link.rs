//! Puts a function of somebody's SPIR-V module into one of ours.
//!
//! Ours is compiled with a stub in the function's place, so that everything around it is the same text as ever; the stub's
//! body becomes a call. Only what the function reaches comes over.

use std::collections::{BTreeMap, BTreeSet};

use rspirv::binary::Assemble;
use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, StorageClass, Word};

/// Calls `name` of `theirs` where `ours` has the function `stub`; the words of the whole.
pub(super) fn link(mut ours: Module, stub: &str, theirs: &Module, name: &str) -> Result<Vec<u32>, String> {
    let names = functions(theirs);
    let Some(entry) = names.get(name).copied() else {
        let known: Vec<&str> = names.keys().map(String::as_str).collect();
        return Err(if known.is_empty() {
            "its functions have no names: compile it with debug information (-g)".to_owned()
        } else {
            format!("it has no function '{name}', but: {}", known.join(", "))
        });
    };
    let reached = reached(theirs, entry)?;
    let live = live(theirs, &reached);
    refuse_interfaces(theirs, &live)?;

    let ids = merge_globals(&mut ours, theirs, &live)?;
    let remap = |instruction: &Instruction| remapped(instruction, &ids);
    for function in theirs.functions.iter().filter(|function| reached.contains(&id_of(function))) {
        let blocks = function.blocks.iter().map(|block| Block {
            label: block.label.as_ref().map(&remap),
            instructions: block.instructions.iter().map(&remap).collect(),
        });
        let function = Function {
            def: function.def.as_ref().map(&remap),
            end: function.end.clone(),
            parameters: function.parameters.iter().map(&remap).collect(),
            blocks: blocks.collect(),
        };
        ours.functions.push(function);
    }
    let stub_id = functions(&ours).get(stub).copied().ok_or("the stub is gone")?;
    call_instead(&mut ours, stub_id, ids[&entry])?;
    Ok(ours.assemble())
}

fn id_of(function: &Function) -> Word {
    function.def.as_ref().and_then(|def| def.result_id).unwrap_or(0)
}

/// Functions by name; glslang puts a mangled list of parameters behind it.
fn functions(module: &Module) -> BTreeMap<String, Word> {
    let defined: BTreeSet<Word> =
        module.functions.iter().filter(|function| !function.blocks.is_empty()).map(id_of).collect();
    let mut names = BTreeMap::new();
    for instruction in &module.debug_names {
        if let (Op::Name, [Operand::IdRef(id), Operand::LiteralString(name)]) =
            (instruction.class.opcode, instruction.operands.as_slice())
            && defined.contains(id)
        {
            names.insert(name.split('(').next().unwrap_or(name).to_owned(), *id);
        }
    }
    names
}

/// The functions that `entry` calls, itself among them.
fn reached(module: &Module, entry: Word) -> Result<BTreeSet<Word>, String> {
    let calls: BTreeMap<Word, BTreeSet<Word>> = module
        .functions
        .iter()
        .map(|function| {
            let called = function.all_inst_iter().filter(|i| i.class.opcode == Op::FunctionCall);
            let called = called.filter_map(|i| i.operands.first().and_then(Operand::id_ref_any));
            (id_of(function), called.collect())
        })
        .collect();
    let mut reached = BTreeSet::from([entry]);
    let mut wave = reached.clone();
    // Without recursion no chain of calls is longer than there are functions.
    for _ in 0..=calls.len() {
        wave = wave.iter().filter_map(|id| calls.get(id)).flatten().copied().collect();
        if wave.is_empty() {
            return Ok(reached);
        }
        reached.extend(&wave);
    }
    Err("its function calls itself, directly or through others".to_owned())
}

/// Everything at module scope that these functions need.
fn live(module: &Module, functions: &BTreeSet<Word>) -> BTreeSet<Word> {
    let mut live = BTreeSet::new();
    let kept = module.functions.iter().filter(|function| functions.contains(&id_of(function)));
    for instruction in kept.flat_map(Function::all_inst_iter) {
        live.extend(references(instruction));
    }
    // What is declared needs only what is declared before it.
    for instruction in module.types_global_values.iter().rev() {
        if instruction.result_id.is_some_and(|id| live.contains(&id)) {
            live.extend(references(instruction));
        }
    }
    live
}

fn references(instruction: &Instruction) -> impl Iterator<Item = Word> {
    instruction.operands.iter().filter_map(Operand::id_ref_any).chain(instruction.result_type)
}

/// Only variables of the shader's own can come along.
fn refuse_interfaces(module: &Module, live: &BTreeSet<Word>) -> Result<(), String> {
    for instruction in &module.types_global_values {
        let Some(id) = instruction.result_id.filter(|id| live.contains(id)) else {
            continue;
        };
        if instruction.class.opcode == Op::Variable
            && !matches!(
                instruction.operands.first(),
                Some(Operand::StorageClass(StorageClass::Private | StorageClass::Function))
            )
        {
            let named = module.debug_names.iter().find_map(|name| match name.operands.as_slice() {
                [Operand::IdRef(target), Operand::LiteralString(name)] if *target == id => {
                    Some(name.as_str())
                }
                _ => None,
            });
            return Err(format!(
                "its function uses '{}', which is outside of it; a module's interface cannot be adapted, its source can",
                named.unwrap_or("a variable")
            ));
        }
    }
    Ok(())
}

/// Brings the live declarations over; returns what their identifiers became.
fn merge_globals(
    ours: &mut Module,
    theirs: &Module,
    live: &BTreeSet<Word>,
) -> Result<BTreeMap<Word, Word>, String> {
    let bound = |module: &Module| module.header.as_ref().map_or(0, |header| header.bound);
    let offset = bound(ours);
    let mut ids: BTreeMap<Word, Word> = (0..bound(theirs)).map(|id| (id, id + offset)).collect();
    if let Some(header) = &mut ours.header {
        header.bound = offset + bound(theirs);
    }
    merge(&mut ours.capabilities, &theirs.capabilities);
    merge(&mut ours.extensions, &theirs.extensions);
    for import in &theirs.ext_inst_imports {
        let Some(id) = import.result_id.filter(|id| live.contains(id)) else {
            continue;
        };
        let same = ours.ext_inst_imports.iter().find(|own| own.operands == import.operands);
        match same.and_then(|own| own.result_id) {
            Some(own) => _ = ids.insert(id, own),
            None => ours.ext_inst_imports.push(remapped(import, &ids)),
        }
    }
    let mut known: Vec<(Instruction, Word)> = Vec::new();
    let unique = |instruction: &Instruction| Instruction { result_id: None, ..instruction.clone() };
    for own in &ours.types_global_values {
        if is_unique_type(own.class.opcode)
            && let Some(id) = own.result_id
        {
            known.push((unique(own), id));
        }
    }
    for instruction in &theirs.types_global_values {
        let Some(id) = instruction.result_id.filter(|id| live.contains(id)) else {
            continue;
        };
        let new = remapped(instruction, &ids);
        let key = unique(&new);
        let same = known.iter().find(|(own, _)| is_unique_type(new.class.opcode) && *own == key);
        match same {
            Some((_, own)) => _ = ids.insert(id, *own),
            None => {
                if is_unique_type(new.class.opcode) {
                    known.push((key, ids[&id]));
                }
                ours.types_global_values.push(new);
            }
        }
    }
    let target = |instruction: &&Instruction| {
        instruction.operands.first().and_then(Operand::id_ref_any).is_some()
            && !matches!(
                instruction.class.opcode,
                Op::GroupDecorate | Op::GroupMemberDecorate | Op::DecorationGroup
            )
    };
    let inside = |id: Word| {
        live.contains(&id)
            || theirs.functions.iter().flat_map(Function::all_inst_iter).any(|i| i.result_id == Some(id))
    };
    for annotation in theirs.annotations.iter().filter(target) {
        let id = annotation.operands.first().and_then(Operand::id_ref_any).unwrap_or(0);
        // A type that was here already has its decorations.
        if inside(id) && ids[&id] == id + offset {
            ours.annotations.push(remapped(annotation, &ids));
        }
    }
    Ok(ids)
}

fn merge(own: &mut Vec<Instruction>, other: &[Instruction]) {
    for instruction in other {
        if !own.contains(instruction) {
            own.push(instruction.clone());
        }
    }
}

/// Types of which a module may hold only one of a kind.
fn is_unique_type(opcode: Op) -> bool {
    matches!(
        opcode,
        Op::TypeVoid
            | Op::TypeBool
            | Op::TypeInt
            | Op::TypeFloat
            | Op::TypeVector
            | Op::TypeMatrix
            | Op::TypePointer
            | Op::TypeFunction
            | Op::TypeImage
            | Op::TypeSampler
            | Op::TypeSampledImage
    )
}

fn remapped(instruction: &Instruction, ids: &BTreeMap<Word, Word>) -> Instruction {
    let new = |id: Word| ids.get(&id).copied().unwrap_or(id);
    let mut instruction = instruction.clone();
    instruction.result_id = instruction.result_id.map(new);
    instruction.result_type = instruction.result_type.map(new);
    for operand in &mut instruction.operands {
        match operand {
            Operand::IdRef(id) | Operand::IdScope(id) | Operand::IdMemorySemantics(id) => *id = new(*id),
            _ => {}
        }
    }
    instruction
}

/// Makes the body of `stub` a call of `callee`.
fn call_instead(module: &mut Module, stub: Word, callee: Word) -> Result<(), String> {
    let types: BTreeMap<Word, Instruction> =
        module.types_global_values.iter().filter_map(|i| Some((i.result_id?, i.clone()))).collect();
    let pointee = |id: Word| match types.get(&id) {
        Some(pointer) if pointer.class.opcode == Op::TypePointer => {
            pointer.operands.get(1).and_then(Operand::id_ref_any)
        }
        _ => None,
    };
    let members = |id: Word| match types.get(&id) {
        Some(ty) if ty.class.opcode == Op::TypeStruct => {
            ty.operands.iter().filter_map(Operand::id_ref_any).collect()
        }
        _ => vec![id],
    };
    let shape = |id: Word| -> Result<(Word, Vec<Word>), String> {
        let function = module.functions.iter().find(|function| id_of(function) == id).ok_or("no function")?;
        let result = function.def.as_ref().and_then(|def| def.result_type).ok_or("no result")?;
        Ok((result, function.parameters.iter().filter_map(|parameter| parameter.result_type).collect()))
    };
    let (our_result, our_parameters) = shape(stub)?;
    let (their_result, their_parameters) = shape(callee)?;
    let by_value = |ty: &Word| pointee(*ty).unwrap_or(*ty);
    let takes = |parameters: &[Word]| parameters.iter().map(by_value).collect::<Vec<Word>>();
    if takes(&our_parameters) != takes(&their_parameters) || members(our_result) != members(their_result) {
        return Err(format!(
            "its function has the shape {}, not {}",
            described(&types, their_result, &takes(&their_parameters)),
            described(&types, our_result, &takes(&our_parameters))
        ));
    }
    let parts = members(our_result);
    let mut next = module.header.as_ref().map_or(0, |header| header.bound);
    let mut fresh = || {
        next += 1;
        next - 1
    };
    let function =
        module.functions.iter_mut().find(|function| id_of(function) == stub).ok_or("the stub is gone")?;
    let mut body = Vec::new();
    let mut arguments = vec![Operand::IdRef(callee)];
    for (parameter, (ours, theirs)) in
        function.parameters.iter().zip(our_parameters.iter().zip(&their_parameters))
    {
        let id = parameter.result_id.ok_or("a parameter without a name")?;
        let argument = match (pointee(*ours), pointee(*theirs)) {
            (Some(value), None) => {
                let loaded = fresh();
                body.push(Instruction::new(Op::Load, Some(value), Some(loaded), vec![Operand::IdRef(id)]));
                loaded
            }
            // glslang passes addresses, and the callee may write there: the caller has copies of its own.
            (Some(_), Some(_)) | (None, None) => id,
            (None, Some(_)) => return Err("its function takes an address of what is a value".to_owned()),
        };
        arguments.push(Operand::IdRef(argument));
    }
    let returned = fresh();
    body.push(Instruction::new(Op::FunctionCall, Some(their_result), Some(returned), arguments));
    let result = if our_result == their_result {
        returned
    } else {
        let mut values = Vec::new();
        for (position, part) in parts.iter().enumerate() {
            let value = fresh();
            let operands = vec![Operand::IdRef(returned), Operand::LiteralBit32(position as u32)];
            body.push(Instruction::new(Op::CompositeExtract, Some(*part), Some(value), operands));
            values.push(Operand::IdRef(value));
        }
        let whole = fresh();
        body.push(Instruction::new(Op::CompositeConstruct, Some(our_result), Some(whole), values));
        whole
    };
    body.push(Instruction::new(Op::ReturnValue, None, None, vec![Operand::IdRef(result)]));
    let label = Instruction::new(Op::Label, None, Some(fresh()), vec![]);
    function.blocks = vec![Block { label: Some(label), instructions: body }];
    if let Some(header) = &mut module.header {
        header.bound = next;
    }
    Ok(())
}

/// `vec3 (vec3, mat3)` in words.
fn described(types: &BTreeMap<Word, Instruction>, result: Word, parameters: &[Word]) -> String {
    let parameters: Vec<String> = parameters.iter().map(|ty| type_name(types, *ty)).collect();
    format!("{} ({})", type_name(types, result), parameters.join(", "))
}

fn type_name(types: &BTreeMap<Word, Instruction>, id: Word) -> String {
    let Some(ty) = types.get(&id) else {
        return "?".to_owned();
    };
    let number = |at: usize| match ty.operands.get(at) {
        Some(Operand::LiteralBit32(number)) => *number,
        _ => 0,
    };
    let inner = || {
        ty.operands.first().and_then(Operand::id_ref_any).map_or("?".to_owned(), |id| type_name(types, id))
    };
    match ty.class.opcode {
        Op::TypeVoid => "void".to_owned(),
        Op::TypeBool => "bool".to_owned(),
        Op::TypeInt => "int".to_owned(),
        Op::TypeFloat if number(0) == 32 => "float".to_owned(),
        Op::TypeFloat => format!("float{}", number(0)),
        Op::TypeVector if inner() == "float" => format!("vec{}", number(1)),
        Op::TypeVector => format!("{}{}", inner(), number(1)),
        Op::TypeMatrix => format!("mat{}", number(1)),
        Op::TypeStruct => {
            let members: Vec<String> =
                ty.operands.iter().filter_map(Operand::id_ref_any).map(|id| type_name(types, id)).collect();
            format!("{{ {} }}", members.join(", "))
        }
        other => format!("{other:?}"),
    }
}
