#version 450 core
// Photons whose corners meet different things, listed by photon_deposit.comp: each is parted into a square of smaller
// ones, which share its surface's slopes and end where their own rays do. Each texel takes their light for the surface
// that they lie on.
#define CHOOSE_LAYERS
#include "water/photon.io.glsl"
#include "water/footprint.io.glsl"
#include "water/split.io.glsl"

layout(local_size_x = 64) in;

const int kFewestParts = 2, kMostParts = 5;   // along x and z
const float kPartTexels = 2.0;                // texels of sums that a part is wide, about

void part(Photon p) {
    vec4 far = photonJacobian(p, slot, lightSpace.slots[slot].reach.w) * (cell.x * cell.y);
    float spread = max(length(far.xy), length(far.zw));
    int parts = clamp(int(ceil(spread / kPartTexels)), kFewestParts, kMostParts);
    float width = cell.x / float(parts);
    for (int i = 0; i < parts * parts; ++i) {
        vec2 share = (vec2(i % parts, i / parts) + 0.5) / float(parts), from = (share - 0.5) * cell.x;
        int layer;
        float travel = photonTravelFrom(p, from, slot, layer);
        vec2 centre = photonPlaceFrom(p, from, slot, travel);
        vec2 open = mix(p.open.xz, p.open.yw, share.x);
        float units = unitsOf(p, travel, centre) * mix(open.x, open.y, share.y) / float(parts * parts);
        layDown(centre, photonJacobian(p, slot, travel) * (width * cell.y), layer, units, vec4(1.0),
                photonHeight(p, slot, travel));
    }
}

void main() {
    uint all = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    for (uint i = gl_GlobalInvocationID.x; i < splitCount; i += all) {
        vec2 id = vec2(splitIds[i] & 0xffffu, splitIds[i] >> 16);
        part(photonAt((lattice.xy + id + 0.5) * cell.x, slot, cell.x, true));
    }
}
