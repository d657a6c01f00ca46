// What the skinning pass reads. It has storage bindings 0..7 to itself.
#ifndef SHOAL_FRAME_SKIN_SHARED_H
#define SHOAL_FRAME_SKIN_SHARED_H

#define SHOAL_SKIN_GROUP 64  // vertices a work group

#define SHOAL_SKIN_CHUNKS 0
#define SHOAL_SKIN_POSE 1  // vec4: matrix rows, three a joint; morph weights
#define SHOAL_SKIN_POSITIONS_IN 2
#define SHOAL_SKIN_FRAMES_IN 3
#define SHOAL_SKIN_INFLUENCES 4
#define SHOAL_SKIN_MORPHS 5  // 6 floats an offset
#define SHOAL_SKIN_POSITIONS_OUT 6
#define SHOAL_SKIN_FRAMES_OUT 7

#ifdef __cplusplus
#include <cstdint>
namespace shoal::frame {
using uint = std::uint32_t;
#endif

// Up to SHOAL_SKIN_GROUP vertices of one posed primitive of one instance.
struct SkinChunk {
    uint vertexCount;
    uint sourceVertex;
    uint targetVertex;
    uint influence;  // of the first vertex; ~0: not skinned
    uint jointRow;   // of joint 0 in the pose buffer
    uint weightRow;  // of morph weight 0, four a row
    uint morphCount;
    uint morphOffset;  // of the first vertex in target 0
    uint morphStride;  // offsets from one target to the next
    uint unused0, unused1, unused2;
};

#ifdef __cplusplus
static_assert(sizeof(SkinChunk) == 48);
}  // namespace shoal::frame
#endif

#endif
