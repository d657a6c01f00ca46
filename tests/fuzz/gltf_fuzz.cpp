// libFuzzer on the glTF reader: any bytes give a model or an error, never a crash; a model can be posed.
#include <cstddef>
#include <cstdint>
#include <span>

#include <shoal/core/pose.h>
#include <shoal/io/model.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto model = shoal::io::readGltf(std::as_bytes(std::span(data, size)), {}, "fuzz.glb");
    if (!model) return 0;
    shoal::Pose pose;
    for (int clip = -1; clip < int(model->clips.size()); ++clip) shoal::poseModel(*model, clip, 0.3f, true, pose);
    (void)shoal::posedBounds(*model, pose);
    return 0;
}
