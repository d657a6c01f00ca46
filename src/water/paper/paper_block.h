// Fills the block that the paper's passes read.
#pragma once

#include "water/paper.shared.h"
#include "water/paper/paper_light.h"

namespace shoal::water {

struct PaperBufferSizes {
    IVec2 caustics, godrays;  // pixels
};
PaperBufferSizes paperBufferSizes(const light::View& eye, const PaperParams& params);

PaperBlock makePaperBlock(const frame::Context& context, const PaperParams& params, const Body& body,
                          const PaperLight& light);
// The part that changes from sample to sample: where pixels are.
void setPaperPixels(PaperBlock& block, const frame::Context& context);

}  // namespace shoal::water
