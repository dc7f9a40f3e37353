/*---
summary = "Two spherical triangles, the sum of their angles less pi: cancels as the square of the resolution"
source  = "Bourke, Solid angle of a pixel, 2017"

[[variant]]
name = "girard"

[[variant]]
name = "girard_atan2"
summary = "The same, each angle by atan(|u x v|, u.v) for acos(u.v)"
defines = { ATAN2 = 1 }
---*/

// Corners on the unit sphere; the tangent at p towards q is (p x (q - p)) x p, normalised; angles between tangents.
//
// Domain: pixels wider than about 1e-2. No guard is added: acos of a rounded dot product above 1 is NaN, as is the
// tangent of an empty side.
// Source: Bourke, "Solid angle of a pixel", 2017 (Girard's theorem).
// Bound: six angles of up to pi, each off by a rounding over the pixel's side (from the difference of corners), over 4/n^2:
// u n^3 with u = 2^-24.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                      cube_map       decimal          fine         window         wide        edge
//   girard        99.1 % 8.2e+3  100 % 4.9e+4  100 % 5.8e+8     96.3 % inf   98.5 % inf  69.5 % inf
//   girard_atan2  74.2 % 1.7e+2  100 % 1.0e+3  100 % 1.1e+7  75.3 % 2.1e+7  91 % 4.9e+8  44.9 % inf

vec3 tangent_towards(vec3 p, vec3 q)
{
    vec3 r = cross(p, q - p);
    return normalize(cross(r, p));
}

float angle_at(vec3 p, vec3 q, vec3 r)
{
    vec3 u = tangent_towards(p, q);
    vec3 v = tangent_towards(p, r);
#ifdef ATAN2
    return atan(length(cross(u, v)), dot(u, v));
#else
    return acos(dot(u, v));
#endif
}

float triangle_excess(vec3 a, vec3 b, vec3 c)
{
    return angle_at(a, b, c) + angle_at(b, c, a) + angle_at(c, a, b) - 3.14159265358979324;
}

float pixel_cube(float x0, float y0, float x1, float y1)
{
    vec3 a = normalize(vec3(x0, y0, 1.0));
    vec3 b = normalize(vec3(x1, y0, 1.0));
    vec3 c = normalize(vec3(x1, y1, 1.0));
    vec3 d = normalize(vec3(x0, y1, 1.0));
    return triangle_excess(a, b, c) + triangle_excess(a, c, d);
}
