// A disk light from three corners of its square relative to P, with a struct, a shared global, and y up.
struct Light {
    vec3 points[3];
    float intensity;
};

uniform Light light;
Light current;

vec3 corner(int which)
{
    return current.points[which];
}

// The cosine integral of the square's inscribed disk seen from P, as that of the equal sphere, in z over the horizon.
float disk_light(vec3 P)
{
    vec3 center = 0.5 * (corner(0) + corner(2)) - P;
    vec3 half_u = 0.5 * (corner(1) - corner(0));
    vec3 half_v = 0.5 * (corner(2) - corner(1));
    vec3 normal = cross(half_u, half_v);
    float square = dot(center, center);
    float area = length(normal);
    float facing = abs(dot(normal, center)) / (area * sqrt(square));
    return area * facing * (center.y / sqrt(square)) / square * current.intensity;
}

void main()
{
    current = light;
    gl_Position = vec4(disk_light(vec3(0.0)));
}
