// Turns and scales a whole model, and turns its surfaces over: the options of readModel.
#pragma once

#include <shoal/core/model.h>

namespace shoal::io {

// Puts a root node above all: rotation first, then scale. Does nothing for no change.
void applyAxes(Model& model, Quat metresFromFile, float scale);

void flipWinding(Model& model);

}  // namespace shoal::io
