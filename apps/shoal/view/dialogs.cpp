// Open, save, screenshot: one small window with a path, and for open the files beside it.
#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

#include <shoal/io/file.h>
#include <shoal/io/model.h>

#include "view/layout.h"

namespace shoal::viewer {

namespace {

namespace fs = std::filesystem;

std::string path, problem;
bool windowSize = true;
Dialog shown = Dialog::none;

bool canOpen(const fs::path& file) {
    const std::string extension = io::lowerExtension(file);
    return extension == ".toml" || extension == ".hdr" || extension == ".exr" || io::isModelFile(file);
}

void prepare(Viewer& v) {
    shown = v.dialog;
    problem.clear();
    const fs::path file = fs::absolute(v.document.file()).lexically_normal();
    if (shown == Dialog::open) path = file.parent_path().string() + "/";
    if (shown == Dialog::save)
        path = ((v.document.isSceneFile() ? file.parent_path() : fs::current_path()) / file.stem()).string() +
               "_view.toml";
    if (shown == Dialog::screenshot) path = (fs::current_path() / file.stem()).string() + ".png";
}

// The folder of what is typed, to click through; returns a file that was chosen.
std::string drawFolder() {
    std::error_code error;
    fs::path folder = fs::path(path);
    if (!fs::is_directory(folder, error)) folder = folder.parent_path();
    std::string chosen;
    ImGui::BeginChild("files", {ImGui::GetFontSize() * 40, ImGui::GetFontSize() * 18}, true);
    if (folder.has_parent_path() && ImGui::Selectable(".."))
        path = folder.lexically_normal().parent_path().parent_path().string() + "/";
    std::vector<fs::path> folders, files;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().filename().string().rfind('.', 0) == 0) continue;
        std::error_code ignored;
        if (it->is_directory(ignored))
            folders.push_back(it->path());
        else if (canOpen(it->path()))
            files.push_back(it->path());
    }
    std::sort(folders.begin(), folders.end());
    std::sort(files.begin(), files.end());
    for (const fs::path& f : folders)
        if (ImGui::Selectable((f.filename().string() + "/").c_str())) path = f.string() + "/";
    for (const fs::path& f : files)
        if (ImGui::Selectable(f.filename().string().c_str())) chosen = f.string();
    ImGui::EndChild();
    return chosen;
}

// Does what the dialog is for; true when it is done with.
bool act(Viewer& v) {
    if (shown == Dialog::open) {
        v.openFiles({path});
        return true;
    }
    const auto done = shown == Dialog::save ? v.saveScene(path, windowSize) : v.screenshot(path);
    if (!done) problem = done.error().message;
    return done.has_value();
}

}  // namespace

void drawDialogs(Viewer& v) {
    if (v.dialog == Dialog::none) {
        shown = Dialog::none;
        return;
    }
    const bool fresh = v.dialog != shown;
    if (fresh) prepare(v);
    const char* title = shown == Dialog::open ? "Open" : shown == Dialog::save ? "Save scene" : "Screenshot";
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.4f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    bool open = true;
    ImGui::Begin(title, &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 40);
    if (fresh) ImGui::SetKeyboardFocusHere();
    bool go =
        ImGui::InputText("##path", &path, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    notePlace(v.places, "dialog:path");
    if (shown == Dialog::open) {
        const std::string chosen = drawFolder();
        if (!chosen.empty()) path = chosen, go = true;
    }
    if (shown == Dialog::save) ImGui::Checkbox("picture size of this window", &windowSize);
    if (shown == Dialog::screenshot) ImGui::TextDisabled(".png or .jpg: the picture; .exr: radiance and every buffer");
    if (ImGui::Button(shown == Dialog::open ? "Open" : "Save")) go = true;
    notePlace(v.places, "dialog:ok");
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) open = false;
    if (!problem.empty()) {
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 40);
        ImGui::TextUnformatted(problem.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
    if (go && act(v)) open = false;
    if (!open) v.dialog = shown = Dialog::none;
}

}  // namespace shoal::viewer
