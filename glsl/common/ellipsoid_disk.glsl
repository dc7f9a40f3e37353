// The ellipse that covers the same directions as an ellipsoid, seen from the origin, given by conjugate semi-axes.
//
// Source: Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid", 2016: in
// coordinates where the ellipsoid is a unit sphere, take the sphere's disk, and map it back.

#ifndef ROOTQ_ELLIPSOID_DISK
#define ROOTQ_ELLIPSOID_DISK

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

#endif
