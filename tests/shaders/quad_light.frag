#version 330 core
// A polygon light in the shape that engines have it: normal, view, place, matrix, corners, two-sided, and a table read in
// the middle for the horizon. With its own uniforms, samplers, inputs, outputs and main().
precision highp float;

uniform sampler2D ltc_2;
uniform vec3 light_color;
uniform Frame {
    mat4 view;
    float exposure;
};
in vec3 world_position;
out vec4 fragment_color;

#include "quad_light_edge.glsl"

const real SIDE = 64.0;

hvec3 quad_light(hvec3 N, hvec3 V, hvec3 P, mat3 Minv, hvec3 points[4], bool twoSided)
{
    hvec3 x = normalize(V - N * dot(V, N));
    hvec3 y = cross(N, x);
    Minv = Minv * transpose(mat3(x, y, N));
    hvec3 L[4];
    for (int i = 0; i < 4; ++i) {
        L[i] = normalize(Minv * (points[i] - P));
    }
    hvec3 sum = hvec3(0.0);
    for (int i = 0; i < 4; ++i) {
        sum += edge(L[i], L[(i + 1) % 4]);
    }
    bool behind = dot(points[0] - P, cross(points[1] - points[0], points[3] - points[0])) > 0.0;
    real size = length(sum);
    real z = sum.z / size * (behind ? 1.0 : -1.0);
    vec2 uv = vec2(z * 0.5 + 0.5, size) * ((SIDE - 1.0) / SIDE) + 0.5 / SIDE;
    real shared_by_both = size * texture(ltc_2, uv).w;
    return hvec3(twoSided || behind ? shared_by_both : 0.0) * exposure;
}

void main()
{
    hvec3 corners[4];
    hvec3 n = normalize(cross(dFdx(world_position), dFdy(world_position)));
    fragment_color = vec4(quad_light(n, n, world_position, mat3(view), corners, false) * light_color, 1.0);
}
