/*---
summary = "The extent of a disk from its normal: radius times sqrt(1 - n^2)"
source  = "folklore of splatting; right for disks only"

[[variant]]
name = "disk_normal"
summary = "With the normal u x v and the radius |u|: ellipses are taken for disks, and the difference may be negative"

[[variant]]
name = "disk_normal_clamped"
summary = "disk_normal, the difference no less than 0"
defines = { CLAMPED = 1 }

[[variant]]
name = "disk_normal_sum"
summary = "disk_normal by n.y^2 + n.z^2 for 1 - n.x^2: nothing cancels"
defines = { SUM = 1 }
---*/

// Domain: perpendicular u, v of one length; a control for all other ellipses.
// Bound: 1 - n^2 loses u/(1 - n^2), u = 2^-24: where a disk lies in a coordinate plane nothing is left. The sum does not.
// Measured: failed / of these not enclosing; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                                scene           disk           flat        conjugate         offset            scale           edge
//   disk_normal          99.7% / 0.12%  89.1% / 89.1%  97.0% / 97.0%  99.995% / 80.1%  89.3% / 89.3%  99.986% / 0.29%  95.2% / 30.5%
//   disk_normal_clamped  99.7% / 0.12%  89.1% / 89.1%  97.0% / 97.0%  99.995% / 80.1%  89.3% / 89.3%  99.986% / 27.4%  82.7% / 53.8%
//   disk_normal_sum      99.7% / 0.12%  88.4% / 88.4%  89.4% / 89.4%  99.995% / 80.1%  87.6% / 87.6%  99.986% / 20.0%  95.2% / 30.7%

EllipseBounds ellipse_bounds(vec3 center, vec3 u, vec3 v)
{
    vec3 n = normalize(cross(u, v));
    vec3 squares = n * n;
#if defined(SUM)
    vec3 rest = squares.yzx + squares.zxy;
#elif defined(CLAMPED)
    vec3 rest = max(1.0 - squares, 0.0);
#else
    vec3 rest = 1.0 - squares;
#endif
    vec3 e = length(u) * sqrt(rest);
    return EllipseBounds(center - e, center + e);
}
