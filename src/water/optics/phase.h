// Scattering functions of water in double precision.
#pragma once

namespace shoal::water {

struct FournierForand {
    double index = 1.1, slope = 3.5835;  // n and mu
    // 1/sr, not scaled. sine2: sin^2 of half the angle, in (0, 1].
    double at(double sine2) const;
    // Fraction scattered by more than 90 degrees, in closed form.
    double backscatter() const;
};
// The member of the family n = 1.01 + 0.1542 (mu - 3) that fits measured functions [Mobley et al. 2002] with this
// fraction scattered backwards, in [0.0001, 0.2].
FournierForand fournierForandOf(double backscatter);

// Integrals of `function` with sine2 held at `peak` at least.
struct PhaseMoments {
    double total = 0;       // over the sphere
    double meanCosine = 0;  // of light so scattered
};
PhaseMoments momentsOf(const FournierForand& function, double peak);
// The peak for which a share `rest` in (0, 1) of all scattered light is left [Potter 1970].
double peakThatLeaves(const FournierForand& function, double rest);

}  // namespace shoal::water
