// Named waters: [Jerlov 1976] types by their inherent and apparent properties, and pure water.
// Channels stand for 640, 545 and 450 nm: there pure water absorbs what the table below gives for the clearest type.
#include <array>

#include <shoal/water/optics.h>

namespace shoal::water {
namespace {

constexpr const char* kJerlov =
    "a, b: Path Tracing in Production: The Path of Water (SIGGRAPH 2023); Kd: Jerlov, Marine Optics (1976), table "
    "XXVII, 640 and 545 nm between its rows";
constexpr const char* kJerlovRed =
    "as the other types, but red a between 1C and 7C at the same Kd and red b 0.74 of green, as in the other coastal "
    "types: the tabulated red is above Kd";
constexpr const char* kPure =
    "a: Pope & Fry 1997; b: Morel 1974 for sea water, 0.00193 (550 nm / wavelength)^4.32; Kd = a + b / 2, Smith & "
    "Baker 1981";

// Between two rows of Jerlov's table.
constexpr float between(double a, double b, double t) { return float(a + (b - a) * t); }
// Kd at 625, 650; 525, 550; 450 nm.
constexpr Vec3 kd(double r625, double r650, double g525, double g550, double b450) {
    return {between(r625, r650, 0.6), between(g525, g550, 0.8), float(b450)};
}

}  // namespace

const std::vector<NamedMedium>& namedMedia() {
    static const std::vector<NamedMedium> media = [] {
        const Vec3 kd1 = kd(0.37, 0.45, 0.13, 0.12, 0.25), kd3 = kd(0.40, 0.46, 0.20, 0.19, 0.39);
        const Vec3 kd5 = kd(0.48, 0.54, 0.31, 0.30, 0.56), kd7 = kd(0.54, 0.63, 0.49, 0.46, 0.89);
        const float red1 = 0.316f, red7 = 0.351f;
        const auto redOf = [&](Vec3 k) { return red1 + (red7 - red1) * (k.x - kd1.x) / (kd7.x - kd1.x); };
        const Vec3 pureA{0.3128f, 0.0512f, 0.0091f}, pureB{0.00100f, 0.00201f, 0.00459f};
        return std::vector<NamedMedium>{
            {"clear", {}, {}, {}, "neither absorbs nor scatters"},
            {"pure", pureA, pureB, pureA + pureB * 0.5f, kPure},
            {"jerlov-I", {.309f, .053f, .009f}, {.001f, .002f, .004f}, kd(.305, .36, .043, .063, .019), kJerlov},
            {"jerlov-IA", {.309f, .054f, .014f}, {.002f, .004f, .007f}, kd(.31, .37, .048, .067, .026), kJerlov},
            {"jerlov-IB", {.309f, .054f, .015f}, {.045f, .054f, .070f}, kd(.315, .375, .054, .072, .036), kJerlov},
            {"jerlov-II", {.310f, .054f, .016f}, {.270f, .365f, .516f}, kd(.335, .40, .076, .089, .068), kJerlov},
            {"jerlov-III", {.310f, .056f, .031f}, {.737f, .998f, 1.413f}, kd(.375, .445, .116, .12, .135), kJerlov},
            {"jerlov-1C", {.316f, .067f, .105f}, {.274f, .372f, .526f}, kd1, kJerlov},
            {"jerlov-3C", {redOf(kd3), .052f, .161f}, {.74f * 1.071f, 1.071f, 1.532f}, kd3, kJerlovRed},
            {"jerlov-5C", {redOf(kd5), .222f, .216f}, {.74f * 1.382f, 1.382f, 1.857f}, kd5, kJerlovRed},
            {"jerlov-7C", {.351f, .188f, .574f}, {1.772f, 2.394f, 3.376f}, kd7, kJerlov},
            {"jerlov-9C", {.398f, .349f, .995f}, {2.347f, 3.180f, 4.496f}, kd(.65, .76, .78, .63, 1.6), kJerlov},
        };
    }();
    return media;
}

}  // namespace shoal::water
