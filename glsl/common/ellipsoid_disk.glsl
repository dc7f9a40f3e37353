// The ellipse that covers the same directions as an ellipsoid, seen from the origin, given by conjugate semi-axes.
//
// Source: Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid", 2016: in
// coordinates where the ellipsoid is a unit sphere, take the sphere's disk, and map it back.

#ifndef ROOTQ_ELLIPSOID_DISK
#define ROOTQ_ELLIPSOID_DISK

#include "common/power_of_two.glsl"
#include "common/sphere_disk.glsl"

// The rotation of q/|q|, q = (x, y, z, w); the identity for q = 0. Scaled, so that |q|^2 stays in range.
mat3 ellipsoid_rotation(vec4 q)
{
    vec4 a = abs(q);
    float largest = max(max(a.x, a.y), max(a.z, a.w));
    if (!(largest > 0.0)) {
        return mat3(1.0);
    }
    q /= largest;
    vec3 s = 2.0 / dot(q, q) * q.xyz;
    vec3 w = s * q.w;
    float xx = s.x * q.x;
    float yy = s.y * q.y;
    float zz = s.z * q.z;
    float xy = s.x * q.y;
    float xz = s.x * q.z;
    float yz = s.y * q.z;
    return mat3(
        1.0 - (yy + zz), xy + w.z, xz - w.y,
        xy - w.z, 1.0 - (xx + zz), yz + w.x,
        xz + w.y, yz - w.x, 1.0 - (xx + yy));
}

// The same by M = R D, without dividing by a semi-axis: with b = R^T c, the direction n of P_b is along
// g = (b.x r.y r.z, b.y r.z r.x, b.z r.x r.y), |P_b| = |g|/v for v = r.x r.y r.z, and the ellipse's centre is `share` c with
// share = 1 - (v/|g|)^2. One semi-axis may be 0. 1: an ellipse; 0: nothing to see; -1: the point is inside. Ours.
int ellipsoid_outline(vec3 center, mat3 R, vec3 r, out vec3 n, out float share)
{
    vec3 b = center * R;
    vec3 g = b * r.yzx * r.zxy;
    float v = r.x * r.y * r.z;
    float scale = scale_to_one(max(largest_component(g), v));
    g *= scale;
    v *= scale;
    float size = length(g);
    n = vec3(0.0, 0.0, 1.0);
    share = 0.0;
    if (!(size > v)) {
        return v > 0.0 ? -1 : 0;
    }
    n = g / size;
    share = (size - v) / size * ((size + v) / size);
    return 1;
}

// Centre and conjugate semi-axes of that ellipse.
int ellipsoid_disk(inout vec3 center, mat3 R, vec3 r, out vec3 v1, out vec3 v2)
{
    vec3 n;
    float share;
    int seen = ellipsoid_outline(center, R, r, n, share);
    v1 = vec3(0.0);
    v2 = vec3(0.0);
    if (seen < 1) {
        return seen;
    }
    vec3 b1;
    vec3 b2;
    sphere_basis(n, b1, b2);
    float root = sqrt(share);
    center *= share;
    v1 = R * (root * r * b1);
    v2 = R * (root * r * b2);
    return 1;
}

#endif
