//! GLSL and HLSL to SPIR-V through glslang's C interface.
//!
//! Used directly rather than through a wrapper because debug line information and include callbacks are needed.
#![allow(unsafe_code, reason = "glslang is a C interface")]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::mem::MaybeUninit;
use std::ptr::{self, NonNull};
use std::sync::OnceLock;

use glslang_sys as sys;

/// Finds an included file's text by the name in the `#include` and the includer's name.
pub(super) type Includes<'a> = &'a (dyn Fn(&str, &str) -> Option<String> + 'a);

/// Name of every kernel's entry point.
const ENTRY: &CStr = c"main";

/// The front end that reads a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrontEnd {
    Glsl,
    Hlsl,
}

/// A text to be read.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) text: &'a str,
    pub(super) front_end: FrontEnd,
    pub(super) includes: Includes<'a>,
}

impl<'a> Source<'a> {
    /// GLSL that includes nothing.
    pub(super) fn glsl(text: &'a str) -> Self {
        Source { text, front_end: FrontEnd::Glsl, includes: &|_, _| None }
    }
}

/// Compiles one compute shader to SPIR-V 1.3 (Vulkan 1.1).
///
/// `debug_lines` keeps source file names and line numbers in the module. The error is glslang's log, one diagnostic a
/// line, in which `#line N "file"` directives of the text name the files.
pub(super) fn compile(source: Source<'_>, debug_lines: bool) -> Result<Vec<u32>, String> {
    read(source, debug_lines, |shader, input, messages| translate(shader, input, messages, debug_lines))
}

/// The text after the preprocessor: what is included put in, macros expanded, comments gone, `#line`, `#version`,
/// `#extension` and `#pragma` directives kept. Errors as of [`compile`].
pub(super) fn preprocess(source: Source<'_>) -> Result<String, String> {
    read(source, false, |shader, _, _| {
        // SAFETY: the shader is live and was preprocessed; the code is a NUL-terminated string of its own.
        Ok(unsafe { text(sys::glslang_shader_get_preprocessed_code(shader.0.as_ptr())) })
    })
}

/// Preprocesses a source and hands on what glslang made of it, with its input and messages.
fn read<T>(
    source: Source<'_>,
    debug_lines: bool,
    then: impl FnOnce(&Shader, &sys::glslang_input_t, i32) -> Result<T, String>,
) -> Result<T, String> {
    static PROCESS: OnceLock<()> = OnceLock::new();
    PROCESS.get_or_init(|| {
        // SAFETY: called once, before any other glslang function; finalising is left to the process's end.
        unsafe { sys::glslang_initialize_process() };
    });

    let code = CString::new(source.text).map_err(|_| "ERROR: the text holds a NUL character".to_owned())?;
    let resource = limits();
    let mut messages = sys::glslang_messages_t::SPV_RULES | sys::glslang_messages_t::VULKAN_RULES;
    if source.front_end == FrontEnd::Hlsl {
        messages |= sys::glslang_messages_t::READ_HLSL | sys::glslang_messages_t::HLSL_OFFSETS;
    }
    if debug_lines {
        messages |= sys::glslang_messages_t::DEBUG_INFO;
    }
    let mut includes = source.includes;
    let input = sys::glslang_input_t {
        language: match source.front_end {
            FrontEnd::Glsl => sys::glslang_source_t::GLSL,
            FrontEnd::Hlsl => sys::glslang_source_t::HLSL,
        },
        stage: sys::glslang_stage_t::Compute,
        client: sys::glslang_client_t::Vulkan,
        client_version: sys::glslang_target_client_version_t::Vulkan1_1,
        target_language: sys::glslang_target_language_t::SPIRV,
        target_language_version: sys::glslang_target_language_version_t::SPIRV1_3,
        code: code.as_ptr(),
        default_version: 450,
        default_profile: sys::glslang_profile_t::None,
        force_default_version_and_profile: 0,
        forward_compatible: 0,
        messages,
        resource: &resource,
        callbacks: sys::glsl_include_callbacks_t {
            include_system: Some(include),
            include_local: Some(include),
            free_include_result: Some(free_include),
        },
        callbacks_ctx: ptr::from_mut(&mut includes).cast(),
    };

    // SAFETY: `input` and all it points to outlive the shader, which is dropped at the end of this function.
    let shader =
        Shader(NonNull::new(unsafe { sys::glslang_shader_create(&input) }).ok_or("ERROR: no shader")?);
    // SAFETY: the shader is live, and glslang copies the names. HLSL has no entry point unless one is named.
    unsafe {
        sys::glslang_shader_set_entry_point(shader.0.as_ptr(), ENTRY.as_ptr());
        sys::glslang_shader_set_source_entry_point(shader.0.as_ptr(), ENTRY.as_ptr());
    }
    // SAFETY: the shader is live and `input` is the one it was created from.
    if unsafe { sys::glslang_shader_preprocess(shader.0.as_ptr(), &input) } == 0 {
        return Err(shader.log());
    }
    then(&shader, &input, messages.0)
}

