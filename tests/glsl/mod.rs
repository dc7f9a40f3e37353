//! GLSL for tests: a kernel's body to SPIR-V.

use std::ffi::{CStr, CString};
use std::ptr;
use std::sync::{Mutex, PoisonError};

use glslang_sys as gl;

/// Compiles the body of a kernel. It sees `k`, its configuration; `stride`; and the columns `i` and `o`.
pub(crate) fn compile(body: &str) -> Vec<u32> {
    compile_text(CONSTANTS, "", body)
}

/// As [`compile`], with push constants of the caller's own.
pub(crate) fn compile_with(constants: &str, body: &str) -> Vec<u32> {
    compile_text(constants, "", body)
}

/// As [`compile`], with more resources declared.
pub(crate) fn compile_reading(declarations: &str, body: &str) -> Vec<u32> {
    compile_text(CONSTANTS, declarations, body)
}

const CONSTANTS: &str = "uint first, count, stride;";

fn compile_text(constants: &str, declarations: &str, body: &str) -> Vec<u32> {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let source = format!(
        "#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs {{ float i[]; }};
layout(std430, set = 0, binding = 1) buffer Outputs {{ float o[]; }};
layout(push_constant) uniform Range {{ {constants} }};
{declarations}
void main() {{
    if (gl_GlobalInvocationID.x >= count) return;
    uint k = first + gl_GlobalInvocationID.x;
    {body}
}}
"
    );
    let source = CString::new(source).expect("GLSL has no zero byte");
    // SAFETY: plain numbers and flags, for which zero is a value; the ones that matter here are set.
    let mut resource: gl::glslang_resource_t = unsafe { std::mem::zeroed() };
    resource.max_compute_work_group_size_x = 128;
    resource.max_compute_work_group_size_y = 1;
    resource.max_compute_work_group_size_z = 1;
    resource.max_compute_work_group_count_x = 65_535;
    resource.max_compute_work_group_count_y = 1;
    resource.max_compute_work_group_count_z = 1;
    resource.limits = gl::glslang_limits_t::default();
    let input = gl::glslang_input_t {
        language: gl::glslang_source_t::GLSL,
        stage: gl::glslang_stage_t::Compute,
        client: gl::glslang_client_t::Vulkan,
        client_version: gl::glslang_target_client_version_t::Vulkan1_1,
        target_language: gl::glslang_target_language_t::SPIRV,
        target_language_version: gl::glslang_target_language_version_t::SPIRV1_3,
        code: source.as_ptr(),
        default_version: 450,
        default_profile: gl::glslang_profile_t::None,
        force_default_version_and_profile: 0,
        forward_compatible: 0,
        messages: gl::glslang_messages_t::SPV_RULES | gl::glslang_messages_t::VULKAN_RULES,
        resource: &raw const resource,
        callbacks: gl::glsl_include_callbacks_t {
            include_system: None,
            include_local: None,
            free_include_result: None,
        },
        callbacks_ctx: ptr::null_mut(),
    };
    // SAFETY: source and limits outlive the shader; shader and program are used in the order the interface
    // wants and deleted once; the lock keeps the process-wide part to one thread.
    unsafe {
        assert_ne!(gl::glslang_initialize_process(), 0);
        let shader = gl::glslang_shader_create(&raw const input);
        let parsed = gl::glslang_shader_preprocess(shader, &raw const input) != 0
            && gl::glslang_shader_parse(shader, &raw const input) != 0;
        let log = CStr::from_ptr(gl::glslang_shader_get_info_log(shader)).to_string_lossy().into_owned();
        assert!(parsed, "{body}: {log}");
        let program = gl::glslang_program_create();
        gl::glslang_program_add_shader(program, shader);
        let messages = gl::glslang_messages_t::SPV_RULES | gl::glslang_messages_t::VULKAN_RULES;
        assert_ne!(gl::glslang_program_link(program, messages.0), 0, "{body}");
        gl::glslang_program_SPIRV_generate(program, gl::glslang_stage_t::Compute);
        let mut spirv = vec![0; gl::glslang_program_SPIRV_get_size(program)];
        gl::glslang_program_SPIRV_get(program, spirv.as_mut_ptr());
        gl::glslang_program_delete(program);
        gl::glslang_shader_delete(shader);
        gl::glslang_finalize_process();
        spirv
    }
}
