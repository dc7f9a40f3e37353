// The cosine over a convex cone of directions by Stokes along its contour, clipped to z > 0 piece by piece.

#ifndef ROOTQ_COSINE_CONTOUR
#define ROOTQ_COSINE_CONTOUR

// 2 pi times the irradiance is the integral of (q x dq).z/|q|^2 along the contour. What lies above the horizon is summed
// as it comes; the two crossings are kept, and the way between them, along the horizon, is their azimuths' difference.
struct CosineContour {
    float sum;
    vec2 down;
    vec2 up;
};

CosineContour cosine_contour()
{
    return CosineContour(0.0, vec2(0.0), vec2(0.0));
}

// The straight piece from a to b.
// Source: Lambert's formula, the angle by atan2 as in Heitz et al. 2016, "Real-Time Polygonal-Light Shading with Linearly
// Transformed Cosines". Bound: a few roundings of |a||b|/|a x b|.
void contour_segment(inout CosineContour contour, vec3 a, vec3 b)
{
    if (max(a.z, b.z) <= 0.0) {
        return;
    }
    // An end exactly on the horizon counts: the next piece may lie on it.
    if (a.z <= 0.0) {
        a = vec3((a.xy * b.z - b.xy * a.z) / (b.z - a.z), 0.0);
        contour.up = a.xy;
    } else if (b.z <= 0.0) {
        b = vec3((b.xy * a.z - a.xy * b.z) / (a.z - b.z), 0.0);
        contour.down = b.xy;
    }
    vec3 normal = cross(a, b - a);
    float size = length(normal);
    if (size > 0.0) {
        contour.sum += atan(size, dot(a, b)) * normal.z / size;
    }
}

float contour_irradiance(CosineContour contour)
{
    float across = contour.down.x * contour.up.y - contour.down.y * contour.up.x;
    float along = dot(contour.down, contour.up);
    float closing = across == 0.0 && along >= 0.0 ? 0.0 : atan(across, along);
    return abs(contour.sum + closing) * 0.159154943091895336;
}

#endif
