#include <shoal/io/file.h>

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/test_folder.h"

namespace shoal::io {
namespace {

namespace fs = std::filesystem;
using test::TestFolder;

std::string textOf(const fs::path& path) {
    const auto bytes = readFile(path);
    if (!bytes) return "error: " + bytes.error().message;
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

TEST(File, ReadsBackWhatWasWritten) {
    const TestFolder folder;
    const fs::path path = folder / "a/b/c.txt";  // makes both folders
    ASSERT_TRUE(writeFileAtomically(path, "hello"));
    EXPECT_EQ(textOf(path), "hello");
    ASSERT_TRUE(writeFileAtomically(path, "other"));
    EXPECT_EQ(textOf(path), "other");
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), fs::directory_iterator()), 1);
}

TEST(File, SaysWhyItCannotRead) {
    const TestFolder folder;
    std::ofstream(folder / "empty").close();
    EXPECT_EQ(readFile(folder / "missing").error().message, (folder / "missing").string() + ": no such file");
    EXPECT_NE(readFile(folder.path()).error().message.find("is a folder"), std::string::npos);
    EXPECT_NE(readFile(folder / "empty").error().message.find("is empty"), std::string::npos);
    EXPECT_NE(readFile("").error().message.find("is empty"), std::string::npos);
    EXPECT_NE(readFile("/dev/null").error().message.find("not a plain file"), std::string::npos);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_NE(readFile(folder / "pipe").error().message.find("not a plain file"), std::string::npos);
    EXPECT_EQ(readFile(folder / "missing").error().kind, ErrorKind::badInput);
}

TEST(File, RefusesFilesBeyondTheLimit) {
    const TestFolder folder;
    std::ofstream(folder / "large").close();
    fs::resize_file(folder / "large", kFileSizeLimit + 1);  // takes no disk
    EXPECT_NE(readFile(folder / "large").error().message.find("4 GiB"), std::string::npos);
}

TEST(File, SaysWhyItCannotWrite) {
    const TestFolder folder;
    ASSERT_TRUE(writeFileAtomically(folder / "file", "x"));
    const auto under = writeFileAtomically(folder / "file/sub/f.png", "y");
    ASSERT_FALSE(under);
    EXPECT_NE(under.error().message.find((folder / "file").string() + " is not a folder"), std::string::npos)
        << under.error().message;
    EXPECT_NE(writeFileAtomically(folder.path(), "y").error().message.find("is a folder"), std::string::npos);
    EXPECT_NE(writeFileAtomically(folder / "new/", "y").error().message.find("folder"), std::string::npos);
    EXPECT_NE(writeFileAtomically("/dev/null", "y").error().message.find("not a plain file"), std::string::npos);
    EXPECT_NE(writeFileAtomically("/proc/nothing/f", "y").error().message.find("cannot make the folder"),
              std::string::npos);
    EXPECT_EQ(textOf(folder / "file"), "x");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(File, KeepsTheOldFileUntilCommitted) {
    const TestFolder folder;
    const fs::path path = folder / "f.bin";
    ASSERT_TRUE(writeFileAtomically(path, "old"));
    {
        auto file = AtomicFile::open(path);
        ASSERT_TRUE(file);
        EXPECT_EQ(file->temporaryPath().parent_path(), path.parent_path());
        EXPECT_EQ(file->temporaryPath().extension(), path.extension());
        std::ofstream(file->temporaryPath()) << "half of the new";
        EXPECT_EQ(textOf(path), "old");
    }
    EXPECT_EQ(textOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1u);
    auto first = AtomicFile::open(path), second = AtomicFile::open(path);  // two writers at once
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->temporaryPath(), second->temporaryPath());
    std::ofstream(first->temporaryPath()) << "1";
    std::ofstream(second->temporaryPath()) << "2";
    ASSERT_TRUE(first->commit());
    ASSERT_TRUE(second->commit());
    EXPECT_EQ(textOf(path), "2");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(File, KeepsLinksAndPermissions) {
    const TestFolder folder;
    ASSERT_TRUE(writeFileAtomically(folder / "real", "old"));
    fs::permissions(folder / "real", fs::perms(0640));
    fs::create_symlink("real", folder / "link");
    ASSERT_TRUE(writeFileAtomically(folder / "link", "new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(textOf(folder / "real"), "new");
    EXPECT_EQ(fs::status(folder / "real").permissions(), fs::perms(0640));
}

TEST(File, ExtensionsComeInSmallLetters) {
    EXPECT_EQ(lowerExtension("out/F.EXR"), ".exr");
    EXPECT_EQ(lowerExtension("a.tar.Gz"), ".gz");
    EXPECT_EQ(lowerExtension("folder.d/name"), "");
}

}  // namespace
}  // namespace shoal::io
