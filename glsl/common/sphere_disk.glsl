// The disk that covers the same directions as a sphere, seen from the origin. Pure functions.

#ifndef ROOTQ_SPHERE_DISK
#define ROOTQ_SPHERE_DISK

// Two unit vectors orthogonal to the unit vector n and to each other.
// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
void sphere_basis(vec3 n, out vec3 b1, out vec3 b2)
{
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    b1 = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    b2 = vec3(b, side + n.y * n.y * a, -n.y);
}

// The circle where the sphere's tangent cone touches it: 1 - (r/d)^2 of the centre, radius r sqrt(1 - (r/d)^2), with the
// difference of squares as a product. False where the point is inside or on the sphere.
bool sphere_disk(inout vec3 center, float radius, out vec3 v1, out vec3 v2)
{
    float d = length(center);
    radius = abs(radius);
    if (!(d > radius)) {
        return false;
    }
    vec3 b1;
    vec3 b2;
    sphere_basis(center / d, b1, b2);
    float share = (d - radius) / d * ((d + radius) / d);
    float r = radius * sqrt(share);
    center *= share;
    v1 = r * b1;
    v2 = r * b2;
    return true;
}

// The same as published: the half angle by asin, its cosine and its tangent.
// Source: Heitz, "Analytical calculation of the solid angle subtended by an arbitrarily positioned ellipsoid", 2016.
void sphere_disk_2016(inout vec3 center, float radius, out vec3 v1, out vec3 v2)
{
    float theta = asin(radius / length(center));
    float cosine = cos(theta);
    center *= cosine * cosine;
    float distance = length(center);
    vec3 b1;
    vec3 b2;
    sphere_basis(center / distance, b1, b2);
    float r = tan(theta) * distance;
    v1 = r * b1;
    v2 = r * b2;
}

#endif
