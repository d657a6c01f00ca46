// How far two pictures are apart. What `shoal compare` prints and the golden tests decide by.
#pragma once

#include <shoal/core/image.h>
#include <shoal/core/result.h>

namespace shoal {

struct Comparison {
    double rmse = 0;           // root of the mean squared difference over all channels (linear units of the pictures)
    double psnr = 0;           // dB against peak 1 (LDR) or the reference's largest value (HDR); infinity when equal
    double ssim = 1;           // mean structural similarity of the luminance, 8x8 Gaussian windows [Wang et al. 2004]
    double largest = 0;        // largest absolute difference of any channel
    int largestX = 0, largestY = 0;
    double meanA = 0, meanB = 0;
    std::size_t differingPixels = 0;   // pixels with any different bit
    std::size_t nonFinite = 0;         // NaN or infinite channel values in either; a comparison with any is a failed one
};

// Compares pictures of equal size and channel count; an error names both sizes where they differ.
Result<Comparison> compare(const Image& a, const Image& b);
// |a - b| times gain, as a picture.
Image differenceImage(const Image& a, const Image& b, float gain);

}  // namespace shoal
