#include "water/waves/tile_transform.h"

#include <algorithm>
#include <array>

#include <kiss_fft.h>

#include <shoal/core/assert.h>

namespace shoal::water {
namespace {

constexpr std::size_t kSize = TileTransform::kSize;

// kiss_fft_cpx is two floats, as std::complex<float> is by the standard.
static_assert(sizeof(kiss_fft_cpx) == sizeof(std::complex<float>));
kiss_fft_cpx* asKiss(std::complex<float>* c) { return reinterpret_cast<kiss_fft_cpx*>(c); }

}  // namespace

struct TileTransform::Plan {
    kiss_fft_cfg inverse = kiss_fft_alloc(int(kSize), 1, nullptr, nullptr);
    Plan() { SHOAL_ASSERT(inverse != nullptr); }
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;
    ~Plan() { kiss_fft_free(inverse); }
};

TileTransform::TileTransform() : columns_(kSize * kSize), used_(kSize) {
    // Read only once made: all threads share it.
    static const auto plan = std::make_shared<const Plan>();
    plan_ = plan;
}
TileTransform::TileTransform(TileTransform&&) noexcept = default;
TileTransform::~TileTransform() = default;

void TileTransform::clear() {
    for (std::size_t m = 0; m < kSize; ++m)
        if (used_[m]) std::fill_n(&columns_[m * kSize], kSize, std::complex<float>());
    std::fill(used_.begin(), used_.end(), char(0));
}

void TileTransform::set(int m, int q, std::complex<float> c) {
    const std::size_t column = std::size_t(m) & (kSize - 1), row = std::size_t(q) & (kSize - 1);
    columns_[column * kSize + row] = c;
    used_[column] = 1;
}

void TileTransform::transformFirst() {
    std::array<std::complex<float>, kSize> line;
    for (std::size_t m = 0; m < kSize; ++m) {
        if (!used_[m]) continue;
        std::complex<float>* column = &columns_[m * kSize];
        std::copy_n(column, kSize, line.begin());
        kiss_fft(plan_->inverse, asKiss(line.data()), asKiss(column));
    }
}

void TileTransform::transformSecond(std::size_t j, std::complex<float>* to) const {
    std::array<std::complex<float>, kSize> line;
    for (std::size_t m = 0; m < kSize; ++m) line[m] = used_[m] ? columns_[m * kSize + j] : std::complex<float>();
    kiss_fft(plan_->inverse, asKiss(line.data()), asKiss(to));
}

}  // namespace shoal::water
