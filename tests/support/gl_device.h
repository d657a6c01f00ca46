// A device that remembers what it logs, for tests: debug messages on, the texts at hand when a test fails.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include <shoal/gl/device.h>
#include <shoal/gl/program.h>

namespace shoal::test {

struct Messages {
    std::vector<std::string> lines;
    LogSink sink() {
        return [this](LogLevel level, std::string_view text) {
            const char* names[] = {"debug", "info", "warning", "error"};
            lines.push_back(std::string(names[int(level)]) + ": " + std::string(text));
        };
    }
    bool contains(const std::string& part) const {
        for (const std::string& line : lines)
            if (line.find(part) != std::string::npos) return true;
        return false;
    }
    std::string all() const {
        std::string out;
        for (const std::string& line : lines) out += line + '\n';
        return out;
    }
};

// Makes a device; at the end of a test nothing may live on it and no error may have been reported.
class GlTest : public ::testing::Test {
protected:
    void SetUp() override { open(""); }
    void open(const std::string& shaderDir) {
        device_.reset();
        auto made =
            gl::Device::create({.device = "auto", .log = messages.sink(), .debug = true, .shaderDir = shaderDir});
        ASSERT_TRUE(made) << made.error().message;
        device_ = *std::move(made);
    }
    void TearDown() override {
        if (!device_) return;
        // Compilers report broken shaders as errors too, each in its own number: -1 expects any.
        if (expectedErrorCount >= 0) {
            EXPECT_EQ(device_->debugErrorCount(), expectedErrorCount) << messages.all();
        }
        const std::int64_t programs = std::int64_t(device_->programs().size());
        EXPECT_EQ(device_->liveObjectCount(), programs) << "objects left alive";
        EXPECT_EQ(device_->liveBytes(), 0) << "bytes left alive";
    }
    gl::Device& device() { return *device_; }

    Messages messages;  // before the device: it logs until it is gone
    int expectedErrorCount = 0;
    std::unique_ptr<gl::Device> device_;
};

}  // namespace shoal::test
