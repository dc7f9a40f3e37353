/*---
summary = "4 pi sin^2(theta/2): no difference, but as good as the device's atan and sin"
source  = "The identity 1 - cos theta = 2 sin^2(theta/2)"

[[variant]]
name = "half_angle"
---*/

// Domain: lengths whose quotient is a normal number; a zero distance where the device's atan(y, x) takes it.
// Source: trigonometry.
// Bound: twice the relative error of atan and of sin. Vulkan promises 4096 ULP of atan and 2^-11 absolute of sin, which
// leaves nothing of a far disk on the worst legal device.
// Measured: failed, and worst error where all are finite; lavapipe (Mesa 22.3), 1 M a scenario, seed 1.
//                  scene       far      near     scale        edge
//   half_angle  0 4.2e-5  0 4.2e-5  0 8.1e-6  0 4.2e-5  7.87 % inf

float disk_solid_angle(float radius, float distance)
{
    float sine = sin(0.5 * atan(abs(radius), abs(distance)));
    return 12.5663706143591730 * sine * sine;
}
