//! A failure as a script of Amber, which runs it on any Vulkan driver: <https://github.com/google/amber>.

use std::fmt::Write;

use rspirv::binary::Disassemble;

use super::check::{self, Check};
use super::evaluate::{Answer, truth};
use super::glsl::words;
use super::story::Story;
use crate::catalog::kernel::{COLUMNS_SET, INPUTS_BINDING, OUTPUTS_BINDING, TABLES_SET};
use crate::catalog::{self, Kernel, TableForm};
use crate::family::Problem;
use crate::record::RecordedFailure;

/// Why there is no script of a failure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Impossible {
    #[error("it reads the table {0} as an image, which rootq does not write as Amber")]
    Image(&'static str),
    #[error("what checks its outputs does not compile: {0}")]
    Broken(String),
    #[error("its SPIR-V cannot be disassembled: {0}")]
    Spirv(String),
}

/// The script: the module as it was audited, the exact bits of inputs and tables, and what must hold of the outputs.
///
/// The module runs first. A second shader makes of its outputs the numbers that are compared: what is not finite would
/// pass every comparison of Amber's, for it compares as C++ does, so that is told by bits and replaced by the largest f32.
pub fn script(
    problem: &dyn Problem,
    kernel: &Kernel,
    recorded: &RecordedFailure,
    story: &Story,
    seen: &Answer,
) -> Result<String, Impossible> {
    let failure = &recorded.failure;
    let exact = truth(problem, &failure.inputs);
    let checks = check::checks(problem, &exact, failure.verdict, &failure.outputs);

    let mut text = String::from("#!amber\n");
    for line in words(story) {
        _ = writeln!(text, "# {line}");
    }
    text.push_str("# Run with: amber -t spv1.3 -v 1.1 FILE\n");
    for (position, (column, value)) in story.truth.columns.iter().zip(&story.truth.values).enumerate() {
        let seen = seen.outputs[position];
        _ = writeln!(text, "# {column}: exactly {value:.16e}, seen {seen:e} (0x{:08x})", seen.to_bits());
    }
    _ = write!(text, "\nSHADER compute audited SPIRV-ASM\n{}\nEND\n", assembly(&kernel.spirv)?);
    let checking = checking(&checks);
    catalog::compile_standalone(&checking).map_err(Impossible::Broken)?;
    _ = write!(text, "\nSHADER compute checking GLSL\n{checking}END\n");

    text.push_str("\n# One value a column: the bits of f32.\nBUFFER inputs DATA_TYPE uint32 DATA\n");
    for number in &story.inputs {
        _ = writeln!(text, "{} # {} = {:e}", number.bits, number.column, number.value);
    }
    _ = write!(
        text,
        "END\nBUFFER outputs DATA_TYPE uint32 SIZE {} FILL 0\n\
         # First configuration, their number, and the distance of columns.\n\
         BUFFER range DATA_TYPE uint32 DATA\n0 1 1\nEND\n\
         BUFFER checks DATA_TYPE float SIZE {} FILL 0\n",
        kernel.outputs,
        checks.len()
    );
    for table in &kernel.tables {
        if table.form != TableForm::Buffer {
            return Err(Impossible::Image(table.name));
        }
        _ = writeln!(text, "BUFFER {} DATA_TYPE uint32 DATA", table.name);
        for texels in table.texels.chunks(8) {
            let bits: Vec<String> = texels.iter().map(|texel| format!("0x{:08x}", texel.to_bits())).collect();
            _ = writeln!(text, "{}", bits.join(" "));
        }
        text.push_str("END\n");
    }

    let bind = |text: &mut String, name: &str, set: u32, binding: u32| {
        _ = writeln!(text, "  BIND BUFFER {name} AS storage DESCRIPTOR_SET {set} BINDING {binding}");
    };
    text.push_str("\nPIPELINE compute evaluate\n  ATTACH audited\n");
    bind(&mut text, "inputs", COLUMNS_SET, INPUTS_BINDING);
    bind(&mut text, "outputs", COLUMNS_SET, OUTPUTS_BINDING);
    for table in &kernel.tables {
        bind(&mut text, table.name, TABLES_SET, table.binding);
    }
    text.push_str("  BIND BUFFER range AS push_constant\nEND\n\nPIPELINE compute check\n  ATTACH checking\n");
    bind(&mut text, "outputs", COLUMNS_SET, INPUTS_BINDING);
    bind(&mut text, "checks", COLUMNS_SET, OUTPUTS_BINDING);
    text.push_str("END\n\nRUN evaluate 1 1 1\nRUN check 1 1 1\n");
    for (position, check) in checks.iter().enumerate() {
        let Check { what, low, high, .. } = check;
        let at = 4 * position;
        _ = writeln!(text, "# {what}");
        // A number without a point would be read as an integer.
        _ = writeln!(text, "EXPECT checks IDX {at} GE {low:.9e}\nEXPECT checks IDX {at} LE {high:.9e}");
    }
    Ok(text)
}

/// A compute shader with the outputs of the other one at its input's binding.
fn checking(checks: &[Check]) -> String {
    let mut text = format!(
        "#version 450\n\
         layout(local_size_x = 1) in;\n\
         layout(std430, set = {COLUMNS_SET}, binding = {INPUTS_BINDING}) readonly buffer Outputs {{ uint bits[]; }};\n\
         layout(std430, set = {COLUMNS_SET}, binding = {OUTPUTS_BINDING}) writeonly buffer Checks {{ float checks[]; }};\n\
         {}void main()\n{{\n",
        check::SHARED
    );
    for (position, check) in checks.iter().enumerate() {
        _ = writeln!(text, "    checks[{position}] = {};", check.number.glsl());
    }
    text.push_str("}\n");
    text
}

/// The module as `spirv-as` reads it.
fn assembly(words: &[u32]) -> Result<String, Impossible> {
    let module = rspirv::dr::load_words(words).map_err(|error| Impossible::Spirv(error.to_string()))?;
    let text = module.disassemble();
    // Amber takes the first END for the shader's end; names are all that could hold one.
    let named = |line: &&str| !(line.contains("END") && line.contains("Name "));
    let lines = text.lines().filter(named).map(|line| {
        // The assembler reads infinities and NaN as hexadecimal floats only.
        let special = [(" inf", " 0x1p+128"), (" -inf", " -0x1p+128"), (" NaN", " 0x1.8p+128")];
        let constant = line.contains(" = OpConstant ");
        match special.iter().find_map(|(name, hex)| Some((line.strip_suffix(name)?, hex))) {
            Some((start, hex)) if constant => format!("{start}{hex}"),
            _ => line.to_owned(),
        }
    });
    Ok(lines.collect::<Vec<String>>().join("\n"))
}
