#pragma once

#include <vector>

#include "support/golden.h"

namespace shoal::test {

// The goldens: shoal's features, one small scene each, then the scenes that ship.
std::vector<Entry> entries();

}  // namespace shoal::test
