// How far two pictures are apart. What `shoal compare` prints and the golden tests decide by.
#pragma once

#include <shoal/core/image.h>
#include <shoal/core/result.h>

namespace shoal {

struct Comparison {
    double rmse = 0;  // root of the mean squared difference over all channels (linear units of the pictures)
    double psnr = 0;  // dB against peak 1, or the largest value of b where that is more (HDR); infinity when equal
    // Mean structural similarity of the luminance [Wang et al. 2004]: 11x11 Gaussian windows of sigma 1.5 with the
    // paper's constants, over the pixels whose window lies inside (in pictures smaller than 11x11 over all pixels, with
    // windows cut at the border). The range L is 1, or the 99th percentile of b's luminance where that is more: one
    // bright sun must not hide the rest. Luminance is the channel of a grey picture, the mean of two channels, Rec.709
    // of more.
    double ssim = 1;
    double largest = 0;  // largest absolute difference of any channel
    int largestX = 0, largestY = 0;
    double meanA = 0, meanB = 0;      // over all channels
    std::size_t differingPixels = 0;  // pixels with any different bit
    std::size_t nonFinite = 0;        // NaN or infinite channel values in either; a comparison with any is a failed one
};

// Compares picture a with the reference b, of equal size and channel count; an error names both sizes where they
// differ. Non-finite values are counted and otherwise left out. Same bits for any thread count.
Result<Comparison> compare(const Image& a, const Image& b);
// |a - b| times gain, as a picture to look at. A difference in alpha (the last of two or four channels) would be
// invisible as alpha: it goes into the colours, and the result has one channel less. Where only one value or both are
// not finite and their bits differ: gain. Sizes and channel counts must be equal.
Image differenceImage(const Image& a, const Image& b, float gain);

}  // namespace shoal
