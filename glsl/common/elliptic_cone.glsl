// An elliptic cone, in the notation of clipped_ellipse.glsl.

#ifndef ROOTQ_ELLIPTIC_CONE
#define ROOTQ_ELLIPTIC_CONE

const float DISK_SMALLEST = 1.17549435e-38;

// The cone by what its irradiance needs.
struct DiskCone {
    float l;
    float sum;        // e1 + e3
    float product;    // e1 e3
    float volume;     // |[C, V1, V2]|
    float height2;    // squares of the unit mean direction's height and horizontal part
    float level2;
    float whole;      // v W3/sqrt(l A B), the irradiance of all of it, below the horizon too
    float slant;      // sqrt(l A B) W3
};

#endif
