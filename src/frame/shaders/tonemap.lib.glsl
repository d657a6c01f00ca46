// From exposed linear Rec.709 radiance to display values in [0, 1]. Compiled by C++ too.
// Sources:
//   AgX, T. Sobotka, github.com/sobotka/AgX: the inset matrix, the range of 16.5 stops around middle grey and the
//   contrast curve (a sigmoid with slope 2 and powers 3 and 3.25 about (20/33, 1/2)) of its OpenColorIO configuration.
//   Its display is a pure power of 2.2, so what leaves the outset matrix is a display value already.
//   IEC 61966-2-1 for sRGB.
#ifndef SHOAL_FRAME_TONEMAP_LIB_GLSL
#define SHOAL_FRAME_TONEMAP_LIB_GLSL

#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

SHOAL_FUNCTION float srgbEncode(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}
SHOAL_FUNCTION vec3 srgbEncode(vec3 c) { return vec3(srgbEncode(c.x), srgbEncode(c.y), srgbEncode(c.z)); }

// One channel of the contrast curve: x is log radiance over the range, in [0, 1]. The sigmoid's own powers cost
// llvmpipe 2 ms of a picture of 1280x720; two polynomials (minimax, slope 2 at the pivot) keep within 1.1e-4 of it.
SHOAL_FUNCTION float agxContrast(float x) {
    const float pivot = 20.0f / 33.0f;
    float t = x - pivot;
    bool toe = t < 0.0f;
    float q = toe ? 429.8201f : 2571.153f;
    q = q * t + (toe ? 1182.815f : -3874.571f);
    q = q * t + (toe ? 1299.269f : 2113.563f);
    q = q * t + (toe ? 704.0126f : -446.0986f);
    q = q * t + (toe ? 178.7774f : 13.35252f);
    q = q * t + (toe ? 11.95983f : -1.05212f);
    q = q * t + (toe ? 0.3647819f : 0.007735556f);
    return 0.5f + t * (2.0f + t * q);
}

SHOAL_FUNCTION vec3 agx(vec3 radiance) {
    const mat3 inset = mat3(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f,
                            0.0784335999999992f, 0.878468636469772f, 0.0784336f,
                            0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const mat3 outset = mat3(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f,
                             -0.0980208811401368f, 1.15190312990417f, -0.0980434501171241f,
                             -0.0990297440797205f, -0.0989611768448433f, 1.15107367264116f);
    const float least = -12.473931f;   // log2(0.18) - 10
    const float range = 16.5f;
    vec3 stops = (log2(max(inset * radiance, vec3(1e-10f))) - least) / range;
    vec3 x = clamp(stops, vec3(0.0f), vec3(1.0f));
    return outset * vec3(agxContrast(x.x), agxContrast(x.y), agxContrast(x.z));
}

// Exposed radiance to display values by each curve. Negative and over-bright results are clipped.
SHOAL_FUNCTION vec3 displayByNone(vec3 radiance) { return clamp(radiance, vec3(0.0f), vec3(1.0f)); }
SHOAL_FUNCTION vec3 displayByPlain(vec3 radiance) { return srgbEncode(clamp(radiance, vec3(0.0f), vec3(1.0f))); }
SHOAL_FUNCTION vec3 displayByAgx(vec3 radiance) {
    return clamp(agx(max(radiance, vec3(0.0f))), vec3(0.0f), vec3(1.0f));
}

// Saturation and contrast of display values; contrast turns about middle grey.
SHOAL_FUNCTION vec3 applyLook(vec3 display, float saturation, float contrast) {
    float grey = dot(display, vec3(0.2126f, 0.7152f, 0.0722f));
    vec3 c = vec3(grey) + (display - vec3(grey)) * saturation;
    c = (c - 0.46f) * contrast + 0.46f;
    return clamp(c, vec3(0.0f), vec3(1.0f));
}

// Noise in [0, 1) of a pixel with little energy in low frequencies: interleaved gradient noise [Jimenez 2014].
SHOAL_FUNCTION float interleavedNoise(vec2 pixel) {
    return fract(52.9829189f * fract(0.06711056f * pixel.x + 0.00583715f * pixel.y));
}

#endif
