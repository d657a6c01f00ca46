// Makes the promises of shoal::Primitive true for what a model file held: normals, tangents, weights, bounds. Shared by
// the readers.
#pragma once

#include <cstdint>
#include <span>

#include <shoal/core/model.h>

namespace shoal::io {

// The primitive whose vertex i is vertex sourceVertex[i] of `primitive`; indices are left empty.
Primitive gatherVertices(const Primitive& primitive, std::span<const std::uint32_t> sourceVertex);

// Gives every triangle its own vertices and its plane's normal.
void makeFlatNormals(Primitive& primitive);

// Smooth normals that keep the edges where faces meet at an angle whose cosine is below `creaseCosine`. Vertices at one
// position count as one; a vertex at such an edge is doubled.
void makeCreaseNormals(Primitive& primitive, float creaseCosine);

// Scales normals to unit length; where one is zero or not finite it becomes the area-weighted mean of the faces around.
// Returns how many those were.
std::size_t repairNormals(Primitive& primitive);

// Scales tangents to unit length, at right angles to the normals, w to +-1; unusable ones become any such vector.
void repairTangents(Primitive& primitive);

// Tangents from uv0 (or uv1), one a vertex.
void makeTangents(Primitive& primitive, bool fromUv1);

// Scales weights to sum 1 and clears the joints of zero weights; where all are zero the first joint gets all. Returns
// how many those were.
std::size_t repairWeights(Primitive& primitive);

// Replaces every component that is not finite by 0.
void clearNonFinite(std::span<float> values);

void computeBounds(Primitive& primitive);

}  // namespace shoal::io
