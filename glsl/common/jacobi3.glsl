// Jacobi's eigenvalue method for symmetric 3x3 matrices.

#ifndef ROOTQ_JACOBI3
#define ROOTQ_JACOBI3

#ifndef JACOBI_SWEEPS
#define JACOBI_SWEEPS 5
#endif

// One rotation in the plane of two indices: `app`, `aqq`, `apq` the block, `arp`, `arq` the third row's entries, `p`, `q`
// the two columns of the eigenvector matrix.
// Source: Rutishauser, "The Jacobi method for real symmetric matrices", 1966 (angle and update by its tangent).
void jacobi_rotate(inout float app, inout float aqq, inout float apq, inout float arp, inout float arq, inout vec3 p, inout vec3 q)
{
    if (apq == 0.0) {
        return;
    }
    float theta = 0.5 * (aqq - app) / apq;
    // Beyond 1e18 the square overflows, and t = 1/(2 theta) is 0 beside 1.
    float size = min(abs(theta), 1e18);
    float t = 1.0 / (size + sqrt(size * size + 1.0));
    t = theta < 0.0 ? -t : t;
    float c = inversesqrt(1.0 + t * t);
    float s = t * c;
    app -= t * apq;
    aqq += t * apq;
    apq = 0.0;
    float last = arp;
    arp = c * last - s * arq;
    arq = s * last + c * arq;
    vec3 column = p;
    p = c * column - s * q;
    q = s * column + c * q;
}

// Eigenvalues (xx, yy, zz) and eigenvectors, the columns of `vectors`, in no order: diagonal d = (xx, yy, zz) and
// off-diagonal o = (xy, xz, yz) on entry. Cyclic sweeps converge quadratically; five are enough for f32.
void jacobi3(inout vec3 d, vec3 o, out mat3 vectors)
{
    vec3 v0 = vec3(1.0, 0.0, 0.0);
    vec3 v1 = vec3(0.0, 1.0, 0.0);
    vec3 v2 = vec3(0.0, 0.0, 1.0);
    for (int sweep = 0; sweep < JACOBI_SWEEPS; ++sweep) {
        if (o == vec3(0.0)) {
            break;
        }
        jacobi_rotate(d.x, d.y, o.x, o.y, o.z, v0, v1);
        jacobi_rotate(d.x, d.z, o.y, o.x, o.z, v0, v2);
        jacobi_rotate(d.y, d.z, o.z, o.x, o.y, v1, v2);
    }
    vectors = mat3(v0, v1, v2);
}

#endif
