// The histogram that automatic exposure is measured from.
#ifndef SHOAL_FRAME_EXPOSURE_SHARED_H
#define SHOAL_FRAME_EXPOSURE_SHARED_H

#ifndef __cplusplus
#include "frame/bindings.shared.h"
#endif

#define SHOAL_EXPOSURE_BINS 128
#define SHOAL_EXPOSURE_LOWEST -20.0  // log2 of the luminance of the first bin's lower end, W/(m2 sr)
#define SHOAL_EXPOSURE_STOPS_A_BIN 0.3125
#define SHOAL_EXPOSURE_STRIDE 4  // every 4th pixel of every 4th row is counted

#ifdef __cplusplus
namespace shoal::frame {
struct ExposureState {
    unsigned bins[SHOAL_EXPOSURE_BINS];
    float measured, adapted, antialiasing;
    unsigned known;
};
}  // namespace shoal::frame
#endif

#endif
