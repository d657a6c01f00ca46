// The inverse Fourier transform of a square tile, of which only low wave numbers are set.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace shoal::water {

// value(i, j) = sum over (m, q) of c(m, q) exp(2 pi i (m i + q j) / 256). Rows of the spectrum that are not set cost
// nothing.
class TileTransform {
public:
    static constexpr int kSize = 256;
    TileTransform();
    TileTransform(TileTransform&&) noexcept;
    ~TileTransform();

    void clear();
    void set(int m, int q, std::complex<float> c);  // |m|, |q| below 128; each (m, q) once
    void transformFirst();                          // along z
    // Texels (0..255, j); after transformFirst(), from any thread.
    void transformSecond(std::size_t j, std::complex<float>* to) const;

private:
    struct Plan;
    std::shared_ptr<const Plan> plan_;
    std::vector<std::complex<float>> columns_;  // by m, each of q: 256 x 256
    std::vector<char> used_;                    // by m
};

}  // namespace shoal::water
