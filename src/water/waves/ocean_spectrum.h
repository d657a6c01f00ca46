// How the energy of wind waves is spread over wave vectors.
#pragma once

#include <shoal/water/waves.h>

namespace shoal::water {

inline constexpr double kGravity = 9.80665;  // m/s2

class OceanSpectrum {
public:
    explicit OceanSpectrum(const WaveParams& params);

    // m^4: integrates over all (kx, kz) in 1/m to the variance of the height, m2.
    double density(double kx, double kz) const;
    // m^3: over all directions; integrates over k.
    double overDirections(double k) const;
    // Integral of overDirections from `low` to `high` 1/m: m2. weightPower 2 gives the mean square of the slope.
    double integral(double low, double high, int weightPower = 0) const;
    double peak() const { return peak_; }  // 1/m

private:
    double spreading(double k, double angle) const;  // 1/rad from the wind, integrates to 1
    bool jonswap_;
    double wind_, alpha_, peak_, spread_, gain2_, toX_, toZ_;
};

}  // namespace shoal::water
