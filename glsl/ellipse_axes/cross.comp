/*---
summary = "placeholder"
source = "ours"
[[variant]]
name = "cross"
---*/
EllipseAxes ellipse_axes(vec3 v1, vec3 v2) {
    return EllipseAxes(v1, v2, 1.0, 1.0);
}