/// Parses, links and translates a preprocessed shader.
fn translate(
    shader: &Shader,
    input: &sys::glslang_input_t,
    flags: i32,
    debug_lines: bool,
) -> Result<Vec<u32>, String> {
    // SAFETY: the shader is live, preprocessed, and `input` is the one it was created from.
    if unsafe { sys::glslang_shader_parse(shader.0.as_ptr(), input) } == 0 {
        return Err(shader.log());
    }

    // SAFETY: plain constructor.
    let program = Program(NonNull::new(unsafe { sys::glslang_program_create() }).ok_or("ERROR: no program")?);
    // SAFETY: both are live, and the shader outlives the program (declared before it, dropped after it).
    let linked = unsafe {
        sys::glslang_program_add_shader(program.0.as_ptr(), shader.0.as_ptr());
        sys::glslang_program_link(program.0.as_ptr(), flags)
    };
    if linked == 0 {
        return Err(program.log());
    }
    let mut options = sys::glslang_spv_options_t {
        generate_debug_info: debug_lines,
        strip_debug_info: false,
        disable_optimizer: true,
        optimize_size: false,
        optimize_performance: false,
        disassemble: false,
        validate: false,
        emit_nonsemantic_shader_debug_info: false,
        emit_nonsemantic_shader_debug_source: false,
        compile_only: false,
        optimize_allow_expanded_id_bound: false,
        compiler_signature: ptr::null(),
        command_line_arguments: ptr::null(),
        current_working_directory: ptr::null(),
    };
    // SAFETY: the program is linked, the options are complete, and the slice is copied before the program goes.
    let words = unsafe {
        sys::glslang_program_SPIRV_generate_with_options(
            program.0.as_ptr(),
            sys::glslang_stage_t::Compute,
            &mut options,
        );
        let length = sys::glslang_program_SPIRV_get_size(program.0.as_ptr());
        let words = sys::glslang_program_SPIRV_get_ptr(program.0.as_ptr());
        if words.is_null() || length == 0 {
            return Err(program.log());
        }
        std::slice::from_raw_parts(words, length).to_vec()
    };
    Ok(words)
}

/// glslang's version, for the record: `15.4.0`.
pub(super) fn version() -> String {
    let mut version = sys::glslang_version_t { major: 0, minor: 0, patch: 0, flavor: ptr::null() };
    // SAFETY: fills the struct it is given.
    unsafe { sys::glslang_get_version(&mut version) };
    format!("{}.{}.{}", version.major, version.minor, version.patch)
}

struct Shader(NonNull<sys::glslang_shader_t>);

impl Shader {
    fn log(&self) -> String {
        // SAFETY: the shader is live and the log is a NUL-terminated string of its own.
        unsafe { text(sys::glslang_shader_get_info_log(self.0.as_ptr())) }
    }
}

impl Drop for Shader {
    fn drop(&mut self) {
        // SAFETY: created by glslang_shader_create, deleted once.
        unsafe { sys::glslang_shader_delete(self.0.as_ptr()) }
    }
}

struct Program(NonNull<sys::glslang_program_t>);

impl Program {
    fn log(&self) -> String {
        // SAFETY: the program is live and the log is a NUL-terminated string of its own.
        unsafe { text(sys::glslang_program_get_info_log(self.0.as_ptr())) }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // SAFETY: created by glslang_program_create, deleted once.
        unsafe { sys::glslang_program_delete(self.0.as_ptr()) }
    }
}

/// Copies a C string; null is empty.
///
/// # Safety
/// `chars` is null or NUL-terminated.
unsafe fn text(chars: *const c_char) -> String {
    if chars.is_null() {
        return String::new();
    }
    // SAFETY: the caller's promise.
    unsafe { CStr::from_ptr(chars) }.to_string_lossy().into_owned()
}

/// An include result and the memory behind its pointers. `result` comes first, so that a pointer to it is one to this.
#[repr(C)]
struct Included {
    result: sys::glsl_include_result_t,
    name: CString,
    text: String,
}

unsafe extern "C" fn include(
    context: *mut c_void,
    name: *const c_char,
    includer: *const c_char,
    depth: usize,
) -> *mut sys::glsl_include_result_t {
    const MAX_DEPTH: usize = 64;
    // SAFETY: the context is the `Includes` that `compile` passes, alive throughout; the names are C strings.
    let (includes, name, includer) = unsafe { (*context.cast::<Includes<'_>>(), text(name), text(includer)) };
    let found = (depth <= MAX_DEPTH).then(|| includes(&name, &includer)).flatten();
    let (Some(text), Ok(name)) = (found, CString::new(name)) else {
        return ptr::null_mut();
    };
    let mut included = Box::new(Included {
        result: sys::glsl_include_result_t {
            header_name: ptr::null(),
            header_data: ptr::null(),
            header_length: text.len(),
        },
        name,
        text,
    });
    included.result.header_name = included.name.as_ptr();
    included.result.header_data = included.text.as_ptr().cast();
    Box::into_raw(included).cast()
}

unsafe extern "C" fn free_include(_context: *mut c_void, result: *mut sys::glsl_include_result_t) -> c_int {
    if !result.is_null() {
        // SAFETY: `include` made it from a Box<Included>, and glslang frees each result once.
        drop(unsafe { Box::from_raw(result.cast::<Included>()) });
    }
    0
}

/// What a compute shader may use; graphics limits stay 0.
fn limits() -> sys::glslang_resource_t {
    // SAFETY: the struct holds only integers, booleans and a union of integers, for which all zeros are values.
    let mut limits: sys::glslang_resource_t = unsafe { MaybeUninit::zeroed().assume_init() };
    limits.max_compute_work_group_count_x = 65535;
    limits.max_compute_work_group_count_y = 65535;
    limits.max_compute_work_group_count_z = 65535;
    limits.max_compute_work_group_size_x = 1024;
    limits.max_compute_work_group_size_y = 1024;
    limits.max_compute_work_group_size_z = 64;
    limits.max_compute_uniform_components = 1024;
    limits.max_compute_texture_image_units = 16;
    limits.max_compute_image_uniforms = 8;
    limits.max_combined_texture_image_units = 80;
    limits.max_texture_image_units = 32;
    limits.max_image_units = 8;
    limits.max_combined_image_uniforms = 8;
    limits.min_program_texel_offset = -8;
    limits.max_program_texel_offset = 7;
    limits.max_draw_buffers = 32;
    limits.limits = sys::glslang_limits_t::default();
    limits
}
