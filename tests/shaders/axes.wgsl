// A WGSL port of the textbook eigenvalues, with resources and an entry point of its own.
struct Frame { tint: vec3<f32>, gain: f32 }
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var nearest: sampler;

struct Axes { major: vec3<f32>, minor: vec3<f32>, lengths: vec2<f32> }

/* nested /* comments */ are this language's own */
fn axes_of(v1: vec3<f32>, v2: vec3<f32>) -> Axes {
    let a = dot(v1, v1);
    let b = dot(v1, v2);
    let c = dot(v2, v2);
    let mid = 0.5 * (a + c);
    let root = sqrt(mid * mid - (a * c - b * b));
    var w = select(vec2<f32>(0.0, 1.0), vec2<f32>(1.0, 0.0), a >= c);
    if abs(b) > 0.0 { w = normalize(vec2<f32>(b, mid + root - a)); }
    return Axes(
        normalize(w.x * v1 + w.y * v2),
        normalize(w.x * v2 - w.y * v1),
        sqrt(vec2<f32>(mid + root, mid - root)),
    );
}

@fragment
fn main(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {
    return textureSample(picture, nearest, uv) * frame.gain;
}
