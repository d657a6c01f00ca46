#include "view/style.h"

#include <filesystem>
#include <string>

#include <imgui.h>

namespace shoal::viewer {

namespace {

ImFont* monoFont = nullptr;
Theme current = Theme::dark;

// Beside the tool (a bundle), else where Debian puts it.
std::string fontFile(const char* name) {
    std::error_code error;
    const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", error);
    for (const std::filesystem::path& folder :
         {tool.parent_path().parent_path() / "share/shoal/fonts",
          std::filesystem::path("/usr/share/fonts/truetype/dejavu"), std::filesystem::path("/usr/share/fonts/TTF")}) {
        const std::filesystem::path file = folder / name;
        if (std::filesystem::is_regular_file(file, error)) return file.string();
    }
    return "";
}

ImFont* addFont(const char* name, float sizePx) {
    static const ImWchar kRanges[] = {0x20, 0x17f, 0x370, 0x3ff, 0x2010, 0x2027, 0x2190, 0x21ff, 0x25a0, 0x25ff, 0};
    ImGuiIO& io = ImGui::GetIO();
    const std::string file = fontFile(name);
    ImFontConfig config;
    config.OversampleH = 2;
    if (!file.empty()) return io.Fonts->AddFontFromFileTTF(file.c_str(), sizePx, &config, kRanges);
    config.SizePixels = sizePx;
    return io.Fonts->AddFontDefault(&config);
}

ImVec4 rgb(int hex, float alpha = 1) {
    return {float(hex >> 16 & 255) / 255, float(hex >> 8 & 255) / 255, float(hex & 255) / 255, alpha};
}

void setColors(Theme theme) {
    const bool dark = theme == Theme::dark;
    dark ? ImGui::StyleColorsDark() : ImGui::StyleColorsLight();
    ImVec4* c = ImGui::GetStyle().Colors;
    const ImVec4 accent = dark ? rgb(0x3f8fb5) : rgb(0x1f6f96);
    const auto faded = [&](float alpha) { return ImVec4{accent.x, accent.y, accent.z, alpha}; };
    c[ImGuiCol_Text] = dark ? rgb(0xdfe3e6) : rgb(0x1b2226);
    c[ImGuiCol_TextDisabled] = dark ? rgb(0x8b959c) : rgb(0x667178);
    c[ImGuiCol_WindowBg] = dark ? rgb(0x1d2226) : rgb(0xf3f5f6);
    c[ImGuiCol_PopupBg] = dark ? rgb(0x252b30, 0.98f) : rgb(0xffffff, 0.98f);
    c[ImGuiCol_MenuBarBg] = dark ? rgb(0x171b1e) : rgb(0xe6eaec);
    c[ImGuiCol_Border] = dark ? rgb(0x363e44) : rgb(0xc9d0d4);
    c[ImGuiCol_FrameBg] = dark ? rgb(0x2c3339) : rgb(0xdfe4e7);
    c[ImGuiCol_FrameBgHovered] = dark ? rgb(0x38424a) : rgb(0xd2dade);
    c[ImGuiCol_FrameBgActive] = dark ? rgb(0x42505a) : rgb(0xc2cdd3);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_MenuBarBg];
    c[ImGuiCol_TitleBgActive] = dark ? rgb(0x28495a) : rgb(0xb9d0db);
    c[ImGuiCol_Header] = faded(0.28f);
    c[ImGuiCol_HeaderHovered] = faded(0.5f);
    c[ImGuiCol_HeaderActive] = faded(0.7f);
    c[ImGuiCol_Button] = faded(dark ? 0.35f : 0.25f);
    c[ImGuiCol_ButtonHovered] = faded(0.6f);
    c[ImGuiCol_ButtonActive] = faded(0.85f);
    c[ImGuiCol_SliderGrab] = c[ImGuiCol_CheckMark] = c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = accent;
    c[ImGuiCol_SliderGrabActive] = c[ImGuiCol_NavHighlight] = accent;
    c[ImGuiCol_Separator] = c[ImGuiCol_Border];
    c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
}

}  // namespace

void applyStyle(Theme theme, float scale) {
    current = theme;
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
    style.WindowBorderSize = 0;
    style.FramePadding = {6, 3};
    style.ItemSpacing = {8, 5};
    style.WindowPadding = {10, 8};
    style.ScrollbarSize = 12;
    style.IndentSpacing = 12;
    style.ScaleAllSizes(scale);
    setColors(theme);
}

void loadFonts(float scale) {
    addFont("DejaVuSans.ttf", 14 * scale);
    monoFont = addFont("DejaVuSansMono.ttf", 13 * scale);
}

unsigned accentColor() { return ImGui::GetColorU32(ImGuiCol_SliderGrab); }
unsigned warningColor() { return ImGui::GetColorU32(current == Theme::dark ? rgb(0xf0a35a) : rgb(0xa84a00)); }

MonoScope::MonoScope() { ImGui::PushFont(monoFont); }
MonoScope::~MonoScope() { ImGui::PopFont(); }

}  // namespace shoal::viewer
