// shoal info --keys: every key of a scene file, as a Markdown table; docs/scene_file.md holds what it prints.
#include <cstdio>
#include <string>

#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/shadows.h>
#include <shoal/pipeline/water.h>
#include <shoal/scene/scene.h>
#include <shoal/scene/shapes.h>

#include "verbs.h"

namespace shoal::app {

namespace {

void printTable(const std::string& title, const std::vector<FieldRow>& rows) {
    std::printf("### %s\n\n| key | unit | range | default | what it does |\n|---|---|---|---|---|\n", title.c_str());
    for (const FieldRow& row : rows) {
        std::string range;
        for (const char c : row.range) range += c == '|' ? std::string("\\|") : std::string(1, c);
        std::printf("| `%s` | %s | %s | %s | %s |\n", row.name.c_str(), row.unit.c_str(), range.c_str(),
                    row.value.c_str(), row.sentence.c_str());
    }
    std::printf("\n");
}

}  // namespace

int printKeys() {
    printTable("[camera]", describe(scene::CameraSpec{}));
    printTable("[camera] orbit = { ... }", describe(scene::OrbitSpec{}));
    printTable("[camera] path = [ { ... }, ... ]", describe(scene::CameraKey{}));
    printTable("[camera] intrinsics = { ... }", describe(scene::IntrinsicsSpec{}));
    printTable("[sun]", describe(scene::SunSpec{}));
    printTable("[environment]", describe(scene::EnvironmentSpec{}));
    printTable("[[light]]", describe(scene::LightSpec{}));
    printTable("[[model]]", describe(scene::ModelSpec{}));
    printTable("[[model]] copies = { ... }", describe(scene::CopiesSpec{}));
    printTable("[[model]] and [[shape]]: where it stands", describe(scene::PlacementSpec{}));
    printTable("[render]", describe(scene::RenderSpec{}));
    printTable("[shadows]", describe(frame::ShadowParams{}));
    printTable("[lighting]", describe(frame::LightingParams{}));
    printTable("[post]", describe(frame::PostParams{}));
    printTable("[water]: the body", describe(water::BodyParams{}));
    printTable("[water]: its optics", describe(water::OpticsParams{}));
    printTable("[water] waves = { ... }", describe(water::WaveParams{}));
    printTable("[water] waves = { components = [ { ... }, ... ] }", describe(water::WaveComponentParams{}));
    printTable("[water.caustics]: photons", describe(water::PhotonParams{}));
    printTable("[water.caustics]: maps", describe(water::LightViewParams{}));
    printTable("[water.shafts]", describe(water::ShaftParams{}));
    printTable("[water.surface]", describe(water::SurfaceParams{}));
    printTable("[water.paper]", describe(water::PaperParams{}));
    for (const std::string& kind : scene::shapeNames())
        printTable("[[shape]] kind = \"" + kind + "\"", scene::describeShape(kind));
    return kDone;
}

}  // namespace shoal::app
