// The published ellipse of an ellipsoid: map it to a sphere, take the sphere's disk, map that back.
//
//     MAP 0   M = R D R^T, equation 1
//     MAP 1   M = R D, which serves as well, since any M = R D O with O orthogonal takes the unit sphere to the ellipsoid: two
//             matrix products and an inverse fewer
//     MAP 2   M = R^T D R^T, as the paper's listing has it
//     SQUARE  the disk from 1 - 1/|P_b|^2 for the angle's asin, cosine and tangent
//
// Domain: the point outside, semi-axes not 0, a unit quaternion up to rounding. No guard is added: from inside, asin of more
// than 1 is NaN.
// Source: Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid", 2016; its
// basis is Frisvad's, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization", 2012.

#ifndef ROOTQ_ELLIPSOID_ELLIPSE_2016
#define ROOTQ_ELLIPSOID_ELLIPSE_2016

#ifndef MAP
#define MAP 0
#endif

#include "common/ellipsoid_disk.glsl"

void frisvad_basis(vec3 n, out vec3 b1, out vec3 b2)
{
    if (n.z < -0.999999) {
        b1 = vec3(0.0, -1.0, 0.0);
        b2 = vec3(-1.0, 0.0, 0.0);
        return;
    }
    float a = 1.0 / (1.0 + n.z);
    float b = -n.x * n.y * a;
    b1 = vec3(1.0 - n.x * n.x * a, b, -n.x);
    b2 = vec3(b, 1.0 - n.y * n.y * a, -n.y);
}

// Centre and conjugate semi-axes.
void ellipsoid_ellipse_2016(inout vec3 center, vec4 rotation, vec3 radius, out vec3 v1, out vec3 v2)
{
    mat3 R = ellipsoid_rotation(rotation);
    mat3 D = mat3(radius.x, 0.0, 0.0, 0.0, radius.y, 0.0, 0.0, 0.0, radius.z);
#if MAP == 1
    mat3 M = mat3(R[0] * radius.x, R[1] * radius.y, R[2] * radius.z);
    vec3 P = center * R / radius;
#else
#if MAP == 2
    mat3 M = transpose(R) * D * transpose(R);
#else
    mat3 M = R * D * transpose(R);
#endif
    vec3 P = inverse(M) * center;
#endif
#ifdef SQUARE
    float square = dot(P, P);
    float share = 1.0 - 1.0 / square;
    vec3 b1;
    vec3 b2;
    frisvad_basis(P * inversesqrt(square), b1, b2);
    float r = sqrt(share);
    center *= share;
#else
    float theta = asin(1.0 / length(P));
    vec3 disk = cos(theta) * cos(theta) * P;
    float r = tan(theta) * length(disk);
    vec3 b1;
    vec3 b2;
    frisvad_basis(disk / length(disk), b1, b2);
    center = M * disk;
#endif
    v1 = M * (r * b1);
    v2 = M * (r * b2);
}

#endif
