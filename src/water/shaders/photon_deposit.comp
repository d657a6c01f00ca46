#version 450 core
// Traces the photons of one slot and lays each one's flux over its footprint. Photons whose corners meet different things
// are listed instead, for photon_split.comp.
// Sources: [Igehy 1999]; [Frisvad et al. 2014].
#include "water/photon.io.glsl"
#include "water/footprint.io.glsl"
#include "water/split.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// How far two heights of the photon's way are apart in light space, in texels.
vec2 slid(Photon p, float from, float to) {
#ifdef NO_LAMPS
    return (p.drift - lightSpace.slots[slot].mean.xy) * ((to - from) * lightSpace.slots[slot].place.w);
#else
    return (photonPlace(p, slot, to) - photonPlace(p, slot, from)) * lightSpace.slots[slot].place.w;
#endif
}

// Whether the photon's light is parted: rays from its corners meet what lies in the other layer, or elsewhere by more than
// a texel and a good part of its footprint.
bool parted(Photon p, float travel, int layer) {
    const float kApart = 1.0, kApartOfIts = 0.25;   // texels, of the footprint's longer edge
    // Where all that is near its way is in one place for it, nothing can part it.
    float reach = lightSpace.slots[slot].reach.w, end = travel < 0.0 ? reach : travel;
    float relief = reliefAt(photonPlace(p, slot, 0.5 * end)).x;
    vec4 j = photonJacobian(p, slot, end) * (kApartOfIts * cell.x * lightSpace.slots[slot].place.w);
    float least2 = max(max(dot(j.xy, j.xy), dot(j.zw, j.zw)), kApart * kApart);
    vec2 apart = slid(p, end, end + relief);
    int corners = dot(apart, apart) > least2 ? 4 : 0;
    float least = end, most = end;
    bool layers = false;
    for (int i = 0; i < corners; ++i) {
        int other;
        float there = photonTravelFrom(p, (vec2(i & 1, i >> 1) - 0.5) * cell.x, slot, other);
        there = there < 0.0 ? reach : there;
        least = min(least, there), most = max(most, there);
        layers = layers || other != layer;
    }
    apart = slid(p, least, most);
    return p.flux > 0.0 && (layers || dot(apart, apart) > least2);
}

void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(lattice.zw)))) return;
    vec2 xz = (lattice.xy + vec2(id) + 0.5) * cell.x;
#ifndef NO_AIR
    bool air = reliefAt(xz).y > 0.0;
#else
    bool air = false;
#endif
    Photon p = photonAt(xz, slot, cell.x, air);
    int layer;
    float travel = photonTravel(p, slot, layer);
    bool split = parted(p, travel, layer);
    list(id, split);
    vec2 centre = photonPlace(p, slot, travel);
    vec4 j = photonJacobian(p, slot, travel) * (cell.x * cell.y);
    layDown(centre, j, layer, split ? 0.0 : unitsOf(p, travel, centre), p.open, photonHeight(p, slot, travel));
}
