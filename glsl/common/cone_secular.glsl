// The cone over an ellipse from its secular equation: the mean direction and the half angles' tangents without a
// difference of large numbers. Lengths within 2^-30..2^30 of 1. Pure functions; ours.
//
// In the ellipse's frame (semi-axes hx along x, hy along y, centre c) the dual of the cone is the matrix
// S = diag(hx^2, hy^2, 0) - c c^T: eigenvalues s1 >= s2 >= 0 > -lambda, tan^2 = s/lambda, and lambda is the one positive
// root of
//
//     p + q + r = 1,    p = cx^2/(hx^2 + lambda),  q = cy^2/(hy^2 + lambda),  r = cz^2/lambda
//
// whose left side falls. With those three weights everything else is sums of positive terms (`cone_tangents`).

#ifndef ROOTQ_CONE_SECULAR
#define ROOTQ_CONE_SECULAR

// Steps at most; each squares the relative error, and five suffice for any aspect below 1e6 (`cone_lambda`).
#ifndef CONE_STEPS
#define CONE_STEPS 6
#endif

// A step below this share of lambda ends the iteration: what it leaves is the square.
#ifndef CONE_DONE
#define CONE_DONE 1e-4
#endif

const float CONE_SMALLEST = 1.17549435e-38;
const float CONE_LARGEST = 3.40282347e38;

// The positive root x of weight/(pole + x) + z/x = 1 for weight, pole, z >= 0, without cancellation; 0 if there is none.
float cone_two_poles(float weight, float pole, float z)
{
    float m = 0.5 * (weight + z - pole);
    float zp = z * pole;
    float d = sqrt(m * m + zp);
    return m > 0.0 ? m + d : (d - m > 0.0 ? zp / (d - m) : 0.0);
}

// One step towards lambda from any x > 0: p + q is replaced by the function weight/(pole + x) of its value and slope
// at x. Its reciprocal is the tangent of 1/(p + q), which is concave, so the result never exceeds lambda; it is
// exact for circles and where cx or cy is 0, and from the first step on it climbs with quadratic convergence.
float cone_step(vec2 h2, vec3 c2, float x)
{
    vec2 inverse = 1.0 / max(h2 + x, CONE_SMALLEST);
    vec2 pq = c2.xy * inverse;
    float value = pq.x + pq.y;
    float slope = dot(pq, inverse);
    float reach = slope > 0.0 ? value / slope : x;
    return max(cone_two_poles(value * reach, max(reach - x, 0.0), c2.z), c2.z);
}

// lambda for the squared semi-axes h2 and the centre's squared components c2; 0 where the origin lies in the light.
//
// The start puts the pole of the shorter semi-axis at 0. That is an upper bound, and off by a factor where the
// truth is not within reach of that pole: scenes need two or three steps, aspects of 1e4 and points beside the rim
// three or four.
float cone_lambda(vec2 h2, vec3 c2)
{
    bool x_is_longer = h2.x > h2.y;
    float longer = x_is_longer ? h2.x : h2.y;
    float along = x_is_longer ? c2.x : c2.y;
    float across = x_is_longer ? c2.y : c2.x;
    float x = cone_two_poles(along, longer, c2.z + across);
    for (int i = 0; i < CONE_STEPS; ++i) {
        float last = x;
        x = cone_step(h2, c2, last);
        if (abs(x - last) <= CONE_DONE * x) {
            break;
        }
    }
    return x;
}

// The unit mean direction, in the ellipse's frame, on the light's side: (cx/(hx^2 + lambda), cy/(hy^2 + lambda), cz/lambda).
// Its largest component is brought to 1 first: beside the rim all of them can be small.
vec3 cone_axis(vec2 h2, vec3 c, float lambda)
{
    vec3 v = vec3(c.xy * (lambda / (h2 + lambda)), c.z);
    vec3 size = abs(v);
    return normalize(v / max(max(size.x, size.y), max(size.z, CONE_SMALLEST)));
}

