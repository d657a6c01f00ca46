// Sample offsets for antialiasing.
//   [Hammersley 1960; Shirley 1991] radical inverses as well-spread points; the digital shift turns the 4-point set
//   into the rotated grid.
#include <shoal/core/assert.h>
#include <shoal/core/random.h>
#include <shoal/frame/post.h>

namespace shoal::frame {
namespace {

// Bit-reversed index, its bits flipped alternately.
std::uint32_t shiftedInverse(std::uint32_t index) {
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= ((index >> bit) & 1u) << (31 - bit);
    return reversed ^ 0x55555555u;
}

}  // namespace

Vec2 samplePattern(int index, int count) {
    SHOAL_ASSERT_GE(index, 0);
    if (count <= 0)  // Halton, for histories: any run of consecutive points covers the pixel
        return {float(radicalInverse(2, std::uint64_t(index) % 1024 + 1) - 0.5),
                float(radicalInverse(3, std::uint64_t(index) % 1024 + 1) - 0.5)};
    SHOAL_ASSERT_LT(index, count);
    // Row: the rank of this point's radical inverse among all, so that any count fills every row and every column once.
    const std::uint32_t own = shiftedInverse(std::uint32_t(index));
    int row = 0;
    for (int i = 0; i < count; ++i) row += shiftedInverse(std::uint32_t(i)) < own;
    return {(float(index) + 0.5f) / float(count) - 0.5f, (float(row) + 0.5f) / float(count) - 0.5f};
}

}  // namespace shoal::frame
