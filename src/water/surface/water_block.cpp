#include "water/surface/water_block.h"

#include <shoal/gl/shaders.h>

#include "gl/embedded_shader.h"

namespace shoal::water {
namespace {

Vec4 with(Vec3 v, float w) { return {v.x, v.y, v.z, w}; }

}  // namespace

void registerWaterShaders() { gl::registerShaders(embeddedShaders()); }

WaterBlock makeWaterBlock(const Body& body, const BodyLights& lights) {
    const Optics& optics = body.optics;
    WaterBlock block;
    const float height = body.waves ? float(body.waves->bounds().height) : 0.0f;
    block.shape = {body.params.level, optics.index, body.params.surfaceVisible ? 1.0f : 0.0f, height};
    block.area = {body.params.areaMin.x, body.params.areaMin.y, body.params.areaMax.x, body.params.areaMax.y};
    const Vec3 beam = optics.beamAttenuation();
    block.beamAttenuation = with(beam, std::min({beam.x, beam.y, beam.z}));
    block.beamScattering = with(optics.beamScattering(), 0);
    block.diffuseAttenuation = with(optics.diffuseAttenuation, 0);
    block.scattering = with(optics.scattering, 0);
    block.phase = phaseVector(optics);
    block.skyIrradiance = with(lights.skyIrradiance, 0);

    Vec3 toSun{0, 1, 0};
    bool shines = false;
    if (lights.sun) {
        const Vec3 direction = normalize(lights.sun->toSun);
        shines = direction.y > 0;
        if (shines) toSun = direction;
    }
    block.toSun = with(toSun, shines ? 1.0f : 0.0f);
    block.sunIrradiance = shines ? with(lights.sun->irradiance, 0) : Vec4{};
    const double index = double(optics.index), horizontal = double(std::sqrt(std::max(1 - toSun.y * toSun.y, 0.0f)));
    const double cosRefracted = std::sqrt(1 - horizontal * horizontal / (index * index));
    block.sunRefracted = {-toSun.x / optics.index, -float(cosRefracted), -toSun.z / optics.index,
                          float(fresnelTransmittance(double(toSun.y), index))};
    block.sunDiffuseAttenuation = with(diffuseAttenuationAt(optics, cosRefracted), 0);
    return block;
}

}  // namespace shoal::water
