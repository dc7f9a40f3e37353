// A cubic solver by itself: coefficients lowest first, the least root in .y, by one arccosine.
vec3 SolveCubic(vec4 c)
{
    vec3 n = c.xyz / c.w;
    float p = n.y - n.z * n.z / 3.0;
    float q = n.x + n.z * (2.0 * n.z * n.z / 27.0 - n.y / 3.0);
    float radius = sqrt(-p / 3.0);
    float angle = acos(-q / (2.0 * radius * radius * radius)) / 3.0;
    vec3 turns = vec3(0.0, 2.094395102, -2.094395102);
    return 2.0 * radius * cos(angle + turns) - n.z / 3.0;
}
