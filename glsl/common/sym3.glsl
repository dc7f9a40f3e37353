// Small steps shared by eigensolvers of symmetric 3x3 matrices. Ours.

#ifndef ROOTQ_SYM3
#define ROOTQ_SYM3

void sym3_order(inout float a, inout float b, inout vec3 p, inout vec3 q)
{
    if (a > b) {
        float value = a;
        a = b;
        b = value;
        vec3 vector = p;
        p = q;
        q = vector;
    }
}

// Eigenvalues ascending, each with its vector, a column of `vectors`.
void sym3_sort(inout vec3 values, inout mat3 vectors)
{
    sym3_order(values.x, values.y, vectors[0], vectors[1]);
    sym3_order(values.y, values.z, vectors[1], vectors[2]);
    sym3_order(values.x, values.y, vectors[0], vectors[1]);
}

mat3 sym3_matrix(vec3 diagonal, vec3 off)
{
    return mat3(diagonal.x, off.x, off.y, off.x, diagonal.y, off.z, off.y, off.z, diagonal.z);
}

// The largest of the cross products of two rows of a singular symmetric matrix: along its null vector if its rank is 2.
vec3 sym3_largest_cross(mat3 m)
{
    vec3 a = cross(m[0], m[1]);
    vec3 b = cross(m[0], m[2]);
    vec3 c = cross(m[1], m[2]);
    float aa = dot(a, a);
    float bb = dot(b, b);
    float cc = dot(c, c);
    if (aa >= bb && aa >= cc) {
        return a;
    }
    return bb >= cc ? b : c;
}

#endif
