// One edge of a polygon, by the published rational fit.
hvec3 edge(hvec3 v1, hvec3 v2)
{
    real x = dot(v1, v2);
    real y = abs(x);
    real a = 0.8543985 + (0.4965155 + 0.0145206 * y) * y;
    real b = 3.4175940 + (4.1616724 + y) * y;
    real v = a / b;
    return cross(v1, v2) * (x > 0.0 ? v : 0.5 * inversesqrt(max(1.0 - x * x, 1e-7)) - v);
}