// The tangents (major, minor) of the cone's half angles. With p + q + r = 1 and squares measured in the longer
// semi-axis, alpha = hx^2/h^2, beta = hy^2/h^2, the squares t1 >= t2 of the tangents are h^2/lambda times
//
//     t1 + t2 = alpha (q + r) + beta (p + r)
//     t1 - t2 = hypot(alpha (q + r) - beta (p + r), 2 sqrt(alpha beta p q))
//     t1 t2   = alpha beta r
//
// The one difference is squared beside what it is small against, and the minor tangent, hx hy cz/(lambda sqrt(s1)), needs
// no square that could underflow.
vec2 cone_tangents(vec2 half_axes, vec3 c, float lambda)
{
    float longer = max(max(half_axes.x, half_axes.y), CONE_SMALLEST);
    float root = inversesqrt(lambda);
    vec2 h2 = half_axes * half_axes;
    vec3 c2 = c * c;
    vec2 inverse = 1.0 / (h2 + lambda);
    float p = c2.x * inverse.x;
    float q = c2.y * inverse.y;
    float r = c2.z / lambda;
    vec2 ab = half_axes / longer;
    ab *= ab;
    float f = ab.x * (q + r);
    float g = ab.y * (p + r);
    float t1 = 0.5 * (f + g + sqrt((f - g) * (f - g) + 4.0 * (ab.x * p) * (ab.y * q)));
    float across = sqrt(t1);
    float major = longer * root * across;
    float minor = across > 0.0 ? min(half_axes.x, half_axes.y) * root * (abs(c.z) * root / across) : 0.0;
    return vec2(major, min(minor, major));
}

// Axis and tangents for semi-axes hx, hy >= 0 and any centre. The origin in the light itself sees a half space: the
// axis is +z and the tangents are the largest number.
void cone_secular(float hx, float hy, vec3 c, out vec3 axis, out float tan_major, out float tan_minor)
{
    vec2 h2 = vec2(hx * hx, hy * hy);
    vec3 c2 = c * c;
    float lambda = cone_lambda(h2, c2);
    if (!(lambda >= CONE_SMALLEST)) {
        axis = vec3(0.0, 0.0, 1.0);
        tan_major = CONE_LARGEST;
        tan_minor = CONE_LARGEST;
        return;
    }
    axis = cone_axis(h2, c, lambda);
    vec2 tangents = cone_tangents(vec2(hx, hy), c, lambda);
    tan_major = tangents.x;
    tan_minor = tangents.y;
}

// The irradiance of the unclipped cone through a plane across its axis, as a share of the hemisphere's.
float cone_form_factor(float tan_major, float tan_minor)
{
    return tan_major * inversesqrt(1.0 + tan_major * tan_major) * (tan_minor * inversesqrt(1.0 + tan_minor * tan_minor));
}

// The cone's major direction W1, a unit vector across `axis`; W2 = cross(axis, W1). It is the eigenvector of S across the axis,
// where c may be replaced by its difference from a multiple of the axis, e = (cx hx^2/(hx^2 + lambda),
// cy hy^2/(hy^2 + lambda), 0), so that far lights cancel nothing. Circular cones: any direction.
vec3 cone_major_direction(float hx, float hy, vec3 c, float lambda, vec3 axis)
{
    vec2 h2 = vec2(hx * hx, hy * hy);
    vec2 e = c.xy * (h2 / (h2 + lambda));
    vec3 t1 = abs(axis.x) > abs(axis.y) ? vec3(-axis.z, 0.0, axis.x) : vec3(0.0, axis.z, -axis.y);
    t1 = normalize(t1);
    vec3 t2 = cross(axis, t1);
    vec2 k = vec2(dot(e, t1.xy), dot(e, t2.xy));
    float m11 = dot(h2, t1.xy * t1.xy) - k.x * k.x;
    float m22 = dot(h2, t2.xy * t2.xy) - k.y * k.y;
    float m12 = dot(h2, t1.xy * t2.xy) - k.x * k.y;
    float tau = 0.5 * (m11 - m22);
    float h = sqrt(tau * tau + m12 * m12);
    vec2 w = tau >= 0.0 ? vec2(tau + h, m12) : vec2(m12, h - tau);
    return dot(w, w) > 0.0 ? normalize(w.x * t1 + w.y * t2) : t1;
}

#endif
