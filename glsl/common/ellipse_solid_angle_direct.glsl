// The solid angle of an ellipse from any two conjugate semi-axes, without an eigensystem. Ours.

#ifndef ROOTQ_ELLIPSE_SOLID_ANGLE_DIRECT
#define ROOTQ_ELLIPSE_SOLID_ANGLE_DIRECT

#include "common/cone_solid_angle.glsl"
#include "common/disk_cone.glsl"

// Vectors whose largest component is 1..2. In its own plane: 2 pi from inside, 0 from outside; 0 without an area.
//
// With l from the secular equation, e1 e3 = |N|^2 cz^2/l, (l + e1)(l + e3) = e1 e3/form^2 and
// e1 + e3 = |V1|^2 + |V2|^2 - |C|^2 + l, whose difference is harmless beside 2 l.
float ellipse_solid_angle_direct(vec3 C, vec3 V1, vec3 V2)
{
    vec3 N = cross(V1, V2);
    if (!(dot(N, N) > DISK_FLAT)) {
        return 0.0;
    }
    DiskCone cone = disk_cone(C, V1, V2);
    if (!(cone.l > 1.0e-30)) {
        return CONE_TAU;
    }
    if (!(cone.product > 0.0) || !(cone.form > 0.0)) {
        return 0.0;
    }
    float l = cone.l;
    float own = dot(V1, V1) + dot(V2, V2) - dot(C, C);
    float root_product = sqrt(cone.product) / cone.form;
    float sum = max(3.0 * l + own, 2.0 * root_product);
    return cone_complete(sqrt(cone.product) * sqrt(l), l, sum, root_product * root_product);
}

#endif
