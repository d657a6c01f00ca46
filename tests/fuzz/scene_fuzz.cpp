// libFuzzer on the scene parser: any bytes give a scene or an error, never a crash.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto scene = shoal::scene::parseScene({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    if (scene && scene->cameraKind != shoal::scene::CameraKind::modelCamera &&
        scene->cameraKind != shoal::scene::CameraKind::poses)
        (void)shoal::scene::cameraAt(*scene, {}, 1.0f, 1.5f);
    return 0;
}
