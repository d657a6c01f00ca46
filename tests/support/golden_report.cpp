#include "support/golden_report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include <shoal/core/image.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "support/run_program.h"

namespace shoal::test {

namespace {

namespace fs = std::filesystem;

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

// The picture, or its layer, as a PNG to look at. `white` is the value shown as white: of the reference for both.
void writePreview(const fs::path& from, const std::string& layer, const fs::path& to, float& white) {
    if (from.extension() == ".png") {
        std::error_code ignored;
        fs::copy_file(from, to, fs::copy_options::overwrite_existing, ignored);
        return;
    }
    const auto layers = io::readLayers(from);
    if (!layers) return;
    const auto found = std::find_if(layers->begin(), layers->end(), [&](const Layer& l) { return l.name == layer; });
    if (found == layers->end()) return;
    const Image& image = found->image;
    if (white <= 0) {
        std::vector<float> values;
        for (const float v : image.pixels)
            if (std::isfinite(v)) values.push_back(std::abs(v));
        if (values.empty()) return;
        const auto high = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.98);
        std::nth_element(values.begin(), high, values.end());
        white = std::max(*high, 1e-6f);
    }
    Image shown(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float v = c < image.channelCount    ? image.at(x, y)[c]
                                : image.channelCount == 1 ? image.at(x, y)[0]
                                                          : 0;
                shown.at(x, y)[c] = std::pow(std::clamp(std::abs(v) / white, 0.0f, 1.0f), 1 / 2.2f);
            }
    if (!io::writePng(to, io::quantize(shown))) return;
}

std::string numberTable(const ReportPage& page) {
    std::string table = "<table><tr><th>what</th><th>rmse</th><th>expected</th><th></th></tr>\n";
    for (const ReportRow& row : page.rows)
        table += fmt::format("<tr><td>{}</td><td>{}</td><td>{} {:.4g}</td><td class={}>{}</td></tr>\n",
                             escaped(row.what), row.rmse ? fmt::format("{:.6g}", *row.rmse) : "none", row.expected,
                             row.limit, row.ok ? "ok" : "bad", row.ok ? "ok" : "FAILED");
    return table + "</table>\n";
}

std::string section(const fs::path& folder, const ReportPage& page) {
    float white = 0;
    if (!page.reference.empty())
        writePreview(page.reference, page.layer, folder / (page.name + "_reference.png"), white);
    if (!page.got.empty()) writePreview(page.got, page.layer, folder / (page.name + "_got.png"), white);
    std::error_code ignored;
    fs::copy_file(page.difference, folder / (page.name + "_difference.png"), fs::copy_options::overwrite_existing,
                  ignored);
    std::string html = fmt::format("<section><h2>{}</h2>\n", page.name);
    if (!page.reason.empty()) html += "<p>" + escaped(page.reason) + "</p>\n";
    for (const char* kind : {"reference", "got", "difference"})
        html += fmt::format("<figure><img src=\"{0}_{1}.png\" alt=\"{1}\"><figcaption>{1}{2}</figcaption></figure>\n",
                            page.name, kind, std::string(kind) == "difference" ? ", 8 times" : "");
    return html + numberTable(page) + "<pre>" + escaped(page.findings + "\n" + page.commands) + "</pre></section>\n";
}

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=en><meta charset=utf-8><title>Goldens that failed</title>\n"
    "<style>body{font:15px sans-serif;margin:2em}figure{display:inline-block;margin:0 1em 1em 0}"
    "img{width:400px;image-rendering:pixelated;background:#888}td,th{padding:0 1em 0 0;text-align:left}"
    ".bad{color:#b00;font-weight:bold}.ok{color:#080}pre{white-space:pre-wrap;background:#eee;padding:1em}</style>\n"
    "<h1>Goldens that failed</h1>\n";

}  // namespace

void writeReport(const fs::path& folder, const ReportPage& page) {
    const fs::path own = folder / (page.name + ".section");
    if (page.findings.empty() && !fs::exists(own)) return;
    fs::create_directories(folder);
    if (page.findings.empty())
        fs::remove(own);
    else if (!io::writeFileAtomically(own, section(folder, page)))
        return;
    std::vector<fs::path> sections;
    for (const auto& file : fs::directory_iterator(folder))
        if (file.path().extension() == ".section") sections.push_back(file.path());
    std::sort(sections.begin(), sections.end());
    std::string html = kHead;
    for (const fs::path& file : sections) html += readText(file);
    if (sections.empty()) html += "<p>None.</p>\n";
    if (!io::writeFileAtomically(folder / "index.html", html + "</html>\n")) return;
}

}  // namespace shoal::test
