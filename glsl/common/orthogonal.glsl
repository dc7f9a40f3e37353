// Directions orthogonal to a given one, where the data determines none. Ours.

#ifndef ROOTQ_ORTHOGONAL
#define ROOTQ_ORTHOGONAL

// A unit vector orthogonal to the unit vector n: n turned by 90 degrees in the coordinate plane that holds at least
// half of its square.
vec3 any_orthogonal(vec3 n)
{
    vec3 turned = abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y);
    return turned * inversesqrt(dot(turned, turned));
}

#endif
