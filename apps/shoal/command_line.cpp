// Reads the command line. Every unknown verb or option is answered with the nearest known one and exit code 2.
#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>

#include <shoal/core/params.h>
#include <shoal/pipeline/pipeline.h>
#include <shoal_build_info.h>

#include "completion.h"
#include "verbs.h"

namespace shoal::app {

namespace {

constexpr const char* kDeviceHelp = "auto (a GPU, else the CPU), gpu, cpu, or a name that `shoal info --devices` lists";

std::string aovHelp() {
    std::string help = "AOV layers of an .exr, separated by commas, or all:";
    for (const pipeline::AovInfo& aov : pipeline::aovs()) help += std::string(" ") + aov.name;
    return help;
}

std::string aovTable() {
    std::string table = "AOVs:\n";
    for (const pipeline::AovInfo& aov : pipeline::aovs()) {
        char line[200];
        std::snprintf(line, sizeof line, "  %-10s %-4s %-10s %s\n", aov.name, aov.channels, aov.unit, aov.sentence);
        table += line;
    }
    return table;
}

void addRender(CLI::App& app, RenderOptions& o) {
    CLI::App* verb =
        app.add_subcommand("render", "Draws a scene, or a bare model, to a picture, numbered frames or a film");
    verb->add_option("scene", o.scene, "scene file (.toml) or model (.glb, .gltf, .obj, .fbx, ...)")->required();
    verb->add_option("-o,--output", o.output, "picture (.png .jpg .exr), with --frames numbered frames, or film (.mp4)")
        ->required();
    verb->add_option("--size", o.size, "WIDTHxHEIGHT in pixels; default: the scene's, 1280x720");
    verb->add_option("--time", o.time, "scene time in seconds of a still, or of frame 0");
    verb->add_option("--frames", o.frames, "FIRST:END, half open: frames FIRST to END - 1");
    verb->add_option("--fps", o.fps, "frames a second; default: the scene's, 30");
    verb->add_option("--samples", o.samples, "samples a pixel of supersampling; default: the scene's, 4");
    verb->add_option("--antialiasing", o.antialiasing,
                     "none, supersample or temporal; default: the scene's, supersample");
    verb->add_option("--aov", o.aovs, aovHelp());
    verb->add_option("--poses", o.posesFile, "writes the camera pose of every frame to this CSV");
    verb->add_option("--set", o.sets,
                     "key=value: overrides a value of the scene, such as camera.fovDeg=40; may be repeated")
        ->take_all()
        ->expected(1);
    verb->add_option("--seed", o.seed, "seed of every random choice; default: the scene's");
    verb->add_option("--device", o.device, kDeviceHelp);
    verb->add_option("--threads", o.threads,
                     "threads of our own loops, 0 for all cores; the picture is the same for any")
        ->check(CLI::Range(0, 1024));
    verb->add_option("--quality", o.quality, "of .jpg, 1 .. 100")->check(CLI::Range(1, 100));
    verb->add_option("--up", o.up, "up axis of a bare model: y or z; default: as its file says");
    verb->add_option("--scale", o.scale, "metres a unit of a bare model stands for; default: as its file says");
    verb->add_flag("--transparent", o.transparent, "a background of nothing (.png, .exr)");
    verb->add_flag("--quiet", o.quiet, "prints nothing but errors");
    verb->add_flag("--debug", o.debug, "OpenGL debug messages to stderr");
    verb->footer("\n" + aovTable() +
                 "\nExamples:\n"
                 "  shoal render scenes/plaza.toml -o plaza.png\n"
                 "  shoal render scenes/plaza.toml -o plaza.mp4 --frames 0:24 --size 640x360 --antialiasing temporal\n"
                 "  shoal render scenes/plaza.toml -o out/f.exr --frames 0:2 --size 640x360 --aov depth,normal --set "
                 "camera.fovDeg=40\n");
}

void addView(CLI::App& app, ViewOptions& o) {
    CLI::App* verb = app.add_subcommand("view", "Shows a scene or models in a window: look, turn, change, save");
    verb->add_option("file", o.files,
                     "scene (.toml), or models (.glb, .gltf, .obj, ...) and an environment (.hdr, .exr); default: a "
                     "shipped scene");
    verb->add_option("--set", o.sets, "key=value: overrides a value of the scene; may be repeated")
        ->take_all()
        ->expected(1);
    verb->add_option("--size", o.size, "WIDTHxHEIGHT of the window; default 1280x720");
    verb->add_option("--ui-scale", o.uiScale, "size of text and panels, 0.5 .. 4; default: as the screen says")
        ->check(CLI::Range(0.5, 4.0));
    verb->add_option("--device", o.device, "auto, or cpu for the software renderer")
        ->check(CLI::IsMember({"auto", "cpu"}));
    verb->add_option("--script", o.script, "does what this file says instead of a person (docs/viewer.md)");
    verb->add_flag("--debug", o.debug, "OpenGL debug messages to stderr");
    verb->footer(
        "\nF1 in the window lists the keys.\n\nExamples:\n  shoal view scenes/plaza.toml\n"
        "  shoal view scenes/plaza.toml --set post.exposureEv=1 --size 960x540\n");
}

void addInfo(CLI::App& app, InfoOptions& o) {
    CLI::App* verb = app.add_subcommand("info", "Tells what is in a file, or what can draw on this machine");
    verb->add_option("file", o.files, "models, scenes, pictures, assets, camera poses");
    verb->add_flag("--devices", o.devices, "lists what can draw here");
    verb->add_flag("--keys", o.keys, "every key of a scene file, with unit, range and default (Markdown)");
    verb->footer("\nExamples:\n  shoal info scenes/plaza.toml\n  shoal info --devices\n");
}

void addCompare(CLI::App& app, CompareOptions& o) {
    CLI::App* verb =
        app.add_subcommand("compare", "Tells how far two pictures are apart; exit code 1 when a limit is passed");
    verb->add_option("a", o.a, "picture")->required();
    verb->add_option("b", o.b, "picture it is compared with (the reference)")->required();
    verb->add_option("--layer", o.layer, "layer of an .exr that is compared instead of the picture, such as depth");
    verb->add_option("--max-rmse", o.maxRmse, "fails above this root mean square difference");
    verb->add_option("--min-psnr", o.minPsnr, "fails below this peak signal to noise ratio, dB");
    verb->add_option("--min-ssim", o.minSsim, "fails below this mean structural similarity");
    verb->add_option("--max-error", o.maxError, "fails above this largest difference of any channel");
    verb->add_option("-o,--difference", o.differenceFile, "writes the absolute difference as a picture (.png, .exr)");
    verb->add_option("--gain", o.gain, "times the difference in that picture; default 4");
    verb->footer("\nExample:\n  shoal compare a.png b.png --max-rmse 0.01 -o difference.png\n");
}

void addCompletion(CLI::App& app, std::string& shell) {
    CLI::App* verb = app.add_subcommand("completion", "Prints what makes a shell complete verbs and options");
    verb->add_option("shell", shell, "bash, zsh or fish")->required();
    verb->footer("\nExample:\n  shoal completion bash\n");
}

// The words an option may be, for those that have few.
std::vector<std::string> wordsOf(const std::string& option) {
    if (option == "--device") return {"auto", "gpu", "cpu"};
    if (option == "--antialiasing") return {"none", "supersample", "temporal"};
    if (option == "--up") return {"y", "z"};
    if (option != "--aov") return {};
    std::vector<std::string> words = {"all"};
    for (const pipeline::AovInfo& aov : pipeline::aovs()) words.push_back(aov.name);
    return words;
}

std::vector<VerbWords> wordsOf(const CLI::App& app) {
    std::vector<VerbWords> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        VerbWords words{verb->get_name(), verb->get_description(), {}};
        for (const CLI::Option* option : verb->get_options()) {
            if (option->get_positional()) continue;
            OptionWords one{{}, option->get_description(), option->get_items_expected_max() > 0, {}};
            for (const std::string& name : option->get_lnames()) {
                one.names.push_back("--" + name);
                one.values = wordsOf("--" + name);
            }
            for (const std::string& name : option->get_snames()) one.names.push_back("-" + name);
            words.options.push_back(std::move(one));
        }
        verbs.push_back(std::move(words));
    }
    return verbs;
}

int completion(const std::string& shell, const CLI::App& app) {
    const auto script = completionScript(shell, wordsOf(app));
    if (!script) return report(script.error());
    std::fputs(script->c_str(), stdout);
    return kDone;
}

void addReference(CLI::App& app, ReferenceVerbOptions& o) {
    CLI::App* verb = app.add_subcommand(
        "reference", "Computes the slow double-precision answer that the real-time pictures are checked against");
    verb->add_option("scene", o.scene, "scene file (.toml) with [water]")->required();
    verb->add_option("-o,--output", o.output, "layers caustics and inscatter, 32-bit (.exr)")->required();
    verb->add_option("--aov", o.aovs,
                     "caustics (W/m2 that refracted light puts on the first surface), inscatter (W/(m2 sr) scattered "
                     "once towards the eye), or both, separated by commas; default both");
    verb->add_option("--rays", o.rays,
                     "from each light; default 64000000. Noise falls with its root; inscatter takes 30 bytes a ray")
        ->check(CLI::Range(1LL, 100'000'000'000LL));
    verb->add_option("--steps", o.steps, "inscatter: points along a view ray; default 512")
        ->check(CLI::Range(1, 1'000'000));
    verb->add_option("--sub-pixels", o.subPixels, "inscatter: view rays a pixel's side; default 1")
        ->check(CLI::Range(1, 64));
    verb->add_option("--size", o.size, "WIDTHxHEIGHT in pixels; default: the scene's, 1280x720");
    verb->add_option("--time", o.time, "scene time in seconds");
    verb->add_option("--set", o.sets, "key=value: overrides a value of the scene; may be repeated")
        ->take_all()
        ->expected(1);
    verb->add_option("--seed", o.seed, "seed of every random choice; default: the scene's");
    verb->add_option("--threads", o.threads, "threads, 0 for all cores; the picture is the same for any")
        ->check(CLI::Range(0, 1024));
    verb->add_flag("--quiet", o.quiet, "prints nothing but errors");
    verb->footer(
        "\nThe surface of the water is not seen: both layers are along straight lines from the eye, as the AOVs of\n"
        "`shoal render` with [water] surfaceVisible = false. Not in it: light of the sky, light scattered twice, "
        "light\n"
        "that the surface reflects, holes of masked materials.\n"
        "\nExample:\n"
        "  shoal reference scenes/tank.toml -o tank.exr --size 160x90 --rays 1000000 --steps 64 --set "
        "water.level=1.4\n");
}

void addDemo(CLI::App& app, DemoOptions& o) {
    CLI::App* verb =
        app.add_subcommand("demo", "Draws the shipped scenes and prints what was drawn, how fast and where");
    verb->add_option("-o,--output", o.folder, "folder for the pictures; default shoal_demo");
    verb->add_option("--size", o.size, "WIDTHxHEIGHT in pixels; default: the scenes'");
    verb->add_option("--device", o.device, kDeviceHelp);
    verb->add_flag("--film", o.film, "a film of each scene too");
    verb->footer("\nExample:\n  shoal demo -o pictures --size 320x180\n");
}

void addBench(CLI::App& app, BenchOptions& o) {
    CLI::App* verb = app.add_subcommand("bench", "Measures every number this project claims");
    verb->add_option("name", o.names, "groups or rows: frame, frame.startup_ms; default: all");
    verb->add_flag("--peers", o.peers, "runs what users would take instead in the same run");
    verb->add_flag("--list", o.list, "names the rows and what they mean");
    verb->add_option("--json", o.jsonFile, "writes the rows to this file");
    verb->add_option("--repetitions", o.repetitions,
                     "interleaved repetitions, at least 7 for a figure that is quoted; default 7")
        ->check(CLI::Range(1, 1000));
    verb->add_option("--config", o.config,
                     "water: only the row of this configuration of the paper: paper-a, paper-b, paper-c, paper-d");
    verb->add_option("--data", o.dataDir, "folder with models to measure on; default: SHOAL_DATA, else ../shared/data");
    verb->add_option("--device", o.device, kDeviceHelp);
    verb->footer("\nExample:\n  shoal bench frame.startup_ms --repetitions 1\n");
}

const CLI::App* findVerb(const CLI::App& app, const std::string& name) {
    const auto found = app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
    return found.empty() ? nullptr : found[0];
}

std::vector<std::string> verbNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(verb->get_name());
    return names;
}

// The first word that begins with "-" and is no option of the verb, in words; "" where there is none.
std::string unknownOption(const CLI::App& app, int argc, char** argv) {
    const CLI::App* verb = argc > 1 ? findVerb(app, argv[1]) : nullptr;
    const CLI::App& owner = verb ? *verb : app;
    std::vector<std::string> known;
    for (const CLI::Option* option : owner.get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        for (const std::string& name : option->get_snames()) known.push_back("-" + name);
    }
    for (int i = verb ? 2 : 1; i < argc; ++i) {
        std::string word = argv[i];
        if (word == "--") break;
        if (word.size() < 2 || word[0] != '-' || std::isdigit(static_cast<unsigned char>(word[1])) || word[1] == '.')
            continue;
        if (word.rfind("--", 0) == 0)
            word = word.substr(0, word.find('='));
        else
            word = word.substr(0, 2);
        if (std::find(known.begin(), known.end(), word) == known.end()) return unknownWord("option", word, known);
    }
    return "";
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app(
        "Shoal draws light in water, crowds, liquids and scanned volumes in real time, on a GPU or a CPU, with or "
        "without a screen.",
        "shoal");
    app.set_version_flag("--version", std::string("shoal ") + SHOAL_VERSION + " (" + SHOAL_COMMIT + ")");
    app.require_subcommand(0, 1);
    app.footer(
        "\n`shoal VERB --help` tells more. Exit codes: 0 done, 1 a comparison failed, 2 usage, 3 bad input or "
        "unwritable output,\n"
        "4 no usable device.\n\nExample:\n  shoal render scenes/plaza.toml -o plaza.png\n");
    RenderOptions renderOptions;
    ViewOptions viewOptions;
    InfoOptions infoOptions;
    CompareOptions compareOptions;
    ReferenceVerbOptions referenceOptions;
    DemoOptions demoOptions;
    BenchOptions benchOptions;
    addRender(app, renderOptions);
    addView(app, viewOptions);
    addInfo(app, infoOptions);
    addCompare(app, compareOptions);
    addReference(app, referenceOptions);
    addDemo(app, demoOptions);
    addBench(app, benchOptions);
    std::string shell;
    addCompletion(app, shell);

    if (argc < 2) {
        std::fputs(app.help().c_str(), stderr);
        return kUsage;
    }
    if (argv[1][0] != '-' && !findVerb(app, argv[1]))
        return report(usageError(unknownWord("verb", argv[1], verbNames(app))));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        const std::string unknown = unknownOption(app, argc, argv);
        return report(usageError(unknown.empty() ? std::string(e.what()) : unknown));
    }
    const std::string verb = app.get_subcommands().empty() ? "" : app.get_subcommands()[0]->get_name();
    if (verb == "render") return render(renderOptions);
    if (verb == "view") return view(viewOptions);
    if (verb == "info") return info(infoOptions);
    if (verb == "compare") return compare(compareOptions);
    if (verb == "reference") return reference(referenceOptions);
    if (verb == "demo") return demo(demoOptions);
    if (verb == "bench") return bench(benchOptions);
    if (verb == "completion") return completion(shell, app);
    std::fputs(app.help().c_str(), stderr);
    return kUsage;
}

}  // namespace shoal::app

int main(int argc, char** argv) { return shoal::app::runCommandLine(argc, argv); }
